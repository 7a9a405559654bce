#include "sim/sweep/row.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <stdexcept>
#include <type_traits>

#include <fmt/format.h>

#include "area_model/figure.hpp"
#include "host/text.hpp"
#include "rays/tree/bvh.hpp"
#include "rtl_gen/schedule/sharing.hpp"
#include "sw_ref/memory/scene_memory.hpp"

namespace hitpipe::sim {

namespace {

double ratio(double dividend, double divisor) {
  return divisor > 0 ? dividend / divisor : 0.0;
}

double difference(std::uint64_t value, std::uint64_t reference) {
  return static_cast<double>(static_cast<std::int64_t>(value - reference));
}

double triangle_time_ms(const SweepRow& row) {
  return static_cast<double>(row.triangle_tests) * static_cast<double>(row.triangle.delay_ps) / 1e9;
}

/// What a cell holds, or nothing if it is of another type.
template <class Number>
std::optional<Number> value_in(const std::string& cell, const Number& /*type*/) {
  return host::number_in<Number>(cell);
}
std::optional<std::string> value_in(const std::string& cell, const std::string& /*type*/) {
  return cell;
}
/// An empty cell holds that nothing is known.
template <class Number>
std::optional<std::optional<Number>> value_in(const std::string& cell,
                                              const std::optional<Number>& /*type*/) {
  if (cell.empty()) return std::optional<Number>();
  const std::optional<Number> number = host::number_in<Number>(cell);
  if (!number) return std::nullopt;
  return std::optional<std::optional<Number>>(number);
}
/// A decimal with exactly this many digits after the point, as a whole number of its last place.
std::optional<std::int64_t> decimal_in(std::string cell, int digits) {
  if (digits > 0) {
    const std::size_t point = cell.find('.');
    if (point == std::string::npos || cell.size() - point - 1 != static_cast<std::size_t>(digits)) return {};
    cell.erase(point, 1);
  }
  return host::number_in<std::int64_t>(cell);
}

constexpr std::int64_t power_of_ten(int digits) {
  return digits == 0 ? 1 : 10 * power_of_ten(digits - 1);
}

/// Reads a cell into the row; a figure is not read, because it follows from the counts.
void read_cell(const SweepColumn& column, const std::string& cell, SweepRow& row) {
  const auto keep = [&]<class Value>(Value& place, const std::optional<Value>& value) {
    if (!value)
      throw std::runtime_error(
          fmt::format("{} of {} is not a number of the right type", host::shortened(cell), column.name));
    place = *value;
  };
  std::visit(
      [&]<class Value>(const Value& value) {
        if constexpr (std::is_same_v<Value, SweepColumn::Decimal>) {
          keep(value.number(row), decimal_in(cell, value.digits));
        } else if constexpr (std::is_same_v<Value, SweepColumn::Optional>) {
          keep(value.number(row), value_in(cell, value.number(row)));
        } else if constexpr (std::is_member_object_pointer_v<Value>) {
          keep(row.*value, value_in(cell, row.*value));
        }
      },
      column.value);
}

/// Both ends or none, and the figure between them.
void check_interval(const char* name, double figure, const std::optional<double>& low,
                    const std::optional<double>& high) {
  constexpr double rounding = 1e-9;
  if (low.has_value() == high.has_value() &&
      (!low || (*low <= figure + rounding && figure <= *high + rounding)))
    return;
  const auto end = [](const std::optional<double>& value) {
    return value ? fmt::format("{}", *value) : "nothing";
  };
  throw std::runtime_error(fmt::format("{} to {} of {}_low and {}_high is no interval around {}", end(low),
                                       end(high), name, name, figure));
}

template <class Value>
std::string text_of(const Value& value) {
  return fmt::format("{}", value);
}
template <class Number>
std::string text_of(const std::optional<Number>& value) {
  return value ? fmt::format("{}", *value) : "";
}

}  // namespace

std::uint64_t SweepRow::rays_traced() const {
  return rays_primary + rays_secondary + rays_shadow - rays_rejected;
}

double SweepRow::occupancy_pct() const {
  return ratio(100.0 * interval * static_cast<double>(unit_tests), static_cast<double>(cycles));
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

double SweepRow::run_time_ns_per_ray() const {
  return cycles_per_ray() * static_cast<double>(stage_delay_ps) / 1e3;
}

double SweepRow::area_per_box_mm2() const {
  return static_cast<double>(area_um2) / static_cast<double>(boxes_per_test) / 1e6;
}

double SweepRow::box_time_ns() const {
  return interval * static_cast<double>(stage_delay_ps) / static_cast<double>(boxes_per_test) / 1e3;
}

double SweepRow::area_delay_mm2_ns() const {
  return static_cast<double>(area_um2) * interval * static_cast<double>(stage_delay_ps) /
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
  return nodes_fetched() * static_cast<std::uint64_t>(bytes_per_node) +
         triangle_tests * ref::bytes_of_corners;
}

double SweepRow::per_ray(std::uint64_t count) const {
  return ratio(static_cast<double>(count), static_cast<double>(rays_traced()));
}

double SweepRow::bytes_per_ray() const {
  return per_ray(bytes_fetched());
}

double SweepRow::reference_bytes_per_ray() const {
  return ratio(static_cast<double>(reference_box_tests * sizeof(ref::BvhNode) +
                                   reference_triangle_tests * ref::bytes_of_corners),
               static_cast<double>(rays_traced()));
}

std::optional<double> SweepRow::energy_nj_per_ray() const {
  if (!energy_pj_per_box) return std::nullopt;
  return *energy_pj_per_box * per_ray(box_tests) / 1e3;
}

std::optional<double> SweepRow::set_up_run_time_ms() const {
  if (!set_up.divisions) return std::nullopt;
  return static_cast<double>(rays_traced() * *set_up.divisions) * static_cast<double>(set_up.bits) *
         static_cast<double>(set_up.delay_ps) / 1e9;
}

double SweepRow::whole_run_time_ms() const {
  return run_time_ms() + triangle_time_ms(*this);
}

double SweepRow::whole_area_run_time_mm2_ms() const {
  return area_run_time_mm2_ms() + (static_cast<double>(triangle.area_um2) * triangle_time_ms(*this) +
                                   static_cast<double>(set_up.area_um2) * set_up_run_time_ms().value_or(0)) /
                                      1e6;
}

double SweepRow::area_per_box_lut() const {
  return static_cast<double>(luts) / static_cast<double>(boxes_per_test);
}

double SweepRow::area_run_time_lut_ms() const {
  return static_cast<double>(luts) * run_time_ms();
}

double SweepRow::whole_area_run_time_lut_ms() const {
  return area_run_time_lut_ms() + static_cast<double>(triangle.luts) * triangle_time_ms(*this) +
         static_cast<double>(set_up.luts) * set_up_run_time_ms().value_or(0);
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

std::string SweepColumn::cell(const SweepRow& row) const {
  return std::visit(
      [&]<class Value>(const Value& figure) {
        if constexpr (std::is_same_v<Value, Decimal>) {
          SweepRow copy = row;
          const std::int64_t number = figure.number(copy);
          if (figure.digits == 0) return fmt::format("{}", number);
          return area::decimal(number, power_of_ten(figure.digits), figure.digits);
        } else if constexpr (std::is_same_v<Value, Optional>) {
          SweepRow copy = row;
          return text_of(figure.number(copy));
        } else {
          return text_of(std::invoke(figure, row));
        }
      },
      value);
}

double SweepColumn::number(const SweepRow& row) const {
  const auto number = is_text() ? std::nullopt : host::number_in<double>(cell(row));
  return number ? *number : throw std::invalid_argument(std::string(name));
}

const SweepColumn& sweep_column(std::string_view name) {
  const auto* const found = std::ranges::find(sweep_columns, name, &SweepColumn::name);
  if (found == sweep_columns.end()) throw std::out_of_range(std::string(name));
  return *found;
}

std::vector<std::string> to_cells(const SweepRow& row) {
  std::vector<std::string> cells;
  for (const SweepColumn& column : sweep_columns) cells.push_back(column.cell(row));
  return cells;
}

SweepRow from_cells(const std::vector<std::string>& cells) {
  if (cells.size() != sweep_columns.size())
    throw std::runtime_error(fmt::format("{} cells; a row has {}", cells.size(), sweep_columns.size()));
  SweepRow r;
  for (std::size_t i = 0; i < cells.size(); ++i) read_cell(sweep_columns[i], cells[i], r);
  if (r.interval < 1 || r.interval > rtl::most_interval)
    throw std::runtime_error(fmt::format("{} of ii is not in 1 to {}", r.interval, rtl::most_interval));
  if (r.boxes_per_test < 1)
    throw std::runtime_error(fmt::format("{} of boxes_per_test is less than 1", r.boxes_per_test));
  // Divides, because a product may not fit in 64 bits.
  const auto boxes = static_cast<std::uint64_t>(r.boxes_per_test);
  if (r.box_tests < r.unit_tests || r.box_tests / boxes + (r.box_tests % boxes != 0 ? 1 : 0) > r.unit_tests)
    throw std::runtime_error(fmt::format("{} of box_tests cannot be answered by {} tests of {} boxes",
                                         r.box_tests, r.unit_tests, r.boxes_per_test));
  check_interval("extra_box_tests_pct", r.extra_box_tests_pct(), r.extra_box_pct_low, r.extra_box_pct_high);
  check_interval("extra_triangle_tests_pct", r.extra_triangle_tests_pct(), r.extra_triangle_pct_low,
                 r.extra_triangle_pct_high);
  const std::vector<std::string> again = to_cells(r);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i] != again[i])
      throw std::runtime_error(fmt::format("{} of {} does not follow from the counts, which give {}",
                                           cells[i], sweep_columns[i].name, again[i]));
  }
  return r;
}

}  // namespace hitpipe::sim
