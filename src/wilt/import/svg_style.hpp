// Style sheets of a drawing, as far as fills need them. Inside the import room only.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace pugi {
class xml_node;
}

namespace wilt::svg {

/// The properties of an element: presentation attributes, overridden by style sheets (element, class, id;
/// combined selectors are ignored), overridden by its style attribute.
class StyleSheet {
 public:
  explicit StyleSheet(const pugi::xml_node& root);

  /// "" when the element does not set it.
  std::string property(const pugi::xml_node& element, const std::string& name) const;

 private:
  struct Rule {
    std::string element, class_name, id;  // "" matches everything
    std::map<std::string, std::string> declarations;
    int weight() const { return (id.empty() ? 0 : 100) + (class_name.empty() ? 0 : 10) + !element.empty(); }
  };
  void add_rules(std::string css);
  static bool matches(const Rule& rule, const pugi::xml_node& element);

  std::vector<Rule> rules_;
};

/// The element's name without the prefix "svg:".
std::string local_name(const pugi::xml_node& element);

}  // namespace wilt::svg
