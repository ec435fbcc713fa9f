// A drawing's file as its elements. Inside the import room only.
#pragma once

#include <string_view>

#include "wilt/import/svg_element.hpp"

namespace wilt::svg {

/// The elements of XML; its entities are not expanded. Throws Error{input} when it cannot be read.
Elements parse_elements(std::string_view text);

}  // namespace wilt::svg
