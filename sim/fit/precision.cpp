#include "sim/fit/precision.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <map>
#include <mutex>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "host/parallel.hpp"
#include "sim/cosim/generic_tracer.hpp"

namespace hitpipe::sim {

namespace {

ref::TraceCounts count_tests(const PrecisionSearch& search, const Format& format,
                             const ref::CoarseAxes& coarse, bool ends) {
  const auto tracer = make_tracer(*search.design, {format, coarse, ends}, search.scene->mesh, *search.bvh);
  const std::vector<ref::RecordedBatch>& batches = search.rays->batches;
  std::mutex counting;
  ref::TraceCounts sum;
  host::for_each_index(batches.size(), search.threads, [&](std::size_t i) {
    std::vector<std::uint32_t> triangles(batches[i].rays.size());
    ref::TraceCounts counts;
    tracer->trace({batches[i].rays, batches[i].query, triangles}, counts);
    const std::scoped_lock lock(counting);
    sum += counts;
  });
  search.measured();
  return sum;
}

double extra_pct(std::uint64_t taken, std::uint64_t reference) {
  return 100.0 * (static_cast<double>(taken) / static_cast<double>(reference) - 1.0);
}

/// The first good value of `sorted`. All values after a good value are good, and the last value is.
template <class Value, class Good>
const Value& first_good(const std::vector<Value>& sorted, Good&& good) {
  return *std::partition_point(sorted.begin(), sorted.end() - 1,
                               [&](const Value& value) { return !good(value); });
}

/// Measures each format with its coarse axes once.
class Measurements {
 public:
  explicit Measurements(const PrecisionSearch& search) : search_(search) {}

  const ref::TraceCounts& tests(const Format& format, const ref::CoarseAxes& coarse, bool ends) {
    const auto [at, is_new] =
        search_.known->try_emplace({format.numbers(), coarse.dropped, ends}, ref::TraceCounts{});
    if (is_new) at->second = count_tests(search_, format, coarse, ends);
    return at->second;
  }
  double extra(const Format& format, const ref::CoarseAxes& coarse = {}, bool ends = true) {
    return extra_pct(tests(format, coarse, ends).box_tests, search_.rays->counts.total().box_tests);
  }
  double extra_triangles(const Format& format) {
    return extra_pct(tests(format, {}, true).triangle_tests, search_.rays->counts.total().triangle_tests);
  }
  double cost(const Format& format, const ref::CoarseAxes& coarse = {}, bool ends = true) {
    const PrecisionKey key{format.numbers(), coarse.dropped, ends};
    if (const auto at = costs_.find(key); at != costs_.end()) return at->second;
    if (search_.limited && extra(format, coarse, ends) > search_.overhead_pct)
      return std::numeric_limits<double>::infinity();
    const Precision precision{
        .format = format, .coarse = coarse, .ends = ends, .endless_extra_box_tests_pct = 0.0};
    return costs_[key] = search_.cost(precision, tests(format, coarse, ends));
  }
  bool good(const Format& format, const ref::CoarseAxes& coarse = {}) {
    return extra(format, coarse) <= search_.overhead_pct;
  }
  [[nodiscard]] int count() const { return static_cast<int>(search_.known->size()); }

 private:
  const PrecisionSearch& search_;
  std::map<PrecisionKey, double> costs_;
};

using FormatGroups = std::vector<std::vector<Format>>;

/// So many groups, and so many formats in a group.
struct Step {
  std::ptrdiff_t groups, formats;
};

/// To neighbours, and two groups on: a group may differ from the next in little. With `far_groups` and `far_formats`
/// they are followed by all formats that are so near.
std::vector<Step> steps_to(std::ptrdiff_t far_groups, std::ptrdiff_t far_formats) {
  std::vector<Step> steps{{0, 1}, {0, -1}, {1, 0}, {-1, 0}, {2, 0}, {-2, 0}};
  for (std::ptrdiff_t group = -far_groups; group <= far_groups; ++group)
    for (std::ptrdiff_t format = -far_formats; format <= far_formats; ++format)
      if (std::abs(group) + std::abs(format) > 1) steps.push_back({group, format});
  return steps;
}

struct Place {
  std::size_t group, format;
};

std::optional<Place> place_of(const FormatGroups& groups, const Format& format) {
  for (std::size_t group = 0; group < groups.size(); ++group) {
    const auto at = std::find(groups[group].begin(), groups[group].end(), format);
    if (at != groups[group].end()) return Place{group, static_cast<std::size_t>(at - groups[group].begin())};
  }
  return std::nullopt;
}

/// Goes from format to format while the cost falls: one format on in the group, or to the format at the same
/// place in one of the next two groups. In steps of a rate the cost of neighbours is uneven, so it looks farther.
Format least_cost_from(const FormatGroups& groups, const Format& start, bool far, Measurements& measured) {
  Place best = place_of(groups, start).value();
  const auto cost_at = [&](const Place& place) { return measured.cost(groups[place.group][place.format]); };
  const auto next_of = [&](const Place& place, const Step& step) -> std::optional<Place> {
    const std::size_t group = place.group + static_cast<std::size_t>(step.groups);  // wraps below 0
    if (group >= groups.size()) return std::nullopt;
    const std::size_t format = place.format + static_cast<std::size_t>(step.formats);
    if (step.groups != 0 && step.formats == 0)
      return Place{group, std::min(format, groups[group].size() - 1)};
    return format < groups[group].size() ? std::optional(Place{group, format}) : std::nullopt;
  };
  for (bool falls = true; falls;) {
    falls = false;
    for (const Step& step : far ? steps_to(2, 3) : steps_to(0, 0)) {
      for (auto next = next_of(best, step); next && cost_at(*next) < cost_at(best);
           next = next_of(best, step)) {
        best = *next;
        falls = true;
      }
    }
  }
  return groups[best.group][best.format];
}

/// Where a search for the least cost begins, each once: the cost has hollows, and a path ends in the first.
std::vector<Format> starts_of(const PrecisionSearch& search, const FormatGroups& groups,
                              const Format& within_limit) {
  const Software& software = software_of(*search.design);
  std::vector<Format> wanted{search.most, within_limit, search.design->default_format};
  if (software.fit_from) wanted.push_back(*software.fit_from);
  wanted.insert(wanted.end(), software.sweep_formats.begin(), software.sweep_formats.end());
  std::vector<Format> starts;
  for (const Format& format : wanted)
    if (place_of(groups, format) && std::find(starts.begin(), starts.end(), format) == starts.end())
      starts.push_back(format);
  return starts;
}

/// Greedy: an axis that cannot lose another bit is not tried again.
ref::CoarseAxes most_dropped(const PrecisionSearch& search, const Format& format, Measurements& measured) {
  const auto fits = software_of(*search.design).fits_coarse;
  if (fits == nullptr) return {};
  ref::CoarseAxes coarse;
  std::vector<std::size_t> open{0, 1, 2};
  const auto next = [&](std::size_t axis) {
    ref::CoarseAxes coarser = coarse;
    ++coarser.dropped[axis];
    return coarser;
  };
  while (true) {
    const auto pays = [&](std::size_t axis) {
      return search.cost ? measured.cost(format, next(axis)) < measured.cost(format, coarse)
                         : measured.good(format, next(axis));
    };
    std::erase_if(
        open, [&](std::size_t axis) { return !fits(format, *search.demands, next(axis)) || !pays(axis); });
    if (open.empty()) return coarse;
    const auto loss = [&](std::size_t axis) {
      return search.cost ? measured.cost(format, next(axis)) : measured.extra(format, next(axis));
    };
    coarse = next(*std::min_element(open.begin(), open.end(),
                                    [&](std::size_t a, std::size_t b) { return loss(a) < loss(b); }));
  }
}

}  // namespace

std::string measured_text(double extra_box_tests_pct) {
  return fmt::format("{:.2f} % extra box tests, measured on the scene's rays", extra_box_tests_pct);
}

double extra_box_tests_pct(const PrecisionSearch& search, const Format& format, const ref::CoarseAxes& coarse,
                           bool ends) {
  return extra_pct(count_tests(search, format, coarse, ends).box_tests,
                   search.rays->counts.total().box_tests);
}

std::optional<Precision> fewest_bits(const PrecisionSearch& search) {
  Measurements measured(search);
  Precision found{.format = search.most};
  if (const auto up_to = software_of(*search.design).smaller_formats; up_to != nullptr) {
    const bool within_limit = measured.good(search.most);
    if (!within_limit && (!search.cost || search.limited)) return std::nullopt;
    const FormatGroups groups = up_to(search.most);
    if (within_limit) {
      const auto& group = first_good(groups, [&](const auto& each) { return measured.good(each.back()); });
      found.format = first_good(group, [&](const Format& each) { return measured.good(each); });
    }
    if (search.cost) {
      for (const Format& start : starts_of(search, groups, found.format)) {
        found.starts.push_back({start, measured.cost(start)});
        const Format end = least_cost_from(groups, start, search.far, measured);
        if (measured.cost(end) < measured.cost(found.format)) found.format = end;
      }
    }
    found.extra_triangle_tests_pct = measured.extra_triangles(found.format);
    found.extra_box_tests_pct = measured.extra(found.format);
    found.coarse = most_dropped(search, found.format, measured);
    found.coarse_extra_box_tests_pct = measured.extra(found.format, found.coarse);
  }
  if (rtl::index_of(search.design->ports(found.format), hls::Role::endless)) {
    found.endless_extra_box_tests_pct = measured.extra(found.format, found.coarse, false);
    found.ends = search.cost ? measured.cost(found.format, found.coarse, false) >=
                                   measured.cost(found.format, found.coarse)
                             : *found.endless_extra_box_tests_pct > search.overhead_pct;
  }
  if (search.cost) found.cost = measured.cost(found.format, found.coarse, found.ends);
  found.formats_measured = measured.count();
  return found;
}

}  // namespace hitpipe::sim
