#include "sw_ref/hierarchy/word_reader.hpp"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include <fmt/format.h>

#include "sw_ref/reject.hpp"

namespace hitpipe::ref {

namespace {

bool is_blank(int c) {
  return c == ' ' || c == '\t' || c == '\r';
}

[[noreturn]] void reject_errno(int error) {
  reject(fmt::format("cannot be read: {}", std::generic_category().message(error)));
}

}  // namespace

WordReader::WordReader(const std::filesystem::path& file) : buffer_(std::size_t{1} << 16U) {
  file_.reset(std::fopen(file.c_str(), "rbe"));
  if (!file_) reject_errno(errno);
}

bool WordReader::next_line() {
  while (started_ && !word().empty()) {
  }
  started_ = true;
  while (true) {
    // At a comment, the end of a line, the end of the file, or the first word.
    int c = peek();
    if (c == '#') {
      while (c != '\n' && c != end_of_file) {
        ++at_;
        c = peek();
      }
    }
    if (c == end_of_file) {
      line_ = last_with_words_;
      return false;
    }
    if (c != '\n' && !is_blank(c)) {
      last_with_words_ = line_;
      return true;
    }
    line_ += c == '\n' ? 1 : 0;
    ++at_;
  }
}

std::string_view WordReader::word() {
  while (is_blank(peek())) ++at_;
  // A word that is cut by the end of the buffer is moved to its front.
  if (end_ - at_ <= longest_word) refill();
  const std::size_t first = at_;
  while (at_ < end_ && !is_blank(buffer_[at_]) && buffer_[at_] != '\n' && buffer_[at_] != '#') {
    if (++at_ - first > longest_word)
      reject(fmt::format("line {}: a word of more than {} characters", line_, longest_word));
  }
  return {buffer_.data() + first, at_ - first};
}

int WordReader::peek() {
  if (at_ == end_) refill();
  return at_ == end_ ? end_of_file : static_cast<unsigned char>(buffer_[at_]);
}

void WordReader::refill() {
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(at_),
            buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
  end_ -= at_;
  at_ = 0;
  end_ += std::fread(buffer_.data() + end_, 1, buffer_.size() - end_, file_.get());
  if (std::ferror(file_.get()) != 0) reject_errno(errno);
}

std::string quoted(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text(word.substr(0, longest));
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
  return fmt::format("\"{}{}\"", text, word.size() > longest ? "..." : "");
}

}  // namespace hitpipe::ref
