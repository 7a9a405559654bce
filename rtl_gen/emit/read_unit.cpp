#include "rtl_gen/emit/read_unit.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/files.hpp"
#include "host/text.hpp"
#include "rtl_gen/emit/manifest.hpp"
#include "rtl_gen/prune/prune.hpp"

namespace hitpipe::rtl {

namespace fs = std::filesystem;

namespace {

std::string text_of(const fs::path& file, std::string_view design) {
  return host::read_file(
      file,
      fmt::format("cannot be read; give a folder that `hitpipe fit` or `hitpipe rtl` wrote for {}", design));
}

struct Manifest {
  fs::path file;
  std::string text;
};

/// The design that a manifest is of; nothing when the text is no manifest.
std::string design_of_manifest(const std::string& text) {
  try {
    return head_of(text).design;
  } catch (const std::runtime_error&) {
    return "";
  }
}

/// The manifest at that place. In a folder it is known by what it says, because users name their units.
Manifest manifest_at(const fs::path& place, std::string_view design) {
  std::error_code error;
  if (!fs::is_directory(place, error)) return {place, text_of(place, design)};
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(place, error))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Manifest> all;
  for (const fs::path& file : files) all.push_back({file, text_of(file, design)});
  // The only one is taken as it is, so that the caller says what is wrong with it.
  if (all.size() == 1) return all.front();
  std::erase_if(all, [&](const Manifest& each) { return design_of_manifest(each.text) != design; });
  if (all.size() == 1) return all.front();
  if (all.empty())
    throw std::runtime_error(
        fmt::format("{}: no manifest of {}; give a folder that `hitpipe fit` or `hitpipe rtl` wrote for it",
                    place.string(), design));
  std::vector<std::string> names;
  for (const Manifest& each : all) names.push_back(each.file.string());
  throw std::runtime_error(fmt::format("{}: {} units of {}; give the manifest of one: {}", place.string(),
                                       all.size(), design, fmt::join(names, ", ")));
}

}  // namespace

Unit read_unit(const fs::path& place, const Design& design, const Library& library) {
  const auto [file, manifest] = manifest_at(place, design.name);
  const auto where = [&file = file](const std::exception& error) {
    return std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
  };
  try {
    const ManifestHead head = head_of(manifest);
    if (head.design != design.name)
      throw std::runtime_error(fmt::format("the manifest of {}; allowed is a manifest of {}",
                                           host::shortened(head.design), design.name));
    const Format format = design.parse_format(head.bits);
    const Graph traced = design.trace(format);
    Demands demands = demands_of_manifest(manifest);
    const PruneOptions options{.set_up = set_up_demands(design.ports(format)), .shares = false};
    Pipeline pipeline =
        make_pipeline(prune(traced, demands, options).graph, library, std::nullopt, head.interval);
    if (head.latency != pipeline.latency())
      throw std::runtime_error(fmt::format(
          "a latency of {} cycles, but with the library {} it is {}; give the library that it was written "
          "with, or write the unit again",
          head.latency, library.name(), pipeline.latency()));
    Unit unit = make_unit(design, format, library, std::move(pipeline), std::move(demands), {},
                          {.module = head.module, .flow_control = head.flow_control});
    unit.verilog = text_of(file.parent_path() / (head.module + ".v"), design.name);
    return unit;
  } catch (const std::invalid_argument& error) {
    throw where(error);
  } catch (const std::runtime_error& error) {
    throw where(error);
  }
}

}  // namespace hitpipe::rtl
