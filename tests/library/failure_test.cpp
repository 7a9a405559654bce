// Each call of the interface has the default arithmetic, and ends when the thread's watch says so.
#include "library/failure.hpp"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <regex>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/callers_arithmetic.hpp"
#include "tests/library/scenes.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::failure_test {
namespace {

using namespace scenes;  // NOLINT(google-build-using-namespace): what this file is about

constexpr float least = std::numeric_limits<float>::denorm_min();

/// A soup and a tetrahedron whose corners are denormal numbers, in one mesh.
Shape with_denormal_corners() {
  Shape shape = soup(80, 12);
  const auto first = static_cast<std::uint32_t>(shape.corners.size());
  for (const Point& corner :
       {Point{0, 0, 0}, Point{900 * least, 0, 0}, Point{0, 900 * least, 0}, Point{0, 0, 900 * least}})
    shape.corners.push_back(corner);
  for (const TriangleCorners& t : {TriangleCorners{0, 2, 1}, TriangleCorners{0, 1, 3},
                                   TriangleCorners{0, 3, 2}, TriangleCorners{1, 2, 3}})
    shape.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  return shape;
}

/// With directions, lengths and origins that are denormal numbers.
std::vector<Ray> with_denormal_rays() {
  std::vector<Ray> rays = random_rays(120, 13);
  for (std::size_t i = 0; i < 60; ++i) {
    Ray ray = rays[i];
    for (float& x : ray.direction) x = std::round(1000 * x) * least;
    if (ray.direction[0] == 0 && ray.direction[1] == 0 && ray.direction[2] == 0) ray.direction[0] = least;
    if (i % 2 == 0)
      for (float& x : ray.origin) x = std::round(400 * std::fabs(x)) * least;
    if (i % 5 == 0) ray.length = 700 * least;
    rays.push_back(ray);
  }
  return rays;
}

template <class Items>
void add(std::string& bytes, const Items& items) {
  bytes.append(reinterpret_cast<const char*>(items.data()), items.size() * sizeof items[0]);
}

/// Made before the arithmetic changes, which would change them.
struct Inputs {
  Shape shape = with_denormal_corners();
  std::vector<Point> moved = shape.corners;
  std::vector<Ray> rays = with_denormal_rays();

  Inputs() {
    for (Point& corner : moved)
      for (float& x : corner) x *= 0.5F;
  }
};

/// Of everything that computes and knows a scene.
std::string of_scenes(const Inputs& inputs, int threads) {
  const auto& [shape, moved, rays] = inputs;
  const Shape tiny{{shape.corners.end() - 4, shape.corners.end()},
                   {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  std::string bytes;
  const auto add_answers = [&](const Scene& scene, const std::vector<Ray>& asked) {
    const Nearest nearest = scene.nearest(asked, true, threads);
    add(bytes, nearest.triangle);
    add(bytes, nearest.t);
    add(bytes, nearest.weights);
    add(bytes, scene.any(asked, threads));
    const Counts counts = scene.count(asked, threads);
    add(bytes, counts.crossings);
    add(bytes, counts.sides);
    const Crossings all = scene.all(asked, threads);
    add(bytes, all.triangle);
    add(bytes, all.t);
  };
  for (const char* world : worlds) {
    const bool floats = std::string(world) == "float";
    const std::vector<Point> contains{{-1, -1, -1}, {1, 1, 1}};
    SceneOptions options{.world = world, .threads = threads};
    if (!floats) options.contains = contains;
    Scene scene = shape.scene(options);
    add_answers(scene, rays);
    if (!floats) {
      for (const IntegerRay& ray : scene.integer_rays(rays))
        for (const auto& numbers : {ray.origin, ray.direction}) add(bytes, std::vector(numbers, numbers + 3));
      add(bytes, std::vector{scene.own_distance(rays[0], 77'777), scene.info().transform.scale});
      add(bytes, scene.core_image());
    }
    scene.move(moved, threads);
    add_answers(scene, rays);
    const Scene small = tiny.scene({.world = world, .threads = threads});
    const std::vector<Ray> within{{{100 * least, 90 * least, 80 * least}, {1, 0, 0}, endless},
                                  {{100 * least, 90 * least, 80 * least}, {least, 3 * least, 0}, endless}};
    add_answers(small, within);
    add(bytes, small.inside(std::vector<Point>{{100 * least, 100 * least, 100 * least}}, threads));
  }
  return bytes;
}

/// Of everything that computes and knows a unit, a box or a cube.
std::string of_units(const std::vector<Ray>& rays) {
  std::string bytes;
  const Transform into = fit({.min = {0.1, 0, 3e-320}, .max = {77.7, 1.0 / 3, 9}});
  add(bytes, std::vector{into.scale, into.offset[0], into.offset[1], into.offset[2]});
  const Box box = to_cube(into, {.min = {0.2, 0.01, 1e-310}, .max = {76.1, 0.3, 0.7}});
  add(bytes, std::vector(box.min, box.min + 6));
  const double origin[] = {1.1, 0.2, 0.3};
  const double direction[] = {1e-42, 2e-43, 1e-44};
  const Ray ray = to_cube(into, origin, direction, 12.3);
  add(bytes, std::vector(ray.origin, ray.origin + 6));
  std::vector<Box> boxes(rays.size(), box);
  for (std::size_t i = 0; i < boxes.size(); i += 2)
    boxes[i] = {{0, -0.5F, 0}, {500 * least, 0.5F, 300 * least}};
  for (std::size_t i = 0; i < hitpipe_design_count(); ++i) {
    DesignInfo design;
    check(hitpipe_design(i, &design));
    if (design.boxes_per_test != 1 || std::string(design.name).find("_slabs") == std::string::npos) continue;
    Unit unit{design.name};
    const Answers answers = unit.test_pairs(rays, boxes);
    add(bytes, answers.hit);
    add(bytes, answers.exact);
    add(bytes, answers.operands);
    add(bytes, answers.results);
  }
  add(bytes, std::vector{price("int_slabs", "12/12").area_um2});
  return bytes;
}

TEST(Arithmetic, OfTheCallerChangesNoAnswerAndStays) {
  const Inputs inputs;
  const std::string scenes_right = of_scenes(inputs, 1);
  const std::string units_right = of_units(inputs.rays);
  for (const CallersArithmetic::Choice& choice : CallersArithmetic::choices()) {
    SCOPED_TRACE(choice.name);
    const CallersArithmetic callers(choice);
    EXPECT_TRUE(of_scenes(inputs, 1) == scenes_right);
    EXPECT_TRUE(of_scenes(inputs, 7) == scenes_right);
    EXPECT_TRUE(of_units(inputs.rays) == units_right);
    std::feclearexcept(FE_ALL_EXCEPT);
    std::feraiseexcept(FE_UNDERFLOW);
    const auto before = CallersArithmetic::state();
    const Ray ray{{0.1F, 0.1F, 0.1F}, {least, 3 * least, 1}, endless};
    const Box box{{-0.3F, -0.3F, -0.3F}, {0.3F, 0.3F, 0.3F}};
    std::uint8_t met = 7;
    check(hitpipe_exact(&ray, &box, 1, &met));
    EXPECT_EQ(hitpipe_open("no design", "", nullptr), HITPIPE_BAD_ARGUMENT);
    EXPECT_EQ(CallersArithmetic::state(), before);
  }
}

/// The wrapper sets the arithmetic, so no function with a status goes without it.
TEST(Arithmetic, IsSetByEachFunctionWithAStatus) {
  const std::filesystem::path folder = std::filesystem::path(HITPIPE_SOURCE) / "library";
  std::size_t functions = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() != ".cpp") continue;
    std::stringstream text;
    text << std::ifstream(file.path()).rdbuf();
    const std::string source = text.str();
    const std::regex head(R"(\nhitpipe_status (hitpipe_\w+)\([^{]*\{\n  (.*))");
    for (std::sregex_iterator at(source.begin(), source.end(), head), end; at != end; ++at, ++functions)
      EXPECT_EQ((*at)[2].str().find("return guarded([&] {"), 0U) << (*at)[1];
  }
  EXPECT_GE(functions, 27U);
}

TEST(Watch, EndsLongCallsOfItsThread) {
  const Scene scene = soup(300, 14).scene();
  const std::vector<Ray> some_rays = random_rays(200'000, 15);
  Unit unit("int_slabs");
  bool stops = true;
  int asked = 0;
  const StopWhen watch([&] {
    ++asked;
    return stops;
  });
  // A fast machine may be done before it is asked for the first time, so the next call has twice as much to do.
  const auto ends = [&](const auto& call) {
    EXPECT_EQ(message_of<Error>([&] {
                for (std::size_t times = 1; times <= 64; times *= 2) call(times);
              }),
              "stopped by the watch of its thread");
  };
  const auto rays = [&](std::size_t times) {
    std::vector<Ray> made;
    while (times-- > 0) made.insert(made.end(), some_rays.begin(), some_rays.end());
    return made;
  };
  for (const int threads : {1, 3})
    ends([&](std::size_t times) { static_cast<void>(scene.nearest(rays(times), true, threads)); });
  ends([&](std::size_t times) {
    const std::vector<Box> boxes(times * some_rays.size(), Box{{-0.3F, -0.3F, -0.3F}, {0.3F, 0.3F, 0.3F}});
    static_cast<void>(unit.test_pairs(rays(times), boxes));
  });
  ends([](std::size_t times) {
    static_cast<void>(soup(static_cast<std::uint32_t>(50'000 * times), 16).scene({.threads = 2}));
  });
  EXPECT_EQ(asked, 4);
  {
    const StopWhen nobody([] { return false; });
    EXPECT_EQ(scene.nearest(some_rays).triangle.size(), some_rays.size());
  }
  stops = false;
  EXPECT_EQ(scene.any(some_rays).size(), some_rays.size());
}

}  // namespace
}  // namespace hitpipe::failure_test
