// Diagrams of the core in a report, by gnuplot: rays a second against area, how busy the port is, and what a
// cache saves.
#pragma once

#include <string>
#include <vector>

#include "cli/report/report_facts.hpp"

namespace hitpipe::cli {

/// None when the core has not traced. Throws as draw_picture().
[[nodiscard]] std::vector<Diagrammed> draw_core(const std::string& scene, const CoreFacts& facts,
                                                const PictureForm& form);

}  // namespace hitpipe::cli
