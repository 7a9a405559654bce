// The processor time of a thread.
#pragma once

namespace hitpipe::host {

/// Processor time of the calling thread since its start, in seconds. It does not advance while the thread
/// waits.
[[nodiscard]] double thread_seconds();

}  // namespace hitpipe::host
