#include "sw_ref/render/png_check.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <boost/crc.hpp>
#include <fmt/format.h>

namespace hitpipe::ref {
namespace {

/// Big-endian.
std::uint32_t number(const char* bytes) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8U | static_cast<unsigned char>(bytes[i]);
  return value;
}

bool filled(std::ifstream& in, char* bytes, std::size_t count) {
  return static_cast<bool>(in.read(bytes, static_cast<std::streamsize>(count)));
}

}  // namespace

void check_png(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::array<char, 8> head{};
  if (!filled(in, head.data(), head.size()) || std::string(head.data(), 8) != "\x89PNG\r\n\x1a\n") return;
  const std::uint64_t size = std::filesystem::file_size(file);
  const auto reject = [](const std::string& why) {
    throw std::runtime_error(fmt::format("a damaged PNG, {}; give a whole one", why));
  };
  std::vector<char> chunk;  // name, contents, checksum
  while (filled(in, head.data(), 4)) {
    const std::uint64_t length = number(head.data());
    if (length + 8 > size - static_cast<std::uint64_t>(in.tellg())) reject("it ends within a chunk");
    chunk.resize(length + 8);
    if (!filled(in, chunk.data(), chunk.size())) reject("it cannot be read to its end");
    boost::crc_32_type sum;
    sum.process_bytes(chunk.data(), length + 4);
    if (sum.checksum() != number(chunk.data() + length + 4)) reject("a checksum is wrong");
    if (std::string(chunk.data(), 4) == "IEND") return;
  }
  reject("its end is missing");
}

}  // namespace hitpipe::ref
