// Several pictures on one sheet.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "wilt/core/image.hpp"

namespace wilt {

/// Pictures row by row in `columns` columns (>= 1), `gap` pixels (>= 0) apart and around.
///
/// Every cell has the size of the largest picture; smaller ones stand in the middle of theirs.
/// Throws Error{configuration} for wrong numbers, Error{input} when there is no picture.
Image contact_sheet(const std::vector<Image>& images, int columns, int gap = 0,
                    std::array<std::uint8_t, 3> background = {237, 234, 229});

}  // namespace wilt
