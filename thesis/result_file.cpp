#include "thesis/result_file.hpp"

#include <cmath>
#include <limits>

namespace hitpipe::thesis {

namespace {

Row kept(double number) {
  if (std::isnan(number)) return "nan";
  if (std::isinf(number)) return number > 0 ? "inf" : "-inf";
  return number;
}

Row kept(const Interval& interval) {
  return Row::array({kept(interval.low), kept(interval.high)});
}

template <class Value>
Row kept(const std::optional<Value>& value) {
  return value ? kept(*value) : Row(nullptr);
}

template <class Value>
Row kept(const std::vector<std::optional<Value>>& values) {
  Row row = Row::array();
  for (const std::optional<Value>& value : values) row.push_back(kept(value));
  return row;
}

double number_of(const Row& row) {
  if (!row.is_string()) return row.get<double>();
  const std::string word = row.get<std::string>();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return word == "inf" ? infinity : word == "-inf" ? -infinity : std::numeric_limits<double>::quiet_NaN();
}

Interval interval_of(const Row& row) {
  return {number_of(row.at(0)), number_of(row.at(1))};
}

/// Null is nothing.
template <class Parse>
auto optional_of(const Row& row, Parse parse) {
  return row.is_null() ? std::nullopt : std::optional(parse(row));
}

template <class Parse>
auto each_of(const Row& rows, Parse parse) {
  std::vector<decltype(parse(rows))> values;
  for (const Row& row : rows) values.push_back(parse(row));
  return values;
}

std::optional<double> figure_of(const Row& row) {
  return optional_of(row, number_of);
}

Row kept(const ResultRow& row) {
  return {{"labels", row.labels},
          {"ours", kept(row.ours)},
          {"printed", kept(row.printed)},
          {"intervals", kept(row.intervals)},
          {"unit", row.unit ? Row(*row.unit) : Row(nullptr)}};
}

ResultRow row_of(const Row& row) {
  return {.labels = row.at("labels").get<std::vector<std::string>>(),
          .ours = each_of(row.at("ours"), figure_of),
          .printed = each_of(row.at("printed"), figure_of),
          .intervals = each_of(row.at("intervals"), [](const Row& r) { return optional_of(r, interval_of); }),
          .unit = optional_of(row.at("unit"), [](const Row& r) { return r.get<std::size_t>(); })};
}

Row kept(const Comparison& figure) {
  return {{"what", figure.what},
          {"printed", kept(figure.printed)},
          {"ours", kept(figure.ours)},
          {"half_unit", kept(figure.half_unit)},
          {"interval", kept(figure.interval)}};
}

Comparison comparison_of(const Row& row) {
  return {.what = row.at("what").get<std::string>(),
          .printed = number_of(row.at("printed")),
          .ours = number_of(row.at("ours")),
          .half_unit = number_of(row.at("half_unit")),
          .interval = optional_of(row.at("interval"), interval_of)};
}

}  // namespace

Row kept_result(const ResultTable& table) {
  Row columns = Row::array();
  for (const ResultColumn& column : table.columns)
    columns.push_back(
        {{"name", column.name}, {"decimals", column.decimals}, {"half_unit", kept(column.half_unit)}});
  Row rows = Row::array();
  for (const ResultRow& row : table.rows) rows.push_back(kept(row));
  Row findings = Row::array();
  for (const Finding& finding : table.findings) {
    Row figures = Row::array();
    for (const Comparison& figure : finding.figures) figures.push_back(kept(figure));
    findings.push_back({{"claim", finding.claim}, {"figures", figures}, {"why", finding.why}});
  }
  return {{"number", table.number}, {"title", table.title}, {"labels", table.labels}, {"columns", columns},
          {"rows", rows},           {"findings", findings}, {"notes", table.notes}};
}

ResultTable parse_result(const Row& row) {
  return {.number = row.at("number").get<std::string>(),
          .title = row.at("title").get<std::string>(),
          .labels = row.at("labels").get<std::vector<std::string>>(),
          .columns = each_of(row.at("columns"),
                             [](const Row& r) {
                               return ResultColumn{r.at("name").get<std::string>(),
                                                   r.at("decimals").get<int>(), number_of(r.at("half_unit"))};
                             }),
          .rows = each_of(row.at("rows"), row_of),
          .findings = each_of(row.at("findings"),
                              [](const Row& r) {
                                return Finding{r.at("claim").get<std::string>(),
                                               each_of(r.at("figures"), comparison_of),
                                               r.at("why").get<std::string>()};
                              }),
          .notes = row.at("notes").get<std::vector<std::string>>()};
}

}  // namespace hitpipe::thesis
