#include "sim/vectors/design_vectors.hpp"

#include <array>
#include <span>

#include "rtl_gen/emit/port_vectors.hpp"
#include "rtl_gen/graph/canonical.hpp"
#include "sim/software.hpp"
#include "sw_ref/judge/adversary/categories.hpp"

namespace hitpipe::sim {

namespace {

using ref::adversary::Category;

/// Operands of rays and boxes of one category. Hits and misses alternate; so do single vectors and pairs
/// across the border beside them.
class CategoryVectors {
 public:
  CategoryVectors(BoxTest& test, rtl::PortVectors& ports, const Category& category, std::uint64_t seed)
      : test_(test), ports_(ports), category_(category), cases_(seed) {}

  [[nodiscard]] rtl::VectorGroup group(std::size_t count) {
    rtl::VectorGroup group{std::string(category_.name), {}};
    for (std::size_t i = 0; group.vectors.size() < count; ++i) {
      rtl::Vector drawn = draw(i % 2 == 0);
      std::vector<rtl::Vector> beside;
      if (i % 4 >= 2) beside = ports_.border(drawn.operands);
      if (beside.empty()) beside.push_back(std::move(drawn));
      for (rtl::Vector& each : beside)
        if (group.vectors.size() < count) group.vectors.push_back(std::move(each));
    }
    return group;
  }

 private:
  /// A vector that hits, or that misses, if a few tries find it.
  [[nodiscard]] rtl::Vector draw(bool hit) {
    constexpr std::size_t boxes_per_ray = 8;
    for (int rays = 0;; ++rays) {
      constexpr int most_rays = 8;
      const ref::adversary::Case drawn = category_.make(cases_);
      std::array<ref::Aabb, boxes_per_ray> boxes;
      ref::adversary::neighbours(cases_, drawn.box, boxes);
      test_.start(drawn.ray);
      for (const ref::Aabb& box : boxes)
        if (test_.hit(box) == hit) return vector();
      if (rays == most_rays) return vector();
    }
  }
  [[nodiscard]] rtl::Vector vector() const {
    const auto operands = test_.operands();
    const auto results = test_.results();
    return {{operands.begin(), operands.end()}, {results.begin(), results.end()}};
  }

  BoxTest& test_;
  rtl::PortVectors& ports_;
  const Category& category_;
  ref::adversary::Random cases_;
};

}  // namespace

rtl::VectorSet design_vectors(const rtl::Design& design, const rtl::Format& format, std::size_t count,
                              std::uint64_t seed) {
  const std::vector<rtl::Port> ports = design.ports(format);
  const std::vector<hls::Result> results = design.results(format);
  const rtl::Evaluate evaluate = design.evaluate(format);
  const rtl::Graph graph = rtl::canonical(design.trace(format));
  const rtl::Demands none;
  // Counted from 2: with the usual seed every planted fault then shows.
  const std::uint64_t stream = seed + 1;
  rtl::PortVectors at_ports({graph, ports, none, evaluate, results}, stream);
  const Software& software = software_of(design);
  const bool has_set_up = software.box_test != nullptr;
  // Three eighths each, and a quarter for what these do not show.
  const std::size_t of_categories = has_set_up ? count * 3 / 8 : 0;
  rtl::VectorSet set{seed, at_ports.groups(count * 3 / 4 - of_categories)};
  if (has_set_up) {
    const std::unique_ptr<BoxTest> test = software.box_test(design, format);
    const auto everyones = ref::adversary::categories();
    std::vector<Category> categories(everyones.begin(), everyones.end());
    categories.insert(categories.end(), software.categories.begin(), software.categories.end());
    for (std::size_t i = 0; i < categories.size(); ++i) {
      const std::size_t share =
          of_categories * (i + 1) / categories.size() - of_categories * i / categories.size();
      set.groups.push_back(CategoryVectors(*test, at_ports, categories[i], stream + i).group(share));
    }
  }
  set.groups.push_back(at_ports.rare(set.groups, count - set.size()));
  return set;
}

}  // namespace hitpipe::sim
