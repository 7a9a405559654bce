#include "rtl_gen/emit/synthesis_targets.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hitpipe::rtl {

std::string synthesis_targets(const Library& library, std::string_view filesets, std::string_view top) {
  std::string text;
  for (const SynthesisTarget& target : library.synthesis_targets())
    text += fmt::format(R"(  {}:
    description: {}
    flow: {}
    flow_options: {}
    filesets: {}
    toplevel: {}
)",
                        target.name, nlohmann::json(target.description).dump(),
                        nlohmann::json(target.flow).dump(), target.options, filesets, top);
  return text;
}

}  // namespace hitpipe::rtl
