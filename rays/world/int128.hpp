// The wide integers of the integer world. With n <= 24, g <= 3 and S <= 32 no number there has more than 120
// bits.
#pragma once

namespace hitpipe::ref {

__extension__ typedef __int128 Int128;
__extension__ typedef unsigned __int128 Uint128;

}  // namespace hitpipe::ref
