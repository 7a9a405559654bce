#include "sim/vectors/design_vectors.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rtl_gen/emit/port_vectors.hpp"
#include "rtl_gen/graph/canonical.hpp"
#include "sim/software/software.hpp"
#include "sw_ref/judge/adversary/categories.hpp"
#include "sw_ref/world/int_cases.hpp"

namespace hitpipe::sim {

namespace {

using ref::adversary::Category;

constexpr std::size_t objects_per_ray = 8;

/// Operands of rays and boxes, or of rays and triangles, of one category.
class CategoryCases {
 public:
  virtual ~CategoryCases() = default;
  /// A ray and an object of which the C++ says `hit`, or the last of eight objects that do not: then false.
  [[nodiscard]] virtual bool draw(bool hit, rtl::Vector& vector) = 0;
};

class BoxCases final : public CategoryCases {
 public:
  BoxCases(BoxTest& test, const Category& category, std::uint64_t seed)
      : test_(test), category_(category), random_(seed) {}

  [[nodiscard]] bool draw(bool hit, rtl::Vector& vector) override {
    const ref::adversary::Case drawn = category_.make(random_);
    std::array<ref::Aabb, objects_per_ray> boxes;
    ref::adversary::neighbours(random_, drawn.box, boxes);
    test_.start(drawn.ray);
    const bool found =
        std::any_of(boxes.begin(), boxes.end(), [&](const ref::Aabb& box) { return test_.hit(box) == hit; });
    const auto operands = test_.operands();
    const auto results = test_.results();
    vector = {{operands.begin(), operands.end()}, {results.begin(), results.end()}};
    return found;
  }

 private:
  BoxTest& test_;
  const Category& category_;
  ref::adversary::Random random_;
};

class TriangleCases final : public CategoryCases {
 public:
  TriangleCases(TriangleTest& test, const ref::IntCategory& category, std::uint64_t seed)
      : test_(test), category_(category), random_(seed) {}

  [[nodiscard]] bool draw(bool hit, rtl::Vector& vector) override {
    const ref::IntCase drawn = category_.make(random_, test_.world());
    std::array<ref::IntTriangle, objects_per_ray> triangles;
    ref::int_neighbours(random_, drawn.triangle, test_.world(), triangles);
    test_.start(drawn.ray);
    std::vector<std::int64_t> operands(test_.operand_count());
    return std::any_of(triangles.begin(), triangles.end(), [&](const ref::IntTriangle& triangle) {
      test_.operands(triangle, operands.data());
      vector = rtl::with_results(operands, test_.evaluate());
      return test_.evaluate().hit(vector.results.data()) == hit;
    });
  }

 private:
  TriangleTest& test_;
  const ref::IntCategory& category_;
  ref::adversary::Random random_;
};

/// A vector that hits, or that misses, if a few tries find it.
rtl::Vector drawn(CategoryCases& cases, bool hit) {
  constexpr int most_tries = 9;
  rtl::Vector vector;
  for (int tries = 0; tries < most_tries; ++tries)
    if (cases.draw(hit, vector)) break;
  return vector;
}

/// Hits and misses alternate. In place of two of four vectors there are others, at the border beside them.
rtl::VectorGroup group_of(std::string_view name, CategoryCases& cases, rtl::PortVectors& ports,
                          std::size_t count) {
  rtl::VectorGroup group{std::string(name), {}};
  for (std::size_t i = 0; group.vectors.size() < count; ++i) {
    rtl::Vector vector = drawn(cases, i % 2 == 0);
    std::vector<rtl::Vector> beside;
    if (i % 4 >= 2) beside = ports.border(vector.operands);
    if (beside.empty()) beside.push_back(std::move(vector));
    for (rtl::Vector& each : beside)
      if (group.vectors.size() < count) group.vectors.push_back(std::move(each));
  }
  return group;
}

/// Adds `count` vectors, as many of each category. Each category has a seed of its own.
template <class Cases, class Test, class Categories>
void add_categories(rtl::VectorSet& set, Test& test, const Categories& categories, rtl::PortVectors& ports,
                    std::size_t count, std::uint64_t stream) {
  for (std::size_t i = 0; i < categories.size(); ++i) {
    const std::size_t share = count * (i + 1) / categories.size() - count * i / categories.size();
    Cases cases(test, categories[i], stream + i);
    set.groups.push_back(group_of(categories[i].name, cases, ports, share));
  }
}

}  // namespace

rtl::VectorSet design_vectors(const rtl::Design& design, const Format& format, std::size_t count,
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
  const bool has_categories = software.box_test != nullptr || software.triangle_test != nullptr;
  // Three eighths each, and a quarter for what these do not show.
  const std::size_t of_categories = has_categories ? count * 3 / 8 : 0;
  rtl::VectorSet set{seed, at_ports.groups(count * 3 / 4 - of_categories)};
  if (software.box_test != nullptr) {
    const auto everyones = ref::adversary::categories();
    std::vector<Category> categories(everyones.begin(), everyones.end());
    categories.insert(categories.end(), software.categories.begin(), software.categories.end());
    add_categories<BoxCases>(set, *software.box_test(design, format), categories, at_ports, of_categories,
                             stream);
  } else if (software.triangle_test != nullptr) {
    const auto test = software.triangle_test(design, format);
    add_categories<TriangleCases>(set, *test, ref::int_categories(test->world()), at_ports, of_categories,
                                  stream);
  }
  set.groups.push_back(at_ports.rare(set.groups, count - set.size()));
  return set;
}

}  // namespace hitpipe::sim
