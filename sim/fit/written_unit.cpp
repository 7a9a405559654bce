#include "sim/fit/written_unit.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <fmt/format.h>

#include "rtl_gen/emit/manifest.hpp"
#include "rtl_gen/prune/demand_fields.hpp"
#include "rtl_gen/prune/promises.hpp"
#include "rtl_gen/prune/prune.hpp"

namespace hitpipe::sim {

namespace fs = std::filesystem;

namespace {

const rtl::PortDemand* demand_on(const rtl::Demands& demands, const std::string& port) {
  const auto found = std::find_if(demands.ports.begin(), demands.ports.end(),
                                  [&](const rtl::PortDemand& each) { return each.port == port; });
  return found == demands.ports.end() ? nullptr : &*found;
}

std::string text_of(const fs::path& folder, const std::string& name, std::string_view design) {
  std::ifstream in(folder / name, std::ios::binary);
  if (!in)
    throw std::runtime_error(
        fmt::format("{}: cannot be read; give a folder that `hitpipe fit` or `hitpipe rtl` wrote for {}",
                    (folder / name).string(), design));
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

ref::CoarseAxes WrittenUnit::coarse() const {
  ref::CoarseAxes axes;
  for (int axis = 0; axis < 3; ++axis) {
    const auto origin = rtl::index_of(ports, hls::Role::origin, static_cast<hls::Axis>(axis + 1));
    if (!origin) continue;
    if (const rtl::PortDemand* const demand = demand_on(demands, ports[*origin].name))
      axes.dropped[static_cast<std::size_t>(axis)] = demand->low_zeros;
  }
  return axes;
}

bool WrittenUnit::ends() const {
  const auto endless = rtl::index_of(ports, hls::Role::endless);
  if (!endless) return true;
  const rtl::PortDemand* const demand = demand_on(demands, ports[*endless].name);
  return demand == nullptr || hull(*demand) != rtl::Interval{1, 1};
}

WrittenUnit read_unit(const fs::path& folder, const rtl::Design& design, const rtl::Library& library) {
  const std::string name(design.name);
  const std::string manifest = text_of(folder, name + ".json", design.name);
  const auto where = [&](const std::exception& error) {
    return std::runtime_error(fmt::format("{}: {}", (folder / (name + ".json")).string(), error.what()));
  };
  try {
    const rtl::ManifestHead head = rtl::head_of(manifest);
    if (head.design != design.name)
      throw std::runtime_error(fmt::format("the manifest of {}; allowed is that of {}", head.design, name));
    const rtl::Format format = design.parse_format(head.bits);
    const rtl::Graph traced = design.trace(format);
    rtl::Demands demands = rtl::demands_of_manifest(manifest);
    const rtl::PruneOptions options{.promised = rtl::promises(design, format), .shares = false};
    rtl::Pipeline pipeline = rtl::make_pipeline(rtl::prune(traced, demands, options).graph, library);
    if (head.latency != pipeline.latency())
      throw std::runtime_error(
          fmt::format("a latency of {} cycles, {} is that of the library {}; write the unit again",
                      head.latency, pipeline.latency(), library.name()));
    return {format, std::move(demands), design.ports(format), std::move(pipeline),
            text_of(folder, name + ".v", design.name)};
  } catch (const std::invalid_argument& error) {
    throw where(error);
  } catch (const std::runtime_error& error) {
    throw where(error);
  }
}

}  // namespace hitpipe::sim
