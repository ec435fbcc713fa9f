#include "wilt/import/svg_document.hpp"

#include <fmt/format.h>

#include <pugixml.hpp>

#include "wilt/core/error.hpp"

namespace wilt::svg {
namespace {

class Lister : public pugi::xml_tree_walker {
 public:
  Elements take() { return std::move(elements_); }

 private:
  // Once for every node below the document, which calls nobody again for a level.
  bool for_each(pugi::xml_node& node) override {
    if (node.type() == pugi::node_element) {
      if (depth() == 0 && !elements_.empty()) return false;  // a second root, which is none
      Element element;
      element.depth = depth();
      element.name = node.name();
      for (const pugi::xml_attribute& own : node.attributes())
        element.attributes.emplace_back(own.name(), own.value());
      elements_.push_back(std::move(element));
    } else if (!elements_.empty() && local_name(elements_.back()) == "style") {
      elements_.back().text += node.value();
    }
    return true;
  }

  Elements elements_;
};

}  // namespace

Elements parse_elements(std::string_view text) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size(), pugi::parse_default);
  if (!parsed)
    throw Error(ErrorCode::input,
                fmt::format("it cannot be read as SVG: {} at byte {}", parsed.description(), parsed.offset));
  Lister lister;
  document.traverse(lister);
  Elements elements = lister.take();
  set_ends(elements);
  return elements;
}

}  // namespace wilt::svg
