// The designs hitpipe knows. A design is one file in hls/pipelines and one hitpipe_design() line in
// CMakeLists.txt.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hls/box/arithmetic.hpp"
#include "rtl_gen/catalogue/format.hpp"
#include "rtl_gen/graph/graph.hpp"

namespace hitpipe::rtl {

/// The pipeline's C++ on the host: HIT for operands in port order, each sign-extended when its port is
/// signed.
using Evaluate = std::function<bool(const std::int64_t* operands)>;
using MakeGraph = std::function<Graph()>;

struct Design {
  std::string_view name;        ///< also the Verilog module's
  std::string_view summary;     ///< one line, with its figures in the thesis
  hls::Arithmetic arithmetic;   ///< decides the formats it has
  MakeGraph (*traced)(Format);  ///< null for a format it does not have
  Evaluate (*native)(Format);   ///< likewise

  [[nodiscard]] bool is_float() const { return arithmetic == hls::Arithmetic::floating; }
  /// 20/24, or binary32.
  [[nodiscard]] Format default_format() const;
  /// A format of this design as a user writes it. Throws std::runtime_error, one line, that says what is
  /// allowed.
  [[nodiscard]] Format parse_format(std::string_view text) const;
  /// Both throw std::runtime_error, one line, when there is no such format.
  [[nodiscard]] Graph trace(Format format) const;
  [[nodiscard]] Evaluate evaluate(Format format) const;
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
/// Where the port of that name is; as many as there are where none is.
[[nodiscard]] std::size_t index_of(const std::vector<Port>& ports, const std::string& name);

}  // namespace hitpipe::rtl
