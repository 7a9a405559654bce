// A made-up component library with numbers that can be added in the head, for tests that should not depend on
// the thesis's. Latch and gate take 1 ps, mux 2, comparator 5, subtractor 10, multiplier 10 for each stage.
// The clock is 11 ps. Areas in um2: 1 for each bit of a latch, mux and subtractor, half of that for a
// comparator, n^2 for a multiplier. It has no floats.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "rtl_gen/component/library.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/text.hpp"

namespace hitpipe::rtl {

inline constexpr std::string_view unit_json = R"json({
  "name": "unit",
  "gate_delay_ps": 1,
  "components": {
    "latch": {"above": "same", "area": "linear", "cells": [
      {"bits": 1, "area_um2": 1, "delay_ps": 1, "stages": 0}]},
    "mux2": {"above": "same", "area": "linear", "cells": [
      {"bits": 1, "area_um2": 1, "delay_ps": 2, "stages": 0}]},
    "int_subtract": {"above": "same", "area": "linear", "cells": [
      {"bits": 8, "area_um2": 8, "delay_ps": 10, "stages": 0}]},
    "int_multiply": {"above": "same", "area": "quadratic", "cells": [
      {"bits": 4, "area_um2": 16, "delay_ps": 10, "stages": 0},
      {"bits": 8, "area_um2": 64, "delay_ps": 10, "stages": 2},
      {"bits": 12, "area_um2": 144, "delay_ps": 10, "stages": 3}]},
    "int_compare": {"above": "same", "area": "linear", "cells": [
      {"bits": 8, "area_um2": 4, "delay_ps": 5, "stages": 0}]}
  }
})json";

inline Library unit_library() {
  return Library::from_json(unit_json, "unit.json");
}

/// A replacement in the text of a library, and the complaint about it; empty: none.
struct Refusal {
  std::string_view from;
  std::string to, complaint;
};
inline void expect_refusals(std::string_view json, const std::vector<Refusal>& refusals) {
  for (const auto& [from, to, complaint] : refusals) {
    const std::string text = replaced(std::string(json), from, to);
    EXPECT_EQ(message_of([&] { return Library::from_json(text, "toy.json"); }),
              complaint.empty() ? "no exception" : "toy.json: " + complaint)
        << from;
  }
}

}  // namespace hitpipe::rtl
