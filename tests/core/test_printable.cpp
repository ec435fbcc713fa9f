#include <gtest/gtest.h>

#include "wilt/core/printable.hpp"

namespace wilt {
namespace {

// Oracle: Unicode's table of well-formed sequences, at the edges of each of its rows.
TEST(Printable, KeepsWhatIsUtf8) {
  for (const char* text : {"", "leaf", "two words\tand a tab",
                           "Gr\xC3\xB6\xC3\x9F"
                           "e",
                           "\xC2\xA0\xDF\xBF", "\xE0\xA0\x80\xED\x9F\xBF\xEE\x80\x80\xEF\xBF\xBF",
                           "\xF0\x90\x80\x80\xF4\x8F\xBF\xBF"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, ReplacesWhatIsNot) {
  const std::string bad = "\xEF\xBF\xBD";
  EXPECT_EQ(printable("a\xFF"
                      "b"),
            "a" + bad + "b");
  EXPECT_EQ(printable("\xC1\x81"), bad + bad);                      // an overlong A
  EXPECT_EQ(printable("\xED\xA0\x80"), bad + bad + bad);            // half of a surrogate pair
  EXPECT_EQ(printable("\xE2\x82"), bad + bad);                      // cut off
  EXPECT_EQ(printable("\xF4\x90\x80\x80"), bad + bad + bad + bad);  // beyond U+10FFFF
  EXPECT_EQ(printable("\x80x"), bad + "x");
  EXPECT_EQ(printable("\x1b[31mred\r\x7f\xC2\x9B"), "?[31mred???");
  EXPECT_EQ(printable("two\nlines"), "two?lines");
  EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a?b");
}

TEST(Untagged, LeavesTheTagOut) {
  EXPECT_EQ(untagged("[json.exception.parse_error.101] parse error"), "parse error");
  EXPECT_EQ(untagged("[1, 2"), "[1, 2");
  EXPECT_EQ(untagged("an index [3] too large"), "an index [3] too large");
}

}  // namespace
}  // namespace wilt
