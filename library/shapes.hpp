// Rays and boxes of the C interface, checked.
#pragma once

#include <span>
#include <vector>

#include "hitpipe/ref.h"
#include "rays/mesh/aabb.hpp"
#include "rays/mesh/ray.hpp"

namespace hitpipe::library {

/// Throws a Refusal that says what is wrong with the ray.
[[nodiscard]] ref::Ray checked(const hitpipe_ray& ray);

/// Throws a Refusal that names the first bad ray by its place and says what is wrong with it.
[[nodiscard]] std::vector<ref::Ray> checked(std::span<const hitpipe_ray> rays);

/// Throws a Refusal that names the first bad box by its place and says what is wrong with it.
[[nodiscard]] std::vector<ref::Aabb> checked(std::span<const hitpipe_box> boxes);

/// Both throw a Refusal for a number of rays or boxes without them.
[[nodiscard]] std::span<const hitpipe_ray> given(const hitpipe_ray* rays, std::size_t count);
[[nodiscard]] std::span<const hitpipe_box> given(const hitpipe_box* boxes, std::size_t count);

}  // namespace hitpipe::library
