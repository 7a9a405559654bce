// The result of repeating an experiment of the thesis: our figures and the printed ones, and whether the
// thesis's findings hold in this run.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace hitpipe::ref {

/// A column of figures.
struct ResultColumn {
  std::string name;
  int decimals = 0;  ///< in text; csv and json keep all digits
};

struct ResultRow {
  std::vector<std::string> labels;             ///< one for each of ResultTable::labels
  std::vector<std::optional<double>> ours;     ///< one a column; nothing: not measured
  std::vector<std::optional<double>> printed;  ///< one a column; nothing: not printed
};

/// A statement of the thesis, compared with this run.
struct Finding {
  std::string claim;
  bool agrees;
  std::string figures;  ///< the figures that decide
};

struct ResultTable {
  std::string number;               ///< "5.1"
  std::string title;                ///< one line, with units
  std::vector<std::string> labels;  ///< names of the label columns; rows are grouped by the first
  std::vector<ResultColumn> columns;
  std::vector<ResultRow> rows;
  std::vector<Finding> findings;
  std::vector<std::string> notes;  ///< stand-ins, sizes, seeds: what a reader must know to judge the figures
};

}  // namespace hitpipe::ref
