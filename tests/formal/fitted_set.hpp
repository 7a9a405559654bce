// The demands of a proof: a demand set, given by its number from 0, or the demands of a fitted unit, given
// by its manifest.
#pragma once

#include <stdexcept>
#include <string>

#include "rtl_gen/emit/manifest.hpp"
#include "tests/rtl_gen/prune/demand_sets.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::formal {

inline rtl::DemandSet fitted_set(const rtl::Design& design, Format format, const std::string& set) {
  if (!set.ends_with(".json")) return rtl::demand_sets(design, format).at(std::stoul(set));
  rtl::DemandSet fitted{"as its manifest demands", rtl::demands_of_manifest(rtl::read_text(set))};
  if (fitted.demands.empty()) throw std::runtime_error(set + ": no demands");
  return fitted;
}

}  // namespace hitpipe::formal
