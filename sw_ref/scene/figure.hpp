// The closed surfaces of a winged figure, 2 units tall, y up, facing +z.
#pragma once

#include <vector>

#include "sw_ref/scene/even_surface.hpp"

namespace hitpipe::ref {

/// Plinth, robe, head, arms, hands, wings, torch and flame.
[[nodiscard]] std::vector<EvenSurface> winged_figure();

}  // namespace hitpipe::ref
