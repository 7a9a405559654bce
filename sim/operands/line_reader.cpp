#include "sim/operands/line_reader.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

namespace hitpipe::sim {

namespace {

constexpr std::size_t longest_line = 1 << 16;

[[noreturn]] void cannot_read(const std::string& name, int error) {
  throw std::runtime_error(
      fmt::format("{}: cannot read the file: {}", name, std::generic_category().message(error)));
}

}  // namespace

LineReader::LineReader(const std::string& file)
    : name_(file == "-" ? "standard input" : file),
      file_(file == "-" ? stdin : std::fopen(file.c_str(), "rbe")),
      buffer_(longest_line) {
  if (file_ == nullptr) cannot_read(name_, errno);
  std::error_code ignored;
  if (file != "-" && std::filesystem::is_regular_file(file, ignored))
    size_ = std::filesystem::file_size(file, ignored);
}

LineReader::~LineReader() {
  if (file_ != stdin) static_cast<void>(std::fclose(file_));
}

bool LineReader::fill() {
  std::memmove(buffer_.data(), buffer_.data() + from_, to_ - from_);
  to_ -= from_;
  from_ = 0;
  const std::size_t got = std::fread(buffer_.data() + to_, 1, buffer_.size() - to_, file_);
  if (got == 0 && std::ferror(file_) != 0) cannot_read(name_, errno);
  to_ += got;
  return got > 0;
}

std::optional<std::string_view> LineReader::next() {
  std::size_t seen = 0;  // bytes without a line end
  for (;;) {
    const char* const begin = buffer_.data() + from_;
    const void* const end = std::memchr(begin + seen, '\n', to_ - from_ - seen);
    const bool ended = end != nullptr;
    std::size_t length =
        ended ? static_cast<std::size_t>(static_cast<const char*>(end) - begin) : to_ - from_;
    if (!ended) {
      seen = length;
      if (length == buffer_.size())
        throw std::runtime_error(
            fmt::format("{}: line {} is longer than {} bytes", name_, number_ + 1, longest_line));
      if (fill()) continue;
      if (length == 0) return std::nullopt;
    }
    const std::string_view line(buffer_.data() + from_, length);
    length += ended ? 1 : 0;
    from_ += length;
    given_ += length;
    ++number_;
    return line.ends_with('\r') ? line.substr(0, line.size() - 1) : line;
  }
}

std::optional<double> LineReader::share() const {
  if (size_ == 0) return std::nullopt;
  return std::min(1.0, static_cast<double>(given_) / static_cast<double>(size_));
}

}  // namespace hitpipe::sim
