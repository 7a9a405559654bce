// What a design is to everything that makes, prices and tests hardware. A design says it once, in
// rtl_gen/designs/NAME.cpp; docs/designs.md tells how to add one.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hls/box/fp_format.hpp"
#include "hls/box/int_format.hpp"
#include "hls/box/operand.hpp"
#include "host/format.hpp"
#include "rtl_gen/catalogue/evaluate.hpp"
#include "rtl_gen/catalogue/port.hpp"
#include "rtl_gen/graph/graph.hpp"

namespace hitpipe::rtl {

/// Where a design's C++ is, for programs that are written to compile it.
struct DesignSource {
  std::string_view pipeline{};  ///< its struct in hitpipe::hls: "IntSlabs"
  std::string header{};         ///< "hls/pipelines/int_slabs.hpp"
};

struct ThesisRow {
  int row;  ///< of the table, from 1
  Format format;
};

/// The rows of a design in Table 7.2 of the thesis, and how these rows depart from the schematics (section
/// 7.5).
struct ThesisAccounting {
  std::vector<ThesisRow> rows{};
  bool input_latches = false;        ///< the words of figure 7.1 are counted
  bool products_at_n_bits = false;   ///< latches of products have n bits, though t > n bits are compared
  bool side_relations_at_t = false;  ///< q - p and its comparator have t bits, though they need t+1
};

struct Design {
  std::string_view name;
  std::string_view summary;  ///< one line, with its figures in the thesis
  hls::DesignKind kind;      ///< what a test answers
  bool conservative;         ///< HIT whenever the exact ray meets the closed box
  Format default_format;     ///< all its formats are of this format's family
  std::vector<hls::Result> (*results_at)(const Format&);
  std::vector<Port> (*ports_at)(const Format&);
  Graph (*trace_at)(const Format&);
  Evaluate::Run (*run_at)(const Format&);  ///< bit by bit
  /// The same answers by the host's floating-point unit. Null, or gives null: there is no such function.
  Evaluate::Run (*float_unit_run_at)(const Format&) = nullptr;
  ThesisAccounting printed{};  ///< empty: the thesis does not have the design
  DesignSource source{};       ///< nothing: no top function for high-level synthesis is written

  /// A format of this design as a user writes it. Throws std::runtime_error, one line, that says what is
  /// allowed.
  [[nodiscard]] Format parse_format(std::string_view text) const;
  /// All throw std::runtime_error, one line, when there is no such format.
  [[nodiscard]] std::vector<Port> ports(const Format& format) const;
  [[nodiscard]] std::vector<hls::Result> results(const Format& format) const;
  [[nodiscard]] Graph trace(const Format& format) const;
  [[nodiscard]] Evaluate evaluate(const Format& format) const;
  /// The same answers by the host's floating-point unit. Nothing when no part of the design is for that unit.
  [[nodiscard]] std::optional<Evaluate> evaluate_on_float_unit(const Format& format) const;
  /// The name and the format; the name alone if the design has one format.
  [[nodiscard]] std::string name_at(const Format& format) const;
  /// The name of its Verilog module unless the user gives another: the design's name at the default format,
  /// "int_slabs_16_16" at another.
  [[nodiscard]] std::string module_at(const Format& format) const;
  /// " --bits 20/24", or nothing when it has one format only: as a command takes it.
  [[nodiscard]] std::string bits_option(const Format& format) const;
};

/// Throws std::invalid_argument, one line, when a design lacks a result of its kind or has one too many.
void check_kind(const Design& design);

/// The designs of designs.cmake. The build writes this function.
[[nodiscard]] std::deque<Design> own_designs();
/// These designs, then the designs that a program added.
[[nodiscard]] const std::deque<Design>& designs();
/// For a program with designs of its own. Throws std::invalid_argument, one line, if the name is taken or if
/// designs() was called before: its caller would not know of this design.
void add_design(Design design);
/// The names of all designs, separated by commas.
[[nodiscard]] std::string design_names();
/// Throws std::runtime_error, which lists the designs, if no design has that name.
[[nodiscard]] const Design& find_design(std::string_view name);
/// Index of the design of that name in designs(), or nullopt.
[[nodiscard]] std::optional<std::size_t> place_of(const Design& design);

}  // namespace hitpipe::rtl
