#include "rtl_gen/emit/vectors.hpp"

#include <algorithm>
#include <random>
#include <utility>

#include <fmt/format.h>

#include "hls/num/bits.hpp"

namespace hitpipe::rtl {

namespace {

std::int64_t fit(std::uint64_t bits, const Port& port) {
  return port.is_signed ? hls::sign_extended(bits, port.width)
                        : static_cast<std::int64_t>(bits & hls::low_mask(port.width));
}

/// Most significant bit first.
std::string binary(std::int64_t value, int width) {
  std::string text;
  for (int i = width - 1; i >= 0; --i) text += (value >> i & 1) != 0 ? '1' : '0';
  return text;
}

std::string hexadecimal(std::string bits) {
  while (bits.size() % 4 != 0) bits.insert(bits.begin(), '0');
  std::string text;
  for (std::size_t i = 0; i < bits.size(); i += 4)
    text += fmt::format("{:x}", std::stoi(bits.substr(i, 4), nullptr, 2));
  return text;
}

}  // namespace

std::vector<std::vector<std::int64_t>> operand_vectors(const std::vector<Port>& ports, int count,
                                                       std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<std::vector<std::int64_t>> vectors;
  // Corners as bit patterns: zero, one, minus one, most and least, alternating; each port draws its own.
  const std::vector<std::uint64_t> corners{
      0, 1, ~std::uint64_t{0}, ~std::uint64_t{0} >> 1, std::uint64_t{1} << 63, 0x5555555555555555U};
  for (int i = 0; i < count; ++i) {
    std::vector<std::int64_t> operands;
    for (const Port& port : ports) {
      std::uint64_t bits = random();
      if (i % 4 == 0) {
        const std::uint64_t corner = corners[bits % corners.size()];
        // Extremes sit at the top of the port's own width.
        bits = corner > 1 && corner != ~std::uint64_t{0} ? corner >> (64 - port.width) : corner;
      } else if (i % 4 == 1) {
        bits = static_cast<std::uint64_t>(static_cast<std::int64_t>(bits) >> (64 - 4));  // close to zero
      }
      operands.push_back(fit(bits, port));
    }
    vectors.push_back(std::move(operands));
  }
  return vectors;
}

std::vector<Vector> with_results(std::vector<std::vector<std::int64_t>> operands, const Evaluate& evaluate) {
  std::vector<Vector> vectors;
  for (std::vector<std::int64_t>& each : operands) vectors.push_back(with_results(std::move(each), evaluate));
  return vectors;
}

std::string vector_file(const std::vector<Port>& ports, const std::vector<Port>& left,
                        const std::vector<hls::Result>& results, const std::vector<Vector>& vectors) {
  std::vector<std::size_t> places;
  for (const Port& port : left) places.push_back(index_of(ports, port.name).value());
  std::string text;
  for (const Vector& vector : vectors) {
    std::string bits;
    for (std::size_t i = 0; i < left.size(); ++i) bits += binary(vector.operands[places[i]], left[i].width);
    for (std::size_t i = 0; i < results.size(); ++i) bits += binary(vector.results[i], results[i].width);
    text += hexadecimal(std::move(bits)) + "\n";
  }
  return text;
}

std::size_t VectorSet::size() const {
  std::size_t sum = 0;
  for (const VectorGroup& group : groups) sum += group.vectors.size();
  return sum;
}

std::vector<Vector> VectorSet::all() const {
  std::vector<Vector> vectors;
  for (const VectorGroup& group : groups)
    vectors.insert(vectors.end(), group.vectors.begin(), group.vectors.end());
  return vectors;
}

namespace {

bool has_hit(const std::vector<hls::Result>& results) {
  return std::any_of(results.begin(), results.end(),
                     [](const hls::Result& result) { return result.meaning == hls::Meaning::hit; });
}

}  // namespace

std::size_t hits(const std::vector<Vector>& vectors, const std::vector<hls::Result>& results) {
  const auto hits_a_box = [&](const Vector& vector) {
    if (!has_hit(results)) return verdict_of(results)(vector.results.data());
    for (std::size_t i = 0; i < results.size(); ++i)
      if (results[i].meaning == hls::Meaning::hit && vector.results[i] != 0) return true;
    return false;
  };
  return static_cast<std::size_t>(std::count_if(vectors.begin(), vectors.end(), hits_a_box));
}

std::string vector_summary(const std::string& unit, const VectorSet& set,
                           const std::vector<hls::Result>& results) {
  std::string text =
      fmt::format("// {}: {} vectors of seed {}, of which {} {}.\n", unit, set.size(), set.seed,
                  hits(set.all(), results), has_hit(results) ? "hit a box" : "have no error");
  text += "// A line is a vector: the operands, the first port in the high bits, then the results.\n";
  text += "// from                     first    last    hits\n";
  std::size_t first = 0;
  for (const VectorGroup& group : set.groups) {
    if (group.vectors.empty()) continue;
    const std::size_t next = first + group.vectors.size();
    text += fmt::format("// {:<22} {:>7} {:>7} {:>7}\n", group.from, first, next - 1,
                        hits(group.vectors, results));
    first = next;
  }
  return text;
}

}  // namespace hitpipe::rtl
