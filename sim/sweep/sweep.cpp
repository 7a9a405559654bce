#include "sim/sweep/sweep.hpp"

#include <algorithm>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "area_model/price.hpp"
#include "area_model/triangle_unit.hpp"
#include "host/parallel.hpp"
#include "sim/cosim/cosim.hpp"
#include "sim/cosim/generic_tracer.hpp"
#include "sim/fit/fit.hpp"
#include "sim/sweep/software_time.hpp"
#include "sim/sweep/unit_energy.hpp"
#include "sim/unit/verilated_design.hpp"
#include "sw_ref/memory/read_bytes.hpp"
#include "sw_ref/render/render.hpp"

namespace hitpipe::sim {

namespace {

/// A design in one format at one interval. It is built once for all numbers of rays in flight.
struct MeasuredUnit {
  std::mutex making;
  std::optional<VerilatedDesign> verilated;
  std::optional<area::Price> price;
  std::optional<ref::Middle> software;  ///< seconds for a million rays
  ref::ReadBytes corners, indices;
  SetUpCost set_up;
  std::optional<area::Toggles> toggles;
};

/// What must be done before a row can be measured.
struct Reference {
  ref::RenderResult picture;
  SoftwareTime software;
  std::vector<ref::RecordedBatch> rays;  ///< of the picture or the list, in one order
};

ref::RenderResult render_reference(const ref::Scene& scene, const ref::Bvh& bvh,
                                   const SweepOptions& options) {
  if (!options.rays.empty()) return {};
  const std::unique_ptr<ref::Tracer> tracer = ref::make_tracer(scene.mesh, bvh, {});
  return ref::render(
      scene, *tracer,
      {.width = options.width, .height = options.height, .threads = options.threads, .light = options.light});
}

class Run {
 public:
  Run(const ref::Scene& scene, const ref::Bvh& bvh, std::span<const SweepPoint> points,
      const SweepOptions& options, const std::function<void(const SweepRow&)>& finished)
      : scene_(scene),
        bvh_(bvh),
        options_(options),
        subject_(sweep_subject(scene, bvh, options)),
        finished_(finished),
        points_(longest_first(points)),
        reference_{render_reference(scene, bvh, options),
                   options.rays.empty()
                       ? SoftwareTime(scene, bvh, options.width, options.height, options.light)
                       : SoftwareTime(scene, bvh, options.rays),
                   options.rays.empty()
                       ? ref::record_rays(scene, bvh, options.width, options.height, 1, options.light)
                       : listed_batches(scene, bvh, options.rays)} {
    for (const SweepPoint& point : points_) units_.try_emplace(unit_key(point));
  }

  void all() {
    const int workers = std::min(options_.threads, static_cast<int>(points_.size()));
    threads_of_a_row_ = options_.threads / workers;
    host::for_each_index(static_cast<std::size_t>(workers), workers, [this](std::size_t) { work(); });
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  /// Units with many operand bits come first, because they take longest to build and to simulate. Further
  /// rows of a unit come later, so that no two rows wait for the same build.
  static std::vector<SweepPoint> longest_first(std::span<const SweepPoint> points) {
    std::map<RowKey, int> rows_before;
    std::vector<std::pair<std::pair<int, int>, SweepPoint>> ranked;
    for (const SweepPoint& point : points) {
      int bits = 0;
      for (const rtl::Port& port : point.design->ports(point.format)) bits += port.width;
      ranked.push_back({{rows_before[unit_key(point)]++, -bits}, point});
    }
    std::stable_sort(ranked.begin(), ranked.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<SweepPoint> sorted;
    for (const auto& [rank, point] : ranked) sorted.push_back(point);
    return sorted;
  }

  static RowKey unit_key(SweepPoint point) {
    point.rays_in_flight = 0;
    return key_of(point);
  }

  void work() {
    while (const SweepPoint* const point = next()) {
      try {
        double share = 0;
        const SweepRow row = measure(*point, share);
        {
          const std::scoped_lock lock(writing_);
          finished_(row);
        }
        const std::scoped_lock lock(state_);
        report(share, 1);
      } catch (...) {
        const std::scoped_lock lock(state_);
        if (!failure_) failure_ = std::current_exception();
      }
    }
  }

  /// A row's finished share has grown. state_ is locked.
  void report(double& share, double grown) {
    rows_done_ += std::max(0.0, grown - share);
    share = std::max(share, grown);
    options_.progress(rows_done_ / static_cast<double>(points_.size()));
  }

  /// Null at the end and after a failure.
  const SweepPoint* next() {
    const std::scoped_lock lock(state_);
    return failure_ || next_ == points_.size() ? nullptr : &points_[next_++];
  }

  const MeasuredUnit& unit_of(const SweepPoint& point) {
    MeasuredUnit& unit = units_.at(unit_key(point));
    const std::scoped_lock lock(unit.making);
    if (!unit.verilated) {
      const rtl::Library& library = *options_.library;
      unit.price = area::price(*point.design, point.format, library, area::Account::built,
                               rtl::FlowControl::stall, point.interval);
      unit.software = reference_.software.of(*point.design, point.format);
      const std::unique_ptr<ref::Tracer> tracer =
          make_tracer(*point.design, {point.format}, scene_.mesh, bvh_);
      const auto read = [&](ref::TriangleLayout layout) {
        return ref::read_bytes(*tracer, scene_.mesh, bvh_, reference_.rays, layout, ref::usual_caches());
      };
      unit.corners = read(ref::TriangleLayout::corners);
      unit.indices = read(ref::TriangleLayout::indices);
      unit.verilated.emplace(
          rtl::make_unit(*point.design, point.format, library, {.interval = point.interval}));
      if (!options_.tests_only) {
        unit.set_up = set_up_cost(*point.design, point.format, library);
        // The tests are of the picture's rays.
        if (library.chip() == nullptr && options_.rays.empty())
          unit.toggles =
              scene_toggles(*point.design, point.format, *unit.verilated->unit().pipeline, scene_, bvh_,
                            {.width = options_.width, .height = options_.height, .light = options_.light});
      }
    }
    return unit;
  }

  /// `share` is the part of the row that is finished; state_ guards it.
  SweepRow measure(const SweepPoint& point, double& share) {
    const MeasuredUnit& unit = unit_of(point);
    const auto progress = [&](double grown) {
      const std::scoped_lock lock(state_);
      report(share, grown);
    };
    const CosimResult result = cosimulate(*unit.verilated, scene_, bvh_,
                                          {.width = options_.width,
                                           .height = options_.height,
                                           .rays_in_flight = point.rays_in_flight,
                                           .threads = threads_of_a_row_,
                                           .referee = true,
                                           .light = options_.light,
                                           .rays = options_.rays,
                                           .progress = progress});
    if (options_.answered) {
      const std::scoped_lock lock(writing_);
      options_.answered(point, result.triangles);
    }
    SweepRow row = priced_row(*point.design, point.format, *unit.price);
    static_cast<SweepSubject&>(row) = subject_;
    row.rays_in_flight = point.rays_in_flight;
    row.bytes_per_node = static_cast<int>(bytes_per_node(*point.design, point.format));
    row.triangle = options_.triangle;
    row.set_up = unit.set_up;
    add_counts(row, result);
    if (unit.toggles && row.unit_tests > 0)
      row.energy_pj_per_box = area::energy_pj(*unit.toggles, static_cast<double>(row.cycles) /
                                                                 static_cast<double>(row.unit_tests)) /
                              row.boxes_per_test;
    row.different_pixels = different_pixels(result);
    row.bytes_4kib = unit.corners.behind[0];
    row.bytes_16kib = unit.corners.behind[1];
    row.bytes_64kib = unit.corners.behind[2];
    row.indexed_bytes = unit.indices.without_cache;
    row.indexed_bytes_4kib = unit.indices.behind[0];
    row.indexed_bytes_16kib = unit.indices.behind[1];
    row.indexed_bytes_64kib = unit.indices.behind[2];
    row.rtl_seconds = milli(result.rtl_seconds);
    if (unit.software) {
      row.software_s = unit.software->median;
      row.software_s_low = unit.software->interval->low;
      row.software_s_high = unit.software->interval->high;
    }
    return row;
  }

  [[nodiscard]] std::uint64_t different_pixels(const CosimResult& result) const {
    std::uint64_t different = 0;
    for (std::size_t pixel = 0; pixel < result.image.size(); ++pixel) {
      const bool same = result.image[pixel] == reference_.picture.image[pixel] &&
                        result.triangles[pixel] == reference_.picture.triangles[pixel];
      different += same ? 0 : 1;
    }
    return different;
  }

  const ref::Scene& scene_;
  const ref::Bvh& bvh_;
  const SweepOptions& options_;
  const SweepSubject subject_;
  const std::function<void(const SweepRow&)>& finished_;
  const std::vector<SweepPoint> points_;
  const Reference reference_;
  std::map<RowKey, MeasuredUnit> units_;
  int threads_of_a_row_ = 1;
  std::mutex writing_;  // a row that goes to the disk keeps nobody from measuring
  std::mutex state_;    // guards all members below
  std::size_t next_ = 0;
  double rows_done_ = 0;  // with parts of rows
  std::exception_ptr failure_;
};

}  // namespace

std::string why_not_priced(const rtl::Design& design, const Format& format, const rtl::Library& library) {
  try {
    static_cast<void>(area::price(design, format, library, area::Account::built));
  } catch (const std::runtime_error& error) {
    return fmt::format("design {}: {}", design.name, error.what());
  }
  return "";
}

SweepRow priced_row(const rtl::Design& design, const Format& format, const area::Price& price) {
  SweepRow row;
  row.design = design.name;
  row.bits = to_string(format);
  row.interval = price.interval;
  row.boxes_per_test = price.boxes;
  row.stages = price.stages;
  row.stage_delay_ps = price.stage_delay_ps;
  row.area_um2 = price.area_um2;
  row.luts = price.taken.luts;
  row.registers = price.taken.registers;
  row.multiplier_blocks = price.taken.blocks;
  return row;
}

void add_counts(SweepRow& row, const CosimResult& result) {
  row.rays_primary = result.rays_primary;
  row.rays_secondary = result.rays_secondary;
  row.rays_shadow = result.rays_shadow;
  row.rays_rejected = result.rejected;
  row.unit_tests = result.unit.tests;
  row.box_tests = result.unit.box_tests;
  row.hits = result.unit.hits;
  row.triangle_tests = result.unit.triangle_tests;
  row.reference_box_tests = result.reference.box_tests;
  row.reference_triangle_tests = result.reference.triangle_tests;
  row.false_hits = result.unit.false_hits.value_or(0);
  row.false_misses = result.unit.false_misses.value_or(0);
  row.rtl_mismatches = result.unit.rtl_mismatches;
  row.different_triangles = result.different_triangles;
  row.cycles = result.unit.cycles;
  if (const auto interval = result.extra_box_tests.percent_interval()) {
    row.extra_box_pct_low = interval->low;
    row.extra_box_pct_high = interval->high;
  }
  if (const auto interval = result.extra_triangle_tests.percent_interval()) {
    row.extra_triangle_pct_low = interval->low;
    row.extra_triangle_pct_high = interval->high;
  }
}

SetUpCost set_up_cost(const rtl::Design& design, const Format& format, const rtl::Library& library) {
  const auto divisions_of = software_of(design).divisions;
  if (divisions_of == nullptr) return {};
  const area::Divisions divisions = divisions_of(format);
  SetUpCost cost{.divisions = static_cast<std::uint64_t>(divisions.count)};
  if (divisions.count == 0) return cost;
  const area::DividerPrice price = area::divider_price(divisions, library);
  cost.bits = divisions.quotient_bits;
  cost.delay_ps = price.clock_ps;
  cost.area_um2 = price.area_um2;
  cost.luts = price.luts;
  return cost;
}

TriangleCost triangle_cost(const rtl::Library& library) {
  const rtl::Design& unit = area::triangle_unit();
  if (why_not_priced(unit, unit.default_format, library).empty()) {
    const area::Price price = area::price_of_triangle_unit(library);
    return {.delay_ps = price.stage_delay_ps, .area_um2 = price.area_um2, .luts = price.taken.luts};
  }
  const auto& rows = area::table_7_2();
  const auto entry = std::ranges::find_if(rows, [&](const area::Entry& each) {
    return why_not_priced(rtl::find_design(each.design), each.format, library).empty();
  });
  if (entry == rows.end())
    throw std::runtime_error(fmt::format("library {}: cannot price a triangle test", library.name()));
  const auto price_by = [&](const rtl::Library& by) {
    return area::price(rtl::find_design(entry->design), entry->format, by, area::Account::built);
  };
  const area::Price triangle = area::price_of_triangle_unit(rtl::Library::thesis());
  const area::Price box = price_by(rtl::Library::thesis());
  const area::Price here = price_by(library);
  const auto scaled = [](std::int64_t value, std::int64_t by, std::int64_t of) {
    return (value * by + of / 2) / of;
  };
  return {.delay_ps = scaled(here.stage_delay_ps, triangle.stage_delay_ps, box.stage_delay_ps),
          .area_um2 = scaled(here.area_um2, triangle.area_um2, box.area_um2),
          .luts = scaled(here.taken.luts, triangle.area_um2, box.area_um2)};
}

void run_sweep(const ref::Scene& scene, const ref::Bvh& bvh, std::span<const SweepPoint> points,
               const SweepOptions& options, const std::function<void(const SweepRow&)>& finished) {
  if (!points.empty()) Run(scene, bvh, points, options, finished).all();
}

}  // namespace hitpipe::sim
