// How long a thread has computed.
#pragma once

namespace hitpipe::host {

/// Processor time of the calling thread since its start, in seconds. It stands still while the thread waits.
[[nodiscard]] double thread_seconds();

}  // namespace hitpipe::host
