#include "wilt/output/glb_container.hpp"

#include <fmt/format.h>

#include "wilt/core/error.hpp"

namespace wilt {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJson = 0x4E4F534A, kBinary = 0x004E4942;
constexpr std::size_t kHeaderSize = 12, kChunkHeaderSize = 8;

void append_u32(std::string& bytes, std::uint64_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>(value >> shift & 0xff));
}

std::uint32_t read_u32(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

std::uint64_t padded(std::size_t size) {
  return (static_cast<std::uint64_t>(size) + 3) / 4 * 4;
}

}  // namespace

std::string join_glb(std::string_view json, std::string binary) {
  const std::uint64_t total =
      kHeaderSize + 2 * kChunkHeaderSize + padded(json.size()) + padded(binary.size());
  if (total > UINT32_MAX) {
    throw Error(ErrorCode::output,
                fmt::format("the GLB would have {} bytes, a GLB can have {}: write fewer frames or vertices",
                            total, UINT32_MAX));
  }
  std::string head;
  for (const std::uint64_t word :
       {std::uint64_t{kMagic}, std::uint64_t{kVersion}, total, padded(json.size()), std::uint64_t{kJson}})
    append_u32(head, word);
  head.append(json);
  head.append(padded(json.size()) - json.size(), ' ');
  for (const std::uint64_t word : {padded(binary.size()), std::uint64_t{kBinary}}) append_u32(head, word);
  binary.append(padded(binary.size()) - binary.size(), '\0');
  binary.insert(0, head);
  return binary;
}

std::string_view glb_json(std::string_view bytes, const std::string& name) {
  const auto refuse = [&](const std::string& reason) {
    throw Error(ErrorCode::input, fmt::format("'{}' is not a GLB that can be read: {}", name, reason));
  };
  if (bytes.size() < kHeaderSize + kChunkHeaderSize || read_u32(bytes, 0) != kMagic)
    refuse("it does not begin with a GLB header; give a .glb that wilt wrote");
  if (read_u32(bytes, 4) != kVersion)
    refuse(fmt::format("its version is {}, wilt reads version 2", read_u32(bytes, 4)));
  if (read_u32(bytes, 8) != bytes.size()) {
    refuse(fmt::format("it has {} bytes and its header says {}; it was cut off or changed, write it again",
                       bytes.size(), read_u32(bytes, 8)));
  }
  const std::size_t size = read_u32(bytes, 12);
  if (read_u32(bytes, 16) != kJson || size > bytes.size() - kHeaderSize - kChunkHeaderSize)
    refuse("its first chunk is not its JSON; it was changed, write it again");
  return bytes.substr(kHeaderSize + kChunkHeaderSize, size);
}

}  // namespace wilt
