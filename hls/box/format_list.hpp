// The formats of a pipeline with a compiled host function of their own, for speed. All others run with widths
// as values.
#pragma once

namespace hitpipe::hls {

template <class... Formats>
struct FormatList {};

}  // namespace hitpipe::hls
