// Changes PLY files by the lines and words of their header, or by the bytes of their body, so that most inputs
// get past the header. Every fourth input is changed as bytes.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <random>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

using Random = std::minstd_rand;

std::size_t below(Random& random, std::size_t count) {
  return random() % count;
}

std::string some_word(Random& random) {
  static const std::vector<std::string> words{"char",
                                              "uchar",
                                              "short",
                                              "ushort",
                                              "int",
                                              "uint",
                                              "float",
                                              "double",
                                              "int8",
                                              "float64",
                                              "list",
                                              "vertex",
                                              "face",
                                              "camera",
                                              "x",
                                              "y",
                                              "z",
                                              "vertex_indices",
                                              "vertex_index",
                                              "property",
                                              "element",
                                              "comment",
                                              "ascii",
                                              "binary_little_endian",
                                              "binary_big_endian",
                                              "0",
                                              "1",
                                              "2",
                                              "3",
                                              "4",
                                              "255",
                                              "4294967295",
                                              "-1",
                                              "1.5",
                                              "tristrips"};
  return words[below(random, words.size())];
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);) parts.push_back(part);
  return parts;
}

std::string joined(const std::vector<std::string>& parts, char by) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : std::string(1, by)) + part;
  return text;
}

/// One change of the lines between the first and end_header.
void change(std::vector<std::string>& lines, Random& random) {
  if (lines.size() < 2) return;
  const auto some_line = [&] { return 1 + below(random, lines.size() - 1); };
  const std::size_t at = some_line();
  switch (below(random, 4)) {
    case 0:
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at));
      break;
    case 1:
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(some_line()), std::string(lines[at]));
      break;
    case 2:
      std::swap(lines[at], lines[some_line()]);
      break;
    default: {
      std::vector<std::string> words = split(lines[at], ' ');
      if (!words.empty()) words[below(random, words.size())] = some_word(random);
      lines[at] = joined(words, ' ');
    }
  }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  constexpr std::string_view end = "\nend_header\n";
  Random random(seed);
  const std::string before(reinterpret_cast<const char*>(data), size);
  const std::size_t header = before.find(end);
  const std::size_t kind = below(random, 4);
  if (kind == 0 || header == std::string::npos) return LLVMFuzzerMutate(data, size, most);
  const std::size_t body = header + end.size();
  if (kind == 1) return body + LLVMFuzzerMutate(data + body, size - body, most - body);
  std::vector<std::string> lines = split(before.substr(0, header), '\n');
  for (std::size_t changes = 1 + below(random, 2); changes > 0; --changes) change(lines, random);
  const std::string after = joined(lines, '\n') + std::string(end) + before.substr(body);
  if (after.size() > most) return LLVMFuzzerMutate(data, size, most);
  std::memcpy(data, after.data(), after.size());
  return after.size();
}
