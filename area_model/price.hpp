// The price of a scheduled design: Table 7.2 for any design, format and component library. Areas are integers
// in square micrometres, times integers in picoseconds. Only area_model/figure.hpp rounds them, for printing.
// On a chip a price has no area; it has the cells that are taken (rtl::ChipCells).
// Designs are compared by figures for each box: a unit that answers for two boxes in a test may be as large
// as two units that answer for one.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "area_model/count.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/machine/machine.hpp"

namespace hitpipe::area {

enum class Account { printed, built };

/// All parts of one kind: a row of Table 7.2.
struct Line {
  Part part;
  int n = 0;
  std::int64_t area_um2 = 0;  ///< of all n together
  rtl::ChipCells taken{};     ///< likewise
  bool estimated = false;     ///< the library marks this width as an estimate, or computes it by a law; on a
                              ///< chip all figures are from laws, and none is marked
};

struct StagePrice {
  int stage = 0;  ///< 0: the input latches
  std::vector<Line> lines;
  std::int64_t area_um2 = 0;
  rtl::ChipCells taken{};
};

struct Price {
  std::string_view design;
  Format format;
  int boxes = 1;                     ///< that one test answers for
  int interval = 1;                  ///< a test begins every so many cycles
  std::vector<Line> lines;           ///< in the order of Table 7.1
  std::vector<StagePrice> by_stage;  ///< every stage from 0 on
  std::int64_t area_um2 = 0;         ///< built: exact; printed: of rows rounded to 0.0001 mm2 as in Table 7.2
  rtl::ChipCells taken{};
  std::optional<std::int64_t> logic_cells{};  ///< of a chip that has a table and a register in each
  int stages = 0;
  int stage_delay_ps = 0;

  [[nodiscard]] std::int64_t latency_ps() const { return std::int64_t{stages} * stage_delay_ps; }
  /// Area for each box, rounded to um2.
  [[nodiscard]] std::int64_t area_per_box_um2() const { return per_box(area_um2); }
  /// Area for each box times the time from one test to the next, "ADP", rounded to um2 ps.
  [[nodiscard]] std::int64_t area_delay_per_box() const { return per_box(area_um2 * test_ps()); }
  /// From one test to the next.
  [[nodiscard]] std::int64_t test_ps() const { return std::int64_t{interval} * stage_delay_ps; }
  /// Rounded down.
  [[nodiscard]] std::int64_t boxes_per_second() const {
    return boxes * std::int64_t{1'000'000'000'000} / test_ps();
  }

 private:
  [[nodiscard]] std::int64_t per_box(std::int64_t whole) const { return (whole + boxes / 2) / boxes; }
};

/// A design at a format: a row of Table 7.2's summary.
struct Entry {
  std::string_view design;
  Format format;
};

/// `interval` is 1..64 cycles; rtl::make_pipeline() shares components accordingly. Throws as
/// rtl::Design::trace, rtl::Library::cell do; of the printed account also std::runtime_error, one line, for a
/// design that the thesis does not have, for a library that is a chip's, and for an interval of several
/// cycles.
[[nodiscard]] Price price(const rtl::Design& design, const Format& format, const rtl::Library& library,
                          Account account, rtl::FlowControl flow = rtl::FlowControl::stall, int interval = 1);

/// The built account of any pipeline; `design` is the one that it comes from. A multiplier of m x n
/// bits, m > n, has n/m of the area of one of m x m bits, as it has n/m of its partial products. That area is
/// estimated.
[[nodiscard]] Price price(const rtl::Pipeline& pipeline, const rtl::Design& design, const Format& format,
                          const rtl::Library& library, rtl::FlowControl flow = rtl::FlowControl::stall);

/// What a machine takes: its registers and what its step computes. The bits of its memories are apart, since
/// their price is that of a memory compiler, or of a chip's block RAM.
struct MachinePrice {
  std::vector<Line> lines;  ///< in the order of Table 7.1
  std::int64_t area_um2 = 0;
  rtl::ChipCells taken{};
  int register_bits = 0;
  std::int64_t memory_bits = 0;
  int clock_ps = 0;  ///< the shortest, as rtl::longest_path() has it
};
/// Throws as rtl::longest_path() and rtl::Library::cell() do.
[[nodiscard]] MachinePrice price(const rtl::MachineGraph& machine, const rtl::Library& library);

/// The six, in its order: the rows that designs say are theirs.
[[nodiscard]] const std::vector<Entry>& table_7_2();

/// The first of them, to which its percentages refer.
[[nodiscard]] const Entry& baseline_design();
/// Whether a library has what it takes.
[[nodiscard]] bool can_price_baseline(const rtl::Library& library);

}  // namespace hitpipe::area
