// Faults of every kind at every node of every design: the vectors that `hitpipe rtl` writes show all that
// change the function. Faults that do not are listed here with the reason, and none of them shows.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <ostream>
#include <regex>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rtl_gen/emit/vectors.hpp"
#include "rtl_gen/graph/canonical.hpp"
#include "sim/vectors/design_vectors.hpp"
#include "tests/sim/vectors/fault_simulation.hpp"

namespace hitpipe::sim::planted_faults_test {
namespace {

using Operands = std::vector<std::vector<std::int64_t>>;

/// A change that is no fault: no operand of the unit shows it.
struct Harmless {
  const char* what;  ///< a regular expression of to_text()
  const char* why;
  /// Operands show it that no set-up gives; the vectors may have such.
  bool by_set_up = false;
};

struct FaultyUnit {
  std::string design;
  std::string bits;
  std::vector<Harmless> harmless{};
  bool reasoned = true;  ///< harmless changes are listed; if not, they are all that no vector shows

  [[nodiscard]] const rtl::Design& found() const { return rtl::find_design(design); }
  [[nodiscard]] Format format() const { return found().parse_format(bits); }
};

void PrintTo(const FaultyUnit& unit, std::ostream* out) {
  *out << unit.design << ' ' << unit.bits;
}

const std::vector<Harmless> of_fp_slabs{
    {"fp_subtract d1_[yz]: with infinity for NaN",
     "a NaN distance of y or z is no constraint: comparisons with it are false and keep the other one; so do "
     "those with the infinity, which d1 gives to the side on which it does not bind"},
    {"fp_compare 1 of apart: less: -0 below \\+0",
     "a far distance of -0 has the sign bit set, so the box lies behind anyway"},
};
/// b is the upper plane less the origin.
const std::vector<Harmless> of_fp_plucker_direct{
    {"fp_subtract b_[xyz]: with infinity for NaN",
     "b is multiplied by a component of at least 0 in q and of at most 0 in p, so q becomes +infinity, p "
     "-infinity, or either NaN; then q is not below p"},
    {"fp_multiply q_[0-5]: with infinity for NaN", "neither is below p, as NaN is not"},
};
const std::vector<Harmless> of_fp_plucker{
    of_fp_plucker_direct[0],
    of_fp_plucker_direct[1],
    {"fp_subtract side_[0-5]: with (0|infinity) for NaN", "neither is below 0, as NaN is not"},
};

constexpr const char* lies_behind =
    "it changes the magnitude of a negative far distance, and the box lies behind whatever that is";
constexpr const char* never_so_far =
    "far is at most the distance on the major axis, which has a bit less; below that range it is less than "
    "near";
constexpr const char* negative_length =
    "it changes the magnitude of a negative near distance, which decides only where the length is negative "
    "too";
constexpr const char* volume_in_the_cube =
    "origin and corners are in the cube, where six times a tetrahedron's volume has a bit less";
constexpr const char* sign_twice = "the two highest bits of the product are both its sign";

/// The sign is extended at each level of the shifter that has a bit for it.
std::vector<Harmless> of_int_major(const char* extended_signs) {
  return {{extended_signs, lies_behind},
          {"xor [23] of s_far_[ab]: (as \\||without its second operand)", lies_behind},
          {"slice 1 of overlap: a bit lower", never_so_far},
          {"extend [0-9]+ of s_near_[ab]: by zeros", negative_length, true}};
}

const std::vector<FaultyUnit> units{
    {"fp_slabs", "fp32", of_fp_slabs},
    {"int_slabs", "20/24"},
    {"int_slabs", "24/24"},
    {"fp_plucker", "fp32", of_fp_plucker},
    {"int_plucker", "20/24"},
    {"int_plucker", "24/24"},
    {"fp_plucker_direct", "fp32", of_fp_plucker_direct},
    {"int_major", "20+1/13", of_int_major("extend [2-6] of s_far_[ab]: by zeros")},
    {"int_major", "16+0/8", of_int_major("extend [2-5] of s_far_[ab]: by zeros")},
    {"int_major_pair", "20+1/13", {{"slice (1|3) of leaves_0: a bit higher", sign_twice}}},
    {"int_major_pair", "16+0/8", {{"slice (1|3) of leaves_0: a bit higher", sign_twice}}},
    {"int_triangle", "20+1s20", {{"slice 1 of ahead: a bit lower", volume_in_the_cube}}},
    {"int_triangle", "20+1s20c1", {{"slice 1 of ahead: a bit lower", volume_in_the_cube}}},
    {"int_triangle",
     "20+1s20c2",
     {{"slice 1 of ahead: a bit lower", volume_in_the_cube},
      {"cmp r_less_p: as <=", "where R_a is P_a, ok_0 takes its other arm"}}},
    {"fp_slabs_safe", "e8m23"},
    {"fp_slabs_safe", "e8m15"},
    {"fp_slabs_safe", "e5m10"},
};

/// These, and every other design in its own format.
std::vector<FaultyUnit> all_units() {
  std::vector<FaultyUnit> all = units;
  for (const rtl::Design& design : rtl::designs()) {
    const auto is_listed = [&](const FaultyUnit& unit) { return unit.design == design.name; };
    if (std::none_of(units.begin(), units.end(), is_listed))
      all.push_back({std::string(design.name), to_string(design.default_format), {}, false});
  }
  return all;
}

class PlantedFaults : public testing::TestWithParam<FaultyUnit> {
 protected:
  [[nodiscard]] static Operands vectors_of_unit(std::size_t count, std::uint64_t seed) {
    Operands operands;
    for (const rtl::Vector& vector :
         design_vectors(GetParam().found(), GetParam().format(), count, seed).all())
      operands.push_back(vector.operands);
    return operands;
  }
  /// Nothing: a fault that must show.
  [[nodiscard]] static const Harmless* why_harmless(const std::string& fault) {
    for (const Harmless& each : GetParam().harmless)
      if (std::regex_match(fault, std::regex(each.what))) return &each;
    return nullptr;
  }

  const rtl::Graph graph_ = rtl::canonical(GetParam().found().trace(GetParam().format()));
  const std::vector<Fault> faults_ = faults_of(graph_);
  const std::vector<std::string> names_ = node_names(graph_);
};

TEST_P(PlantedFaults, AreShownByTheUsualVectors) {
  FaultSimulation simulation(graph_, vectors_of_unit(usual_vectors, usual_seed));
  // What a design without a list hides from the usual vectors, ten times as many of another seed do not show.
  std::optional<FaultSimulation> more;
  if (!GetParam().reasoned) more.emplace(graph_, vectors_of_unit(10 * usual_vectors, usual_seed + 1));
  std::size_t shown = 0;
  for (const Fault& fault : faults_) {
    const std::string text = to_text(graph_, names_, fault);
    const bool is_shown = simulation.shown_by(fault).has_value();
    const Harmless* const harmless = why_harmless(text);
    const bool either = harmless != nullptr && harmless->by_set_up;
    if (more) {
      EXPECT_TRUE(is_shown || !more->shown_by(fault)) << text;
    } else {
      EXPECT_TRUE(either || is_shown == (harmless == nullptr)) << text;
    }
    shown += is_shown ? 1 : 0;
  }
  fmt::print("{} {}: {} of {} faults show\n", GetParam().design, GetParam().bits, shown, faults_.size());
}

/// So the list of harmless changes grows no dead entry.
TEST_P(PlantedFaults, ContainEveryHarmlessChange) {
  for (const Harmless& each : GetParam().harmless) {
    EXPECT_TRUE(std::any_of(faults_.begin(), faults_.end(), [&](const Fault& fault) {
      return std::regex_match(to_text(graph_, names_, fault), std::regex(each.what));
    })) << each.what;
  }
}

/// Random operands were the vectors once.
TEST_P(PlantedFaults, AreNotAllShownByRandomOperands) {
  const Operands operands = rtl::operand_vectors(rtl::input_ports(graph_), 1000, 1);
  const rtl::Evaluate evaluate = GetParam().found().evaluate(GetParam().format());
  std::array<std::int64_t, rtl::Evaluate::most_results> results{};
  const auto is_yes = [&](const auto& each) {
    evaluate(each.data(), results.data());
    return evaluate.yes(results.data());
  };
  const auto hits =
      std::count_if(operands.begin(), operands.end(), [&](const auto& each) { return is_yes(each); });
  FaultSimulation simulation(graph_, operands);
  std::size_t hidden = 0;
  for (const Fault& fault : faults_)
    if (!simulation.shown_by(fault) && why_harmless(to_text(graph_, names_, fault)) == nullptr) ++hidden;
  EXPECT_GT(hidden, 10U);
  fmt::print("{} {}: {} of {} faults are hidden from 1000 random operands, of which {} hit\n",
             GetParam().design, GetParam().bits, hidden, faults_.size(), hits);
}

/// The faults themselves change the results, not the simulation that plants them.
TEST_P(PlantedFaults, AreAbsentFromTheRightGraph) {
  const Operands vectors = rtl::operand_vectors(rtl::input_ports(graph_), 200, 1);
  const FaultSimulation simulation(graph_, vectors);
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    std::vector<std::uint64_t> inputs;
    for (std::size_t k = 0; k < vectors[i].size(); ++k)
      inputs.push_back(static_cast<std::uint64_t>(vectors[i][k]) &
                       ~std::uint64_t{0} >> (64 - graph_[graph_.inputs()[k]].width));
    EXPECT_EQ(simulation.outputs(i), rtl::evaluate(graph_, inputs)) << i;
  }
}

std::string name_of(const testing::TestParamInfo<FaultyUnit>& parameter) {
  std::string name = fmt::format("{}_{}", parameter.param.design, parameter.param.bits);
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '/' || c == '+'; }, '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Designs, PlantedFaults, testing::ValuesIn(all_units()), name_of);

}  // namespace
}  // namespace hitpipe::sim::planted_faults_test
