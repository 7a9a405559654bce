// My rays, my boxes, my Verilated unit: every HIT against the software test and exact arithmetic.
#include <cstdio>
#include <random>

#include <hitpipe/ref.hpp>

#include "Vint_slabs.h"

struct Test {
  std::vector<std::uint64_t> operands;
  bool hit, exact;
};

void drive(Vint_slabs& top, const std::vector<std::uint64_t>& o) {
  top.irx = o[0], top.iry = o[1], top.irz = o[2], top.irlen = o[3];
  top.iri_floor = o[4], top.irj_floor = o[6], top.irk_floor = o[8];
  top.iri_ceil = o[5], top.irj_ceil = o[7], top.irk_ceil = o[9], top.rinf = o[10];
  top.ixmin = o[11], top.iymin = o[13], top.izmin = o[15];
  top.ixmax = o[12], top.iymax = o[14], top.izmax = o[16];
}

int main() {
  std::mt19937 random(1);
  const auto draw = [&](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
  const hitpipe::Transform into_cube = hitpipe::fit({{0, 0, 0}, {100, 80, 20}});  // my scene, in metres
  hitpipe::Unit unit("int_slabs");
  std::vector<Test> tests;
  for (int i = 0; i < 10'000; ++i) {
    const double eye[] = {draw(0, 100), draw(0, 80), 2}, way[] = {draw(-1, 1), draw(-1, 1), draw(0, 0.2)};
    unit.set_ray(hitpipe::to_cube(into_cube, eye, way, i % 2 ? hitpipe::endless : draw(0, 50)));
    const double x = draw(0, 60), y = draw(0, 40), z = draw(0, 10);
    const auto answer = unit.test(hitpipe::to_cube(into_cube, {{x, y, z}, {x + 40, y + 40, z + 10}}));
    tests.push_back({unit.port_bits(answer.operands), answer.hit[0] != 0, answer.exact[0] != 0});
  }

  Vint_slabs top;
  std::size_t sent = 0, came = 0, hits = 0, mismatches = 0, false_misses = 0, cycles = 0;
  for (top.rst = 1; came < tests.size() && cycles < 1'000'000; top.rst = 0, ++cycles) {
    top.in_valid = sent < tests.size() && draw(0, 1) < 0.8;  // gaps
    top.out_ready = draw(0, 1) < 0.8;                        // stalls
    if (top.in_valid) drive(top, tests[sent].operands);
    top.clk = 0, top.eval();
    if (!top.rst && top.in_valid && top.in_ready) ++sent;
    if (!top.rst && top.out_valid && top.out_ready) {
      const Test& test = tests[came++];
      hits += top.hit;
      mismatches += (top.hit != 0) != test.hit;
      false_misses += test.exact && !top.hit;
    }
    top.clk = 1, top.eval();
  }
  std::printf("%zu tests in %zu cycles: %zu hits, %zu mismatches, %zu false misses\n", came, cycles, hits,
              mismatches, false_misses);
  return came == tests.size() && mismatches == 0 && false_misses == 0 ? 0 : 1;
}
