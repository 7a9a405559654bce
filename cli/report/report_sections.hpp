// The page of a report: question and findings, diagrams, images, tables, schematics, commands, versions.
#pragma once

#include <string>
#include <vector>

#include "cli/report/report_facts.hpp"
#include "cli/text/table.hpp"

namespace hitpipe::cli {

[[nodiscard]] std::string report_html(const ReportFacts& facts);

/// The tables that do not come from the sweep's rows, for files beside the page.
[[nodiscard]] std::vector<Row> pipeline_rows(const ReportFacts& facts);
[[nodiscard]] std::vector<Row> stability_rows(const ReportFacts& facts);

}  // namespace hitpipe::cli
