// Rays through stacks of triangles that face one way: the count is as large as a triangle's number may be, and the sum
// of sides is larger than a distance.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "rays/image/core_image.hpp"
#include "sim/core/core_questions.hpp"
#include "sim/core/native_core.hpp"
#include "tests/sim/core/core_pictures.hpp"

namespace hitpipe::sim::stacks_of_triangles_test {
namespace {

using namespace core_pictures;

struct Stack {
  const char* name;
  unsigned triangles;
  int number_bits;
  bool weights = false;
  bool floats = false;
};

/// In planes z = -0.9 to 0.9, each around the z axis. Planes coincide where the grid has fewer.
ref::IntScene scene_of(unsigned triangles, const hls::WorldBits& world) {
  ref::Scene scene;
  for (unsigned i = 0; i < triangles; ++i) {
    const float z = -0.9F + 1.8F * static_cast<float>(i) / static_cast<float>(triangles);
    const auto first = static_cast<unsigned>(scene.mesh.vertices.size());
    for (const glm::vec3 corner :
         {glm::vec3(-0.9F, -0.9F, z), glm::vec3(0.9F, -0.9F, z), glm::vec3(0, 0.9F, z)})
      scene.mesh.vertices.push_back(corner);
    scene.mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  return ref::int_scene(scene, world, {.build = {.max_triangles = 2}});
}

class StackOfTriangles : public testing::TestWithParam<Stack> {};

TEST_P(StackOfTriangles, IsCountedWithItsSides) {
  const Stack& stack = GetParam();
  rtl::CoreOptions options = options_of(4, 3);
  options.bits = {.coord = 8, .finer = 1, .mantissa = 5, .slope = 8};
  options.questions = true;
  options.number_bits = stack.number_bits;
  options.weights = stack.weights;
  options.float_door = stack.floats;
  const ref::IntScene scene = scene_of(stack.triangles, options.bits.world());
  const ref::CoreImage image = ref::core_image(scene);
  const rtl::Core core = rtl::make_core(options, library());
  NativeCore native(core);
  CoreBench bench(core, native, image, MemoryOptions{});
  const ref::Ray up{.origin = {0.1F, 0, -1}, .direction = {0, 0, 1}, .length = ref::Ray::infinite},
      down{.origin = {0.1F, 0, 1}, .direction = {0, 0, -1}, .length = ref::Ray::infinite},
      half{.origin = {0.1F, 0, 0}, .direction = {0, 0, 1}, .length = ref::Ray::infinite};
  const QuestionTrace found =
      trace_questions(bench, scene, std::vector{up, down, half}, {.count_alone = stack.triangles > 15});
  EXPECT_EQ(found.wrong, 0U);
  EXPECT_GE(found.crossings, 2 * stack.triangles);
}

// 2^N - 1 triangles are the most that N bits number.
INSTANTIATE_TEST_SUITE_P(Of, StackOfTriangles,
                         testing::Values(Stack{"AllNumbers", 15, 4},
                                         Stack{"AllNumbersAndWeights", 15, 4, true},
                                         Stack{"AllNumbersInFloats", 15, 4, false, true},
                                         Stack{"MoreSidesThanDistances", 300, 9},
                                         Stack{"MoreSidesAndWeights", 300, 32, true}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace hitpipe::sim::stacks_of_triangles_test
