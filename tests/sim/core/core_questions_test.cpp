// The questions count and next of a core: each ray counts its crossings and walks through all of them, in closed meshes
// where rays meet corners and edges, run in planes of triangles, and meet several triangles at one T.
#include "sim/core/core_questions.hpp"

#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rays/image/core_image.hpp"
#include "rtl_gen/core/feature.hpp"
#include "sim/core/native_core.hpp"
#include "sim/core/vector_scenes.hpp"
#include "sim/machine/verilated_machine.hpp"
#include "sw_ref/judge/adversary/random.hpp"
#include "sw_ref/world/edge_lines.hpp"
#include "tests/message_of.hpp"
#include "tests/rays/world/tetrahedra.hpp"
#include "tests/rtl_gen/text.hpp"
#include "tests/sim/core/both_cores.hpp"
#include "tests/sim/core/core_pictures.hpp"

namespace hitpipe::sim::core_questions_test {
namespace {

using namespace core_pictures;
using ref::adversary::Random;

/// The surface of a cube of that size with its middle at 0, each face of side x side squares. Corners of all sizes
/// coincide with a lattice.
void add_cube(ref::Scene& scene, float size, int side) {
  for (int axis = 0; axis < 3; ++axis)
    for (const float end : {-1.0F, 1.0F}) {
      const auto first = static_cast<unsigned>(scene.mesh.vertices.size());
      for (int i = 0; i <= side; ++i)
        for (int j = 0; j <= side; ++j) {
          glm::vec3 corner(0);
          corner[axis] = end * size;
          corner[(axis + 1) % 3] = size * (2.0F * static_cast<float>(i) / static_cast<float>(side) - 1);
          corner[(axis + 2) % 3] = size * (2.0F * static_cast<float>(j) / static_cast<float>(side) - 1);
          scene.mesh.vertices.push_back(corner);
        }
      const auto row = static_cast<unsigned>(side + 1);
      for (unsigned i = 0; i + 1 < row; ++i)
        for (unsigned j = 0; j + 1 < row; ++j) {
          glm::uvec3 a(first + i * row + j, first + (i + 1) * row + j, first + i * row + j + 1);
          glm::uvec3 b(first + (i + 1) * row + j, first + (i + 1) * row + j + 1, first + i * row + j + 1);
          if (end < 0) {
            std::swap(a.y, a.z);
            std::swap(b.y, b.z);
          }
          scene.mesh.triangles.push_back(a);
          scene.mesh.triangles.push_back(b);
        }
    }
}

/// Cubes in one another, and one of them twice.
ref::IntScene cubes(const hls::WorldBits& of) {
  ref::Scene scene;
  add_cube(scene, 0.75F, 4);
  add_cube(scene, 0.375F, 2);
  add_cube(scene, 0.375F, 1);
  return ref::int_scene(scene, of, {.build = {.builder = ref::Builder::sah, .max_triangles = 2}});
}

/// From the lattice along axes and diagonals, and to corners.
std::vector<ref::Ray> rays_of(const ref::IntScene& scene, int count, std::uint64_t seed) {
  Random random(seed);
  Lattice lattice(scene.bits.coord, random);
  std::vector<ref::Ray> rays;
  while (static_cast<int>(rays.size()) < count) {
    ref::Ray ray = lattice.ray();
    if (random.below(2) == 0) {
      for (int axis = 0; axis < 3; ++axis)
        ray.origin[axis] = 0.1875F * static_cast<float>(random.between(-5, 5));
    }
    if (random.below(2) == 0) {
      const auto& corners = scene.mesh.mesh.vertices;
      const glm::vec3 to = corners[random.below(corners.size())] - ray.origin;
      if (to != glm::vec3(0)) ray.direction = to;
    }
    if (random.below(3) != 0) ray.length = ref::Ray::infinite;
    rays.push_back(ray);
  }
  return rays;
}

struct Form {
  const char* name;
  hls::RayBits bits;
  int rays = 12, stack_bits = 2, triangle_interval = 4;
  int cache_kib = 0;
  bool weights = false;
  bool verilog = false;
  bool floats = false;
  bool narrow = false;  ///< as few bits as the image needs for triangle numbers and leaf counts
};

class CoreWithQuestions : public testing::TestWithParam<Form> {};

TEST_P(CoreWithQuestions, CountsAndWalksThroughAllCrossings) {
  const Form& form = GetParam();
  const ref::IntScene scene = cubes(form.bits.world());
  const ref::CoreImage image = ref::core_image(scene);
  rtl::CoreOptions options = options_of(form.rays, form.stack_bits);
  options.bits = form.bits;
  options.triangle_interval = form.triangle_interval;
  options.cache.kib = form.cache_kib;
  options.weights = form.weights;
  options.float_door = form.floats;
  options.questions = true;
  if (form.narrow) {
    options.number_bits = image.header.number_bits();
    options.leaf_bits = image.header.leaf_bits();
    options.step_bits = 7;
    EXPECT_EQ(options.number_bits, 8);
    EXPECT_EQ(options.leaf_bits, 2);
  }
  MemoryOptions memory{.least_latency = 1, .most_latency = 60, .refused_percent = 20};
  memory.reads_lines = rtl::bus_of(options).has_lines;
  const rtl::Core core = rtl::make_core(options, library());
  std::unique_ptr<rtl::NativeMachine> machine;
  BothCores* both = nullptr;
  if (form.verilog) {
    auto made = std::make_unique<BothCores>(core, rtl::to_verilog(core, library()));
    both = made.get();
    machine = std::move(made);
  } else {
    machine = std::make_unique<NativeCore>(core, rtl::Collision::any_word);
  }
  CoreBench bench(core, *machine, image, memory, {.held_percent = 30});
  const QuestionTrace found =
      trace_questions(bench, scene, rays_of(scene, form.verilog || form.rays == 1 ? 150 : 1'500, 7));
  EXPECT_EQ(found.wrong, 0U);
  EXPECT_EQ(found.nexts, found.rays + found.crossings);
  for (const std::uint64_t each : {found.nearests, found.anys, found.counts}) EXPECT_EQ(each, found.rays);
  EXPECT_GT(found.ties, found.rays / 2);
  EXPECT_GT(found.crossings, found.rays / 2);
  if (both != nullptr) {
    EXPECT_EQ(both->first_difference, "");
  }
}

INSTANTIATE_TEST_SUITE_P(
    Formats, CoreWithQuestions,
    testing::Values(Form{"Usual", bits}, Form{"ManyRays", bits, 128, 3}, Form{"OneRay", bits, 1, 1},
                    Form{"ShortStack", bits, 32, 1, 3}, Form{"Cached", bits, 32, 2, 8, 4},
                    Form{"OfTheDefault", hls::RayBits{}, 32, 2},
                    Form{"NoFinerOrigins", {8, 0, 4, 0, 8, 0}, 32, 2},
                    Form{"WithAFraction", {16, 2, 9, -1, 14, 3}, 32, 2},
                    Form{"InVerilog", bits, 12, 1, 4, 0, false, true},
                    Form{"NarrowInVerilog", bits, 12, 1, 4, 0, false, true, false, true},
                    Form{"CachedInVerilog", bits, 12, 1, 8, 2, true, true},
                    Form{"FloatsInVerilog", bits, 12, 2, 4, 0, false, true, true},
                    Form{"OfTheDefaultInVerilog", hls::RayBits{}, 12, 2, 8, 0, false, true}),
    [](const auto& each) { return each.param.name; });

/// HITPIPE_EDGE_SOLIDS: how many polyhedra.
int solids() {
  const char* const text = std::getenv("HITPIPE_EDGE_SOLIDS");
  return text != nullptr ? std::atoi(text) : 400;
}

/// Polyhedra, each of which is closed. Rays go through corners and edges, along them and in planes.
class Polyhedra : public testing::Test {
 protected:
  [[nodiscard]] QuestionTrace traced_by(const std::string& verilog, int solids) const {
    VerilatedMachine machine(core_, verilog);
    ref::world_cases::Draw draw(39311);
    QuestionTrace sum;
    for (int i = 0; i < solids; ++i) {
      const ref::tetrahedra::Solid solid = ref::tetrahedra::draw_solid(draw, 12);
      // Its corners are few steps of this grid, or of a smaller one.
      if (solid.bits.coord > world.coord) continue;
      ref::Scene scene;
      scene.mesh = ref::tetrahedra::mesh_of(ref::tetrahedra::boundary(solid), world).mesh;
      if (scene.mesh.triangles.empty()) continue;
      const ref::IntScene traced = ref::int_scene(scene, world, {.build = {.max_triangles = 2}});
      EXPECT_TRUE(ref::closedness(traced.mesh).even()) << "solid " << i;
      const ref::CoreImage image = ref::core_image(traced);
      CoreBench bench(core_, machine, image, {.least_latency = 1, .most_latency = 9});
      std::vector<ref::Ray> rays;
      for (const ref::IntRay& ray : ref::edge_rays(traced.mesh, world, static_cast<std::uint64_t>(i), 0, 64))
        rays.push_back(ref::binary32_ray(ray, world));
      sum += trace_questions(bench, traced, rays, {.count_alone = i % 8 != 0, .closed = true});
    }
    return sum;
  }
  static rtl::CoreOptions options() {
    rtl::CoreOptions made = options_of(32, 2);
    made.triangle_interval = 3;
    made.questions = true;
    return made;
  }

  const rtl::Core core_ = rtl::make_core(options(), library());
  const std::string verilog_ = rtl::to_verilog(core_, library());
};

TEST_F(Polyhedra, AreCrossedEvenlyInVerilog) {
  const QuestionTrace found = traced_by(verilog_, solids());
  EXPECT_EQ(found.wrong, 0U);
  EXPECT_EQ(found.odd, 0U);
  EXPECT_GT(found.rays, 16U * static_cast<std::uint64_t>(solids()));
  EXPECT_GT(found.outside, found.rays / 4);
  EXPECT_GT(found.ties, found.rays);
}

TEST_F(Polyhedra, AreCrossedOddlyIfTiesAreWrong) {
  for (const auto& [good, bad] : {std::pair{"still = meets_word & zero_1", "still = 3'h0"},
                                  {"ties_and = hit_1 & ~again", "ties_and = hit_1 & ~again_and"}}) {
    const QuestionTrace found = traced_by(rtl::replaced(verilog_, good, bad), 100);
    EXPECT_GT(found.wrong, 10U) << bad;
    EXPECT_GT(found.odd, 5U) << bad;
  }
}

TEST(CoreQuestions, AreRefusedWhereTheyCannotBe) {
  rtl::CoreOptions options;
  options.questions = true;
  options.serial_triangle = true;
  EXPECT_EQ(message_of<std::runtime_error>([&] { static_cast<void>(rtl::make_core(options, library())); }),
            "questions count and next: allowed with a triangle unit, not with the serial test");
  options = {.float_door = true, .rings = true, .questions = true};
  EXPECT_EQ(message_of<std::runtime_error>([&] { static_cast<void>(rtl::make_core(options, library())); }),
            "questions count and next: allowed with rays at pins, not with rays from memory");
}

}  // namespace
}  // namespace hitpipe::sim::core_questions_test
