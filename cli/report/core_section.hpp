// The section of a report's page on the core.
#pragma once

#include "cli/report/report_facts.hpp"
#include "cli/report/report_page.hpp"

namespace hitpipe::cli {

void add_core_section(Page& page, const ReportFacts& facts);

}  // namespace hitpipe::cli
