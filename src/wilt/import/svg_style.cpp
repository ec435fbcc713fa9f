#include "wilt/import/svg_style.hpp"

#include <algorithm>
#include <sstream>

namespace wilt::svg {
namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) parts.push_back(trimmed(part));
  return parts;
}

std::map<std::string, std::string> declarations_of(const std::string& text) {
  std::map<std::string, std::string> result;
  for (const std::string& declaration : split(text, ';')) {
    const std::size_t colon = declaration.find(':');
    if (colon == std::string::npos) continue;
    std::string value = trimmed(declaration.substr(colon + 1));
    value = trimmed(value.substr(0, value.find("!important")));
    result[trimmed(declaration.substr(0, colon))] = value;
  }
  return result;
}

}  // namespace

StyleSheet::StyleSheet(const Elements& elements) {
  for (const Element& element : elements)
    if (local_name(element) == "style") add_rules(element.text);
  std::stable_sort(rules_.begin(), rules_.end(),
                   [](const Rule& a, const Rule& b) { return a.weight() < b.weight(); });
}

void StyleSheet::add_rules(std::string css) {
  for (std::size_t from = css.find("/*"); from != std::string::npos; from = css.find("/*", from)) {
    const std::size_t to = css.find("*/", from + 2);
    css.erase(from, to == std::string::npos ? std::string::npos : to + 2 - from);
  }
  for (std::size_t at = 0;;) {
    const std::size_t open = css.find('{', at), close = css.find('}', at);
    if (open == std::string::npos || close == std::string::npos || close < open) return;
    const auto declarations = declarations_of(css.substr(open + 1, close - open - 1));
    for (const std::string& selector : split(css.substr(at, open - at), ',')) {
      if (selector.empty() || selector.find_first_of(" >+~:[@") != std::string::npos) continue;
      Rule rule;
      rule.declarations = declarations;
      const std::size_t mark = selector.find_first_of(".#");
      rule.element = selector.substr(0, mark) == "*" ? "" : selector.substr(0, mark);
      if (mark != std::string::npos)
        (selector[mark] == '.' ? rule.class_name : rule.id) = selector.substr(mark + 1);
      rules_.push_back(std::move(rule));
    }
    at = close + 1;
  }
}

bool StyleSheet::matches(const Rule& rule, const Element& element) {
  if (!rule.element.empty() && rule.element != local_name(element)) return false;
  if (!rule.id.empty() && rule.id != attribute(element, "id")) return false;
  if (rule.class_name.empty()) return true;
  const std::vector<std::string> classes = split(attribute(element, "class"), ' ');
  return std::find(classes.begin(), classes.end(), rule.class_name) != classes.end();
}

std::string StyleSheet::property(const Element& element, const std::string& name) const {
  const auto own = declarations_of(attribute(element, "style"));
  if (const auto it = own.find(name); it != own.end()) return it->second;
  for (auto rule = rules_.rbegin(); rule != rules_.rend(); ++rule) {
    const auto it = rule->declarations.find(name);
    if (it != rule->declarations.end() && matches(*rule, element)) return it->second;
  }
  return trimmed(attribute(element, name));
}

}  // namespace wilt::svg
