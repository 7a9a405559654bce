// What the library refuses: the status, the whole line, and that nothing is written.
#include <cmath>

#include <gtest/gtest.h>
#include <hitpipe/ref.hpp>

namespace hitpipe {
namespace {

const Ray ray{{0, 0, 0}, {1, 0, 0}, 1};
const Box box{{0, 0, 0}, {0.5F, 0.5F, 0.5F}};

/// "4: line"
template <class Call>
std::string refusal(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return std::to_string(error.status()) + ": " + error.what();
  }
  return "no refusal";
}

TEST(LibraryRefusal, NamesWhatIsWrongWithADesign) {
  std::string names;
  for (std::size_t i = 0; i < hitpipe_design_count(); ++i) {
    DesignInfo each;
    check(hitpipe_design(i, &each));
    names += (i == 0 ? "" : ", ") + std::string(each.name);
  }
  EXPECT_EQ(refusal([] { Unit("slabs"); }), "2: design slabs: unknown; there are: " + names);
  EXPECT_EQ(refusal([] { Unit("int_slabs", "40/24"); }),
            "3: bits 40/24: no format of int_slabs; allowed is n/t with n in 6..32 and t in 6..2n-1, for "
            "example 20/24");
  DesignInfo info;
  EXPECT_EQ(refusal([&] { check(hitpipe_design(99, &info)); }),
            "1: design 99: allowed is 0.." + std::to_string(hitpipe_design_count() - 1));
}

TEST(LibraryRefusal, NamesWhatIsWrongWithARay) {
  Unit unit("int_slabs");
  const auto refused = [&](const Ray& bad) { return refusal([&] { unit.set_ray(bad); }); };
  EXPECT_EQ(refused({{0, 1.5F, 0}, {1, 0, 0}, 1}),
            "4: ray: origin.y = 1.5 is outside the cube; allowed is [-1, 1]");
  EXPECT_EQ(refused({{0, 0, 0}, {1, 0, INFINITY}, 1}),
            "4: ray: direction.z = inf; components must be finite");
  EXPECT_EQ(refused({{0, 0, 0}, {0, -0.0F, 0}, 1}),
            "4: ray: direction is (0, 0, 0); one component must differ from 0");
  EXPECT_EQ(refused({{0, 0, 0}, {1, 0, 0}, -1}), "4: ray: length = -1; it must be >= 0 or infinite");
  EXPECT_EQ(refused({{0, 0, 0}, {1, 0, 0}, NAN}), "4: ray: length = nan; it must be >= 0 or infinite");
  EXPECT_EQ(refused({{NAN, 0, 0}, {1, 0, 0}, 1}),
            "4: ray: origin.x = nan is outside the cube; allowed is [-1, 1]");
}

TEST(LibraryRefusal, ARefusedRayLeavesNoRay) {
  Unit unit("int_slabs");
  const auto test = [&] { return refusal([&] { static_cast<void>(unit.test(box)); }); };
  const std::string no_ray = "6: design int_slabs: no ray is set; set one before a test";
  EXPECT_EQ(test(), no_ray);
  unit.set_ray(ray);
  EXPECT_EQ(test(), "no refusal");
  EXPECT_NE(refusal([&] { unit.set_ray({{2, 0, 0}, {1, 0, 0}, 1}); }), "no refusal");
  EXPECT_EQ(test(), no_ray);
}

TEST(LibraryRefusal, NamesTheFirstBadOperand) {
  const Unit unit("int_slabs");
  const std::size_t count = unit.ports().size();
  std::vector<std::int64_t> operands(2 * count);
  std::vector<std::int64_t> results(2, 7);
  EXPECT_EQ(refusal([&] { check(hitpipe_test_operands(nullptr, operands.data(), 2, results.data())); }),
            "1: unit: a null pointer is not allowed");
  const auto refused = [&](std::size_t place, std::int64_t value) {
    operands[place] = value;
    const std::string line = refusal([&] { static_cast<void>(unit.test_operands(operands)); });
    operands[place] = 0;
    return line;
  };
  EXPECT_EQ(refused(count, 524'288), "8: test 1: operand irx is 524288; allowed is -524288 to 524287");
  EXPECT_EQ(refused(0, -524'289), "8: test 0: operand irx is -524289; allowed is -524288 to 524287");
  EXPECT_EQ(refused(10, -1), "8: test 0: operand rinf is -1; allowed is 0 to 1");
  EXPECT_EQ(refused(0, 524'287), "no refusal");
  operands.pop_back();
  EXPECT_THROW(static_cast<void>(unit.test_operands(operands)), std::invalid_argument);
}

TEST(LibraryRefusal, WritesNoResultOfABadOperand) {
  hitpipe_unit* unit = nullptr;
  check(hitpipe_open("int_slabs", nullptr, &unit));
  std::vector<std::int64_t> operands(2 * hitpipe_port_count(unit));
  operands.back() = INT64_MAX;
  std::int64_t results[] = {7, 7};
  EXPECT_EQ(hitpipe_test_operands(unit, operands.data(), 2, results), HITPIPE_BAD_OPERAND);
  EXPECT_EQ(results[0], 7);
  EXPECT_EQ(hitpipe_test_operands(unit, operands.data(), 1, results), HITPIPE_OK);
  EXPECT_NE(results[0], 7);
  EXPECT_EQ(results[1], 7);
  EXPECT_EQ(hitpipe_test_operands(unit, nullptr, 0, nullptr), HITPIPE_OK);
  EXPECT_EQ(hitpipe_test_operands(unit, nullptr, 1, results), HITPIPE_BAD_ARGUMENT);
  EXPECT_EQ(hitpipe_test_operands(unit, operands.data(), 1, nullptr), HITPIPE_BAD_ARGUMENT);
  hitpipe_close(unit);
}

TEST(LibraryRefusal, NamesTheFirstBadBox) {
  Unit unit("fp_slabs");
  unit.set_ray(ray);
  const auto refused = [&](const Box& bad) {
    const Box boxes[] = {box, bad, bad};
    return refusal([&] { static_cast<void>(unit.test(boxes)); });
  };
  EXPECT_EQ(refused({{-1.5F, 0, 0}, {0, 0, 0}}),
            "5: box 1: min.x = -1.5 is outside the cube; allowed is [-1, 1]");
  EXPECT_EQ(refused({{0, 0, 0}, {0, NAN, 0}}),
            "5: box 1: max.y = nan is outside the cube; allowed is [-1, 1]");
  EXPECT_EQ(refused({{0, 0, 0.5F}, {0, 0, 0.25F}}), "5: box 1: min.z = 0.5 is above max.z = 0.25");
  EXPECT_EQ(refusal([&] {
              static_cast<void>(exact(ray, {{0, 0, 0}, {2, 0, 0}}));
            }),
            "5: box 0: max.x = 2 is outside the cube; allowed is [-1, 1]");
}

TEST(LibraryRefusal, WritesNothing) {
  Unit unit("int_slabs");
  unit.set_ray(ray);
  hitpipe_unit* handle = nullptr;
  ASSERT_EQ(hitpipe_open("int_slabs", nullptr, &handle), HITPIPE_OK);
  ASSERT_EQ(hitpipe_set_ray(handle, &ray), HITPIPE_OK);
  const Box boxes[] = {box, {{0, 0, 0}, {2, 0, 0}}};
  std::uint8_t hit[2] = {7, 7};
  std::uint8_t met[2] = {7, 7};
  std::vector<std::int64_t> operands(2 * hitpipe_port_count(handle), 7);
  const hitpipe_answers out{hit, met, operands.data(), nullptr};
  EXPECT_EQ(hitpipe_test(handle, boxes, 2, &out), HITPIPE_BAD_BOX);
  EXPECT_EQ(hit[0] + hit[1] + met[0] + met[1], 28);
  EXPECT_EQ(operands, std::vector<std::int64_t>(operands.size(), 7));
  hitpipe_unit* const before = handle;
  EXPECT_EQ(hitpipe_open("int_slabs", "1/1", &handle), HITPIPE_BAD_FORMAT);
  EXPECT_EQ(handle, before);
  hitpipe_close(handle);
}

TEST(LibraryRefusal, TwoBoxesATestNeedAnEvenNumber) {
  Unit unit("int_major_pair");
  unit.set_ray(ray);
  EXPECT_EQ(refusal([&] { static_cast<void>(unit.test(box)); }),
            "1: design int_major_pair: 1 boxes; a test takes 2, so allowed are multiples of 2");
}

/// Every function, with every pointer that it takes.
TEST(LibraryRefusal, NullPointersAreNamed) {
  hitpipe_unit* unit = nullptr;
  ASSERT_EQ(hitpipe_open("int_slabs", nullptr, &unit), HITPIPE_OK);
  ASSERT_EQ(hitpipe_set_ray(unit, &ray), HITPIPE_OK);
  std::uint8_t met = 7;
  const hitpipe_answers answers{&met, nullptr, nullptr, nullptr};
  const hitpipe_bounds bounds{{0, 0, 0}, {1, 1, 1}};
  const double vector[3] = {1, 0, 0};
  hitpipe_port_info port{};
  hitpipe_result_info result{};
  hitpipe_transform transform{};
  hitpipe_unit* other = nullptr;
  Box cube{};
  Ray moved{};
  const auto refused = [](const char* name, hitpipe_status status) {
    EXPECT_EQ(status, HITPIPE_BAD_ARGUMENT) << name;
    EXPECT_EQ(hitpipe_error(), std::string(name) + ": a null pointer is not allowed");
  };
  refused("design", hitpipe_open(nullptr, nullptr, &other));
  refused("out", hitpipe_open("int_slabs", nullptr, nullptr));
  refused("out", hitpipe_design(0, nullptr));
  refused("unit", hitpipe_port(nullptr, 0, &port));
  refused("out", hitpipe_port(unit, 0, nullptr));
  refused("unit", hitpipe_result(nullptr, 0, &result));
  refused("out", hitpipe_result(unit, 0, nullptr));
  refused("ray", hitpipe_exact(nullptr, &box, 1, &met));
  refused("boxes", hitpipe_exact(&ray, nullptr, 1, &met));
  refused("met", hitpipe_exact(&ray, &box, 1, nullptr));
  refused("unit", hitpipe_test(nullptr, &box, 1, &answers));
  refused("boxes", hitpipe_test(unit, nullptr, 1, &answers));
  refused("out", hitpipe_test(unit, &box, 1, nullptr));
  refused("unit", hitpipe_set_ray(nullptr, &ray));
  refused("ray", hitpipe_set_ray(unit, nullptr));
  refused("bounds", hitpipe_fit(nullptr, &transform));
  refused("out", hitpipe_fit(&bounds, nullptr));
  refused("box", hitpipe_to_cube_box(nullptr, nullptr, &cube));
  refused("out", hitpipe_to_cube_box(nullptr, &bounds, nullptr));
  refused("origin", hitpipe_to_cube_ray(nullptr, nullptr, vector, 1, &moved));
  refused("direction", hitpipe_to_cube_ray(nullptr, vector, nullptr, 1, &moved));
  refused("out", hitpipe_to_cube_ray(nullptr, vector, vector, 1, nullptr));
  EXPECT_EQ(other, nullptr);
  EXPECT_EQ(met, 7);
  hitpipe_close(unit);
  hitpipe_close(nullptr);
}

/// What has no status answers with nothing, and says why.
TEST(LibraryRefusal, OfNoUnitNothingIsTold) {
  const auto refused = [] {
    const std::string line = hitpipe_error();
    static_cast<void>(hitpipe_open(nullptr, nullptr, nullptr));  // another line
    return line;
  };
  const std::string line = "unit: a null pointer is not allowed";
  static_cast<void>(refused());
  EXPECT_STREQ(hitpipe_unit_design(nullptr), "");
  EXPECT_EQ(refused(), line);
  EXPECT_STREQ(hitpipe_unit_format(nullptr), "");
  EXPECT_EQ(refused(), line);
  EXPECT_EQ(hitpipe_unit_conservative(nullptr), 0);
  EXPECT_EQ(refused(), line);
  EXPECT_EQ(hitpipe_unit_boxes_per_test(nullptr), 0U);
  EXPECT_EQ(refused(), line);
  EXPECT_EQ(hitpipe_port_count(nullptr), 0U);
  EXPECT_EQ(refused(), line);
  EXPECT_EQ(hitpipe_result_count(nullptr), 0U);
  EXPECT_EQ(refused(), line);
}

}  // namespace
}  // namespace hitpipe
