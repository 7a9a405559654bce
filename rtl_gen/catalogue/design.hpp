// The designs hitpipe knows. A design is one file in hls/pipelines and one hitpipe_design() line in
// CMakeLists.txt.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hls/box/int_format.hpp"
#include "rtl_gen/graph/graph.hpp"

namespace hitpipe::rtl {

/// The pipeline's C++ on the host: HIT for operands in port order, each sign-extended when its port is
/// signed.
using Evaluate = bool (*)(const std::int64_t* operands);

struct Design {
  std::string_view name;               ///< also the Verilog module's
  std::string_view summary;            ///< one line, with its figures in the thesis
  Graph (*(*traced)(hls::IntBits))();  ///< null for a format it does not have
  Evaluate (*native)(hls::IntBits);    ///< likewise

  /// Both throw std::runtime_error, one line, when there is no such format.
  [[nodiscard]] Graph trace(hls::IntBits bits) const;
  [[nodiscard]] Evaluate evaluate(hls::IntBits bits) const;
};

[[nodiscard]] std::span<const Design> designs();
/// Throws std::runtime_error that lists the designs when there is none of that name.
[[nodiscard]] const Design& find_design(std::string_view name);

struct Port {
  std::string name;
  int width;  ///< 1..64
  bool is_signed;
};
/// A graph's inputs, in order.
[[nodiscard]] std::vector<Port> input_ports(const Graph& graph);

/// "20/24". Throws std::runtime_error naming the text and what is allowed.
[[nodiscard]] hls::IntBits parse_bits(std::string_view text);
[[nodiscard]] std::string to_string(hls::IntBits bits);

}  // namespace hitpipe::rtl
