#include "rays/files/gltf_uri.hpp"

#include <algorithm>
#include <fstream>
#include <optional>

#include <fmt/format.h>

#include "host/outputs.hpp"
#include "host/reject.hpp"
#include "host/text.hpp"

namespace hitpipe::ref {
namespace {

std::optional<std::uint32_t> base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  if (c == '/') return 63;
  return std::nullopt;
}

std::optional<int> hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return std::nullopt;
}

}  // namespace

bool is_data_uri(std::string_view uri) {
  return uri.starts_with("data:");
}

std::string decoded_data_uri(const Place& place, std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64"))
    place.fail("is a data URI without \";base64,\"; allowed are data URIs with it");
  std::string_view digits = uri.substr(comma + 1);
  for (int padding = 0; padding < 2 && digits.ends_with('='); ++padding) digits.remove_suffix(1);
  if (digits.size() % 4 == 1)
    place.fail(fmt::format("has {} base64 digits; the last one has no bits of a byte", digits.size()));
  std::string bytes;
  bytes.reserve(digits.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    const auto digit = base64_digit(digits[i]);
    if (!digit)
      place.fail(fmt::format(
          "character {} of the base64 data is \"{}\"; allowed are letters, digits, + and /", i, digits[i]));
    bits = bits << 6U | *digit;
    if (i % 4 != 0) bytes.push_back(static_cast<char>(bits >> (6U - 2U * (i % 4)) & 0xFFU));
  }
  return bytes;
}

std::string decoded_file_uri(const Place& place, std::string_view uri) {
  // A scheme such as "http:" is letters before the first colon, of which a path has none before.
  const bool has_scheme = uri.find(':') < std::min(uri.find('/'), uri.size());
  if (uri.empty() || uri.starts_with('/') || has_scheme)
    place.fail(fmt::format("\"{}\" is not read; allowed are data URIs and names relative to the file",
                           host::shortened(uri)));
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      name.push_back(uri[i]);
      continue;
    }
    const auto high = i + 2 < uri.size() ? hex_digit(uri[i + 1]) : std::nullopt;
    const auto low = i + 2 < uri.size() ? hex_digit(uri[i + 2]) : std::nullopt;
    if (!high || !low || *high + *low == 0)
      place.fail(
          fmt::format("\"{}\" has a % without two hexadecimal digits, 01 to FF", host::shortened(uri)));
    name.push_back(static_cast<char>(16 * *high + *low));
    i += 2;
  }
  return name;
}

std::string buffer_file_bytes(const std::filesystem::path& file, const std::string& name) {
  const auto refuse = [&](const char* reason) {
    reject(fmt::format("buffer file \"{}\": {}", host::shortened(name), reason));
  };
  std::error_code error;
  if (!std::filesystem::exists(file, error)) refuse("no such file");
  if (!std::filesystem::is_regular_file(file, error)) refuse("is not a regular file");
  host::never_replace(file.string());
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  std::ifstream in(file, std::ios::binary);
  if (!in || error) refuse("cannot be opened");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!in) refuse("cannot be read");
  return bytes;
}

}  // namespace hitpipe::ref
