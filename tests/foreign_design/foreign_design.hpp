// A design that is not in designs.cmake. Its files lie in this folder as they would in the tree. All test
// programs that have designs have it too, so that no test relies on hitpipe's own.
#pragma once

namespace hitpipe {

/// Null in a program without designs, or without software of designs.
[[gnu::weak]] void add_foreign_design();
[[gnu::weak]] void add_foreign_software();

}  // namespace hitpipe
