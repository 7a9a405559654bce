// Measures the ways to a slab's distances (docs/safe_floats.md, "Fusion").
//   slab_forms verilog FORM E M STAGES          a distance as Verilog; docs/fusion.sh synthesises it
//   slab_forms scene NAME [PIXELS [TRIANGLES]]  extra tests of each form, beyond those with an exact box test
//   slab_forms judge RAYS                       aimed tests, judged by the referee: 16 of RAYS rays of a
//   category
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/slab_forms/form_verilog.hpp"
#include "sw_ref/adversary/categories.hpp"
#include "sw_ref/adversary/float_unit.hpp"
#include "sw_ref/adversary/neighbours.hpp"
#include "sw_ref/exact/box_referee.hpp"
#include "sw_ref/experiment/recording.hpp"
#include "sw_ref/scene/scene.hpp"
#include "sw_ref/traverse/slab_form_test.hpp"
#include "sw_ref/traverse/traversal.hpp"

namespace hitpipe::bench {

namespace {

using ref::SlabForm;

/// Calls visit.operator()<Test>(name) for each form in a format. Short products leave 1, 2 or 3 bits alone.
template <int E, int M, class Visit>
void for_each_form(const Visit& visit) {
  visit.template operator()<ref::SlabFormTest<E, M, SlabForm::plain>>("plain");
  visit.template operator()<ref::SlabFormTest<E, M, SlabForm::exact>>("exact");
  visit.template operator()<ref::SlabFormTest<E, M, SlabForm::short_product, 1>>("short_product, 1");
  visit.template operator()<ref::SlabFormTest<E, M, SlabForm::short_product, 2>>("short_product, 2");
  visit.template operator()<ref::SlabFormTest<E, M, SlabForm::short_product, 3>>("short_product, 3");
  visit.template operator()<ref::SlabFormTest<E, M, SlabForm::fused>>("fused");
  visit.template operator()<ref::SlabFormTest<E, M, SlabForm::separate>>("separate");
  visit.template operator()<ref::SlabFormTest<E, M, SlabForm::separate_fused>>("separate_fused");
}

/// visit(format's name, for_each_form of it).
template <class Visit>
void for_each_format(const Visit& visit) {
  visit.template operator()<8, 23>("e8m23");
  visit.template operator()<8, 15>("e8m15");
  visit.template operator()<8, 7>("e8m7");
  visit.template operator()<5, 10>("e5m10");
}

template <class Test>
ref::TraversalCounts traced(const ref::Scene& scene, const ref::Bvh& bvh,
                            const std::vector<ref::RecordedBatch>& batches) {
  std::vector<typename Test::Box> boxes;
  for (const ref::BvhNode& node : bvh.nodes) boxes.push_back(Test::round(node.box));
  ref::TraversalCounts counts;
  for (const ref::RecordedBatch& batch : batches) {
    for (const ref::Ray& ray : batch.rays) {
      Test test(ray);
      ref::Traversal traversal(bvh, scene.mesh, ray, batch.query);
      float length = traversal.length();
      while (!traversal.done()) {
        traversal.answer(test(boxes[traversal.node()]));
        if (traversal.length() == length) continue;
        length = traversal.length();
        test.shorten(length);
      }
      counts += traversal.counts();
    }
  }
  return counts;
}

/// Boxes are the exact ones, and so are the answers.
struct ExactTest {
  using Box = ref::Aabb;
  explicit ExactTest(const ref::Ray& of) : ray(of), referee(of) {}
  static Box round(const ref::Aabb& box) { return box; }
  void shorten(float length) {
    ray.length = length;
    referee = ref::BoxReferee(ray);
  }
  bool operator()(const Box& box) const { return referee.meets(box); }

  ref::Ray ray;
  ref::BoxReferee referee;
};

void print_scene(const std::string& name, int pixels, std::size_t triangles) {
  ref::SceneOptions options;
  if (triangles != 0) options.triangles = triangles;
  const ref::Scene scene = ref::load_scene(name, options);
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  const auto batches = ref::record_rays(scene, bvh, pixels, pixels, 1);
  const ref::TraversalCounts exact = traced<ExactTest>(scene, bvh, batches);
  const auto extra = [](std::uint64_t count, std::uint64_t least) {
    return 100 * (static_cast<double>(count) / static_cast<double>(least) - 1);
  };
  fmt::print("scene,format,form,extra_box_tests_pct,extra_triangle_tests_pct\n");
  for_each_format([&]<int E, int M>(const char* format) {
    for_each_form<E, M>([&]<class Test>(const char* form) {
      const ref::TraversalCounts counts = traced<Test>(scene, bvh, batches);
      fmt::print("{},{},\"{}\",{:.3f},{:.3f}\n", name, format, form, extra(counts.box_tests, exact.box_tests),
                 extra(counts.triangle_tests, exact.triangle_tests));
    });
  });
}

template <class Test>
void print_judged(const char* format, const char* form, int rays) {
  ref::adversary::Random random(7);
  std::vector<ref::Aabb> boxes(16);
  std::uint64_t tests = 0;
  std::uint64_t false_hits = 0;
  std::uint64_t false_misses = 0;
  for (const auto& categories : {ref::adversary::categories(), ref::adversary::float_unit_categories()}) {
    for (const ref::adversary::Category& category : categories) {
      for (int i = 0; i < rays; ++i) {
        const ref::adversary::Case c = category.make(random);
        ref::adversary::neighbours(random, c.box, boxes);
        const Test test(c.ray);
        const ref::BoxReferee referee(c.ray);
        for (const ref::Aabb& box : boxes) {
          const bool hit = test(Test::round(box));
          const bool meets = referee.meets(box);
          ++tests;
          false_hits += hit && !meets ? 1 : 0;
          false_misses += !hit && meets ? 1 : 0;
        }
      }
    }
  }
  fmt::print("{},\"{}\",{},{},{}\n", format, form, tests, false_hits, false_misses);
}

int usage() {
  fmt::print(
      stderr,
      "slab_forms: wanted is verilog FORM E M STAGES, scene NAME [PIXELS [TRIANGLES]] or judge RAYS\n");
  return 2;
}

int run(const std::vector<std::string>& words) {
  if (words.size() == 5 && words[0] == "verilog") {
    fmt::print("{}", form_verilog(words[1], {std::stoi(words[2]), std::stoi(words[3])}, std::stoi(words[4])));
    return 0;
  }
  if (words.size() >= 2 && words.size() <= 4 && words[0] == "scene") {
    print_scene(words[1], words.size() > 2 ? std::stoi(words[2]) : 64,
                words.size() > 3 ? std::stoul(words[3]) : 0);
    return 0;
  }
  if (words.size() == 2 && words[0] == "judge") {
    fmt::print("format,form,tests,false_hits,false_misses\n");
    for_each_format([&]<int E, int M>(const char* format) {
      for_each_form<E, M>(
          [&]<class Test>(const char* form) { print_judged<Test>(format, form, std::stoi(words[1])); });
    });
    return 0;
  }
  return usage();
}

}  // namespace

}  // namespace hitpipe::bench

int main(int argc, char** argv) {
  try {
    return hitpipe::bench::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print(stderr, "slab_forms: {}\n", error.what());
    return 2;
  }
}
