#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sw_ref/scene/built_in_scenes.hpp"
#include "sw_ref/scene/noise.hpp"
#include "sw_ref/scene/shapes.hpp"

namespace hitpipe::ref {
namespace {

enum PoppyColour : std::uint8_t { soil, green, leaf_green, red, deep_red, black, pale_green, hair };

constexpr double half_turn = std::numbers::pi;

class Poppies {
 public:
  Poppies(Shapes& shapes, double detail) : shapes_(shapes), detail_(detail), finer_(std::sqrt(detail)) {}

  struct Stem {
    glm::dvec3 top;
    glm::dvec3 direction;  ///< unit, at its top
  };

  /// A stem from the ground to `top`, with the direction `arrival` at its top.
  Stem stem(const glm::dvec3& root, const glm::dvec3& top, const glm::dvec3& arrival, double radius) {
    const int steps = scaled(44, finer_, 8);
    const glm::dvec3 low = root + glm::dvec3(0, 0.45 * top.y, 0);
    const glm::dvec3 high = top - arrival * (0.4 * top.y);
    std::vector<glm::dvec3> path;
    std::vector<double> radii;
    for (int i = 0; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      const double s = 1.0 - t;
      path.push_back(root * (s * s * s) + low * (3.0 * s * s * t) + high * (3.0 * s * t * t) +
                     top * (t * t * t));
      radii.push_back(radius * (1.15 - 0.45 * t));
    }
    shapes_.material(green);
    shapes_.tube(path, radii, std::max(5, static_cast<int>(9 * finer_)), Ends::closed);
    hairs(path, radii, scaled(420, detail_, 5), 0.030);
    return {top, glm::normalize(path.back() - path[path.size() - 2])};
  }

  void flower(const Stem& stem, double size, double open) {
    const Frame frame = Frame::along(stem.direction);
    const double start = dice_.between(0.0, 2.0 * half_turn);
    for (int layer = 0; layer < 2; ++layer) {
      for (int i = 0; i < 3; ++i)
        petal(stem.top, frame, start + (i + 0.5 * layer) * 2.0 * half_turn / 3.0,
              size * (layer == 0 ? 1.0 : 0.92), open * (layer == 0 ? 1.0 : 0.82),
              layer == 0 ? red : deep_red);
    }
    pod(stem.top, frame.z, 0.16 * size);
    const int stamens = scaled(110, detail_, 6);
    Dice dice(++parts_);
    for (int i = 0; i < stamens; ++i) stamen(stem.top, frame, size, open, i, dice);
  }

  void pod(const glm::dvec3& base, const glm::dvec3& axis, double radius) {
    shapes_.material(pale_green);
    const std::array<glm::dvec2, 12> profile{{{0.0, -0.1},
                                              {0.35, 0.0},
                                              {0.62, 0.25},
                                              {0.82, 0.6},
                                              {0.92, 1.0},
                                              {0.88, 1.35},
                                              {0.76, 1.6},
                                              {0.74, 1.68},
                                              {1.02, 1.74},
                                              {1.0, 1.82},
                                              {0.55, 1.93},
                                              {0.0, 1.97}}};
    std::vector<glm::dvec2> scaled_profile;
    for (const glm::dvec2& p : profile) scaled_profile.push_back(p * radius);
    shapes_.turned(base, axis, scaled_profile, scaled(24, finer_, 6));
  }

  /// A bud that hangs at the end of its stem.
  void bud(const Stem& stem, double size) {
    shapes_.material(leaf_green);
    std::vector<glm::dvec2> profile;
    std::vector<glm::dvec3> path;
    std::vector<double> radii;
    for (int i = 0; i <= 14; ++i) {
      const double t = i / 14.0;
      const double radius = 0.42 * size * std::pow(std::sin(half_turn * t), 0.7);
      profile.emplace_back(i == 0 || i == 14 ? 0.0 : radius, size * 1.35 * t);
      path.push_back(stem.top + stem.direction * (size * 1.35 * t));
      radii.push_back(profile.back().x);
    }
    shapes_.turned(stem.top, stem.direction, profile, scaled(20, finer_, 6));
    hairs(path, radii, scaled(420, detail_, 5), 0.034);
  }

  /// A deeply cut leaf, like a feather.
  void leaf(const glm::dvec3& root, double heading, double length, double lift) {
    shapes_.material(leaf_green);
    const glm::dvec3 ahead(std::cos(heading), 0.0, std::sin(heading));
    const glm::dvec3 aside(-ahead.z, 0.0, ahead.x);
    const double shift = dice_.between(0.0, 9.0);
    shapes_.sheet(scaled(14, finer_, 2), scaled(90, finer_, 8), [&](double u, double v) {
      const double across = 2.0 * u - 1.0;
      const double lobe = 0.5 + 0.5 * std::cos(2.0 * half_turn * (7.0 * v - 0.25 * std::abs(across)));
      const double width = length * 0.27 * std::sin(half_turn * std::min(1.0, 0.06 + 0.94 * v)) *
                           (0.16 + 0.84 * std::pow(lobe, 1.6));
      const double rise = lift * length * std::sin(half_turn * (0.05 + 0.72 * v)) +
                          0.02 * length * noise({8.0 * v, 3.0 * u, shift});
      return root + ahead * (length * (v + 0.10 * std::abs(across) * lobe)) + aside * (across * width) +
             glm::dvec3(0, rise - 0.35 * width * across * across, 0);
    });
  }

  void ground() {
    shapes_.material(soil);
    const int cells = scaled(70, finer_, 6);
    shapes_.sheet(cells, cells, [](double u, double v) {
      const double x = 14.0 * (u - 0.5);
      const double z = 14.0 * (0.72 - v);
      return glm::dvec3(x, 0.10 * layered_noise({1.3 * x, 0.0, 1.3 * z}, 4) - 0.06, z);
    });
  }

 private:
  void petal(const glm::dvec3& base, const Frame& frame, double angle, double size, double open,
             std::uint8_t colour) {
    shapes_.material(colour);
    const glm::dvec3 out = frame.x * std::cos(angle) + frame.y * std::sin(angle);
    const glm::dvec3 aside = glm::cross(frame.z, out);
    const double shift = dice_.between(0.0, 50.0);
    shapes_.sheet(scaled(44, finer_, 4), scaled(34, finer_, 4), [&](double u, double v) {
      const double fan = (2.0 * u - 1.0) * 1.12;
      const double crumple = layered_noise({4.5 * u, 1.6 * v, shift}, 3);
      const double edge = 1.0 + 0.05 * noise({9.0 * u, 0.0, shift}) - 0.16 * std::pow(std::abs(fan), 3.0);
      const double along = size * (0.06 + 0.94 * v) * edge;
      // A bowl: the petal leans outward by `open` (0: shut, 1: flat) and its rim curls over.
      const double lean = open * (0.55 + 0.75 * v) + 0.10 * crumple * v;
      const double cup = 0.20 * size * v * fan * fan * (1.0 - open);
      return base + out * (along * std::sin(lean) * std::cos(0.75 * fan) - cup) +
             aside * (along * 0.98 * std::sin(0.80 * fan)) +
             frame.z * (along * std::cos(lean) * 0.92 + 0.10 * size * std::abs(fan) * v +
                        0.055 * size * crumple * v);
    });
  }

  void stamen(const glm::dvec3& base, const Frame& frame, double size, double open, int number, Dice& dice) {
    shapes_.material(black);
    const double angle = 2.39996323 * number;
    const double out_by = size * open * open * dice.between(0.17, 0.34);
    const double height = size * dice.between(0.20, 0.36);
    const glm::dvec3 out = frame.x * std::cos(angle) + frame.y * std::sin(angle);
    const glm::dvec3 foot = base + out * (0.07 * size);
    const glm::dvec3 head = base + out * out_by + frame.z * height;
    const double thick = 0.0042 * size;
    shapes_.tube(std::array{foot, glm::mix(foot, head, 0.5) + out * (0.02 * size), head},
                 std::array{thick, thick, thick}, 4, Ends::open);
    const glm::dvec3 way = glm::normalize(out + frame.z * 0.4);
    const double anther = 0.030 * size;
    shapes_.tube(std::array{head - way * anther, head - way * (0.6 * anther), head + way * (0.6 * anther),
                            head + way * anther},
                 std::array{0.0, 0.4 * anther, 0.4 * anther, 0.0}, 6, Ends::open);
  }

  void hairs(const std::vector<glm::dvec3>& path, const std::vector<double>& radii, int count,
             double length) {
    shapes_.material(hair);
    Dice dice(++parts_);
    for (int i = 0; i < count; ++i) {
      const double place = dice.next() * static_cast<double>(path.size() - 1);
      const auto at = std::min(static_cast<std::size_t>(place), path.size() - 2);
      const Frame frame = Frame::along(path[at + 1] - path[at]);
      const double angle = dice.between(0.0, 2.0 * half_turn);
      const double long_by = length * dice.between(0.5, 1.0);
      const glm::dvec3 out = frame.x * std::cos(angle) + frame.y * std::sin(angle);
      const double part = place - static_cast<double>(at);
      const glm::dvec3 root =
          glm::mix(path[at], path[at + 1], part) + out * (0.9 * glm::mix(radii[at], radii[at + 1], part));
      const glm::dvec3 way = out + frame.z * dice.between(-0.3, 0.3);
      shapes_.tube(
          std::array{root, root + way * (0.6 * long_by), root + way * long_by + frame.z * (0.15 * long_by)},
          std::array{0.0011, 0.0009, 0.0}, 3, Ends::open);
    }
  }

  Shapes& shapes_;
  double detail_;
  double finer_;  ///< of sheets, in each of their two directions
  Dice dice_{0x90B7};
  std::uint64_t parts_ = 0;  ///< for the seeds of parts whose number grows with the detail
};

void build_poppy(Shapes& shapes, double detail) {
  Poppies poppies(shapes, detail);
  poppies.ground();
  struct Bloom {
    glm::dvec3 root, top, arrival;
    double size, open;
  };
  constexpr std::array<Bloom, 8> blooms{
      {{{0.00, 0, 0.00}, {0.05, 2.05, 0.30}, {0.05, 0.75, 0.66}, 0.52, 0.86},
       {{-0.15, 0, 0.05}, {-0.72, 1.62, 0.32}, {-0.45, 0.75, 0.50}, 0.48, 0.80},
       {{0.20, 0, 0.00}, {0.80, 1.70, 0.15}, {0.42, 0.70, 0.58}, 0.50, 0.92},
       {{0.10, 0, 0.20}, {0.32, 1.22, 0.75}, {0.15, 0.60, 0.78}, 0.44, 0.76},
       {{-0.25, 0, -0.10}, {-0.42, 2.30, -0.40}, {-0.20, 0.92, 0.30}, 0.46, 0.60},
       {{0.25, 0, -0.15}, {0.55, 2.42, -0.35}, {0.15, 0.95, 0.28}, 0.44, 0.50},
       {{-0.30, 0, 0.15}, {-1.10, 1.05, 0.62}, {-0.50, 0.62, 0.60}, 0.42, 0.84},
       {{0.40, 0, 0.10}, {1.30, 1.12, 0.35}, {0.55, 0.66, 0.50}, 0.40, 0.70}}};
  for (const Bloom& bloom : blooms)
    poppies.flower(poppies.stem(bloom.root, bloom.top, glm::normalize(bloom.arrival), 0.022), bloom.size,
                   bloom.open);
  for (const auto& [root, top] : {std::pair{glm::dvec3(0.05, 0, 0.1), glm::dvec3(-0.20, 1.30, 0.62)},
                                  {glm::dvec3(0.3, 0, -0.1), glm::dvec3(1.12, 2.02, -0.1)},
                                  {glm::dvec3(-0.3, 0, 0.0), glm::dvec3(-1.12, 1.92, -0.2)},
                                  {glm::dvec3(-0.1, 0, 0.2), glm::dvec3(-0.70, 0.82, 0.80)}}) {
    const glm::dvec3 nod = glm::normalize(glm::dvec3(top.x - root.x, -0.9, 0.35));
    poppies.bud(poppies.stem(root, top, nod, 0.017), 0.17);
  }
  for (const auto& [root, top] : {std::pair{glm::dvec3(0.0, 0, -0.1), glm::dvec3(0.12, 2.72, -0.6)},
                                  {glm::dvec3(-0.2, 0, -0.2), glm::dvec3(-0.82, 2.50, -0.6)},
                                  {glm::dvec3(0.3, 0, 0.2), glm::dvec3(0.90, 0.92, 0.72)}}) {
    const Poppies::Stem stem =
        poppies.stem(root, top, glm::normalize(glm::dvec3(0.1 * top.x, 1.0, 0.1)), 0.019);
    poppies.pod(stem.top, stem.direction, 0.095);
  }
  for (int i = 0; i < 22; ++i) {
    const double heading = 2.39996323 * i;
    const double length = 0.75 + 0.45 * (0.5 + 0.5 * noise({i * 0.7, 0.3, 0.1}));
    poppies.leaf({0.22 * std::cos(heading), 0.0, 0.22 * std::sin(heading)}, heading, length,
                 0.28 + 0.35 * ((i * 7) % 5) / 5.0);
  }
}

}  // namespace

BuiltInDescription poppy(std::size_t triangles) {
  BuiltInDescription scene;
  scene.mesh.triangles.reserve(triangles);
  Shapes shapes(scene.mesh, Shapes::Normals::smooth);
  build_poppy(shapes, detail_for(triangles, build_poppy));
  scene.materials = {{.albedo = {0.42F, 0.33F, 0.25F}}, {.albedo = {0.34F, 0.47F, 0.22F}},
                     {.albedo = {0.27F, 0.44F, 0.24F}}, {.albedo = {0.86F, 0.13F, 0.06F}},
                     {.albedo = {0.74F, 0.08F, 0.05F}}, {.albedo = {0.07F, 0.05F, 0.08F}},
                     {.albedo = {0.56F, 0.63F, 0.42F}}, {.albedo = {0.78F, 0.76F, 0.62F}}};
  scene.eye = {0.3, 2.05, 5.2};
  scene.target = {0.02, 1.34, 0.0};
  scene.fov_degrees = 38.5;
  scene.lights = {{{-3.2, 5.2, 4.0}, {0.92, 0.86, 0.74}}, {{4.2, 3.0, 3.2}, {0.24, 0.27, 0.32}}};
  return scene;
}

}  // namespace hitpipe::ref
