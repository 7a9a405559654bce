// The formats of a pipeline that a program compiles for speed; all others are run with widths as values.
#pragma once

namespace hitpipe::hls {

template <class... Formats>
struct FormatList {};

}  // namespace hitpipe::hls
