// A scene in other units: powers of two change no bit, and the effect of other scales is counted.
#include "sim/check/rescale.hpp"

#include <bit>
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rays/exact/exact_triangle.hpp"
#include "sw_ref/scene/built_in.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::sim::rescale_test {
namespace {

constexpr int side = 64;
constexpr PictureOptions small{.width = side, .height = side, .threads = 2};

/// Equal bit for bit.
void expect_same(const Picture& picture, const Picture& original, const char* what) {
  EXPECT_EQ(picture.triangles, original.triangles) << what;
  ASSERT_EQ(picture.image.size(), original.image.size());
  for (std::size_t i = 0; i < picture.image.size(); ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      ASSERT_EQ(std::bit_cast<std::uint32_t>(picture.image[i][channel]),
                std::bit_cast<std::uint32_t>(original.image[i][channel]))
          << what << ", pixel " << i;
    }
  }
}

TEST(Rescale, PowersOfTwoMoveNoBit) {
  const ref::SceneDescription scene = ref::make_built_in("spheres", {});
  const Picture original = picture(scene, small);
  for (const int exponent : {-100, -10, -1, 1, 10, 100}) {
    const MovedScene scaled = moved(scene, {.scale = std::ldexp(1.0, exponent)});
    EXPECT_EQ(scaled.vertices_moved, 0U) << exponent;
    const Picture seen = picture(scaled.description, small);
    expect_same(seen, original, std::to_string(exponent).c_str());
    const PixelChanges changes = pixel_changes(original, seen);
    EXPECT_EQ(changes.other_triangle, 0U);
    EXPECT_EQ(changes.other_colour, 0U);
  }
}

TEST(Rescale, PowersOfTwoMoveNoBitThroughTheVerilog) {
  const ref::SceneDescription scene = ref::make_built_in("spheres", {});
  const rtl::Design& design = rtl::find_design("int_slabs");
  const VerilatedDesign verilated(rtl::make_unit(design, hls::IntBits{20, 24}, rtl::Library::thesis()));
  PictureOptions options = small;
  options.verilated = &verilated;
  const Picture original = picture(scene, small);
  for (const double scale : {0x1p-100, 1.0, 0x1p100, 0.1}) {
    const MovedScene scaled = moved(scene, {.scale = scale});
    const Picture seen = picture(scaled.description, options);
    EXPECT_EQ(seen.different_triangles, 0U) << scale;
    EXPECT_EQ(seen.rtl_mismatches, 0U) << scale;
    // The same mesh in software gives the same triangles, whatever the scale has rounded.
    EXPECT_EQ(seen.triangles, picture(scaled.description, small).triangles) << scale;
    if (scale != 0.1) {
      EXPECT_EQ(seen.triangles, original.triangles) << scale;
    }
  }
}

TEST(Rescale, CountsTheVerticesThatUndoingDoesNotBringBack) {
  ref::SceneDescription scene = ref::make_built_in("spheres", {});
  scene.mesh.vertices = {{1.0F, 0.0F, 0.0F}, {3.0F, 10.0F, 2.0F}, {0x1.000002p0F, 0.0F, 0.0F}};
  // Three times 1 + 2^-23 is 3 + 3 * 2^-23, between two numbers 2^-22 apart.
  EXPECT_EQ(moved(scene, {.scale = 3.0}).vertices_moved, 1U);
  EXPECT_EQ(moved(scene, {.scale = 2.0}).vertices_moved, 0U);
  // 8 + 1 + 2^-23 is rounded to 9.
  const MovedScene shifted = moved(scene, {.offset = {8.0, 0.0, 0.0}});
  EXPECT_EQ(shifted.vertices_moved, 1U);
  EXPECT_EQ(shifted.description.mesh.vertices[2].x, 9.0F);
  EXPECT_EQ(moved(scene, {.offset = {0x1p30, 0.0, 0.0}}).vertices_moved, 3U);
}

TEST(Rescale, MovesCameraAndLightsAlike) {
  const ref::SceneDescription scene = ref::make_built_in("spheres", {});
  const MovedScene shifted = moved(scene, {.scale = 2.0, .offset = {1.0, 2.0, 3.0}});
  const auto expected = [](const glm::dvec3& p) { return 2.0 * p + glm::dvec3(1.0, 2.0, 3.0); };
  EXPECT_EQ(shifted.description.eye, expected(scene.eye));
  EXPECT_EQ(shifted.description.target, expected(scene.target));
  ASSERT_EQ(shifted.description.lights.size(), scene.lights.size());
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    EXPECT_EQ(shifted.description.lights[i].position, expected(scene.lights[i].position));
    EXPECT_EQ(shifted.description.lights[i].intensity, scene.lights[i].intensity);
  }
  EXPECT_EQ(shifted.description.up, scene.up);
}

TEST(Rescale, LeavesSunsWhereTheyAre) {
  ref::SceneDescription scene = ref::make_built_in("spheres", {});
  scene.lights[0] = {{0.0, 1.0, 0.25}, {1.0, 1.0, 1.0}, ref::LightKind::sun};
  const MovedScene shifted = moved(scene, {.scale = 2.0, .offset = {1.0, 2.0, 3.0}});
  EXPECT_EQ(shifted.description.lights[0].position, scene.lights[0].position);
  EXPECT_NE(shifted.description.lights[1].position, scene.lights[1].position);
}

TEST(Rescale, FarOffsetChangesPixelsAndLosesTriangles) {
  const ref::SceneDescription scene = ref::make_built_in("spheres", {});
  const Picture original = picture(scene, small);
  const MovedScene far = moved(scene, {.offset = glm::dvec3(1e6)});
  EXPECT_GT(far.vertices_moved, scene.mesh.vertices.size() / 2);
  const Picture seen = picture(far.description, small);
  EXPECT_GT(seen.lost_to_rounding, 0U);
  EXPECT_LT(seen.lost_to_rounding, scene.mesh.triangles.size());
  // Triangles keep their numbers although some before them were dropped.
  const PixelChanges changes = pixel_changes(original, seen);
  EXPECT_GT(changes.other_triangle, 10U);
  EXPECT_LT(changes.other_triangle, std::uint64_t{side} * side / 4);
}

TEST(Rescale, VertexBeyondBinary32Rejected) {
  ref::SceneDescription scene = ref::make_built_in("spheres", {});
  scene.mesh.vertices = {{1.0F, 0.5F, 0.0F}};
  EXPECT_EQ(message_of([&] { static_cast<void>(moved(scene, {.scale = 0x1p128})); }),
            "vertex 0: (1, 0.5, 0) leaves the range of binary32");
}

TEST(PixelChanges, CountTrianglesAndVisibleColours) {
  Picture one;
  one.image = {glm::vec3(0.5F), glm::vec3(0.5F), glm::vec3(0.5F)};
  one.triangles = {1, 2, ref::Hit::none};
  Picture other = one;
  EXPECT_EQ(pixel_changes(one, other).other_triangle, 0U);
  EXPECT_EQ(pixel_changes(one, other).other_colour, 0U);
  other.triangles[2] = 0;
  other.image[0].y += 0.01F;
  other.image[1].z -= 0.001F;
  EXPECT_EQ(pixel_changes(one, other).other_triangle, 1U);
  EXPECT_EQ(pixel_changes(one, other).other_colour, 1U);
}

}  // namespace
}  // namespace hitpipe::sim::rescale_test
