#include "rtl_gen/emit/vector_set.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace hitpipe::rtl {

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

std::size_t hits(const std::vector<Vector>& vectors, const std::vector<hls::Result>& results) {
  const auto hits_a_box = [&](const Vector& vector) {
    for (std::size_t i = 0; i < results.size(); ++i)
      if (results[i].meaning == hls::Meaning::hit && vector.results[i] != 0) return true;
    return false;
  };
  return static_cast<std::size_t>(std::count_if(vectors.begin(), vectors.end(), hits_a_box));
}

std::string vector_summary(const std::string& unit, const VectorSet& set,
                           const std::vector<hls::Result>& results) {
  std::string text = fmt::format("// {}: {} vectors of seed {}, of which {} hit a box.\n", unit, set.size(),
                                 set.seed, hits(set.all(), results));
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
