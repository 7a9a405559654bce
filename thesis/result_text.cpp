#include "thesis/result_text.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "host/text.hpp"

namespace hitpipe::thesis {

namespace {

using Figures = std::vector<std::optional<double>>;

Row json_figures(const ResultTable& table, const Figures& figures) {
  Row row = Row::object();
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    row[table.columns[i].name] = figures[i] ? Row(*figures[i]) : Row();
  return row;
}

Row json_interval(const std::optional<ref::Interval>& interval) {
  return interval ? Row{interval->low, interval->high} : Row();
}

Row json_intervals(const ResultTable& table, const ResultRow& row) {
  Row all = Row::object();
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    all[table.columns[i].name] = json_interval(row.intervals[i]);
  return all;
}

Row json_finding(const Finding& finding) {
  Row figures = Row::array();
  for (const Comparison& figure : finding.figures)
    figures.push_back({{"what", figure.what},
                       {"thesis", figure.printed},
                       {"ours", figure.ours},
                       {"interval_95", json_interval(figure.interval)},
                       {"verdict", verdict_name(verdict_of(figure))}});
  Row row{{"claim", finding.claim},
          {"verdict", verdict_name(finding.verdict())},
          {"figures", std::move(figures)}};
  if (!finding.why.empty()) row["why"] = finding.why;
  return row;
}

}  // namespace

Row result_record(const ResultTable& table) {
  Row all{{"number", table.number}, {"title", table.title}, {"rows", Row::array()}};
  for (const ResultRow& row : table.rows) {
    Row entry = Row::object();
    for (std::size_t i = 0; i < table.labels.size(); ++i) entry[table.labels[i]] = row.labels[i];
    entry["ours"] = json_figures(table, row.ours);
    entry["thesis"] = json_figures(table, row.printed);
    if (!row.intervals.empty()) entry["interval_95"] = json_intervals(table, row);
    all["rows"].push_back(std::move(entry));
  }
  all["findings"] = Row::array();
  for (const Finding& finding : table.findings) all["findings"].push_back(json_finding(finding));
  all["notes"] = table.notes;
  return all;
}

namespace {

/// The lower or the upper ends of a row's intervals.
Figures ends(const ResultRow& row, double ref::Interval::*end) {
  Figures figures;
  for (const std::optional<ref::Interval>& interval : row.intervals)
    figures.push_back(interval ? std::optional(*interval.*end) : std::nullopt);
  return figures;
}

/// Half the widths of a row's intervals.
Figures half_widths(const ResultRow& row) {
  Figures figures;
  for (const std::optional<ref::Interval>& interval : row.intervals)
    figures.push_back(interval ? std::optional((interval->high - interval->low) / 2) : std::nullopt);
  return figures;
}

}  // namespace

std::vector<Row> result_rows(const ResultTable& table) {
  std::vector<Row> rows;
  for (const ResultRow& row : table.rows) {
    const auto add = [&](const char* source, const Figures& figures) {
      Row& line = rows.emplace_back(Row::object());
      for (std::size_t i = 0; i < table.labels.size(); ++i) line[table.labels[i]] = row.labels[i];
      line["source"] = source;
      line.update(json_figures(table, figures));
    };
    add("ours", row.ours);
    if (!row.intervals.empty()) {
      add("ours_low", ends(row, &ref::Interval::low));
      add("ours_high", ends(row, &ref::Interval::high));
    }
    add("thesis", row.printed);
  }
  return rows;
}

namespace {

class TextTable {
 public:
  explicit TextTable(const ResultTable& table)
      : table_(table),
        grouped_(table.labels.size() > 1),
        gap_(table.columns.size() > 6 ? " " : "  "),
        label_widths_(table.labels.size()) {
    for (std::size_t i = 0; i < table.labels.size(); ++i) {
      label_widths_[i] = table.labels[i].size();
      for (const ResultRow& row : table.rows)
        label_widths_[i] = std::max(label_widths_[i], row.labels[i].size());
    }
    head(columns_in_one_line());
    if (header_width() > terminal_columns) head(columns_in_words());
  }

  [[nodiscard]] std::string text() const {
    std::string text = fmt::format("Table {}: {}\n\n", table_.number, table_.title);
    std::string labels = grouped_ ? "" : fmt::format("{:<{}}", table_.labels.front(), label_widths_.front());
    for (std::size_t i = 1; i < table_.labels.size(); ++i) labels += column(table_.labels[i], i);
    for (std::size_t line = 0; line < heads_.front().size(); ++line) {
      const bool is_last = line + 1 == heads_.front().size();
      text += fmt::format("{:{}}  {:6}", is_last ? labels : "", labels.size(), "");
      for (std::size_t i = 0; i < widths_.size(); ++i)
        text += fmt::format("{}{:>{}}", gap_, heads_[i][line], widths_[i]);
      text += "\n";
    }
    const std::string* group = nullptr;
    for (const ResultRow& row : table_.rows) {
      if (grouped_ && (group == nullptr || *group != row.labels.front())) text += row.labels.front() + "\n";
      group = &row.labels.front();
      text += lines(row);
    }
    return text + below();
  }

 private:
  static constexpr std::size_t terminal_columns = 80;
  /// The lines of each column's heading; all have the same number.
  using Heads = std::vector<std::vector<std::string>>;

  [[nodiscard]] Heads columns_in_one_line() const {
    Heads heads;
    for (const auto& each : table_.columns) heads.push_back({each.name});
    return heads;
  }
  /// A word of the name in each line, the last one at the bottom.
  [[nodiscard]] Heads columns_in_words() const {
    Heads heads;
    std::size_t most = 0;
    for (const auto& each : table_.columns) {
      std::istringstream name(each.name);
      std::vector<std::string>& words = heads.emplace_back();
      for (std::string word; std::getline(name, word, '_');) words.push_back(word);
      most = std::max(most, words.size());
    }
    for (std::vector<std::string>& words : heads) words.insert(words.begin(), most - words.size(), "");
    return heads;
  }

  void head(Heads heads) {
    heads_ = std::move(heads);
    widths_.clear();
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      std::size_t width = 0;
      for (const std::string& line : heads_[i]) width = std::max(width, line.size());
      for (const ResultRow& row : table_.rows) has_printed_ = has_printed_ || row.printed[i].has_value();
      for (const ResultRow& row : table_.rows)
        width = std::max({width, cell(row.ours, i).size(), cell(row.printed, i).size()});
      widths_.push_back(width);
    }
  }
  /// Of labels, source and columns.
  [[nodiscard]] std::size_t header_width() const {
    std::size_t width = 8;
    for (std::size_t i = grouped_ ? 1 : 0; i < label_widths_.size(); ++i)
      width += label_widths_[i] + (i == 0 ? 0 : 2);
    for (const std::size_t column_width : widths_) width += gap_.size() + column_width;
    return width;
  }

  [[nodiscard]] std::string cell(const Figures& figures, std::size_t i) const {
    if (!figures[i]) return "-";
    // Decimals mean nothing in numbers above a thousand.
    return fmt::format("{:.{}f}", *figures[i],
                       std::abs(*figures[i]) < 1000.0 ? table_.columns[i].decimals : 0);
  }

  [[nodiscard]] std::string column(const std::string& label, std::size_t i) const {
    return fmt::format("  {:<{}}", label, label_widths_[i]);
  }

  [[nodiscard]] std::string lines(const ResultRow& row) const {
    std::string labels = grouped_ ? "" : fmt::format("{:<{}}", row.labels.front(), label_widths_.front());
    for (std::size_t i = 1; i < row.labels.size(); ++i) labels += column(row.labels[i], i);
    const auto line = [&](const std::string& names, const char* source, const Figures& figures) {
      std::string text = fmt::format("{:{}}  {:6}", names, labels.size(), source);
      for (std::size_t i = 0; i < widths_.size(); ++i)
        text += fmt::format("{}{:>{}}", gap_, cell(figures, i), widths_[i]);
      return text + "\n";
    };
    const std::string spread = row.intervals.empty() ? "" : line("", "+-95 %", half_widths(row));
    const std::string thesis = has_printed_ ? line("", "thesis", row.printed) : "";
    return line(labels, "ours", row.ours) + spread + thesis;
  }

  [[nodiscard]] std::string below() const {
    std::string text;
    if (!table_.findings.empty()) text += "\n";
    for (const Finding& finding : table_.findings) {
      const Comparison& figure = finding.worst();
      std::string line =
          fmt::format("{}: {}: {}: thesis {}, ours {}", verdict_text(figure), finding.claim, figure.what,
                      figure_text(figure.printed), figure_text(figure.ours, figure.interval));
      if (!finding.why.empty() && finding.verdict() != Verdict::agrees) line += ". " + finding.why;
      text += host::wrapped(line, 2);
    }
    if (!table_.notes.empty()) text += "\n";
    for (const std::string& note : table_.notes) text += host::wrapped(note, 2);
    return text;
  }

  const ResultTable& table_;
  bool grouped_;
  bool has_printed_ = false;  // proposals of the thesis have no printed figures
  std::string_view gap_;      // blanks between columns
  std::vector<std::size_t> label_widths_;
  Heads heads_;
  std::vector<std::size_t> widths_;
};

}  // namespace

std::string result_text(const ResultTable& table) {
  return TextTable(table).text();
}

}  // namespace hitpipe::thesis
