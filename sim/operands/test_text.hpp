// Tests of a unit as text: the operands of each, all its results and the exact answer. As CSV, as JSON lines,
// or as vectors that the emitted testbench reads.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/prune/draw.hpp"
#include "sim/operands/rays_and_boxes.hpp"

namespace hitpipe::sim {

enum class TestForm {
  csv,   ///< a comment line, a header, one line for each test
  json,  ///< one object in each line; the first says what the others are
  hex,   ///< rtl::vector_file() below lines of comment
};

/// A ray and its boxes, what the unit gets and gives, and what is right.
struct JudgedTest {
  std::uint64_t ray_number = 0;  ///< from 1
  std::uint64_t box_number = 0;  ///< of the line that holds one box or two, from 1
  ref::Ray ray;
  Boxes boxes;
  std::span<const std::int64_t> operands;
  std::span<const std::int64_t> results;
  std::array<bool, 2> exact{};  ///< the ray meets the box
  /// The unit tested only the parent of two boxes, which the ray misses. Its results of a second box mean
  /// nothing and are left empty.
  bool of_parent = false;
};

/// What stands in each column. It is shared by all that write one file.
class TestLayout {
 public:
  /// `with_input`: ray and boxes too, as they were tested.
  TestLayout(const rtl::Design& design, const Format& format, const Placement& placement, TestForm form,
             bool with_input);

  /// For operands that the user gives. There is no ray and no box, so no exact answer either.
  TestLayout(const rtl::Design& design, const Format& format, TestForm form);

  /// What stands before the first test: of CSV the header alone.
  [[nodiscard]] std::string head() const;
  /// One line for each test. Hex has all tests of one call.
  void append(const JudgedTest& test, std::string& text) const;
  [[nodiscard]] std::string vectors(const std::vector<rtl::Vector>& tests) const;
  /// The results have these hits. If not, they belong to the parent's test, which has no second box.
  [[nodiscard]] bool reports(std::span<const std::int64_t> results, const std::array<bool, 2>& hits) const;
  [[nodiscard]] TestForm form() const { return form_; }
  [[nodiscard]] std::size_t boxes_per_test() const { return boxes_; }

 private:
  struct Column {
    std::string name;
    int pattern_digits = 0;  ///< of a float's pattern in hexadecimal; 0: a decimal number
  };
  void add_columns();
  void append_values(const JudgedTest& test, std::string& text) const;

  std::string design_;
  std::string bits_;
  std::optional<Placement> placement_;  ///< nothing: operands of one's own
  TestForm form_;
  bool with_input_ = false;
  std::size_t boxes_;
  std::vector<rtl::Port> ports_;
  std::vector<hls::Result> results_;
  std::vector<Column> columns_;
};

}  // namespace hitpipe::sim
