#include "sim/operands/own_operands.hpp"

#include <charconv>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "hls/num/bits.hpp"
#include "host/text.hpp"
#include "rtl_gen/catalogue/evaluate.hpp"

namespace hitpipe::sim {

namespace {

constexpr std::size_t tests_a_write = 1024;

/// The pattern of the port's bits: "0x7f".
std::optional<std::int64_t> pattern(std::string_view digits, const rtl::Port& port) {
  std::uint64_t bits = 0;
  const char* const end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, bits, 16);
  if (error != std::errc{} || stop != end || (bits & ~hls::low_mask(port.width)) != 0) return std::nullopt;
  const bool negative = port.is_signed && (bits >> (port.width - 1) & 1U) != 0;
  return static_cast<std::int64_t>(negative ? bits | ~hls::low_mask(port.width) : bits);
}

std::optional<std::int64_t> operand(std::string_view word, const rtl::Port& port) {
  if (word.starts_with("0x") || word.starts_with("0X")) return pattern(word.substr(2), port);
  const auto number = host::number_in<std::int64_t>(word);
  const auto [low, high] = numbers_of(port);
  return number && *number >= low && *number <= high ? number : std::nullopt;
}

[[noreturn]] void refuse(const NumberFile& file, const NumberLine& line, std::string_view word,
                         const rtl::Port& port) {
  const auto [low, high] = numbers_of(port);
  file.reject(
      line, fmt::format("{} is \"{}\"; allowed is {} to {}, or the pattern of its {} bits, such as 0x{:x}",
                        port.name, host::shortened(word), low, high, port.width, hls::low_mask(port.width)));
}

/// What `hitpipe operands` writes beside the operands.
std::vector<std::string> other_columns(const rtl::Design& design, const std::vector<hls::Result>& results) {
  std::vector<std::string> names{"ray", "box", "of_parent", "ox", "oy", "oz", "dx", "dy", "dz", "length"};
  for (std::string& name : box_columns(static_cast<std::size_t>(design.kind.objects)))
    names.push_back(std::move(name));
  for (const hls::Result& result : results) names.emplace_back(result.name);
  for (const hls::Result& result : results)
    if (result.meaning == hls::Meaning::hit) names.push_back(fmt::format("exact_{}", result.name));
  return names;
}

}  // namespace

RunCounts run_operands(const rtl::Design& design, const Format& format, const std::string& file,
                       TestForm form, const std::function<void(std::string_view)>& write,
                       const std::function<void(double)>& progress) {
  const TestLayout layout(design, format, form);
  const std::vector<rtl::Port> ports = design.ports(format);
  const std::vector<hls::Result> results = design.results(format);
  const rtl::Evaluate evaluate = design.evaluate(format);
  std::vector<std::string> names;
  for (const rtl::Port& port : ports) names.push_back(port.name);
  NumberFile lines(file, names, other_columns(design, results));
  std::vector<std::string_view> words(lines.columns());
  std::vector<rtl::Vector> vectors;
  std::string text;
  RunCounts counts;
  write(layout.head());
  const auto flush = [&] {
    write(form == TestForm::hex ? layout.vectors(vectors) : text);
    vectors.clear();
    text.clear();
    if (const auto share = lines.share()) progress(*share);
  };
  while (const std::optional<NumberLine> line = lines.next()) {
    lines.words(*line, words);
    rtl::Vector test{std::vector<std::int64_t>(ports.size()), std::vector<std::int64_t>(results.size())};
    for (std::size_t i = 0; i < ports.size(); ++i) {
      const std::optional<std::int64_t> value = operand(words[i], ports[i]);
      if (!value) refuse(lines, *line, words[i], ports[i]);
      test.operands[i] = *value;
    }
    evaluate(test.operands.data(), test.results.data());
    for (std::size_t i = 0; i < results.size(); ++i)
      counts.hits += results[i].meaning == hls::Meaning::hit && test.results[i] != 0 ? 1 : 0;
    ++counts.tests;
    if (form == TestForm::hex) {
      vectors.push_back(std::move(test));
    } else {
      JudgedTest answered;
      answered.operands = test.operands;
      answered.results = test.results;
      layout.append(answered, text);
    }
    if (counts.tests % tests_a_write == 0) flush();
  }
  if (counts.tests == 0)
    throw std::runtime_error(
        fmt::format("{}: there is no line below the names of the columns", lines.name()));
  flush();
  return counts;
}

}  // namespace hitpipe::sim
