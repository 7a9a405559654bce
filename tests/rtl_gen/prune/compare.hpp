// A fitted graph against the unfitted design's C++ on the host, on random operands as demanded.
#pragma once

#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rtl_gen/prune/facts.hpp"
#include "rtl_gen/prune/prune.hpp"
#include "tests/rtl_gen/prune/demand_sets.hpp"

namespace hitpipe::rtl {

struct Comparison {
  std::size_t vectors = 0;
  std::size_t hits = 0;
  std::string mismatch{};  ///< the first one: operands in hex; empty: none
};

inline Comparison compare(const Design& design, Format format, const Demands& demands, const Graph& fitted,
                          std::size_t vectors, Seeded& random) {
  const std::vector<Port> ports = design.ports(format);
  const Draw draw(ports, demands);
  const Evaluate native = design.evaluate(format);
  Comparison result;
  for (; result.vectors < vectors && result.mismatch.empty(); ++result.vectors) {
    const std::vector<std::int64_t> operands = draw(random);
    const bool expected = native(operands.data());
    result.hits += expected ? 1 : 0;
    const bool found = evaluate(fitted, operands_left(fitted, ports, operands)).front() != 0;
    if (found == expected) continue;
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < ports.size(); ++i)
      texts.push_back(fmt::format("{}={:#x}", ports[i].name,
                                  static_cast<std::uint64_t>(operands[i]) & hls::low_mask(ports[i].width)));
    result.mismatch = fmt::format("{} {}: fitted {}, C++ {}: {}", design.name, to_string(format), found,
                                  expected, fmt::join(texts, " "));
  }
  return result;
}

}  // namespace hitpipe::rtl
