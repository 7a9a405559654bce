#include "rays/image/core_header.hpp"

#include <array>
#include <bit>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "hls/machines/block_kind.hpp"
#include "hls/world/world_format.hpp"
#include "host/text.hpp"

namespace hitpipe::ref {

namespace {

/// The version of the layout follows it.
constexpr std::string_view magic = "hitpipe";
constexpr unsigned version_at = 56;  ///< of the first word

/// Places of 64 bits in the header.
enum HeaderWord : std::size_t {
  magic_word,
  sizes_word,
  counts_word,
  offset_word = 4,
  scale_word = 8,
  checksum_word
};
/// These are 0. Three of them end a block, so its last byte is 0 and nobody takes it for a record or a triangle.
constexpr std::array<std::size_t, 4> empty_words{3, 7, 10, 11};

std::uint64_t word_of(std::string_view text) {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < text.size(); ++i)
    word |= std::uint64_t{static_cast<unsigned char>(text[i])} << 8 * i;
  return word;
}

std::uint64_t& word(std::vector<CoreBlock>& blocks, std::size_t place) {
  return blocks[1 + place / 4][place % 4];
}
std::uint64_t word(std::span<const CoreBlock> blocks, std::size_t place) {
  return blocks[1 + place / 4][place % 4];
}

/// FNV-1a of all bytes but those of the checksum.
std::uint64_t checksum_of(std::span<const CoreBlock> blocks) {
  std::uint64_t hash = host::fnv1a_start;
  for (std::size_t block = 0; block < blocks.size(); ++block)
    for (std::size_t i = 0; i < 4; ++i) {
      if (4 * block + i == 4 + checksum_word) continue;
      std::array<std::byte, 8> bytes;
      for (std::size_t byte = 0; byte < 8; ++byte)
        bytes[byte] = std::byte(blocks[block][i] >> 8 * byte & 0xff);
      hash = host::fnv1a(bytes, hash);
    }
  return hash;
}

}  // namespace

void put_header(std::vector<CoreBlock>& blocks, const CoreHeader& header) {
  word(blocks, magic_word) = word_of(magic) | std::uint64_t{hls::image_version} << version_at;
  word(blocks, sizes_word) =
      static_cast<std::uint64_t>(header.coord_bits) | static_cast<std::uint64_t>(header.levels) << 8 |
      static_cast<std::uint64_t>(header.most_in_leaf) << 16 | std::uint64_t{blocks.size()} << 32;
  word(blocks, counts_word) = header.triangles | std::uint64_t{header.missing} << 32;
  for (std::size_t axis = 0; axis < 3; ++axis)
    word(blocks, offset_word + axis) =
        std::bit_cast<std::uint64_t>(header.to_cube.offset[static_cast<glm::length_t>(axis)]);
  word(blocks, scale_word) = std::bit_cast<std::uint64_t>(header.to_cube.scale);
  word(blocks, checksum_word) = checksum_of(blocks);
}

CoreHeader header_of(std::span<const CoreBlock> blocks) {
  constexpr std::uint64_t name = (std::uint64_t{1} << version_at) - 1;
  if (blocks.size() <= header_blocks || (word(blocks, magic_word) & name) != word_of(magic))
    throw std::runtime_error("there is no header; allowed is a file of `hitpipe core image`");
  if (const std::uint64_t version = word(blocks, magic_word) >> version_at; version != hls::image_version)
    throw std::runtime_error(
        fmt::format("the image has version {} of its layout; allowed is {}", version, hls::image_version));
  const std::uint64_t sizes = word(blocks, sizes_word), counts = word(blocks, counts_word);
  if (sizes >> 32 != blocks.size())
    throw std::runtime_error(
        fmt::format("there are {} blocks; allowed are {}, as the header says", blocks.size(), sizes >> 32));
  if (blocks.size() % 2 != 0)
    throw std::runtime_error(fmt::format(
        "there are {} blocks; allowed is an even number, since memory has lines of two", blocks.size()));
  if (word(blocks, checksum_word) != checksum_of(blocks))
    throw std::runtime_error("the checksum differs: the image was changed or half written");
  for (const std::size_t place : empty_words)
    if (word(blocks, place) != 0)
      throw std::runtime_error(
          fmt::format("the header has {:#x} as its word {}; allowed is 0", word(blocks, place), place));
  if ((sizes >> 24 & 0xff) != 0)
    throw std::runtime_error(
        fmt::format("the header has {} as byte 43 of the image; allowed is 0", sizes >> 24 & 0xff));
  constexpr int least = hls::WorldBits::min_proved_coord, most = hls::WorldBits::max_coord;
  const auto coord_bits = static_cast<int>(sizes & 0xff);
  if (coord_bits < least || coord_bits > most)
    throw std::runtime_error(
        fmt::format("the header says a grid of {} bits; allowed is {} to {}", coord_bits, least, most));
  CoreHeader header{.coord_bits = coord_bits,
                    .levels = static_cast<int>(sizes >> 8 & 0xff),
                    .triangles = static_cast<std::uint32_t>(counts),
                    .missing = static_cast<std::uint32_t>(counts >> 32),
                    .most_in_leaf = static_cast<int>(sizes >> 16 & 0xff)};
  for (std::size_t axis = 0; axis < 3; ++axis)
    header.to_cube.offset[static_cast<glm::length_t>(axis)] =
        std::bit_cast<double>(word(blocks, offset_word + axis));
  header.to_cube.scale = std::bit_cast<double>(word(blocks, scale_word));
  return header;
}

std::string core_image_bytes(std::span<const CoreBlock> blocks) {
  std::string bytes;
  bytes.reserve(blocks.size() * core_block_bytes);
  for (const CoreBlock& block : blocks)
    for (const std::uint64_t part : block)
      for (unsigned byte = 0; byte < 8; ++byte) bytes += static_cast<char>(part >> 8 * byte & 0xff);
  return bytes;
}

std::vector<CoreBlock> core_image_blocks(const std::string& bytes) {
  if (bytes.size() % core_block_bytes != 0)
    throw std::runtime_error(
        fmt::format("there are {} bytes; allowed are whole blocks of {}", bytes.size(), core_block_bytes));
  std::vector<CoreBlock> blocks(bytes.size() / core_block_bytes);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const std::uint64_t byte = static_cast<unsigned char>(bytes[i]);
    blocks[i / core_block_bytes][i % core_block_bytes / 8] |= byte << 8 * (i % 8);
  }
  return blocks;
}

}  // namespace hitpipe::ref
