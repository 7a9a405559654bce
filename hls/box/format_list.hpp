// The formats of a pipeline with a compiled host function of their own, for speed. All others run with widths
// as values.
#pragma once

namespace hitpipe {
namespace hls {

template <class... Formats>
struct FormatList {};

}  // namespace hls
}  // namespace hitpipe
