// The tables of a JPEG before a decoder reads them. Inside the core room only.
#pragma once

#include <string_view>

namespace wilt::detail {

/// Throws Error{input} when a Huffman table of the JPEG states more than the 256 codes that there can be
/// (ISO 10918-1, B.2.4.2): stb_image 2.27 writes beyond its own tables then. Looks at what stands between the
/// first marker and the end of the image, segment by segment, as a decoder does. O(#bytes).
void check_jpeg_tables(std::string_view jpeg);

}  // namespace wilt::detail
