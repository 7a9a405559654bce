#include "sim/sweep/resume.hpp"

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "host/files.hpp"
#include "host/text.hpp"

namespace hitpipe::sim {

namespace {

/// The rows, if they are of this. A file has rows of one subject.
std::vector<SweepRow> required_of(std::vector<SweepRow> rows, const std::filesystem::path& file,
                                  const SweepSubject& subject) {
  if (rows.empty() || subject == rows.front()) return rows;
  throw std::runtime_error(
      fmt::format("{}: holds rows of \"{}\", asked for are \"{}\"; give another file or remove it",
                  file.string(), rows.front().text(), subject.text()));
}

/// Rows by their place in the file. Each new row is written at once, behind the others if its place is there.
class KeptRows {
 public:
  /// Takes the rows that the file holds, and `more` rows. What a triangle test costs is no measurement, so
  /// they get the cost that is asked for now.
  KeptRows(std::filesystem::path file, const std::vector<SweepRow>& more, SweepSubject subject,
           const TriangleCost& triangle)
      : file_(std::move(file)), subject_(std::move(subject)) {
    if (std::filesystem::exists(file_)) take(own_rows(), triangle);
    take(more, triangle);
    // Written before the long run, so that a file that cannot be written is reported at once.
    write_all();
  }

  [[nodiscard]] bool has(const SweepPoint& point) const { return rows_.contains(key_of(point)); }
  void add(const SweepRow& row) {
    const RowKey key = keep(row);
    if (key != rows_.rbegin()->first || was_changed()) return write_all();
    const std::string line = host::csv_line(to_cells(row));
    host::append_to_file(file_, line);
    bytes_ += line.size();
  }
  [[nodiscard]] std::vector<SweepRow> contents() const {
    std::vector<SweepRow> rows;
    for (const auto& [key, row] : rows_) rows.push_back(row);
    return rows;
  }

 private:
  void write_all() {
    const std::vector<SweepRow> all = contents();
    write_rows(file_, all);
    bytes_ = to_csv(all).size();
  }
  /// By another run.
  [[nodiscard]] bool was_changed() const {
    std::error_code error;
    return std::filesystem::file_size(file_, error) != bytes_;
  }
  /// A run that was killed, or a copy that broke off, may have cut the file. What its last line would say is
  /// measured again.
  [[nodiscard]] std::vector<SweepRow> own_rows() const {
    const std::string text = host::read_file(file_, "cannot read the rows");
    if (rows_header().starts_with(text)) return {};
    const std::size_t end = text.rfind('\n');
    const std::string whole = end == std::string::npos ? text : text.substr(0, end + 1);
    return required_of(parse_rows(whole, file_.string()), file_, subject_);
  }
  void take(std::vector<SweepRow> rows, const TriangleCost& triangle) {
    for (SweepRow& row : rows) {
      row.triangle = triangle;
      keep(row);
    }
  }
  RowKey keep(const SweepRow& row) {
    const RowKey key = key_of(row.design, row.bits, row.rays_in_flight, row.interval);
    rows_.insert_or_assign(key, row);
    return key;
  }

  std::filesystem::path file_;
  SweepSubject subject_;
  std::map<RowKey, SweepRow> rows_;
  std::uintmax_t bytes_ = 0;  ///< of the file, as this run left it
};

}  // namespace

std::vector<SweepRow> resume(const ResumableSweep& sweep) {
  std::vector<SweepPoint> points = sweep.points;
  const SweepSubject subject = sweep_subject(*sweep.scene, *sweep.bvh, sweep.options);
  std::vector<SweepRow> more;
  for (const std::filesystem::path& each : sweep.more)
    for (SweepRow& row : read_rows_of(each, subject)) more.push_back(std::move(row));
  KeptRows rows(sweep.file, more, subject, sweep.options.triangle);
  if (!sweep.notes.empty()) host::write_file(sweep.notes_file, sweep.notes);
  std::erase_if(points, [&](const SweepPoint& point) { return rows.has(point); });
  run_sweep(*sweep.scene, *sweep.bvh, points, sweep.options, [&](const SweepRow& row) { rows.add(row); });
  return rows.contents();
}

std::vector<SweepRow> join_rows(const std::filesystem::path& file, const std::vector<SweepRow>& rows) {
  if (rows.empty()) return {};
  return KeptRows(file, rows, rows.front(), rows.front().triangle).contents();
}

std::vector<SweepRow> read_rows_of(const std::filesystem::path& file, const SweepSubject& subject) {
  return required_of(read_rows(file), file, subject);
}

}  // namespace hitpipe::sim
