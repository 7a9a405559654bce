#include "host/cannot.hpp"

#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

namespace hitpipe::host {

void cannot(std::string_view what, const std::filesystem::path& path, int error) {
  throw std::runtime_error(
      fmt::format("{}: cannot {}: {}", path.string(), what, std::generic_category().message(error)));
}

}  // namespace hitpipe::host
