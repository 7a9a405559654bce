// How the machines of a core are joined (docs/core.md). The software of the core and its top module are made
// from this list.
#pragma once

#include <array>

namespace hitpipe::rtl {

/// From an output of a machine to an input of another one. Both have one width.
struct Wire {
  const char *from, *output;
  const char *to, *input;
};

inline constexpr std::array core_wires{
    // A new ray begins.
    Wire{"walker", "takes", "best_hits", "walker_takes"},
    Wire{"best_hits", "begins", "walker", "begins"},
    Wire{"best_hits", "begin_ray", "walker", "begun"},
    Wire{"best_hits", "begin_cut", "walker", "length"},
    // A ray goes to a record or a leaf.
    Wire{"walker", "goes", "reader", "go"},
    Wire{"walker", "of", "reader", "goer"},
    Wire{"walker", "wanted", "reader", "block"},
    Wire{"walker", "triangles", "reader", "triangles"},
    // A hit is compared with the best one.
    Wire{"divider", "asked", "best_hits", "asked"},
    Wire{"divider", "done", "best_hits", "done"},
    Wire{"divider", "t", "best_hits", "t"},
    Wire{"divider", "closer", "best_hits", "closer"},
    Wire{"best_hits", "asked_number", "divider", "number"},
    Wire{"best_hits", "best", "divider", "best"},
    Wire{"best_hits", "best_number", "divider", "best_number"},
    Wire{"best_hits", "divided", "reader", "divides"},
    Wire{"best_hits", "divided_ray", "reader", "divided_ray"},
    Wire{"best_hits", "divided_stops", "reader", "stops"},
    // A leaf is done.
    Wire{"reader", "done", "best_hits", "leaf"},
    Wire{"reader", "of", "best_hits", "leaf_ray"},
    Wire{"reader", "stopped", "best_hits", "stops"},
    Wire{"reader", "lost", "best_hits", "lost"},
    Wire{"best_hits", "leaf_done", "walker", "leaf"},
    Wire{"best_hits", "leaf_done_ray", "walker", "leaf_ray"},
    Wire{"best_hits", "leaf_done_cut", "walker", "cut"},
    Wire{"best_hits", "leaf_done_stops", "walker", "stops"},
    Wire{"best_hits", "leaf_done_lost", "walker", "lost"},
    // A walk ends.
    Wire{"walker", "ended", "best_hits", "ended"},
    Wire{"walker", "of", "best_hits", "ender"},
    Wire{"walker", "failed", "best_hits", "failed"},
};

}  // namespace hitpipe::rtl
