// Style sheets of a drawing, as far as fills need them. Inside the import room only.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "wilt/import/svg_element.hpp"

namespace wilt::svg {

/// The properties of an element: presentation attributes, overridden by style sheets (element, class, id;
/// combined selectors are ignored), overridden by its style attribute.
class StyleSheet {
 public:
  explicit StyleSheet(const Elements& elements);

  /// "" when the element does not set it.
  std::string property(const Element& element, const std::string& name) const;

 private:
  struct Rule {
    std::string element, class_name, id;  // "" matches everything
    std::map<std::string, std::string> declarations;
    int weight() const { return (id.empty() ? 0 : 100) + (class_name.empty() ? 0 : 10) + !element.empty(); }
  };
  void add_rules(std::string css);
  static bool matches(const Rule& rule, const Element& element);

  std::vector<Rule> rules_;
};

}  // namespace wilt::svg
