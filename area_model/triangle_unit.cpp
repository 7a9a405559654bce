#include "area_model/triangle_unit.hpp"

#include <string>

#include "rtl_gen/graph/trace_fp.hpp"

namespace hitpipe::area {

namespace {

using rtl::FpSignal;
using Bit = rtl::Trace::bit;

struct Vector {
  FpSignal x, y, z;
};

/// Turns the sign of x when `turn` is 1.
FpSignal turned(const Bit& turn, const FpSignal& x) {
  const int top = width_of(x.bits) - 1;
  return {cat(slice(x.bits, top, top) ^ turn, slice(x.bits, top - 1, 0)), x.format};
}

FpSignal sum(const FpSignal& a, const FpSignal& b) {
  return fp_sub(a, turned(rtl::Trace::lit(1, 1), b));
}

Vector operator-(const Vector& a, const Vector& b) {
  return {fp_sub(a.x, b.x), fp_sub(a.y, b.y), fp_sub(a.z, b.z)};
}

Vector cross(const Vector& a, const Vector& b) {
  return {fp_sub(fp_mul(a.y, b.z), fp_mul(a.z, b.y)), fp_sub(fp_mul(a.z, b.x), fp_mul(a.x, b.z)),
          fp_sub(fp_mul(a.x, b.y), fp_mul(a.y, b.x))};
}

FpSignal dot(const Vector& a, const Vector& b) {
  return sum(sum(fp_mul(a.x, b.x), fp_mul(a.y, b.y)), fp_mul(a.z, b.z));
}

rtl::Graph trace(const hls::FpBits& format) {
  rtl::Graph graph("float_triangle");
  const rtl::TraceRecorder tracer(graph);
  const auto number = [&](const std::string& name) {
    return FpSignal{rtl::Trace::uint(graph.input(name, format.width(), false)), format};
  };
  const auto vector = [&](const std::string& name) {
    return Vector{number(name + "x"), number(name + "y"), number(name + "z")};
  };
  const Vector a = vector("a"), b = vector("b"), c = vector("c");
  const Vector origin = vector("r"), direction = vector("d");
  const FpSignal length = number("rlen");
  const Bit endless(graph.input("rinf", 1, false));

  const Vector side_b = b - a, side_c = c - a, from_a = origin - a;
  const Vector p = cross(direction, side_c), q = cross(from_a, side_b);
  const FpSignal determinant = dot(side_b, p);
  const Bit back = sign(determinant);
  const FpSignal size = turned(back, determinant);
  const FpSignal u = turned(back, dot(from_a, p)), v = turned(back, dot(direction, q));
  const FpSignal t = turned(back, dot(side_c, q));
  const Bit inside = ~sign(u) & ~sign(v) & ~fp_compare(size, sum(u, v)).less;
  const Bit in_reach = ~sign(t) & (~fp_compare(fp_mul(length, size), t).less | endless);
  graph.output("hit", (inside & in_reach).id());
  graph.output("distance", t.bits.id());
  graph.output("determinant", size.bits.id());
  return graph;
}

}  // namespace

const rtl::Design& triangle_unit() {
  static const rtl::Design design{
      .name = "float_triangle",
      .summary = "float triangle test of Moeller and Trumbore",
      .kind = {"triangle", 1, hls::meanings(hls::Meaning::hit), hls::meanings()},
      .conservative = false,
      .default_format = hls::Binary32{},
      .results_at =
          [](const Format&) {
            return std::vector{hls::Result{"hit", hls::Meaning::hit, 0, 1, false}};
          },
      .ports_at = nullptr,
      .trace_at = [](const Format& format) { return trace(format.as<hls::Binary32>()); },
      .run_at = nullptr};
  return design;
}

Price price_of_triangle_unit(const rtl::Library& library) {
  return price(triangle_unit(), triangle_unit().default_format, library, Account::built);
}

}  // namespace hitpipe::area
