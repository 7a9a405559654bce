// What a box costs a unit in energy on a scene (area_model/energy.hpp).
#pragma once

#include <optional>

#include "area_model/energy.hpp"
#include "rtl_gen/pipeline.hpp"
#include "sim/board/board_tests.hpp"

namespace hitpipe::sim {

/// Tests of rays of the scene, as they follow one another in a unit that has rays of many pixels in flight.
/// Nothing if the cells have no component that the unit needs, or if no ray can be tested. Throws as
/// scene_tests() does.
[[nodiscard]] std::optional<area::Toggles> scene_toggles(const rtl::Design& design, const Format& format,
                                                         const rtl::Pipeline& pipeline,
                                                         const ref::Scene& scene, const ref::Bvh& bvh,
                                                         const SceneTestOptions& options);

}  // namespace hitpipe::sim
