#include "wilt/import/scan_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "wilt/core/error.hpp"

namespace wilt::detail {
namespace {

constexpr std::size_t kMostPoints = 20'000'000;
constexpr std::string_view kSeparators = " ,;\t\r\"";

std::optional<double> number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

void split(std::string_view line, std::vector<std::string_view>& words) {
  words.clear();
  std::size_t from = 0;
  while ((from = line.find_first_not_of(kSeparators, from)) != line.npos) {
    const std::size_t to = std::min(line.find_first_of(kSeparators, from), line.size());
    words.push_back(line.substr(from, to - from));
    from = to;
  }
}

// The line without the mark of a comment; whether there was one.
bool strip_comment(std::string_view& line) {
  const std::size_t start = std::min(line.find_first_not_of(" \t"), line.size());
  line.remove_prefix(start);
  if (line.starts_with("//"))
    line.remove_prefix(2);
  else if (line.starts_with('#'))
    line.remove_prefix(1);
  else
    return false;
  return true;
}

// Reads line by line; knows which columns matter and how many there are.
class PointReader {
 public:
  void read(std::string_view line) {
    ++line_;
    if (line_ == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
    if (line.find('\0') != line.npos) refuse("it is no text file; a scan is lines of x y z");
    const bool comment = strip_comment(line);
    split(line, words_);
    if (words_.empty() || (take_names() || comment)) return;
    if (points_.empty() && skipped_ == 0 && words_.size() == 1 && number(words_[0])) return;  // how many
    if (line.find(';') != line.npos && line.find(',') != line.npos)
      refuse("both ; and , stand in it; write decimals with a point");
    take_row();
  }

  const std::vector<Vec3>& points() const { return points_; }
  std::size_t skipped() const { return skipped_; }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw Error(ErrorCode::input, fmt::format("line {}: {}", line_, why));
  }

  // Names of columns, before the first point.
  bool take_names() {
    if (!points_.empty()) return false;
    std::array<int, 3> found{-1, -1, -1};
    for (std::size_t i = 0; i < words_.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        if (words_[i].size() == 1 && (words_[i][0] | 0x20) == 'x' + axis) found[axis] = static_cast<int>(i);
      }
    }
    if (*std::min_element(found.begin(), found.end()) < 0) return false;
    columns_ = found;
    return true;
  }

  void take_row() {
    if (row_length_ == 0) row_length_ = words_.size();
    const std::size_t needed =
        1 + static_cast<std::size_t>(*std::max_element(columns_.begin(), columns_.end()));
    if (words_.size() < needed)
      refuse(fmt::format("{} columns; a point needs x, y and z in {} columns", words_.size(), needed));
    if (words_.size() != row_length_)
      refuse(fmt::format("{} columns where the first point has {}; every point needs as many", words_.size(),
                         row_length_));
    Vec3 point;
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = words_[columns_[axis]];
      const std::optional<double> value = number(word);
      if (!value)
        refuse(
            fmt::format("'{}' is no number; a scan is lines of x y z, with one line of names above at most",
                        word.substr(0, 40)));
      point[axis] = *value;
    }
    if (!point.allFinite()) {
      ++skipped_;
      return;
    }
    if (points_.size() == kMostPoints)
      refuse(fmt::format("more than {} million points; thin the scan first", kMostPoints / 1'000'000));
    points_.push_back(point);
  }

  std::vector<Vec3> points_;
  std::vector<std::string_view> words_;
  std::array<int, 3> columns_{0, 1, 2};
  std::size_t row_length_ = 0, line_ = 0, skipped_ = 0;
};

}  // namespace

Points3 parse_points(std::string_view text, std::vector<std::string>& notes) {
  PointReader reader;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    reader.read(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  if (reader.skipped() > 0)
    notes.push_back(fmt::format("{} points without numbers (nan) were left out", reader.skipped()));
  Points3 points(static_cast<Eigen::Index>(reader.points().size()), 3);
  for (Eigen::Index i = 0; i < points.rows(); ++i) points.row(i) = reader.points()[i].transpose();
  return points;
}

}  // namespace wilt::detail
