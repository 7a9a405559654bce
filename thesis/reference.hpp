// The experiments are written in the names of sw_ref.
#pragma once

namespace hitpipe::ref {}

namespace hitpipe::thesis {
using namespace ref;
}
