// What `implement` prints of any module in a target.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/text/table.hpp"
#include "sim/implement/module_implementation.hpp"
#include "sim/implement/target.hpp"

namespace hitpipe::cli {

/// To as many digits as a tool's result is worth.
[[nodiscard]] Row rounded(std::optional<double> value);

/// Cells of each kind, the part of the chip, area, and clock.
[[nodiscard]] Row taken_row(const sim::Implementation& module);
/// The last keys: why there is no placement, and the tools.
[[nodiscard]] Row tools_row(const sim::Implementation& module);

/// For a reader: only what there is.
[[nodiscard]] Row without_nothing(const Row& row);

/// What is wrong with the module in this target; empty when nothing is.
[[nodiscard]] std::string fault_of(const sim::Target& target, const sim::Implementation& module);

/// Writes the row to a file as JSON, and prints it with the file's folder. Text has only what there is, and
/// no schedules that were tried: they have a table of their own.
void keep_and_print(Row row, const std::filesystem::path& file, OutputFormat format);

}  // namespace hitpipe::cli
