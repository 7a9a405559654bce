// What the software of all designs with a major axis shares: the operands of a ray, and formats.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hls/box/int_major_operands.hpp"
#include "hls/box/major_format.hpp"
#include "sim/feeds/set_up_feed.hpp"
#include "sim/software.hpp"
#include "sw_ref/quantise/int_box.hpp"
#include "sw_ref/quantise/int_major_ray.hpp"
#include "sw_ref/scene/aabb.hpp"

namespace hitpipe::sim {

void put_major_ray(const ref::IntMajorRay& ray, hls::MajorRay<Words, hls::MajorBits>& in);

/// Boxes as a unit of this format reads them.
void major_boxes(std::span<const ref::Aabb> boxes, const rtl::Format& format, std::span<ref::IntBox> out);

/// The software of a design without its own set-up: feed, box_test and tracer are missing.
[[nodiscard]] Software major_design_software();

}  // namespace hitpipe::sim
