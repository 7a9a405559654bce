// A made-up component library with numbers that can be added in the head, for tests that should not depend on
// the thesis's. Latch and gate take 1 ps, mux 2, comparator 5, subtractor 10, multiplier 10 for each stage.
// The clock is 11 ps. Areas in um2: 1 for each bit of a latch, mux and subtractor, half of that for a
// comparator, n^2 for a multiplier. It has no floats.
#pragma once

#include <string_view>

#include "rtl_gen/component/library.hpp"

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

}  // namespace hitpipe::rtl
