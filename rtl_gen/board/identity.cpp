#include "rtl_gen/board/identity.hpp"

#include <span>

#include <fmt/format.h>

#include "host/text.hpp"
#include "rtl_gen/emit/testbench.hpp"

namespace hitpipe::rtl {

namespace {

constexpr int fingerprint_vectors = 1000;
constexpr std::uint64_t fingerprint_seed = 1;

}  // namespace

std::uint64_t fingerprint(const Design& design, const Format& format) {
  const std::vector<Port> ports = design.ports(format);
  std::string text;
  for (const auto& each : {ports, result_ports(design.results(format))}) {
    for (const Port& port : each)
      text += fmt::format("{} {} {}\n", port.name, port.width, port.is_signed ? "signed" : "unsigned");
  }
  for (const Vector& vector :
       judged(operand_vectors(ports, fingerprint_vectors, fingerprint_seed), design.evaluate(format))) {
    for (const std::int64_t result : vector.results) text += fmt::format("{} ", result);
  }
  return host::fnv1a(std::as_bytes(std::span(text)));
}

std::string board_identity(const Design& design, const Format& format) {
  return fmt::format("hitpipe {} {} {} {:016x}", board_protocol, design.name, to_string(format),
                     fingerprint(design, format));
}

}  // namespace hitpipe::rtl
