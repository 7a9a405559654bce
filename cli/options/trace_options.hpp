// The options by which a command chooses how it traces in software and how far it follows rays.
#pragma once

#include <optional>
#include <string>

#include "sw_ref/render/whitted.hpp"
#include "sw_ref/trace/tracer.hpp"

namespace CLI {
class App;
}

namespace hitpipe::cli {

/// Adds --bounces.
void add_bounces_option(CLI::App& command, ref::WhittedOptions& options);

struct TraceChoice {
  ref::TracerOptions tracer;
  std::optional<std::string> bits;  ///< as the user wrote it

  /// Throws std::runtime_error, one line, when the bits are not a format, or when nothing uses them.
  /// ref::make_tracer() refuses combinations that do not exist.
  [[nodiscard]] ref::TracerOptions options() const;
};

/// Adds --traversal, --arithmetic, --bits, --encoding, --lut, --bundle, --triangle-test.
void add_trace_options(CLI::App& command, TraceChoice& choice);

/// The options that choose this algorithm, arithmetic and format, for example "--traversal slabs-dsa
/// --arithmetic integer --bits 20/24".
[[nodiscard]] std::string trace_options_text(const ref::TracerOptions& options);

}  // namespace hitpipe::cli
