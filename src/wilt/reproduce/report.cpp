#include "wilt/reproduce/report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "wilt/core/version.hpp"
#include "wilt/output/markup.hpp"
#include "wilt/reproduce/pictures.hpp"
#include "wilt/reproduce/report_style.hpp"

namespace wilt {
namespace {

std::string mark(Verdict verdict) {
  const char* kind = verdict == Verdict::comes_out ? "yes" : verdict == Verdict::does_not ? "no" : "none";
  const char* sign = verdict == Verdict::comes_out ? "✓" : verdict == Verdict::does_not ? "✗" : "–";
  return fmt::format("<span class=\"verdict {}\">{} {}</span>", kind, sign, verdict_text(verdict));
}

std::string grid_columns(std::size_t pictures, bool labels) {
  return fmt::format("{}repeat({}, minmax(0, 1fr))", labels ? "5.5rem " : "", pictures);
}

// Blocks as HTML.
struct BlockWriter {
  std::string operator()(const Paragraph& paragraph) const {
    return fmt::format("<p>{}</p>\n", markup_text(paragraph.text));
  }

  std::string operator()(const PictureGrid& grid) const {
    const std::size_t width = grid.rows.empty() ? 1 : grid.rows.front().pictures.size();
    const bool labels = std::any_of(grid.rows.begin(), grid.rows.end(),
                                    [](const PictureGrid::Row& row) { return !row.label.empty(); });
    std::string text = fmt::format(
        "<figure><div class=\"scroll\"><div class=\"grid\" style=\"grid-template-columns: {}\">\n",
        grid_columns(width, labels));
    if (!grid.columns.empty()) {
      if (labels) text += "<div></div>";
      for (const std::string& head : grid.columns)
        text += fmt::format("<div class=\"head\">{}</div>", markup_text(head));
      text += "\n";
    }
    for (const PictureGrid::Row& row : grid.rows) {
      if (labels) text += fmt::format("<div class=\"label\">{}</div>", markup_text(row.label));
      for (const Picture& picture : row.pictures)
        text += fmt::format("<div class=\"cell\">{}<span>{}</span></div>\n", image(picture),
                            markup_text(picture.caption));
    }
    return text + "</div></div>" + caption(grid.caption) + "</figure>\n";
  }

  std::string operator()(const PictureStrips& strips) const {
    std::string text =
        "<figure><div class=\"scroll\"><div class=\"strips\">\n<div></div><div class=\"heads\">";
    for (const std::string& head : strips.columns) text += fmt::format("<span>{}</span>", markup_text(head));
    text += "</div>\n";
    for (const PictureStrips::Row& row : strips.rows)
      text += fmt::format("<div class=\"label\">{}</div><div class=\"strip\">{}</div>\n",
                          markup_text(row.label), image(row.strip));
    return text + "</div></div>" + caption(strips.caption) + "</figure>\n";
  }

  std::string operator()(const PlotBlock& plot) const {
    return fmt::format(
        "<figure class=\"plot\"><img src=\"{}\" alt=\"{}\" loading=\"lazy\"/>"
        "<figcaption>{} Numbers: <a href=\"{}\">{}</a>, script: <a "
        "href=\"{}\">{}</a>.</figcaption></figure>\n",
        plot.files.svg, markup_text(plot.alt), markup_text(plot.caption), plot.files.csv, plot.files.csv,
        plot.files.script, plot.files.script);
  }

  std::string operator()(const TableBlock& table) const {
    std::string text = fmt::format("<div class=\"scroll\"><table><caption>{}</caption>\n<thead><tr>",
                                   markup_text(table.caption));
    for (const std::string& head : table.header) text += fmt::format("<th>{}</th>", markup_text(head));
    text += "</tr></thead>\n<tbody>";
    for (const auto& row : table.rows) {
      text += "<tr>";
      for (const std::string& cell : row) text += fmt::format("<td>{}</td>", markup_text(cell));
      text += "</tr>\n";
    }
    return text + "</tbody></table></div>\n";
  }

  std::string operator()(const LegendBar& bar) const {
    std::string colours;
    for (const auto& c : kViridis) colours += fmt::format(", #{:02x}{:02x}{:02x}", c[0], c[1], c[2]);
    return fmt::format(
        "<p class=\"soft\">{}: {:.3g} <span class=\"bar\" style=\"background: linear-gradient(to "
        "right{})\"></span> "
        "{:.3g}</p>\n",
        markup_text(bar.label), bar.least, colours, bar.most);
  }

 private:
  static std::string image(const Picture& picture) {
    return fmt::format("<a href=\"{0}\"><img src=\"{0}\" alt=\"{1}\" loading=\"lazy\"/></a>", picture.file,
                       markup_text(picture.alt));
  }
  static std::string caption(const std::string& text) {
    return text.empty() ? "" : fmt::format("<figcaption>{}</figcaption>", markup_text(text));
  }
};

const Claim* find_claim(const Figure& figure, const std::string& id, const std::string& model) {
  for (const Claim& claim : figure.claims) {
    if (claim.id == id && claim.model == model) return &claim;
  }
  return nullptr;
}

std::string short_name(const Figure& figure) {
  const std::size_t digits = figure.id.find_first_of("0123456789");
  return fmt::format("{} {}", figure.id[0] == 't' ? "Table" : "Figure", figure.id.substr(digits));
}

// One row per claim, the models side by side.
std::string summary(const std::vector<Figure>& figures) {
  std::string text =
      "<div class=\"scroll\"><table class=\"claims\"><thead><tr><th></th><th>What is "
      "claimed</th><th>Criterion</th>"
      "<th>paper</th><th>cell</th></tr></thead>\n<tbody>\n";
  for (const Figure& figure : figures) {
    for (const Claim& claim : figure.claims) {
      if (claim.model != "paper") continue;
      text += fmt::format("<tr><td><a href=\"#{}\">{}</a></td><td>{}</td><td>{}: {}</td>", figure.id,
                          short_name(figure), markup_text(claim.statement), markup_text(claim.metric),
                          markup_text(claim.criterion.text() + (claim.unit.empty() ? "" : " " + claim.unit)));
      for (const char* model : {"paper", "cell"}) {
        const Claim* found = find_claim(figure, claim.id, model);
        text += found == nullptr ? "<td></td>"
                                 : fmt::format("<td>{}<br/>{}</td>", mark(verdict(*found)),
                                               markup_text(value_text(*found)));
      }
      text += "</tr>\n";
    }
  }
  return text + "</tbody></table></div>\n";
}

std::string section(const Figure& figure) {
  std::string text = fmt::format("<section id=\"{}\"><h2><span class=\"number\">{}</span> {}</h2>\n",
                                 figure.id, short_name(figure), markup_text(figure.title));
  text += fmt::format("<blockquote><p>{}</p></blockquote>\n", markup_text(figure.claim));
  for (const Block& block : figure.blocks) text += std::visit(BlockWriter{}, block);
  if (figure.claims.empty()) return text + "</section>\n";
  text +=
      "<table><caption>Verdicts</caption><thead><tr><th>Claim</th><th>Model</th><th>Verdict</th><th>Why</"
      "th></tr>"
      "</thead>\n<tbody>";
  for (const Claim& claim : figure.claims)
    text +=
        fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n", markup_text(claim.statement),
                    claim.model, mark(verdict(claim)), markup_text(reason(claim)));
  return text + "</tbody></table>\n</section>\n";
}

std::string counts(const std::vector<Figure>& figures, const char* model) {
  int holds = 0, all = 0;
  for (const Figure& figure : figures) {
    for (const Claim& claim : figure.claims) {
      if (claim.model != model || verdict(claim) == Verdict::not_run) continue;
      ++all;
      holds += verdict(claim) == Verdict::comes_out ? 1 : 0;
    }
  }
  return fmt::format("{} of {} under <em>{}</em>", holds, all, model);
}

}  // namespace

std::string report_html(const std::vector<Figure>& figures, const ReportFacts& facts) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\"><head><meta "
      "charset=\"utf-8\"/>\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
      "<title>Wilting leaves, reproduced</title>\n<style>{}</style></head>\n<body>\n<header>\n",
      detail::kReportStyle);
  text += "<h1>Wilting leaves, reproduced</h1>\n";
  text += fmt::format(
      "<p class=\"lead\">The figures and tables of <em>Wilting Deformation of Leaves Using Cell Dynamics and "
      "Time-Varying External Forces</em>, computed anew by wilt {} from leaves of {} vertices (seed {}), 100 "
      "iterations each. Claims that come out: {}, {}.</p>\n",
      version(), facts.vertices, facts.seed, counts(figures, "paper"), counts(figures, "cell"));
  text +=
      "<p><em>paper</em> keeps the printed equations where they run; <em>cell</em> is wilt's own model: the "
      "same "
      "forces, made independent of the mesh and conservative, with bending, differential shrinkage, stiff "
      "veins, gravity. Every verdict is computed: a measured number against a stated criterion. L is the "
      "length of the leaf.</p>\n";
  for (const std::string& note : facts.notes)
    text += fmt::format("<p><strong>{}</strong></p>\n", markup_text(note));
  text += "<nav>";
  for (const Figure& figure : figures)
    text += fmt::format("<a href=\"#{}\">{}</a>\n", figure.id, short_name(figure));
  text += "</nav>\n</header>\n<main>\n<section id=\"claims\"><h2>Claims</h2>\n" + summary(figures) +
          "<p class=\"soft\">As a table for programs: <a href=\"claims.csv\">claims.csv</a>.</p></section>\n";
  for (const Figure& figure : figures) text += section(figure);
  return text +
         "</main>\n<footer><p>Made by <code>wilt reproduce</code>. Pictures are rendered, plots are drawn by "
         "gnuplot from the CSV files beside them.</p></footer>\n</body></html>\n";
}

}  // namespace wilt
