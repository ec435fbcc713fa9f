#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "wilt/core/error.hpp"
#include "wilt/import/drawn_leaf.hpp"
#include "wilt/import/svg_element.hpp"

namespace wilt {
namespace {

svg::Elements listed_elements(std::string_view text) {
  svg::Elements elements;
  try {
    const auto list = nlohmann::json::parse(text);
    for (const auto& entry : list) {
      svg::Element element;
      element.depth = entry.at(0).get<int>();
      element.name = entry.at(1).get<std::string>();
      for (const auto& [key, value] : entry.at(2).items())
        element.attributes.emplace_back(key, value.get<std::string>());
      element.text = entry.at(3).get<std::string>();
      elements.push_back(std::move(element));
    }
  } catch (const nlohmann::json::exception& error) {
    throw Error(ErrorCode::input,
                fmt::format("the list of the drawing's elements is damaged: {}", error.what()));
  }
  svg::set_ends(elements);
  return elements;
}

}  // namespace

DrawnLeaf drawn_from_elements(std::string_view json, int nth) {
  return detail::outline_of_drawing(listed_elements(json), nth);
}

}  // namespace wilt
