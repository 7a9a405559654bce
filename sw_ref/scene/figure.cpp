#include "sw_ref/scene/figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "sw_ref/scene/noise.hpp"

namespace hitpipe::ref {
namespace {

constexpr double pi = std::numbers::pi;

double bump(double x, double middle, double width) {
  const double t = (x - middle) / width;
  return std::exp(-t * t);
}

double rise(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// Chisel marks and pores, along the normal-like direction `out`.
glm::dvec3 carved(const glm::dvec3& p, const glm::dvec3& out, double height) {
  return p + out * (height * layered_noise(p * 18.0, 5) + 0.12 * height * layered_noise(p * 260.0, 3));
}

struct Slice {
  double y;      ///< height
  double side;   ///< half width
  double front;  ///< half depth
  double x, z;   ///< centre
};

/// A Catmull-Rom interpolation between the slices around y.
Slice slice_at(std::span<const Slice> slices, double t) {
  const double place = t * static_cast<double>(slices.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(place), slices.size() - 2);
  const double f = place - static_cast<double>(i);
  const Slice& a = slices[i == 0 ? 0 : i - 1];
  const Slice& b = slices[i];
  const Slice& c = slices[i + 1];
  const Slice& d = slices[std::min(i + 2, slices.size() - 1)];
  const auto curve = [&](double Slice::*m) {
    return b.*m +
           0.5 * f *
               (c.*m - a.*m +
                f * (2.0 * a.*m - 5.0 * b.*m + 4.0 * c.*m - d.*m + f * (3.0 * (b.*m - c.*m) + d.*m - a.*m)));
  };
  return {curve(&Slice::y), std::max(0.0, curve(&Slice::side)), std::max(0.0, curve(&Slice::front)),
          curve(&Slice::x), curve(&Slice::z)};
}

constexpr std::array<Slice, 18> robe_slices{{{0.10, 0.0, 0.0, 0.0, 0.0},
                                             {0.10, 0.20, 0.19, 0.0, 0.0},
                                             {0.11, 0.30, 0.28, 0.0, 0.0},
                                             {0.18, 0.285, 0.265, 0.0, 0.0},
                                             {0.32, 0.255, 0.235, 0.0, 0.0},
                                             {0.50, 0.228, 0.212, 0.01, 0.0},
                                             {0.68, 0.214, 0.190, 0.015, 0.01},
                                             {0.84, 0.202, 0.172, 0.02, 0.015},
                                             {0.96, 0.188, 0.156, 0.02, 0.01},
                                             {1.07, 0.152, 0.126, 0.012, 0.0},
                                             {1.16, 0.139, 0.115, 0.005, 0.0},
                                             {1.27, 0.158, 0.128, 0.0, 0.008},
                                             {1.36, 0.176, 0.126, 0.0, 0.005},
                                             {1.44, 0.172, 0.105, 0.0, -0.005},
                                             {1.50, 0.105, 0.076, 0.0, -0.005},
                                             {1.55, 0.055, 0.056, 0.0, 0.0},
                                             {1.64, 0.048, 0.050, 0.0, 0.01},
                                             {1.66, 0.0, 0.0, 0.0, 0.01}}};

glm::dvec3 robe(double u, double v) {
  const Slice s = slice_at(robe_slices, v);
  const double angle = 2.0 * pi * u;
  const glm::dvec3 out(std::cos(angle), 0.0, std::sin(angle));
  // Folds hang from the girdle. They become deeper and fewer towards the hem, and wander as in cloth.
  const double hang = rise(1.16, 0.25, s.y);
  const double wander = 0.55 * layered_noise({3.0 * out.x, 2.2 * s.y, 3.0 * out.z}, 3);
  const double wide = std::sin(9.0 * angle + 3.0 * wander + 1.7 * s.y);
  const double narrow = std::sin(23.0 * angle + 5.0 * wander - 2.3 * s.y);
  double fold = hang * (0.030 * (1.0 - std::abs(wide)) + 0.009 * narrow);
  // Above it the cloth is drawn to the shoulders; the girdle itself is a cord wound twice.
  const double bodice = rise(1.17, 1.24, s.y) * rise(1.53, 1.44, s.y);
  fold += bodice * 0.007 * std::sin(34.0 * s.y - 9.0 * std::abs(out.x) + 4.0 * wander);
  fold += bodice * 0.040 * bump(s.y, 1.33, 0.06) *
          (bump(angle, 0.5 * pi - 0.42, 0.3) + bump(angle, 0.5 * pi + 0.42, 0.3));
  fold += 0.016 * (bump(s.y, 1.135, 0.014) + bump(s.y, 1.165, 0.014)) *
          (1.0 + 0.25 * std::sin(60.0 * angle + 400.0 * s.y));
  // A knee pushes through.
  fold += 0.045 * bump(s.y, 0.62, 0.14) * bump(angle, 0.5 * pi - 0.45, 0.35);
  const double inside = rise(0.0, 0.08, std::min(s.side, s.front));
  const glm::dvec3 p = glm::dvec3(s.x, s.y, s.z) + glm::dvec3(out.x * s.side, 0.0, out.z * s.front);
  return carved(p + out * (fold * inside), out, 0.0022 * inside);
}

glm::dvec3 head(double u, double v) {
  const double turn = 2.0 * pi * u;
  const double polar = pi * v;
  const glm::dvec3 d(std::sin(polar) * std::cos(turn), -std::cos(polar), std::sin(polar) * std::sin(turn));
  glm::dvec3 p = d * glm::dvec3(0.082, 0.118, 0.098);
  if (d.y < 0.0) p.x *= 1.0 + 0.32 * d.y;  // towards the chin
  const double face = rise(0.35, 0.7, d.z);
  // The face has its own coordinates; x and y are about +-0.07 and +-0.1.
  double relief = 0.026 * bump(p.x, 0.0, 0.010 + 0.008 * rise(0.01, -0.035, p.y)) * bump(p.y, -0.014, 0.026);
  relief -= 0.010 * (bump(p.x, 0.030, 0.014) + bump(p.x, -0.030, 0.014)) * bump(p.y, 0.013, 0.012);
  relief += 0.008 * (bump(p.x, 0.031, 0.011) + bump(p.x, -0.031, 0.011)) * bump(p.y, 0.011, 0.006);
  relief += 0.004 * bump(p.y, 0.036 - 8.0 * (std::abs(p.x) - 0.03) * (std::abs(p.x) - 0.03), 0.006) *
            bump(std::abs(p.x), 0.03, 0.02);
  relief += 0.008 * bump(p.x, 0.0, 0.024) * (bump(p.y, -0.058, 0.007) + 0.9 * bump(p.y, -0.072, 0.007));
  relief += 0.008 * bump(p.x, 0.0, 0.020) * bump(p.y, -0.100, 0.016);
  // Hair: waves combed back from the forehead, gathered at the neck.
  const double hairline = d.z - 0.55 + 0.9 * std::max(0.0, -d.y) - 1.1 * std::max(0.0, d.y - 0.35);
  const double hair = rise(0.12, -0.12, hairline) * rise(-0.95, -0.7, d.y);
  const double wave = std::sin(46.0 * std::atan2(d.y + 0.1, std::abs(d.x) + 0.35) + 6.0 * d.z +
                               2.5 * layered_noise(d * 4.0, 3));
  relief = face * relief + hair * (0.012 + 0.0045 * wave) +
           0.05 * bump(d.z, -1.0, 0.5) * bump(d.y, -0.25, 0.3) * hair;
  return carved(glm::dvec3(0.0, 1.70, 0.018) + p + d * relief, d, 0.0006);
}

/// A limb along a curve of four control points; radius(t) and folds of a sleeve.
struct Limb {
  std::array<glm::dvec3, 4> curve;
  double first, last;  ///< radii
  double folds;        ///< depth
};

glm::dvec3 bezier(const std::array<glm::dvec3, 4>& c, double t) {
  const double s = 1.0 - t;
  return c[0] * (s * s * s) + c[1] * (3.0 * s * s * t) + c[2] * (3.0 * s * t * t) + c[3] * (t * t * t);
}

glm::dvec3 limb(const Limb& limb, double u, double v) {
  // The last twentieth at either end closes in a round end.
  constexpr double round = 0.05;
  const double t = std::clamp((v - 0.5 * round) / (1.0 - round), 0.0, 1.0);
  const double end = std::min({1.0, v / round, (1.0 - v) / round});
  const glm::dvec3 way = glm::normalize(bezier(limb.curve, t + 0.01) - bezier(limb.curve, t - 0.01));
  const glm::dvec3 x = glm::normalize(glm::cross(way, glm::dvec3(0.21, 0.34, 0.92)));
  const glm::dvec3 y = glm::cross(x, way);
  const double angle = 2.0 * pi * u;
  const glm::dvec3 out = x * std::cos(angle) + y * std::sin(angle);
  const double radius = glm::mix(limb.first, limb.last, t) * std::sqrt(std::max(0.0, end * (2.0 - end)));
  const glm::dvec3 p = bezier(limb.curve, t) + out * radius;
  const double fold = layered_noise({9.0 * t + 0.8 * std::sin(angle), 1.1 * std::cos(angle), 2.0}, 3);
  return carved(p + out * (limb.folds * fold * end), out, 0.0018 * end);
}

/// side is -1 or 1. The wing is a closed sheet along its leading edge, with feathers in three rows.
glm::dvec3 wing(double side, double u, double v) {
  const std::array<glm::dvec3, 4> edge{{{0.05 * side, 1.36, -0.10},
                                        {0.30 * side, 1.98, -0.34},
                                        {0.66 * side, 1.98, -0.40},
                                        {0.62 * side, 1.12, -0.34}}};
  const double t = v;
  // Both wings go around the edge in the same sense, because one is the mirror image of the other.
  const double turn = side < 0.0 ? u : 1.0 - u;
  const bool front = turn < 0.5;
  const double across = front ? 2.0 * turn : 2.0 - 2.0 * turn;
  const glm::dvec3 down = glm::normalize(glm::dvec3(-0.30 * side, -1.0, 0.06));
  const glm::dvec3 out = glm::normalize(glm::dvec3(-0.35 * side, 0.0, 1.0));
  const double close = std::sqrt(std::max(0.0, 1.0 - std::pow(std::abs(2.0 * t - 1.0), 6.0)));
  const double feather = t * 15.0;
  const double quill = feather - std::floor(feather);
  const double tip = 1.0 - 0.24 * std::pow(std::abs(2.0 * quill - 1.0), 2.0) * rise(0.6, 0.95, across);
  const double chord = (0.56 - 0.30 * t) * close * tip;
  const double thickness = 0.030 * close * std::sqrt(across * (1.0 - across)) * 2.0 * (1.0 - 0.6 * across);
  const double row = across < 0.3 ? across / 0.3 : across < 0.6 ? (across - 0.3) / 0.3 : (across - 0.6) / 0.4;
  const double vanes = across < 0.6 ? 2.0 : 1.0;
  const double vane = t * 15.0 * vanes;
  const double shaft = std::abs(2.0 * (vane - std::floor(vane)) - 1.0);
  const double inside = close * rise(0.0, 0.06, across) * rise(1.0, 0.96, across);
  const double relief = inside * (0.013 * (1.0 - shaft * shaft) + 0.014 * row * row +
                                  0.0012 * std::sin(90.0 * across + 16.0 * shaft));
  const glm::dvec3 p =
      bezier(edge, t) + down * (chord * across) + out * (0.05 * std::sin(pi * across) * close);
  const double face = front ? 1.0 : -1.0;
  return carved(p + out * (face * (thickness + relief)), out * face, 0.0012 * inside);
}

glm::dvec3 flame(double u, double v) {
  const double angle = 2.0 * pi * u;
  const double radius = 0.048 * std::sin(pi * std::pow(v, 0.62));
  const double twist = angle + 5.0 * v;
  const glm::dvec3 out(std::cos(angle), 0.0, std::sin(angle));
  const double tongues = 1.0 + 0.38 * std::sin(4.0 * twist) * rise(0.05, 0.5, v);
  return carved(glm::dvec3(0.335, 2.02 + 0.17 * v, 0.14) + out * (radius * tongues), out,
                0.0015 * rise(0.0, 0.01, radius));
}

constexpr std::array<Slice, 11> torch_slices{{{1.66, 0.0, 0.0, 0.285, 0.14},
                                              {1.66, 0.013, 0.013, 0.285, 0.14},
                                              {1.70, 0.017, 0.017, 0.290, 0.14},
                                              {1.80, 0.019, 0.019, 0.303, 0.14},
                                              {1.92, 0.021, 0.021, 0.320, 0.14},
                                              {1.96, 0.026, 0.026, 0.325, 0.14},
                                              {1.98, 0.052, 0.052, 0.328, 0.14},
                                              {2.01, 0.060, 0.060, 0.332, 0.14},
                                              {2.04, 0.066, 0.066, 0.335, 0.14},
                                              {2.03, 0.045, 0.045, 0.335, 0.14},
                                              {2.02, 0.0, 0.0, 0.335, 0.14}}};

glm::dvec3 torch(double u, double v) {
  const Slice s = slice_at(torch_slices, v);
  const double angle = 2.0 * pi * u;
  const glm::dvec3 out(std::cos(angle), 0.0, std::sin(angle));
  const double inside = rise(0.0, 0.01, s.side);
  const double flutes = 0.0016 * std::sin(10.0 * angle + 60.0 * s.y) * inside;
  return carved(glm::dvec3(s.x, s.y, s.z) + out * (s.side + flutes), out, 0.0008 * inside);
}

constexpr std::array<Slice, 12> plinth_slices{{{-0.12, 0.0, 0.0, 0.0, 0.0},
                                               {-0.12, 0.40, 0.36, 0.0, 0.0},
                                               {-0.12, 0.44, 0.40, 0.0, 0.0},
                                               {-0.10, 0.44, 0.40, 0.0, 0.0},
                                               {-0.06, 0.44, 0.40, 0.0, 0.0},
                                               {-0.04, 0.43, 0.39, 0.0, 0.0},
                                               {-0.02, 0.40, 0.36, 0.0, 0.0},
                                               {0.04, 0.39, 0.35, 0.0, 0.0},
                                               {0.09, 0.39, 0.35, 0.0, 0.0},
                                               {0.115, 0.37, 0.33, 0.0, 0.0},
                                               {0.12, 0.30, 0.27, 0.0, 0.0},
                                               {0.12, 0.0, 0.0, 0.0, 0.0}}};

glm::dvec3 plinth(double u, double v) {
  const Slice s = slice_at(plinth_slices, v);
  const double angle = 2.0 * pi * u;
  const glm::dvec3 out(std::cos(angle), 0.0, std::sin(angle));
  const glm::dvec3 p = glm::dvec3(0.0, s.y, 0.0) + glm::dvec3(out.x * s.side, 0.0, out.z * s.front);
  return carved(p, out, 0.0045 * rise(0.0, 0.1, s.side));
}

}  // namespace

std::vector<EvenSurface> winged_figure() {
  constexpr Limb raised{{{{0.14, 1.40, 0.0}, {0.36, 1.36, 0.02}, {0.30, 1.52, 0.10}, {0.288, 1.73, 0.14}}},
                        0.066,
                        0.030,
                        0.012};
  constexpr Limb lowered{
      {{{-0.145, 1.41, 0.0}, {-0.30, 1.20, -0.02}, {-0.27, 1.06, 0.06}, {-0.13, 1.02, 0.17}}},
      0.068,
      0.034,
      0.012};
  constexpr Limb upper_hand{
      {{{0.286, 1.71, 0.135}, {0.288, 1.74, 0.15}, {0.29, 1.77, 0.15}, {0.297, 1.79, 0.135}}},
      0.030,
      0.034,
      0.003};
  constexpr Limb lower_hand{
      {{{-0.14, 1.022, 0.165}, {-0.11, 1.018, 0.185}, {-0.08, 1.01, 0.19}, {-0.05, 0.985, 0.19}}},
      0.028,
      0.018,
      0.002};
  std::vector<EvenSurface> parts;
  parts.emplace_back(plinth);
  parts.emplace_back(robe);
  parts.emplace_back(head);
  for (const Limb& shape : {raised, lowered, upper_hand, lower_hand})
    parts.emplace_back([shape](double u, double v) { return limb(shape, u, v); });
  for (const double side : {-1.0, 1.0})
    parts.emplace_back([side](double u, double v) { return wing(side, u, v); });
  parts.emplace_back(torch);
  parts.emplace_back(flame);
  return parts;
}

}  // namespace hitpipe::ref
