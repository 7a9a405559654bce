// The text of one ray and box, as `check --replay` takes it. When it is read, printed and read again it stays
// the same; the exact referees agree; and no integer unit misses a box that the ray meets (sections 6.2,
// 6.3).
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "rays/exact/box_referee.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "sim/software/box_software.hpp"
#include "sw_ref/judge/adversary/case.hpp"
#include "tests/fuzz/expect.hpp"

namespace {

using namespace hitpipe;
using fuzz::expect;

const auto& integer_units() {
  static const auto units = [] {
    std::vector<std::unique_ptr<sim::BoxTest>> all;
    for (const auto& [name, bits] : {std::pair{"int_slabs", "20/24"},
                                     {"int_slabs", "12/12"},
                                     {"int_plucker", "24/24"},
                                     {"int_plucker", "20/24"},
                                     {"int_major", "20+1/13"},
                                     {"int_major", "12+2/8f1"},
                                     {"int_major_pair", "16+0/9"}}) {
      const rtl::Design& design = rtl::find_design(name);
      all.push_back(sim::make_box_test(design, design.parse_format(bits)));
    }
    return all;
  }();
  return units;
}

void judge(const ref::adversary::Case& c) {
  const bool meets = ref::ray_meets_box_exact(c.ray, c.box);
  expect(ref::ray_meets_box(c.ray, c.box) == meets, "the referee is exact");
  expect(ref::ray_meets_box_by_products(c.ray, c.box) == meets, "products are exact");
  expect(ref::ray_meets_box_filtered(c.ray, c.box).value_or(meets) == meets, "the filter is exact");
  for (const auto& unit : integer_units()) {
    unit->start(c.ray);
    expect(unit->hit(c.box) || !meets, "an integer unit never misses");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto c = ref::adversary::parse_case({reinterpret_cast<const char*>(data), size});
    const std::string text = to_text(c);
    expect(to_text(ref::adversary::parse_case(text)) == text, "a case is read as it was printed");
    judge(c);
  } catch (const std::runtime_error& error) {
    expect(!std::string(error.what()).empty(), "a message says what is wrong");
  }
  return 0;
}
