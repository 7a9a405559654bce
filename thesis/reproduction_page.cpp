#include "thesis/reproduction_page.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hitpipe::thesis {

namespace {

constexpr std::array verdicts{Verdict::agrees, Verdict::same_order, Verdict::differs};

/// How many of something have each verdict.
struct Tally {
  std::array<std::size_t, verdicts.size()> of{};

  void add(Verdict verdict) { ++of.at(static_cast<std::size_t>(verdict)); }
  [[nodiscard]] std::size_t all() const { return of[0] + of[1] + of[2]; }
  [[nodiscard]] std::string cells() const {
    return fmt::format("{} | {} | {} | {}", all(), of[0], of[1], of[2]);
  }
};

/// The figure of a cell that both have measured; nothing for a cell that is 1 by definition.
std::optional<Comparison> compared_cell(const ResultTable& table, const ResultRow& row, std::size_t column) {
  if (!row.ours[column] || !row.printed[column] || row.unit == column) return std::nullopt;
  Comparison cell{table.columns[column].name, *row.printed[column], *row.ours[column],
                  table.columns[column].half_unit};
  if (!row.intervals.empty()) cell.interval = row.intervals[column];
  return cell;
}

bool is_table(const ResultTable& table) {
  return !table.rows.empty();
}

bool is_measured(const ResultTable& table) {
  return !table.findings.empty() ||
         std::any_of(table.rows.begin(), table.rows.end(), [](const ResultRow& row) {
           return std::any_of(row.ours.begin(), row.ours.end(),
                              [](const auto& figure) { return figure.has_value(); });
         });
}

std::string name_of(const ResultTable& table) {
  return is_table(table) ? "Table " + table.number : "No table";
}

/// A table has the verdict of its worst statement; nothing if none was measured.
std::optional<Verdict> verdict_of(const ResultTable& table) {
  if (table.findings.empty()) return std::nullopt;
  Verdict worst = Verdict::agrees;
  for (const Finding& finding : table.findings) worst = std::max(worst, finding.verdict());
  return worst;
}

std::string finding_line(const ResultTable& table, const Finding& finding) {
  const Comparison& figure = finding.worst();
  const bool known = !finding.why.empty() && finding.verdict() != Verdict::agrees;
  return fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", table.number, finding.claim, figure.what,
                     figure_text(figure.printed), figure_text(figure.ours, figure.interval),
                     verdict_text(figure), known ? finding.why : "");
}

constexpr const char* finding_header =
    "| table | statement | figure that decides | thesis | ours (95 %) | verdict | why |\n"
    "|---|---|---|--:|--:|---|---|\n";

std::string findings_where(const std::vector<ResultTable>& tables, auto wanted) {
  std::string text = finding_header;
  for (const ResultTable& table : tables)
    for (const Finding& finding : table.findings)
      if (wanted(finding)) text += finding_line(table, finding);
  return text;
}

std::string summary(const std::vector<ResultTable>& tables) {
  Tally of_tables;
  Tally of_statements;
  Tally of_figures;
  std::vector<std::string> unmeasured;
  for (const ResultTable& table : tables) {
    const std::optional<Verdict> verdict = verdict_of(table);
    if (is_table(table) && verdict) of_tables.add(*verdict);
    if (!is_measured(table)) unmeasured.push_back(table.number);
    for (const Finding& finding : table.findings) of_statements.add(finding.verdict());
    for (const ResultRow& row : table.rows)
      for (std::size_t i = 0; i < table.columns.size(); ++i)
        if (const auto cell = compared_cell(table, row, i)) of_figures.add(verdict_of(*cell));
  }
  std::string text = fmt::format(
      "| | all | agree | same order | differ |\n|---|--:|--:|--:|--:|\n"
      "| tables, by their worst statement | {} |\n| statements, by their worst figure | {} |\n"
      "| printed figures | {} |\n\n",
      of_tables.cells(), of_statements.cells(), of_figures.cells());
  if (!unmeasured.empty())
    text +=
        fmt::format("Not measured, because no scene stands in: table {}.\n\n", fmt::join(unmeasured, ", "));
  return text;
}

double median(std::vector<double> of) {
  const auto middle = of.begin() + static_cast<std::ptrdiff_t>(of.size() / 2);
  std::nth_element(of.begin(), middle, of.end());
  return *middle;
}

std::string columns_of(const ResultTable& table) {
  std::string text;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    Tally tally;
    std::vector<double> factors;
    for (const ResultRow& row : table.rows) {
      const auto cell = compared_cell(table, row, i);
      if (!cell) continue;
      tally.add(verdict_of(*cell));
      factors.push_back(factor_between(*cell));
    }
    if (factors.empty()) continue;
    const double middle = median(factors);
    text += fmt::format("| {} | {} | {} | {} |\n", table.number, table.columns[i].name, tally.cells(),
                        std::isinf(middle) ? "other sign" : fmt::format("{:.2f}", middle));
  }
  return text;
}

std::string notes_of(const std::vector<ResultTable>& tables) {
  std::string text;
  for (const ResultTable& table : tables)
    text += fmt::format("- **{}**: {}. {}.\n", name_of(table), table.title, fmt::join(table.notes, ". "));
  return text;
}

constexpr const char* rule =
    "A figure *agrees* if it is within a factor of 1.25 of the thesis's, is of the *same order* within a "
    "factor "
    "of 3,\nand else *differs*, as do figures of different signs. The figure is the one that the statement "
    "is "
    "about: where the\nthesis says \"4 % more tests\", 4 and not 104. A printed figure stands for all that "
    "is "
    "rounded to it. A statement has the\nverdict of its worst figure, a table the verdict of its worst "
    "statement. "
    "An interval says how far another sample of the\nimage's tiles would move our figure. "
    "[`verdict.hpp`](../../thesis/verdict.hpp) is the rule, "
    "and\n[reproduction.md](../reproduction.md) "
    "says "
    "how each experiment is made. Times are of one machine.\n\n";

constexpr const char* not_run =
    "## What was not run\n\n"
    "- Section 4.3: avoiding empty children makes rendering up to 30 % faster. The builder always avoids "
    "them.\n"
    "- Section 5.8: seconds of a machine that swaps. Tables 5.8 and 5.9 count page faults of a model "
    "instead.\n"
    "- Section 7.2: synthesis with the thesis's cells, which are not public. Table 7.1 is taken as data.\n\n";

}  // namespace

std::string reproduction_page(const std::vector<ResultTable>& tables, const std::string& command) {
  std::string text = fmt::format(
      "# The thesis, line by line\n\nMade by this command; do not edit.\n\n```sh\n{}\n```\n\n", command);
  text += summary(tables) + rule;
  text += "## What differs\n\n" +
          findings_where(tables, [](const Finding& f) { return f.verdict() == Verdict::differs; });
  text += "\n## What is of the same order\n\n" +
          findings_where(tables, [](const Finding& f) { return f.verdict() == Verdict::same_order; });
  text += "\n## What agrees\n\n" +
          findings_where(tables, [](const Finding& f) { return f.verdict() == Verdict::agrees; });
  text += std::string("\n") + not_run;
  text +=
      "## Every figure, by column\n\nThe CSV file beside this page has each figure. `fp32` and the numbers "
      "of "
      "nodes and bytes belong to\nother people's scenes; the changes beside them are what the thesis is "
      "about.\n\n"
      "| table | column | all | agree | same order | differ | median factor |\n"
      "|---|---|--:|--:|--:|--:|--:|\n";
  for (const ResultTable& table : tables) text += columns_of(table);
  text += "\n## Scenes and sizes\n\n" + notes_of(tables);
  return text;
}

std::vector<Row> reproduction_rows(const std::vector<ResultTable>& tables) {
  std::vector<Row> rows;
  for (const ResultTable& table : tables) {
    for (const ResultRow& row : table.rows) {
      for (std::size_t i = 0; i < table.columns.size(); ++i) {
        const auto cell = compared_cell(table, row, i);
        if (!cell) continue;
        rows.push_back({{"table", table.number},
                        {"row", fmt::format("{}", fmt::join(row.labels, " "))},
                        {"column", cell->what},
                        {"thesis", cell->printed},
                        {"ours", cell->ours},
                        {"ours_low", cell->interval ? Row(cell->interval->low) : Row()},
                        {"ours_high", cell->interval ? Row(cell->interval->high) : Row()},
                        {"ratio", cell->printed == 0 ? Row() : Row(cell->ours / cell->printed)},
                        {"verdict", verdict_name(verdict_of(*cell))}});
      }
    }
  }
  return rows;
}

}  // namespace hitpipe::thesis
