// Claims: the verdict follows from the number and the criterion, and what is written can be read back.
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "csv.hpp"
#include "wilt/reproduce/claims.hpp"
#include "wilt/reproduce/report.hpp"

namespace wilt {
namespace {

using Kind = Criterion::Kind;

Claim claim_with(std::optional<double> value, Criterion criterion) {
  Claim claim;
  claim.figure = "fig7";
  claim.id = "planted";
  claim.statement = "A planted claim";
  claim.model = "cell";
  claim.metric = "a number";
  claim.value = value;
  claim.criterion = criterion;
  return claim;
}

// Oracle: the meaning of the words; every kind can hold and can fail.
TEST(Claims, ComeOutOrNotByTheNumberAlone) {
  struct Case {
    double value;
    Criterion criterion;
    Verdict expected;
  };
  for (const Case& c : {Case{0.0021, {Kind::at_least, 0.002}, Verdict::comes_out},
                        Case{0.0019, {Kind::at_least, 0.002}, Verdict::does_not},
                        Case{0.002, {Kind::at_least, 0.002}, Verdict::comes_out},
                        Case{-0.95, {Kind::at_most, -0.9}, Verdict::comes_out},
                        Case{-0.85, {Kind::at_most, -0.9}, Verdict::does_not},
                        Case{0.0, {Kind::exactly, 0.0}, Verdict::comes_out},
                        Case{1e-300, {Kind::exactly, 0.0}, Verdict::does_not}}) {
    EXPECT_EQ(verdict(claim_with(c.value, c.criterion)), c.expected) << c.value << " " << c.criterion.text();
  }
}

// Oracle: a run that broke off has no number; that must never count as holding.
TEST(Claims, DoNotComeOutWithoutANumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Kind kind : {Kind::at_least, Kind::at_most, Kind::exactly})
    EXPECT_EQ(verdict(claim_with(nan, {kind, 0.0})), Verdict::does_not);
  EXPECT_EQ(verdict(claim_with(std::nullopt, {Kind::at_least, 0.0})), Verdict::not_run);
}

// Oracle: only the model whose run broke off loses its numbers; a claim that was not run stays so.
TEST(Claims, LoseTheirNumbersWithABrokenRun) {
  std::vector<Claim> claims(3, claim_with(1.0, {Kind::at_least, 0.0}));
  claims[1].model = "paper";
  claims[2].value = std::nullopt;
  withhold(claims, {"cell"});
  EXPECT_EQ(verdict(claims[0]), Verdict::does_not);
  EXPECT_NE(reason(claims[0]).find("stopped early"), std::string::npos);
  EXPECT_EQ(verdict(claims[1]), Verdict::comes_out);
  EXPECT_EQ(verdict(claims[2]), Verdict::not_run);
}

TEST(Claims, GiveTheNumberAndTheBoundAsTheReason) {
  const std::string fails = reason(claim_with(0.5, {Kind::at_least, 1.0}));
  EXPECT_EQ(fails, "a number is 0.5, but should be at least 1");
  EXPECT_EQ(reason(claim_with(2.0, {Kind::at_least, 1.0})), "a number is 2, which is at least 1");
}

// Oracle: a CSV reader of the test's own, on text with commas, quotes and line breaks.
TEST(Claims, ReadBackFromCsvFieldByField) {
  Claim claim = claim_with(0.25, {Kind::at_most, 1.0});
  claim.statement = "commas, \"quotes\"\nand lines";
  const auto rows = read_csv(claims_csv({claim, claim_with(std::nullopt, {Kind::exactly, 0.0})}));
  ASSERT_EQ(rows.size(), 3U);
  for (const auto& row : rows) EXPECT_EQ(row.size(), 10U);
  EXPECT_EQ(rows[0][5], "value");
  EXPECT_EQ(rows[1][2], claim.statement);
  EXPECT_EQ(rows[1][5], "0.25");
  EXPECT_EQ(rows[1][8], "comes out");
  EXPECT_EQ(rows[2][5], "");
  EXPECT_EQ(rows[2][8], "not run");
}

TEST(Claims, ReadBackFromJson) {
  const auto json = nlohmann::json::parse(
      claims_json({claim_with(0.25, {Kind::at_least, 1.0}), claim_with(std::nullopt, {Kind::exactly, 0.0})}));
  EXPECT_EQ(json[0]["value"], 0.25);
  EXPECT_EQ(json[0]["verdict"], "does not");
  EXPECT_TRUE(json[1]["value"].is_null());
}

// Oracle: what was planted. The marks are words and signs, not colour alone.
TEST(Report, ShowsBothVerdictsAndEscapesText) {
  Figure figure{"fig7", "A < B & C", "claimed", {}, {}};
  figure.claims = {claim_with(2.0, {Kind::at_least, 1.0}), claim_with(0.0, {Kind::at_least, 1.0})};
  figure.claims[0].model = "paper";
  const std::string html = report_html({figure}, {});
  EXPECT_NE(html.find("A &lt; B &amp; C"), std::string::npos);
  EXPECT_NE(html.find("✓ comes out"), std::string::npos);
  EXPECT_NE(html.find("✗ does not"), std::string::npos);
  EXPECT_NE(html.find("1 of 1 under <em>paper</em>, 0 of 1 under <em>cell</em>"), std::string::npos);
}

}  // namespace
}  // namespace wilt
