// Baseline JPEG (ITU-T T.81), written on several threads.
#pragma once

#include <string>

#include "wilt/core/image.hpp"

namespace wilt {

/// A baseline JPEG in YCbCr, colour at full resolution, quality 1 to 100 on the scale of the Independent JPEG
/// Group. Every row of blocks is a restart interval, so rows are written at the same time. Sides of 1 to
/// 65535 pixels. Deterministic on any number of threads.
std::string baseline_jpeg(const Image& image, int quality);

}  // namespace wilt
