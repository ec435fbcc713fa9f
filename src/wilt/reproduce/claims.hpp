// What the paper claims, as a number and a criterion; the verdict follows from them.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace wilt {

/// What a number must be for a claim to come out.
struct Criterion {
  enum class Kind { at_least, at_most, exactly };
  Kind kind = Kind::at_least;
  double bound = 0.0;

  bool holds(double value) const;  ///< false for a value that is not a number
  std::string text() const;        ///< "at least 0.002"
};

enum class Verdict { comes_out, does_not, not_run };
const char* verdict_text(Verdict verdict);  ///< "comes out", "does not", "not run"

/// One claim, measured under one model.
struct Claim {
  std::string figure;           ///< "fig7"
  std::string id;               ///< "swelling-wrinkles"; with figure and model unique
  std::string statement;        ///< in our words
  std::string model;            ///< "paper" or "cell"
  std::string metric;           ///< what `value` is
  std::optional<double> value;  ///< none: not run
  std::string unit;             ///< "" for a pure number
  Criterion criterion;
  std::string detail;  ///< further measurements, for the reason
};

Verdict verdict(const Claim& claim);

/// Takes the numbers from the claims under models of which a run stopped early: they do not come out.
void withhold(std::vector<Claim>& claims, const std::set<std::string>& broken_models);

/// The measurement against the criterion in words, with the detail: the "why" of the verdict.
std::string reason(const Claim& claim);

/// A value with four significant digits and its unit.
std::string value_text(const Claim& claim);

/// claims.csv: figure,id,claim,model,metric,value,unit,criterion,verdict,reason (RFC 4180, nine digits).
std::string claims_csv(const std::vector<Claim>& claims);

/// The same as a JSON array of objects; the value of a claim that was not run is null.
std::string claims_json(const std::vector<Claim>& claims);

/// A field of a CSV file: in quotes where it must be.
std::string csv_field(const std::string& text);

}  // namespace wilt
