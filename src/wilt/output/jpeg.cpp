// Symbols as in ITU-T T.81: annex A.3 for the transform (here in the form of Arai, Agui and Nakajima 1988,
// whose outputs are larger by a factor per row and column that goes into the quantisation), annex F.1 for the
// coding, annex K for the tables.
#include "wilt/output/jpeg.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

#include "wilt/core/parallel.hpp"
#include "wilt/core/simd.hpp"

namespace wilt {
namespace {

constexpr int kSide = 8, kArea = 64, kChannels = 3;

constexpr std::array<std::uint8_t, kArea> kLuminance{
    16, 11,  10,  16, 24, 40, 51, 61, 12,  12,  14,  19,  26, 58, 60, 55,  14,  13,  16,  24, 40, 57,
    69, 56,  14,  17, 22, 29, 51, 87, 80,  62,  18,  22,  37, 56, 68, 109, 103, 77,  24,  35, 55, 64,
    81, 104, 113, 92, 49, 64, 78, 87, 103, 121, 120, 101, 72, 92, 95, 98,  112, 100, 103, 99};
constexpr std::array<std::uint8_t, kArea> kChrominance{
    17, 18, 24, 47, 99, 99, 99, 99, 18, 21, 26, 66, 99, 99, 99, 99, 24, 26, 56, 99, 99, 99,
    99, 99, 47, 66, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99,
    99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99, 99};

// Row-major place of the k-th coefficient.
constexpr std::array<std::uint8_t, kArea> kZigzag{
    0,  1,  8,  16, 9,  2,  3,  10, 17, 24, 32, 25, 18, 11, 4,  5,  12, 19, 26, 33, 40, 48,
    41, 34, 27, 20, 13, 6,  7,  14, 21, 28, 35, 42, 49, 56, 57, 50, 43, 36, 29, 22, 15, 23,
    30, 37, 44, 51, 58, 59, 52, 45, 38, 31, 39, 46, 53, 60, 61, 54, 47, 55, 62, 63};

// Huffman codes: how many of each length from 1 to 16, and the symbols in their order. Those of luminance
// serve all channels.
using Lengths = std::array<std::uint8_t, 16>;
constexpr Lengths kDcLengths{0, 1, 5, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0};
constexpr Lengths kAcLengths{0, 2, 1, 3, 3, 2, 4, 3, 5, 5, 4, 4, 0, 0, 1, 0x7d};
constexpr std::array<std::uint8_t, 12> kDcSymbols{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
constexpr std::array<std::uint8_t, 162> kAcSymbols{
    0x01, 0x02, 0x03, 0x00, 0x04, 0x11, 0x05, 0x12, 0x21, 0x31, 0x41, 0x06, 0x13, 0x51, 0x61, 0x07, 0x22,
    0x71, 0x14, 0x32, 0x81, 0x91, 0xa1, 0x08, 0x23, 0x42, 0xb1, 0xc1, 0x15, 0x52, 0xd1, 0xf0, 0x24, 0x33,
    0x62, 0x72, 0x82, 0x09, 0x0a, 0x16, 0x17, 0x18, 0x19, 0x1a, 0x25, 0x26, 0x27, 0x28, 0x29, 0x2a, 0x34,
    0x35, 0x36, 0x37, 0x38, 0x39, 0x3a, 0x43, 0x44, 0x45, 0x46, 0x47, 0x48, 0x49, 0x4a, 0x53, 0x54, 0x55,
    0x56, 0x57, 0x58, 0x59, 0x5a, 0x63, 0x64, 0x65, 0x66, 0x67, 0x68, 0x69, 0x6a, 0x73, 0x74, 0x75, 0x76,
    0x77, 0x78, 0x79, 0x7a, 0x83, 0x84, 0x85, 0x86, 0x87, 0x88, 0x89, 0x8a, 0x92, 0x93, 0x94, 0x95, 0x96,
    0x97, 0x98, 0x99, 0x9a, 0xa2, 0xa3, 0xa4, 0xa5, 0xa6, 0xa7, 0xa8, 0xa9, 0xaa, 0xb2, 0xb3, 0xb4, 0xb5,
    0xb6, 0xb7, 0xb8, 0xb9, 0xba, 0xc2, 0xc3, 0xc4, 0xc5, 0xc6, 0xc7, 0xc8, 0xc9, 0xca, 0xd2, 0xd3, 0xd4,
    0xd5, 0xd6, 0xd7, 0xd8, 0xd9, 0xda, 0xe1, 0xe2, 0xe3, 0xe4, 0xe5, 0xe6, 0xe7, 0xe8, 0xe9, 0xea, 0xf1,
    0xf2, 0xf3, 0xf4, 0xf5, 0xf6, 0xf7, 0xf8, 0xf9, 0xfa};

struct Code {
  std::uint16_t bits = 0;
  std::uint8_t length = 0;
};

// Annex C: codes of one length are consecutive numbers.
template <class Symbols>
std::array<Code, 256> codes_of(const Lengths& lengths, const Symbols& symbols) {
  std::array<Code, 256> codes;
  std::uint16_t bits = 0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i, bits = static_cast<std::uint16_t>(bits << 1)) {
    for (int k = 0; k < lengths[i]; ++k) codes[symbols[next++]] = {bits++, static_cast<std::uint8_t>(i + 1)};
  }
  return codes;
}

struct Tables {
  std::array<std::array<std::uint8_t, kArea>, 2> steps;  // of luminance and chrominance, row-major
  std::array<std::array<float, kArea>, 2> weights;       // 1 / step for the transform's outputs, transposed
  std::array<Code, 256> dc = codes_of(kDcLengths, kDcSymbols), ac = codes_of(kAcLengths, kAcSymbols);

  explicit Tables(int quality) {
    const int scale = quality < 50 ? 5000 / quality : 200 - 2 * quality;
    const auto factor = [](int k) {  // of the transform's output
      return k == 0 ? 2.0 * std::sqrt(2.0) : 4.0 * std::cos(k * std::acos(-1.0) / 16.0);
    };
    for (std::size_t table = 0; table < 2; ++table) {
      for (std::size_t i = 0; i < kArea; ++i) {
        const int base = table == 0 ? kLuminance[i] : kChrominance[i];
        const int step = std::clamp((base * scale + 50) / 100, 1, 255);
        const int row = static_cast<int>(i) / kSide, column = static_cast<int>(i) % kSide;
        steps[table][i] = static_cast<std::uint8_t>(step);
        weights[table][static_cast<std::size_t>(column * kSide + row)] =
            static_cast<float>(1.0 / (step * factor(row) * factor(column)));
      }
    }
  }
};

// The transform of eight numbers, lane by lane.
WILT_INLINE void transform(Float16 (&d)[kSide]) {
  const Float16 s07 = d[0] + d[7], d07 = d[0] - d[7], s16 = d[1] + d[6], d16 = d[1] - d[6];
  const Float16 s25 = d[2] + d[5], d25 = d[2] - d[5], s34 = d[3] + d[4], d34 = d[3] - d[4];
  const Float16 even0 = s07 + s34, even3 = s07 - s34, even1 = s16 + s25, even2 = s16 - s25;
  const Float16 turned = (even2 + even3) * 0.707106781f;
  d[0] = even0 + even1, d[4] = even0 - even1;
  d[2] = even3 + turned, d[6] = even3 - turned;
  const Float16 odd0 = d34 + d25, odd1 = d25 + d16, odd2 = d16 + d07;
  const Float16 z5 = (odd0 - odd2) * 0.382683433f, z2 = odd0 * 0.541196100f + z5,
                z4 = odd2 * 1.306562965f + z5, z3 = odd1 * 0.707106781f;
  const Float16 z11 = d07 + z3, z13 = d07 - z3;
  d[5] = z13 + z2, d[3] = z13 - z2;
  d[1] = z11 + z4, d[7] = z11 - z4;
}

// Transposes the 8 x 8 numbers in the lower and in the upper lanes: squares of 4, 2 and 1 change places.
WILT_INLINE void transpose(Float16 (&d)[kSide]) {
  for (int i = 0; i < 4; ++i) {
    const Float16 a = d[i], b = d[i + 4];
    d[i] = __builtin_shufflevector(a, b, 0, 1, 2, 3, 16, 17, 18, 19, 8, 9, 10, 11, 24, 25, 26, 27);
    d[i + 4] = __builtin_shufflevector(a, b, 4, 5, 6, 7, 20, 21, 22, 23, 12, 13, 14, 15, 28, 29, 30, 31);
  }
  for (const int i : {0, 1, 4, 5}) {
    const Float16 a = d[i], b = d[i + 2];
    d[i] = __builtin_shufflevector(a, b, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29);
    d[i + 2] = __builtin_shufflevector(a, b, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30, 31);
  }
  for (const int i : {0, 2, 4, 6}) {
    const Float16 a = d[i], b = d[i + 1];
    d[i] = __builtin_shufflevector(a, b, 0, 16, 2, 18, 4, 20, 6, 22, 8, 24, 10, 26, 12, 28, 14, 30);
    d[i + 1] = __builtin_shufflevector(a, b, 1, 17, 3, 19, 5, 21, 7, 23, 9, 25, 11, 27, 13, 29, 15, 31);
  }
}

// Quantised coefficients of one channel of a row of blocks: the pair of blocks k takes 2 x 64 numbers from
// 128 k, coefficient (u, v) (column, row) of its block b at 16 u + 8 b + v. `pixels`: 8 rows of `width`.
WILT_CLONES void quantise(const float* pixels, int width, const float* weights, std::int32_t* coefficients) {
  for (int x = 0; x < width; x += 2 * kSide, coefficients += 2 * kArea) {
    Float16 d[kSide];
    for (int y = 0; y < kSide; ++y) d[y] = simd::load(pixels + static_cast<std::ptrdiff_t>(y) * width + x);
    transform(d);
    transpose(d);
    transform(d);
    for (int u = 0; u < kSide; ++u) {
      float twice[2 * kSide];
      for (int v = 0; v < 2 * kSide; ++v) twice[v] = weights[kSide * u + v % kSide];
      const Float16 value = d[u] * simd::load(twice);
      const Float16 half = value < 0.0f ? Float16{} - 0.5f : Float16{} + 0.5f;
      const Int16 rounded = __builtin_convertvector(value + half, Int16);
      std::memcpy(coefficients + 2 * kSide * u, &rounded, sizeof rounded);
    }
  }
}

class BitWriter {
 public:
  explicit BitWriter(std::string& bytes) : bytes_(bytes) {}

  void put(std::uint32_t bits, int length) {
    pending_ = pending_ << length | bits;
    count_ += length;
    while (count_ >= 8) {
      count_ -= 8;
      const auto byte = static_cast<char>(pending_ >> count_ & 0xff);
      bytes_.push_back(byte);
      if (byte == '\xff') bytes_.push_back('\0');
    }
  }
  void put(const Code& code) { put(code.bits, code.length); }

  /// Fills the last byte with ones.
  void finish() {
    if (count_ > 0) put((1u << (8 - count_)) - 1, 8 - count_);
  }

 private:
  std::string& bytes_;
  std::uint64_t pending_ = 0;
  int count_ = 0;
};

// A symbol whose low four bits are the size of `value`, then its bits (F.1.2).
void put_value(BitWriter& out, const std::array<Code, 256>& codes, int run, int value) {
  const auto magnitude = static_cast<std::uint32_t>(std::abs(value));
  const int size = magnitude == 0 ? 0 : 32 - __builtin_clz(magnitude);
  out.put(codes[static_cast<std::size_t>(run << 4 | size)]);
  if (size > 0) out.put(static_cast<std::uint32_t>(value < 0 ? value - 1 : value) & ((1u << size) - 1), size);
}

// A block whose coefficient (u, v) stands at 16 u + v; `last_dc` is that of the block before.
void put_block(BitWriter& out, const Tables& tables, const std::int32_t* block, int& last_dc) {
  put_value(out, tables.dc, 0, block[0] - last_dc);
  last_dc = block[0];
  int run = 0;
  for (std::size_t k = 1; k < kArea; ++k) {
    const int value = block[kZigzag[k] % kSide * 2 * kSide + kZigzag[k] / kSide];
    if (value == 0) {
      ++run;
      continue;
    }
    for (; run > 15; run -= 16) out.put(tables.ac[0xf0]);
    put_value(out, tables.ac, run, value);
    run = 0;
  }
  if (run > 0) out.put(tables.ac[0x00]);
}

// Luminance and the two colour differences of eight rows from `top`, `width` a row; pixels beyond the
// picture repeat its edge.
void convert_rows(const Image& image, int top, int width, std::array<std::vector<float>, kChannels>& planes) {
  for (int y = 0; y < kSide; ++y) {
    const std::uint8_t* row = image.pixel(0, std::min(top + y, image.height - 1));
    const std::size_t begin = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
    for (int x = 0; x < width; ++x) {
      const std::uint8_t* p = row + 3 * std::min(x, image.width - 1);
      const float r = p[0], g = p[1], b = p[2];
      const std::size_t i = begin + static_cast<std::size_t>(x);
      planes[0][i] = 0.299F * r + 0.587F * g + 0.114F * b - 128.0F;
      planes[1][i] = -0.168736F * r - 0.331264F * g + 0.5F * b;
      planes[2][i] = 0.5F * r - 0.418688F * g - 0.081312F * b;
    }
  }
}

// The coded bits of the blocks in rows top to top + 7.
std::string block_row(const Image& image, const Tables& tables, int top) {
  const int blocks = (image.width + kSide - 1) / kSide, width = (blocks + 1) / 2 * 2 * kSide;
  std::array<std::vector<float>, kChannels> planes;
  std::array<std::vector<std::int32_t>, kChannels> coefficients;
  for (auto& plane : planes) plane.resize(static_cast<std::size_t>(width * kSide));
  convert_rows(image, top, width, planes);
  for (std::size_t c = 0; c < kChannels; ++c) {
    coefficients[c].resize(planes[c].size());
    quantise(planes[c].data(), width, tables.weights[std::min<std::size_t>(c, 1)].data(),
             coefficients[c].data());
  }
  std::string bytes;
  BitWriter out(bytes);
  std::array<int, kChannels> last_dc{};
  for (int block = 0; block < blocks; ++block) {
    const std::size_t first = static_cast<std::size_t>(block / 2 * 2 * kArea + block % 2 * kSide);
    for (std::size_t c = 0; c < kChannels; ++c) put_block(out, tables, &coefficients[c][first], last_dc[c]);
  }
  out.finish();
  return bytes;
}

void put_u16(std::string& bytes, int value) {
  bytes.push_back(static_cast<char>(value >> 8));
  bytes.push_back(static_cast<char>(value & 0xff));
}

void put_segment(std::string& bytes, char marker, std::string_view content) {
  bytes.push_back('\xff');
  bytes.push_back(marker);
  put_u16(bytes, static_cast<int>(content.size()) + 2);
  bytes += content;
}

template <class Symbols>
std::string huffman_segment(char kind, const Lengths& lengths, const Symbols& symbols) {
  std::string content(1, kind);
  content.append(lengths.begin(), lengths.end());
  content.append(symbols.begin(), symbols.end());
  return content;
}

std::string header(const Image& image, const Tables& tables) {
  std::string bytes = "\xff\xd8";
  put_segment(bytes, '\xe0', std::string_view("JFIF\0\1\1\0\0\1\0\1\0\0", 14));
  for (std::size_t table = 0; table < 2; ++table) {
    std::string content(1, static_cast<char>(table));
    for (const std::uint8_t place : kZigzag) content.push_back(static_cast<char>(tables.steps[table][place]));
    put_segment(bytes, '\xdb', content);
  }
  std::string frame(1, '\10');  // bits a sample
  put_u16(frame, image.height);
  put_u16(frame, image.width);
  frame += std::string_view("\3\1\x11\0\2\x11\1\3\x11\1", 10);  // channels: number, sampling, quantisation
  put_segment(bytes, '\xc0', frame);
  put_segment(bytes, '\xc4', huffman_segment('\x00', kDcLengths, kDcSymbols));
  put_segment(bytes, '\xc4', huffman_segment('\x10', kAcLengths, kAcSymbols));
  std::string interval;
  put_u16(interval, (image.width + kSide - 1) / kSide);
  put_segment(bytes, '\xdd', interval);
  put_segment(bytes, '\xda', std::string_view("\3\1\0\2\0\3\0\0\77\0", 10));  // channels: number, codes
  return bytes;
}

}  // namespace

std::string baseline_jpeg(const Image& image, int quality) {
  const Tables tables(std::clamp(quality, 1, 100));
  std::vector<std::string> rows(static_cast<std::size_t>((image.height + kSide - 1) / kSide));
  parallel_for(static_cast<int>(rows.size()), 4, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) rows[static_cast<std::size_t>(i)] = block_row(image, tables, i * kSide);
  });
  std::string bytes = header(image, tables);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i > 0) {
      bytes.push_back('\xff');
      bytes.push_back(static_cast<char>(0xd0 + (i - 1) % 8));
    }
    bytes += rows[i];
  }
  bytes += "\xff\xd9";
  return bytes;
}

}  // namespace wilt
