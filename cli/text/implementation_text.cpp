#include "cli/text/implementation_text.hpp"

#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/files.hpp"

namespace hitpipe::cli {

namespace {

Row count_row(const sim::Implementation& module, std::string_view resource) {
  const sim::ResourceCount* const count = module.count_of(resource);
  return count == nullptr ? Row(nullptr) : Row(count->used);
}

/// The resource of which the module takes the largest part of the chip.
std::pair<Row, Row> largest_share(const sim::Implementation& module) {
  std::pair<Row, Row> largest{nullptr, nullptr};
  double most = -1;
  for (const sim::ResourceCount& count : module.counts) {
    if (!count.available || *count.available == 0) continue;
    const double share = 100.0 * count.used / *count.available;
    if (share <= most) continue;
    most = share;
    largest = {rounded(share), count.name};
  }
  return largest;
}

}  // namespace

Row rounded(std::optional<double> value) {
  if (!value) return nullptr;
  return std::round(*value * 100) / 100;
}

Row taken_row(const sim::Implementation& module) {
  const auto [share, share_of] = largest_share(module);
  const bool placed = module.placed && !module.placed->seeds.empty();
  Row row;
  row["cells"] = module.synthesis.cell_count();
  for (const std::string_view resource : sim::resource_names)
    row[std::string(resource)] = count_row(module, resource);
  row.update({{"chip_share_pct", share},
              {"chip_share_of", share_of},
              {"cell_area_um2", rounded(module.synthesis.area_um2)},
              {"seeds", placed ? Row(module.placed->seeds.size()) : Row(nullptr)},
              {"fmax_mhz", rounded(module.fmax_mhz())},
              {"fmax_best_mhz", placed ? rounded(module.placed->best().fmax_mhz) : Row(nullptr)},
              {"critical_path_ns", rounded(module.critical_path_ns)},
              {"critical_from", placed ? Row(module.placed->median().critical.from) : Row(nullptr)},
              {"critical_to", placed ? Row(module.placed->median().critical.to) : Row(nullptr)}});
  return row;
}

Row tools_row(const sim::Implementation& module) {
  return {{"not_placed", module.not_placed.empty() ? Row(nullptr) : Row(module.not_placed)},
          {"tools", fmt::format("{}", fmt::join(module.tools, "; "))}};
}

Row without_nothing(const Row& row) {
  Row left;
  for (const auto& [key, value] : row.items())
    if (!value.is_null()) left[key] = value;
  return left;
}

std::string fault_of(const sim::Target& target, const sim::Implementation& module) {
  if (module.simulated && !module.simulated->agrees)
    return fmt::format("its netlist is wrong: {}", module.simulated->said);
  if (const std::string excess = module.excess(); !excess.empty())
    return fmt::format("does not fit {}: {}", target.chip, excess);
  if (module.placed && !module.placed->why_not.empty())
    return fmt::format("fits {}, but not with the shift registers around it: {}", target.chip,
                       module.placed->why_not);
  return "";
}

void keep_and_print(Row row, const std::filesystem::path& file, OutputFormat format) {
  host::write_file(file, record_text(row, OutputFormat::json));
  row["files"] = file.parent_path().string();
  if (format == OutputFormat::text) row.erase("tried");
  fmt::print("{}", record_text(format == OutputFormat::text ? without_nothing(row) : row, format));
}

}  // namespace hitpipe::cli
