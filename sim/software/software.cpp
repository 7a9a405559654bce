#include "sim/software/software.hpp"

#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace hitpipe::sim {

namespace {

SoftwareByName& all() {
  static SoftwareByName known = own_software();
  return known;
}

}  // namespace

const Software& software_of(const rtl::Design& design) {
  static const Software nothing;
  const auto found = all().find(design.name);
  return found == all().end() ? nothing : found->second;
}

void add_software(std::string_view design, Software software) {
  if (!all().emplace(design, std::move(software)).second)
    throw std::invalid_argument(fmt::format("design {}: its software is known already", design));
}

void add_design(const rtl::Design& design, Software software) {
  if (!all().contains(design.name)) rtl::add_design(design);
  add_software(design.name, std::move(software));
}

std::vector<Format> stiffness_formats(const rtl::Design& design) {
  const std::vector<Format>& own = software_of(design).stiffness_formats;
  return own.empty() ? std::vector{design.default_format} : own;
}

std::string missing(const rtl::Design& design, std::string_view part) {
  return fmt::format("design {}: there is no {}", design.name, part);
}

std::string why_not_traced(const rtl::Design& design) {
  if (software_of(design).feed == nullptr) return missing(design, set_up_part);
  if (design.kind.objects > 2)
    return fmt::format("design {}: answers for {} boxes at a time; traversals ask about one or two",
                       design.name, design.kind.objects);
  return "";
}

}  // namespace hitpipe::sim
