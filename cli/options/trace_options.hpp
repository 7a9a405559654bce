// The options by which a command that traces in software chooses how, and how far rays are followed.
#pragma once

#include <optional>
#include <string>

#include "sw_ref/render/whitted.hpp"
#include "sw_ref/traverse/tracer.hpp"

namespace CLI {
class App;
}

namespace hitpipe::cli {

/// --bounces.
void add_bounces_option(CLI::App& command, ref::WhittedOptions& options);

struct TraceChoice {
  ref::TracerOptions tracer;
  std::optional<std::string> bits;  ///< as the user wrote it

  /// Throws std::runtime_error, one line, for bits that are no format or that nothing uses. Combinations are
  /// ref::make_tracer()'s to refuse.
  [[nodiscard]] ref::TracerOptions options() const;
};

/// --traversal, --arithmetic, --bits, --encoding, --lut, --bundle, --triangle-test.
void add_trace_options(CLI::App& command, TraceChoice& choice);

/// "--traversal slabs-dsa --arithmetic integer --bits 20/24": the options that choose this algorithm,
/// arithmetic and format.
[[nodiscard]] std::string trace_options_text(const ref::TracerOptions& options);

}  // namespace hitpipe::cli
