#include "cli/text/answers_file.hpp"

#include <optional>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "cli/text/csv_metadata.hpp"
#include "host/text.hpp"

namespace hitpipe::cli {

namespace {

/// Behind the unit's.
const std::vector<std::string> answer_columns{
    "ray", "query", "hit",       "number",       "face",       "t",       "distance",      "w0",
    "w1",  "w2",    "exact_hit", "exact_number", "exact_face", "exact_t", "exact_distance"};

/// Vertices are binary32, so more digits say nothing.
std::string answer_cell(double number) {
  return fmt::format("{:.9g}", number);
}

template <class Number>
std::string answer_cell(const std::optional<Number>& number) {
  if (!number) return "";
  if constexpr (std::is_same_v<Number, double>) return answer_cell(*number);
  return fmt::format("{}", *number);
}

/// What names a triangle.
void add_triangle(std::vector<std::string>& cells, const std::optional<sim::Meeting>& meeting) {
  cells.push_back(meeting ? fmt::format("{}", meeting->number) : "");
  cells.push_back(meeting ? fmt::format("{}", meeting->face) : "");
}

void add_place(std::vector<std::string>& cells, const std::optional<sim::Meeting>& meeting) {
  cells.push_back(meeting ? answer_cell(meeting->t) : "");
  cells.push_back(meeting ? answer_cell(meeting->distance) : "");
}

void add_answer(std::vector<std::string>& cells, const sim::Answer& answer) {
  const auto& [given, found, exact] = answer;
  cells.push_back(!given ? "" : found ? "1" : "0");
  add_triangle(cells, found);
  add_place(cells, found);
  for (std::size_t corner = 0; corner < 3; ++corner)
    cells.push_back(found && found->weights ? answer_cell((*found->weights)[corner]) : "");
  cells.emplace_back(exact ? "1" : "0");
  add_triangle(cells, exact);
  add_place(cells, exact);
}

}  // namespace

AnswersFile::AnswersFile(const std::string& file, std::vector<std::string> unit_columns) : file_(file) {
  if (file.empty()) return;
  unit_columns.insert(unit_columns.end(), answer_columns.begin(), answer_columns.end());
  header_ = host::csv_line(unit_columns);
  pending_ = std::make_unique<host::PendingFile>(file_);
  pending_->write(header_);
}

void AnswersFile::add(std::span<const std::string> unit, std::span<const sim::AskedRay> rays,
                      const std::function<sim::Answer(std::size_t ray)>& answer) {
  if (!wanted()) return;
  for (std::size_t ray = 0; ray < rays.size(); ++ray) {
    std::vector<std::string> cells(unit.begin(), unit.end());
    cells.push_back(fmt::format("{}", ray));
    cells.emplace_back(rays[ray].query == ref::Query::any ? "any" : "nearest");
    add_answer(cells, answer(ray));
    pending_->write(host::csv_line(cells));
  }
}

void AnswersFile::finish(const Row& notes) {
  if (!wanted()) return;
  pending_->close();
  host::write_file(metadata_file(file_), csv_metadata({csv_table(file_, header_)}, notes));
  pending_->rename();
}

}  // namespace hitpipe::cli
