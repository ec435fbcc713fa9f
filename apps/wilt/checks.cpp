#include "checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "wilt/core/nearest.hpp"

namespace wilt::cli {
namespace {

constexpr const char* kWords = "words";  // the name of the validators that carry words, as their description

}  // namespace

CLI::Validator whole_number(std::int64_t least, std::int64_t most) {
  const auto check = [least, most](const std::string& text) -> std::string {
    std::int64_t value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error == std::errc() && stop == end && value >= least && value <= most) return "";
    return fmt::format("takes a whole number from {} to {}, not '{}'", least, most, text);
  };
  return {check, ""};
}

CLI::Validator number(double least, double most) {
  const auto check = [least, most](const std::string& text) -> std::string {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (!text.empty() && *end == '\0' && value >= least && value <= most) return "";
    return fmt::format("takes a number from {} to {}, not '{}'", least, most, text);
  };
  return {check, ""};
}

CLI::Validator one_of(const std::vector<std::string>& words) {
  const auto check = [words](const std::string& text) -> std::string {
    if (std::find(words.begin(), words.end(), text) != words.end()) return "";
    return fmt::format("takes one of {}, not '{}'{}", fmt::join(words, ", "), text,
                       did_you_mean(text, words));
  };
  return {check, fmt::format("{}", fmt::join(words, " ")), kWords};
}

CLI::Validator offers(const std::vector<std::string>& words) {
  return {[](const std::string&) { return std::string(); }, fmt::format("{}", fmt::join(words, " ")), kWords};
}

std::string value_name(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  return type.substr(0, type.find(':'));
}

std::vector<std::string> words_of(CLI::Option& option) {
  try {
    return CLI::detail::split(option.get_validator(kWords)->get_description(), ' ');
  } catch (const CLI::OptionNotFound&) {
    return {};
  }
}

}  // namespace wilt::cli
