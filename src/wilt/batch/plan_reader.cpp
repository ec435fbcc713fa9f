// A plan's TOML: every key, what it takes, and that what varies stays within its range.
#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <optional>

#include "wilt/batch/item_files.hpp"
#include "wilt/batch/plan_contents.hpp"
#include "wilt/batch/toml_section.hpp"
#include "wilt/core/error.hpp"
#include "wilt/render/label_files.hpp"

namespace wilt::detail {
namespace {

using Words = std::vector<std::string>;

constexpr int kMostItems = 100'000'000;
constexpr std::int64_t kMostCells = 1'000'000'000;
constexpr std::int64_t kMostSeed = 9'000'000'000'000'000;

[[noreturn]] void fail(const std::string& message) {
  throw Error(ErrorCode::configuration, message);
}

// The files that a pattern stands for, in order; other names stand for themselves. As seen from `folder`.
Words matching(const std::filesystem::path& folder, const std::string& name) {
  if (name.find_first_of("*?[") == std::string::npos) return {name};
  glob_t found{};
  ::glob((folder / name).c_str(), 0, nullptr, &found);
  Words files;
  for (std::size_t i = 0; i < found.gl_pathc; ++i) {
    const std::filesystem::path file(found.gl_pathv[i]);
    files.push_back(folder.empty() || std::filesystem::path(name).is_absolute()
                        ? file.string()
                        : file.lexically_relative(folder).string());
  }
  ::globfree(&found);
  if (files.empty()) fail(fmt::format("no file is called '{}'", (folder / name).string()));
  return files;
}

Words map_names() {
  Words names;
  for (const LabelKind kind : all_label_kinds()) names.push_back(label_name(kind));
  return names;
}

Distribution leaves(const std::filesystem::path& folder, const toml::node& node) {
  Distribution names = parse_distribution("leaf", node);
  if (names.values.empty()) fail("leaf takes a name, {choice = [...]} or {grid = [...]}");
  Words files;
  std::vector<double> weights;
  for (std::size_t k = 0; k < names.values.size(); ++k) {
    const Words found = matching(folder, names.values[k]);
    files.insert(files.end(), found.begin(), found.end());
    if (!names.weights.empty())
      weights.insert(weights.end(), found.size(), names.weights[k] / double(found.size()));
  }
  if (names.spread == Spread::fixed && files.size() > 1)
    fail(fmt::format("'{}' is {} files; say {{choice = [...]}} or {{grid = [...]}}", names.values.front(),
                     files.size()));
  names.values = std::move(files);
  names.weights = std::move(weights);
  return names;
}

// Keeps a normal distribution within [least, most] too.
void keep_within(Distribution& values, const std::string& key, double least, double most) {
  values.least = std::max(values.least, least);
  values.most = std::min(values.most, most);
  if (!(values.least <= values.most)) fail(fmt::format("{}: nothing lies between min and max", key));
}

// Values between which all others lie.
Words extremes(const Distribution& values) {
  const auto text = [&](double value) {
    return values.whole ? fmt::format("{:.0f}", value) : fmt::format("{}", value);
  };
  switch (values.spread) {
    case Spread::uniform:
    case Spread::latin:
      return {fmt::format("{}", values.a), fmt::format("{}", values.b)};
    case Spread::normal:
      return {text(std::clamp(values.a, values.least, values.most))};
    default:
      return values.values;
  }
}

Distribution setting_values(const std::string& key, const toml::node& node) {
  Config scratch = default_config(species("generic"));
  const auto& table = settings();
  const auto setting =
      std::find_if(table.begin(), table.end(), [&key](const Setting& s) { return s.key == key; });
  const bool known = setting != table.end();
  if (known && std::holds_alternative<std::vector<double>*>(setting->field(scratch)))
    fail(fmt::format("{} is a list of numbers; a plan takes settings of one value each", key));
  Distribution values = parse_distribution(key, node);
  values.whole = known && std::holds_alternative<std::int64_t*>(setting->field(scratch));
  if (known && values.spread == Spread::normal) keep_within(values, key, setting->min, setting->max);
  for (const std::string& value : extremes(values)) set(scratch, key, value);
  return values;
}

Distribution degrees(const std::string& key, const toml::node& node, double least, double most) {
  Distribution values = parse_distribution(key, node);
  if (values.spread == Spread::normal) keep_within(values, key, least, most);
  for (const std::string& text : extremes(values)) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !(value >= least && value <= most))
      fail(fmt::format("{} must be between {} and {} degrees, not {}", key, least, most, text));
  }
  return values;
}

Distribution colours(const std::string& key, const toml::node& node) {
  Distribution values = parse_distribution(key, node);
  if (values.values.empty()) fail("background takes colours like \"#eeeae5\"");
  for (const std::string& colour : values.values) parse_colour(colour);
  return values;
}

class Reader {
 public:
  Reader(PlanContents& plan, const std::string& source) : plan_(plan), source_(source) {}

  void read(const toml::table& document) {
    using Key = const std::string&;
    using Node = const toml::node&;
    std::optional<std::int64_t> count;
    take_section(document, "", source_,
                 {{"leaf", [&](Key key, Node node) { add(key, leaves(plan_.folder, node)); }},
                  {"seed",
                   [&](Key key, Node node) {
                     plan_.seed = static_cast<std::uint64_t>(whole_number(key, node, 0, kMostSeed));
                   }},
                  {"count", [&](Key key, Node node) { count = whole_number(key, node, 1, kMostItems); }},
                  {"file", [&](Key, Node node) { read_file_options(node); }},
                  {"settings", [&](Key, Node node) { read_settings(node, ""); }},
                  {"write", [&](Key, Node node) { read_write(node); }},
                  {"pictures", [&](Key, Node node) { read_pictures(node); }},
                  {"dataset", [&](Key, Node node) { read_dataset(node); }}});
    std::sort(plan_.variables.begin(), plan_.variables.end(),
              [](const Variable& a, const Variable& b) { return a.key < b.key; });
    check();
    std::vector<std::string>& maps = plan_.outputs.pictures.maps;
    if (plan_.outputs.coco && std::find(maps.begin(), maps.end(), "leaf") == maps.end())
      maps.push_back("leaf");
    plan_.count = static_cast<int>(count.value_or(std::min<std::int64_t>(grid_cells(plan_), kMostItems)));
  }

 private:
  void add(const std::string& key, Distribution values) {
    plan_.variables.push_back({key, std::move(values)});
  }

  void check() const {
    const bool has_leaf = std::any_of(plan_.variables.begin(), plan_.variables.end(),
                                      [](const Variable& variable) { return variable.key == "leaf"; });
    const auto refuse = [this](const std::string& reason) { fail(source_ + ": " + reason); };
    if (!has_leaf)
      refuse("which leaves? give leaf = \"maple\" or leaf = {choice = [\"maple\", \"photos/*.jpg\"]}");
    double cells = 1.0;
    for (const Variable& variable : plan_.variables) {
      if (variable.distribution.spread == Spread::grid) cells *= double(variable.distribution.values.size());
    }
    if (cells > double(kMostCells))
      refuse(fmt::format("the grids have {:.3g} cells, at most {} are allowed", cells, kMostCells));
    if (plan_.outputs.files.empty() && plan_.outputs.pictures.frames == 0)
      refuse("nothing would be written; add [write] files = [\"leaf.glb\"] or [pictures]");
    if (plan_.outputs.coco && plan_.outputs.pictures.frames == 0)
      refuse("the layout coco describes pictures; add [pictures]");
  }

  void read_file_options(const toml::node& node) {
    using Key = const std::string&;
    using Node = const toml::node&;
    ReadOptions& read = plan_.read;
    take_section(
        node, "file", source_,
        {{"petiole",
          [&](Key key, Node value) {
            constexpr double kFar = 1e12;
            const toml::array& place = pair(key, value);
            read.petiole = Vec2(number(key, place[0], -kFar, kFar), number(key, place[1], -kFar, kFar));
          }},
         {"nth",
          [&](Key key, Node value) { read.nth = static_cast<int>(whole_number(key, value, 1, 10000)); }},
         {"mm_per_pixel", [&](Key key, Node value) { read.mm_per_pixel = number(key, value, 1e-6, 1e6); }},
         {"mask", [&](Key key, Node value) { read.mask = plan_.folder / word(key, value); }},
         {"threshold", [&](Key key, Node value) { read.threshold = number(key, value, 0.0, 100.0); }},
         {"scan", [&](Key key, Node value) { read.scan = flag(key, value); }},
         {"mm_per_unit", [&](Key key, Node value) { read.mm_per_unit = number(key, value, 1e-9, 1e9); }},
         {"veins", [&](Key key, Node value) { plan_.veins = (plan_.folder / word(key, value)).string(); }}});
  }

  void read_settings(const toml::node& node, const std::string& prefix) {
    const toml::table* table = node.as_table();
    if (table == nullptr) fail("[settings] is a section with keys of its own");
    for_each_key(*table, source_, [&](const std::string& name, const toml::node& value) {
      const toml::table* nested = value.as_table();
      const std::string key = prefix + name;
      const bool is_setting = std::any_of(settings().begin(), settings().end(),
                                          [&key](const Setting& setting) { return setting.key == key; });
      if (nested != nullptr && !is_setting && !is_distribution(*nested))
        return read_settings(value, key + ".");
      add(key, setting_values(key, value));
    });
  }

  void read_write(const toml::node& node) {
    take_section(node, "write", source_, {{"files", [&](const std::string& key, const toml::node& value) {
                                             plan_.outputs.files = words(key, value, {});
                                             check_item_files(plan_.outputs.files);
                                           }}});
  }

  void read_pictures(const toml::node& node) {
    using Key = const std::string&;
    using Node = const toml::node&;
    PicturePlan& pictures = plan_.outputs.pictures;
    pictures.frames = 1;
    const auto angle = [this](double least, double most) {
      return [this, least, most](Key key, Node value) {
        add("pictures." + key, degrees(key, value, least, most));
      };
    };
    take_section(node, "pictures", source_,
                 {{"frames",
                   [&](Key key, Node value) {
                     const bool all = value.is_string() && *value.value<std::string>() == "all";
                     pictures.frames =
                         all ? kEveryFrame
                             : static_cast<int>(whole_number(key + " is \"all\" or it", value, 1, 100000));
                   }},
                  {"size",
                   [&](Key key, Node value) {
                     const toml::array& size = pair(key, value);
                     pictures.width = static_cast<int>(whole_number(key, size[0], 16, 16384));
                     pictures.height = static_cast<int>(whole_number(key, size[1], 16, 16384));
                   }},
                  {"samples",
                   [&](Key key, Node value) {
                     pictures.samples = static_cast<int>(whole_number(key, value, 1, 65536));
                   }},
                  {"maps", [&](Key key, Node value) { pictures.maps = words(key, value, map_names()); }},
                  {"azimuth", angle(-360.0, 360.0)},
                  {"elevation", angle(-90.0, 90.0)},
                  {"sun_azimuth", angle(-360.0, 360.0)},
                  {"sun_elevation", angle(1.0, 90.0)},
                  {"background", [&](Key key, Node value) { add("pictures." + key, colours(key, value)); }}});
  }

  void read_dataset(const toml::node& node) {
    using Key = const std::string&;
    using Node = const toml::node&;
    Outputs& outputs = plan_.outputs;
    take_section(node, "dataset", source_,
                 {{"layouts",
                   [&](Key key, Node value) {
                     for (const std::string& layout : words(key, value, {"folder", "coco", "webdataset"})) {
                       outputs.coco = outputs.coco || layout == "coco";
                       outputs.webdataset = outputs.webdataset || layout == "webdataset";
                     }
                   }},
                  {"items_per_shard", [&](Key key, Node value) {
                     outputs.items_per_shard = static_cast<int>(whole_number(key, value, 1, 1'000'000));
                   }}});
  }

  PlanContents& plan_;
  const std::string& source_;
};

}  // namespace

PlanContents read_contents(std::string_view toml, const std::string& source,
                           const std::filesystem::path& folder) {
  PlanContents plan;
  plan.text = toml;
  plan.folder = folder;
  Reader(plan, source).read(parse_toml(toml, source));
  return plan;
}

std::int64_t grid_cells(const PlanContents& plan) {
  std::int64_t cells = 1;
  for (const Variable& variable : plan.variables) {
    if (variable.distribution.spread == Spread::grid)
      cells *= static_cast<std::int64_t>(variable.distribution.values.size());
  }
  return cells;
}

Vec3 parse_colour(const std::string& text) {
  unsigned int value = 0;
  const char* end = text.data() + text.size();
  if (text.size() != 7 || text[0] != '#' || std::from_chars(text.data() + 1, end, value, 16).ptr != end)
    fail(fmt::format("background takes colours like \"#eeeae5\", not '{}'", text));
  return Vec3(value >> 16, (value >> 8) & 255, value & 255) / 255.0;
}

}  // namespace wilt::detail
