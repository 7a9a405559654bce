// One measured row of a sweep: the counts, and the figures that follow from them. docs/choosing.md
// defines each.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sim/sweep/subject.hpp"

namespace hitpipe::sim {

/// What a triangle test costs: a unit of this area begins one after each such delay.
struct TriangleCost {
  std::int64_t delay_ps = 0;
  std::int64_t area_um2 = 0;
  std::int64_t luts = 0;  ///< on a chip, which has no area

  friend bool operator==(const TriangleCost&, const TriangleCost&) = default;
};

/// What a ray's set-up costs: divisions, by a machine that makes a bit in each such delay. Without
/// `divisions` nothing is known of it, or it is not counted.
struct SetUpCost {
  std::optional<std::uint64_t> divisions;  ///< of a ray
  std::int64_t bits = 0;                   ///< of a quotient
  std::int64_t delay_ps = 0;
  std::int64_t area_um2 = 0;
  std::int64_t luts = 0;

  friend bool operator==(const SetUpCost&, const SetUpCost&) = default;
};

struct SweepRow : SweepSubject {
  int rays_in_flight = 0;
  int interval = 1;  ///< a test may begin every so many cycles
  std::string design;
  std::string bits;        ///< "20/24" or "fp32"
  int boxes_per_test = 1;  ///< that the design answers for
  int stages = 0;
  std::int64_t stage_delay_ps = 0;
  std::int64_t area_um2 = 0;  ///< of the whole unit, account `built`; 0 on a chip
  std::int64_t luts = 0;      ///< and what it takes of a chip; 0 in cells
  std::int64_t registers = 0;
  std::int64_t multiplier_blocks = 0;
  int bytes_per_node = 0;  ///< that a unit of this format reads
  TriangleCost triangle;
  SetUpCost set_up;
  std::optional<double> energy_pj_per_box;  ///< in OSU cells (area_model/energy.hpp)

  std::uint64_t rays_primary = 0;
  std::uint64_t rays_secondary = 0;
  std::uint64_t rays_shadow = 0;
  std::uint64_t rays_rejected = 0;  ///< of all kinds; no unit traced them
  std::uint64_t unit_tests = 0;     ///< through the pipeline
  std::uint64_t box_tests = 0;      ///< boxes that they answered for
  std::uint64_t hits = 0;
  std::uint64_t triangle_tests = 0;
  std::uint64_t reference_box_tests = 0;
  std::uint64_t reference_triangle_tests = 0;
  std::uint64_t false_hits = 0;
  std::uint64_t false_misses = 0;
  std::uint64_t rtl_mismatches = 0;
  std::uint64_t different_triangles = 0;
  std::uint64_t different_pixels = 0;
  std::uint64_t cycles = 0;

  /// From memory, by a model of the same reads in software (sw_ref/memory): behind caches of 4, 16 and 64
  /// KiB; and all of it with triangles that are read by their indices.
  std::uint64_t bytes_4kib = 0, bytes_16kib = 0, bytes_64kib = 0;
  std::uint64_t indexed_bytes = 0, indexed_bytes_4kib = 0, indexed_bytes_16kib = 0, indexed_bytes_64kib = 0;

  double rtl_seconds = 0;  ///< measured: CosimResult::rtl_seconds
  /// Ends of the 95 % intervals of extra_box_tests_pct() and extra_triangle_tests_pct(): ref::ExtraWork of the pixels.
  std::optional<double> extra_box_pct_low, extra_box_pct_high, extra_triangle_pct_low,
      extra_triangle_pct_high;
  /// Measured: processor time of the design's own traversal in software, in seconds for a million rays. Median of
  /// repeated runs and its 95 % interval; nothing of a design without a tracer of its own.
  std::optional<double> software_s, software_s_low, software_s_high;

  [[nodiscard]] std::uint64_t rays_traced() const;
  [[nodiscard]] double occupancy_pct() const;           ///< 100: a test begins whenever one may
  [[nodiscard]] double false_hits_per_million() const;  ///< per million box tests
  [[nodiscard]] double extra_box_tests_per_ray() const;
  [[nodiscard]] double extra_triangle_tests_per_ray() const;
  /// In percent of the reference's. Negative for a unit that makes fewer.
  [[nodiscard]] double extra_box_tests_pct() const;
  [[nodiscard]] double extra_triangle_tests_pct() const;
  [[nodiscard]] double run_time_ms() const;  ///< of the box tests alone, as in the thesis
  [[nodiscard]] double cycles_per_ray() const { return per_ray(cycles); }
  [[nodiscard]] double run_time_ns_per_ray() const;
  [[nodiscard]] bool on_chip() const { return luts > 0; }
  [[nodiscard]] double area_per_box_mm2() const;
  [[nodiscard]] double box_time_ns() const;        ///< of the unit when it is full
  [[nodiscard]] double area_delay_mm2_ns() const;  ///< area times that time
  /// With the whole area: the cycles already count a test of several boxes once.
  [[nodiscard]] double area_run_time_mm2_ms() const;

  /// From memory, without a cache: a test reads the node of each of its boxes, a triangle test its triangle.
  [[nodiscard]] std::uint64_t nodes_fetched() const;
  [[nodiscard]] std::uint64_t bytes_fetched() const;
  [[nodiscard]] double bytes_per_ray() const;
  [[nodiscard]] double bytes_per_ray_4kib() const { return per_ray(bytes_4kib); }
  [[nodiscard]] double bytes_per_ray_16kib() const { return per_ray(bytes_16kib); }
  [[nodiscard]] double bytes_per_ray_64kib() const { return per_ray(bytes_64kib); }
  [[nodiscard]] double indexed_bytes_per_ray() const { return per_ray(indexed_bytes); }
  [[nodiscard]] double indexed_bytes_per_ray_4kib() const { return per_ray(indexed_bytes_4kib); }
  [[nodiscard]] double indexed_bytes_per_ray_16kib() const { return per_ray(indexed_bytes_16kib); }
  [[nodiscard]] double indexed_bytes_per_ray_64kib() const { return per_ray(indexed_bytes_64kib); }
  [[nodiscard]] double reference_bytes_per_ray() const;           ///< with nodes of binary32
  [[nodiscard]] std::optional<double> energy_nj_per_ray() const;  ///< of box tests
  /// Of all rays' set-up, one bit after the other.
  [[nodiscard]] std::optional<double> set_up_run_time_ms() const;
  /// Box tests and triangle tests, one after the other. Set-up goes on beside them.
  [[nodiscard]] double whole_run_time_ms() const;
  /// The area of each unit for the time that it works: of boxes, of triangles, and of set-up where it is
  /// known.
  [[nodiscard]] double whole_area_run_time_mm2_ms() const;
  /// The same in lookup tables, on a chip. Registers and multiplier blocks are counted beside them.
  [[nodiscard]] double area_per_box_lut() const;
  [[nodiscard]] double area_run_time_lut_ms() const;
  [[nodiscard]] double whole_area_run_time_lut_ms() const;
  /// In lookup tables on a chip, in mm2 elsewhere.
  [[nodiscard]] double area_run_time() const;
  [[nodiscard]] double whole_area_run_time() const;

  /// Everything that must be zero is zero. False misses must be zero if the design is conservative.
  [[nodiscard]] bool verified(bool conservative) const;

  friend bool operator==(const SweepRow&, const SweepRow&) = default;

 private:
  [[nodiscard]] double per_ray(std::uint64_t count) const;
};

/// A column of a sweep's CSV file.
struct SweepColumn {
  /// A whole number of the last of `digits` decimal places.
  struct Decimal {
    std::int64_t& (*number)(SweepRow& row);
    int digits;
  };
  /// A count that may be unknown.
  struct Optional {
    std::optional<std::uint64_t>& (*number)(SweepRow& row);
  };

  std::string_view name;
  /// What the row holds, or a figure that follows from it.
  std::variant<std::string SweepRow::*, int SweepRow::*, std::uint64_t SweepRow::*, double SweepRow::*,
               std::optional<double> SweepRow::*, Decimal, Optional, std::uint64_t (SweepRow::*)() const,
               double (SweepRow::*)() const, std::optional<double> (SweepRow::*)() const>
      value;

  [[nodiscard]] bool is_text() const { return std::holds_alternative<std::string SweepRow::*>(value); }
  /// The cell of a row, without the quotes of CSV. Numbers have all their digits.
  [[nodiscard]] std::string cell(const SweepRow& row) const;
  /// The number that the cell is. Throws std::invalid_argument for text.
  [[nodiscard]] double number(const SweepRow& row) const;
};

/// The columns, in order. The last four are measured times. Only they differ between runs.
inline constexpr auto sweep_columns = std::to_array<SweepColumn>({
    {"program", &SweepRow::program},
    {"scene", &SweepRow::scene},
    {"content", &SweepRow::content},
    {"triangles", &SweepRow::triangles},
    {"hierarchy", &SweepRow::hierarchy},
    {"bvh_nodes", &SweepRow::bvh_nodes},
    {"width", &SweepRow::width},
    {"height", &SweepRow::height},
    {"bounces", &SweepRow::bounces},
    {"diffuse", &SweepRow::diffuse},
    {"occlusion", &SweepRow::occlusion},
    {"light_seed", &SweepRow::light_seed},
    {"library", &SweepRow::library},
    {"cost", &SweepRow::cost},
    {"rays_in_flight", &SweepRow::rays_in_flight},
    {"ii", &SweepRow::interval},
    {"box_time_ns", &SweepRow::box_time_ns},
    {"design", &SweepRow::design},
    {"bits", &SweepRow::bits},
    {"boxes_per_test", &SweepRow::boxes_per_test},
    {"stages", &SweepRow::stages},
    {"stage_delay_ns",
     SweepColumn::Decimal{[](SweepRow& row) -> std::int64_t& { return row.stage_delay_ps; }, 3}},
    {"area_mm2", SweepColumn::Decimal{[](SweepRow& row) -> std::int64_t& { return row.area_um2; }, 6}},
    {"luts", SweepColumn::Decimal{[](SweepRow& row) -> std::int64_t& { return row.luts; }, 0}},
    {"registers", SweepColumn::Decimal{[](SweepRow& row) -> std::int64_t& { return row.registers; }, 0}},
    {"multiplier_blocks",
     SweepColumn::Decimal{[](SweepRow& row) -> std::int64_t& { return row.multiplier_blocks; }, 0}},
    {"bytes_per_node", &SweepRow::bytes_per_node},
    {"triangle_delay_ns",
     SweepColumn::Decimal{[](SweepRow& row) -> std::int64_t& { return row.triangle.delay_ps; }, 3}},
    {"triangle_area_mm2",
     SweepColumn::Decimal{[](SweepRow& row) -> std::int64_t& { return row.triangle.area_um2; }, 6}},
    {"triangle_luts",
     SweepColumn::Decimal{[](SweepRow& row) -> std::int64_t& { return row.triangle.luts; }, 0}},
    {"set_up_divisions", SweepColumn::Optional{[](SweepRow& row) -> std::optional<std::uint64_t>& {
       return row.set_up.divisions;
     }}},
    {"set_up_bits", SweepColumn::Decimal{[](SweepRow& row) -> std::int64_t& { return row.set_up.bits; }, 0}},
    {"set_up_delay_ns",
     SweepColumn::Decimal{[](SweepRow& row) -> std::int64_t& { return row.set_up.delay_ps; }, 3}},
    {"set_up_area_mm2",
     SweepColumn::Decimal{[](SweepRow& row) -> std::int64_t& { return row.set_up.area_um2; }, 6}},
    {"set_up_luts", SweepColumn::Decimal{[](SweepRow& row) -> std::int64_t& { return row.set_up.luts; }, 0}},
    {"rays_primary", &SweepRow::rays_primary},
    {"rays_secondary", &SweepRow::rays_secondary},
    {"rays_shadow", &SweepRow::rays_shadow},
    {"rays_rejected", &SweepRow::rays_rejected},
    {"unit_tests", &SweepRow::unit_tests},
    {"box_tests", &SweepRow::box_tests},
    {"hits", &SweepRow::hits},
    {"triangle_tests", &SweepRow::triangle_tests},
    {"reference_box_tests", &SweepRow::reference_box_tests},
    {"reference_triangle_tests", &SweepRow::reference_triangle_tests},
    {"false_hits", &SweepRow::false_hits},
    {"false_misses", &SweepRow::false_misses},
    {"rtl_mismatches", &SweepRow::rtl_mismatches},
    {"different_triangles", &SweepRow::different_triangles},
    {"different_pixels", &SweepRow::different_pixels},
    {"cycles", &SweepRow::cycles},
    {"bytes_4kib", &SweepRow::bytes_4kib},
    {"bytes_16kib", &SweepRow::bytes_16kib},
    {"bytes_64kib", &SweepRow::bytes_64kib},
    {"indexed_bytes", &SweepRow::indexed_bytes},
    {"indexed_bytes_4kib", &SweepRow::indexed_bytes_4kib},
    {"indexed_bytes_16kib", &SweepRow::indexed_bytes_16kib},
    {"indexed_bytes_64kib", &SweepRow::indexed_bytes_64kib},
    {"occupancy_pct", &SweepRow::occupancy_pct},
    {"false_hits_per_million", &SweepRow::false_hits_per_million},
    {"extra_box_tests_per_ray", &SweepRow::extra_box_tests_per_ray},
    {"extra_triangle_tests_per_ray", &SweepRow::extra_triangle_tests_per_ray},
    {"extra_box_tests_pct", &SweepRow::extra_box_tests_pct},
    {"extra_box_tests_pct_low", &SweepRow::extra_box_pct_low},
    {"extra_box_tests_pct_high", &SweepRow::extra_box_pct_high},
    {"extra_triangle_tests_pct", &SweepRow::extra_triangle_tests_pct},
    {"extra_triangle_tests_pct_low", &SweepRow::extra_triangle_pct_low},
    {"extra_triangle_tests_pct_high", &SweepRow::extra_triangle_pct_high},
    {"run_time_ms", &SweepRow::run_time_ms},
    {"cycles_per_ray", &SweepRow::cycles_per_ray},
    {"run_time_ns_per_ray", &SweepRow::run_time_ns_per_ray},
    {"area_per_box_mm2", &SweepRow::area_per_box_mm2},
    {"area_delay_mm2_ns", &SweepRow::area_delay_mm2_ns},
    {"area_run_time_mm2_ms", &SweepRow::area_run_time_mm2_ms},
    {"nodes_fetched", &SweepRow::nodes_fetched},
    {"bytes_fetched", &SweepRow::bytes_fetched},
    {"bytes_per_ray", &SweepRow::bytes_per_ray},
    {"bytes_per_ray_4kib", &SweepRow::bytes_per_ray_4kib},
    {"bytes_per_ray_16kib", &SweepRow::bytes_per_ray_16kib},
    {"bytes_per_ray_64kib", &SweepRow::bytes_per_ray_64kib},
    {"indexed_bytes_per_ray", &SweepRow::indexed_bytes_per_ray},
    {"indexed_bytes_per_ray_4kib", &SweepRow::indexed_bytes_per_ray_4kib},
    {"indexed_bytes_per_ray_16kib", &SweepRow::indexed_bytes_per_ray_16kib},
    {"indexed_bytes_per_ray_64kib", &SweepRow::indexed_bytes_per_ray_64kib},
    {"reference_bytes_per_ray", &SweepRow::reference_bytes_per_ray},
    {"energy_pj_per_box", &SweepRow::energy_pj_per_box},
    {"energy_nj_per_ray", &SweepRow::energy_nj_per_ray},
    {"set_up_run_time_ms", &SweepRow::set_up_run_time_ms},
    {"whole_run_time_ms", &SweepRow::whole_run_time_ms},
    {"whole_area_run_time_mm2_ms", &SweepRow::whole_area_run_time_mm2_ms},
    {"area_per_box_lut", &SweepRow::area_per_box_lut},
    {"area_run_time_lut_ms", &SweepRow::area_run_time_lut_ms},
    {"whole_area_run_time_lut_ms", &SweepRow::whole_area_run_time_lut_ms},
    {"rtl_seconds", &SweepRow::rtl_seconds},
    {"software_s_per_mray", &SweepRow::software_s},
    {"software_s_per_mray_low", &SweepRow::software_s_low},
    {"software_s_per_mray_high", &SweepRow::software_s_high},
});
inline constexpr std::size_t sweep_time_columns = 4;

/// Throws std::out_of_range for a name that is none.
[[nodiscard]] const SweepColumn& sweep_column(std::string_view name);

/// One cell for each column; from_cells() gives the same row.
[[nodiscard]] std::vector<std::string> to_cells(const SweepRow& row);

/// Throws std::runtime_error, one line, for a wrong number of cells, a cell that is not a number of its type,
/// a figure that does not follow from the counts, more box tests than the tests can have answered, or an
/// interval that no unit has.
[[nodiscard]] SweepRow from_cells(const std::vector<std::string>& cells);

}  // namespace hitpipe::sim
