#include "cli/version.hpp"

#include "sources_hash.hpp"

namespace hitpipe::cli {

std::string_view program_version() {
  return "hitpipe " HITPIPE_VERSION;
}

std::string_view program_and_sources() {
  return "hitpipe " HITPIPE_VERSION " (" HITPIPE_SOURCES_HASH ")";
}

}  // namespace hitpipe::cli
