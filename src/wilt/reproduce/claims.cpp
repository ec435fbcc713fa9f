#include "wilt/reproduce/claims.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace wilt {

bool Criterion::holds(double value) const {
  switch (kind) {
    case Kind::at_least:
      return value >= bound;
    case Kind::at_most:
      return value <= bound;
    case Kind::exactly:
      return value == bound;
  }
  return false;
}

std::string Criterion::text() const {
  const char* word = kind == Kind::at_least ? "at least" : kind == Kind::at_most ? "at most" : "exactly";
  return fmt::format("{} {:.4g}", word, bound);
}

const char* verdict_text(Verdict verdict) {
  switch (verdict) {
    case Verdict::comes_out:
      return "comes out";
    case Verdict::does_not:
      return "does not";
    case Verdict::not_run:
      return "not run";
  }
  return "";
}

Verdict verdict(const Claim& claim) {
  if (!claim.value) return Verdict::not_run;
  return claim.criterion.holds(*claim.value) ? Verdict::comes_out : Verdict::does_not;
}

void withhold(std::vector<Claim>& claims, const std::set<std::string>& broken_models) {
  for (Claim& claim : claims) {
    if (!claim.value || broken_models.count(claim.model) == 0) continue;
    claim.value = std::numeric_limits<double>::quiet_NaN();
    claim.detail = "a run stopped early; the report's notes say why";
  }
}

std::string value_text(const Claim& claim) {
  if (!claim.value) return "-";
  if (std::isnan(*claim.value)) return "no number";
  return fmt::format("{:.4g}{}{}", *claim.value, claim.unit.empty() ? "" : " ", claim.unit);
}

std::string reason(const Claim& claim) {
  if (!claim.value) return claim.detail;
  const bool holds = verdict(claim) == Verdict::comes_out;
  std::string text = fmt::format("{} is {}, {} {}", claim.metric, value_text(claim),
                                 holds ? "which is" : "but should be", claim.criterion.text());
  if (!claim.detail.empty()) text += "; " + claim.detail;
  return text;
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string claims_csv(const std::vector<Claim>& claims) {
  std::string text = "figure,id,claim,model,metric,value,unit,criterion,verdict,reason\n";
  for (const Claim& c : claims) {
    const std::string value = c.value ? fmt::format("{:.9g}", *c.value) : "";
    text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", c.figure, c.id, csv_field(c.statement), c.model,
                        csv_field(c.metric), value, csv_field(c.unit), csv_field(c.criterion.text()),
                        verdict_text(verdict(c)), csv_field(reason(c)));
  }
  return text;
}

std::string claims_json(const std::vector<Claim>& claims) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Claim& c : claims) {
    json.push_back({{"figure", c.figure},
                    {"id", c.id},
                    {"claim", c.statement},
                    {"model", c.model},
                    {"metric", c.metric},
                    {"value", nullptr},
                    {"unit", c.unit},
                    {"criterion", c.criterion.text()},
                    {"verdict", verdict_text(verdict(c))},
                    {"reason", reason(c)}});
    if (c.value) json.back()["value"] = *c.value;
  }
  return json.dump(2) + "\n";
}

}  // namespace wilt
