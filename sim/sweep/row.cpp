#include "sim/sweep/row.hpp"

#include <charconv>
#include <stdexcept>
#include <type_traits>

#include <fmt/format.h>

#include "area_model/figure.hpp"
#include "sw_ref/hierarchy/bvh.hpp"

namespace hitpipe::sim {

namespace {

constexpr int area_digits = 6;   // of mm2: whole um2
constexpr int delay_digits = 3;  // of ns: whole ps

double ratio(double dividend, double divisor) {
  return divisor > 0 ? dividend / divisor : 0.0;
}

double difference(std::uint64_t value, std::uint64_t reference) {
  return static_cast<double>(static_cast<std::int64_t>(value - reference));
}

double triangle_time_ms(const SweepRow& row) {
  return static_cast<double>(row.triangle_tests) * static_cast<double>(row.triangle.delay_ps) / 1e9;
}

std::string shortest(double value) {
  return fmt::format("{}", value);
}

/// Reads cells in turn, each as a number of the type of its target.
class CellReader {
 public:
  explicit CellReader(const std::vector<std::string>& cells) : cells_(cells) {}

  void read(std::string& text) { text = cells_[at_++]; }
  template <class Number>
  void read(Number& number) {
    const std::string& cell = cells_[at_];
    const char* const end = cell.data() + cell.size();
    const auto [stop, error] = std::from_chars(cell.data(), end, number);
    if (error != std::errc{} || stop != end) reject();
    ++at_;
  }
  /// Reads a decimal with exactly this many digits after the point, as a whole number of its last place.
  void read_scaled(std::int64_t& number, std::size_t digits) {
    std::string cell = cells_[at_];
    const std::size_t point = cell.find('.');
    if (point == std::string::npos || cell.size() - point - 1 != digits) reject();
    cell.erase(point, 1);
    const auto [stop, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
    if (error != std::errc{} || stop != cell.data() + cell.size()) reject();
    ++at_;
  }
  void skip(std::size_t cells) { at_ += cells; }

 private:
  [[noreturn]] void reject() const {
    throw std::runtime_error(fmt::format("{} of {} is not a number of the right type", cells_[at_],
                                         at_ < sweep_columns.size() ? sweep_columns[at_] : "?"));
  }

  const std::vector<std::string>& cells_;
  std::size_t at_ = 0;
};

}  // namespace

std::uint64_t SweepRow::rays_traced() const {
  return rays_primary + rays_secondary + rays_shadow - rays_rejected;
}

double SweepRow::occupancy_pct() const {
  return ratio(100.0 * static_cast<double>(unit_tests), static_cast<double>(cycles));
}

double SweepRow::false_hits_per_million() const {
  return ratio(1e6 * static_cast<double>(false_hits), static_cast<double>(box_tests));
}

double SweepRow::extra_box_tests_per_ray() const {
  return ratio(difference(box_tests, reference_box_tests), static_cast<double>(rays_traced()));
}

double SweepRow::extra_triangle_tests_per_ray() const {
  return ratio(difference(triangle_tests, reference_triangle_tests), static_cast<double>(rays_traced()));
}

double SweepRow::extra_box_tests_pct() const {
  return ratio(100.0 * difference(box_tests, reference_box_tests), static_cast<double>(reference_box_tests));
}

double SweepRow::extra_triangle_tests_pct() const {
  return ratio(100.0 * difference(triangle_tests, reference_triangle_tests),
               static_cast<double>(reference_triangle_tests));
}

double SweepRow::run_time_ms() const {
  return static_cast<double>(cycles) * static_cast<double>(stage_delay_ps) / 1e9;
}

double SweepRow::area_per_box_mm2() const {
  return static_cast<double>(area_um2) / static_cast<double>(boxes_per_test) / 1e6;
}

double SweepRow::area_delay_mm2_ns() const {
  return static_cast<double>(area_um2) * static_cast<double>(stage_delay_ps) /
         static_cast<double>(boxes_per_test) / 1e9;
}

double SweepRow::area_run_time_mm2_ms() const {
  return static_cast<double>(area_um2) * run_time_ms() / 1e6;
}

std::uint64_t SweepRow::nodes_fetched() const {
  // A record of two nodes is read whole, also where its second box is not tested.
  return unit_tests * static_cast<std::uint64_t>(boxes_per_test);
}

std::uint64_t SweepRow::bytes_fetched() const {
  return nodes_fetched() * static_cast<std::uint64_t>(bytes_per_node) + triangle_tests * bytes_per_triangle;
}

double SweepRow::bytes_per_ray() const {
  return ratio(static_cast<double>(bytes_fetched()), static_cast<double>(rays_traced()));
}

double SweepRow::reference_bytes_per_ray() const {
  return ratio(static_cast<double>(reference_box_tests * sizeof(ref::BvhNode) +
                                   reference_triangle_tests * bytes_per_triangle),
               static_cast<double>(rays_traced()));
}

double SweepRow::whole_run_time_ms() const {
  return run_time_ms() + triangle_time_ms(*this);
}

double SweepRow::whole_area_run_time_mm2_ms() const {
  return area_run_time_mm2_ms() + static_cast<double>(triangle.area_um2) * triangle_time_ms(*this) / 1e6;
}

double SweepRow::area_per_box_lut() const {
  return static_cast<double>(luts) / static_cast<double>(boxes_per_test);
}

double SweepRow::area_run_time_lut_ms() const {
  return static_cast<double>(luts) * run_time_ms();
}

double SweepRow::whole_area_run_time_lut_ms() const {
  return area_run_time_lut_ms() + static_cast<double>(triangle.luts) * triangle_time_ms(*this);
}

double SweepRow::area_run_time() const {
  return on_chip() ? area_run_time_lut_ms() : area_run_time_mm2_ms();
}

double SweepRow::whole_area_run_time() const {
  return on_chip() ? whole_area_run_time_lut_ms() : whole_area_run_time_mm2_ms();
}

bool SweepRow::verified(bool conservative) const {
  return rtl_mismatches == 0 && different_triangles == 0 && different_pixels == 0 &&
         (!conservative || false_misses == 0);
}

std::vector<std::string> to_cells(const SweepRow& r) {
  std::vector<std::string> cells;
  const auto add = [&](const auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>) {
      cells.push_back(shortest(value));
    } else {
      cells.push_back(fmt::format("{}", value));
    }
  };
  add(r.scene);
  for (const std::uint64_t count : {r.triangles, r.bvh_nodes}) add(count);
  for (const int count : {r.width, r.height, r.rays_in_flight}) add(count);
  for (const std::string& text : {r.library, r.design, r.bits}) add(text);
  add(r.boxes_per_test);
  add(r.stages);
  add(area::decimal(r.stage_delay_ps, 1000, delay_digits));
  add(area::decimal(r.area_um2, 1'000'000, area_digits));
  for (const std::int64_t count : {r.luts, r.registers, r.multiplier_blocks}) add(count);
  add(r.bytes_per_node);
  add(area::decimal(r.triangle.delay_ps, 1000, delay_digits));
  add(area::decimal(r.triangle.area_um2, 1'000'000, area_digits));
  add(r.triangle.luts);
  for (const std::uint64_t count :
       {r.rays_primary, r.rays_secondary, r.rays_shadow, r.rays_rejected, r.unit_tests, r.box_tests, r.hits,
        r.triangle_tests, r.reference_box_tests, r.reference_triangle_tests, r.false_hits, r.false_misses,
        r.rtl_mismatches, r.different_triangles, r.different_pixels, r.cycles})
    add(count);
  for (const double figure :
       {r.occupancy_pct(), r.false_hits_per_million(), r.extra_box_tests_per_ray(),
        r.extra_triangle_tests_per_ray(), r.extra_box_tests_pct(), r.extra_triangle_tests_pct(),
        r.run_time_ms(), r.area_per_box_mm2(), r.area_delay_mm2_ns(), r.area_run_time_mm2_ms()})
    add(figure);
  for (const std::uint64_t count : {r.nodes_fetched(), r.bytes_fetched()}) add(count);
  for (const double figure :
       {r.bytes_per_ray(), r.reference_bytes_per_ray(), r.whole_run_time_ms(), r.whole_area_run_time_mm2_ms(),
        r.area_per_box_lut(), r.area_run_time_lut_ms(), r.whole_area_run_time_lut_ms()})
    add(figure);
  for (const double time : {r.rtl_seconds, r.software_ratio}) add(time);
  return cells;
}

SweepRow from_cells(const std::vector<std::string>& cells) {
  if (cells.size() != sweep_columns.size())
    throw std::runtime_error(fmt::format("{} cells; a row has {}", cells.size(), sweep_columns.size()));
  SweepRow r;
  CellReader in(cells);
  in.read(r.scene);
  for (std::uint64_t* const count : {&r.triangles, &r.bvh_nodes}) in.read(*count);
  for (int* const count : {&r.width, &r.height, &r.rays_in_flight}) in.read(*count);
  for (std::string* const text : {&r.library, &r.design, &r.bits}) in.read(*text);
  in.read(r.boxes_per_test);
  in.read(r.stages);
  in.read_scaled(r.stage_delay_ps, delay_digits);
  in.read_scaled(r.area_um2, area_digits);
  for (std::int64_t* const count : {&r.luts, &r.registers, &r.multiplier_blocks}) in.read(*count);
  in.read(r.bytes_per_node);
  in.read_scaled(r.triangle.delay_ps, delay_digits);
  in.read_scaled(r.triangle.area_um2, area_digits);
  in.read(r.triangle.luts);
  for (std::uint64_t* const count :
       {&r.rays_primary, &r.rays_secondary, &r.rays_shadow, &r.rays_rejected, &r.unit_tests, &r.box_tests,
        &r.hits, &r.triangle_tests, &r.reference_box_tests, &r.reference_triangle_tests, &r.false_hits,
        &r.false_misses, &r.rtl_mismatches, &r.different_triangles, &r.different_pixels, &r.cycles})
    in.read(*count);
  constexpr std::size_t figures = 19;
  in.skip(figures);
  for (double* const time : {&r.rtl_seconds, &r.software_ratio}) in.read(*time);

  if (r.boxes_per_test < 1)
    throw std::runtime_error(fmt::format("{} of boxes_per_test is less than 1", r.boxes_per_test));
  // Divides, because a product may not fit in 64 bits.
  const auto boxes = static_cast<std::uint64_t>(r.boxes_per_test);
  if (r.box_tests < r.unit_tests || r.box_tests / boxes + (r.box_tests % boxes != 0 ? 1 : 0) > r.unit_tests)
    throw std::runtime_error(fmt::format("{} of box_tests cannot be answered by {} tests of {} boxes",
                                         r.box_tests, r.unit_tests, r.boxes_per_test));
  const std::vector<std::string> again = to_cells(r);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i] != again[i])
      throw std::runtime_error(fmt::format("{} of {} does not follow from the counts, which give {}",
                                           cells[i], sweep_columns[i], again[i]));
  }
  return r;
}

}  // namespace hitpipe::sim
