#include "sim/sweep/resume.hpp"

#include <cstdint>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "host/files.hpp"
#include "host/text.hpp"

namespace hitpipe::sim {

namespace {

/// The rows, if they are about this.
RowsFile required_about(RowsFile rows, const std::filesystem::path& file, const std::string& what) {
  if (rows.about == what) return rows;
  throw std::runtime_error(
      fmt::format("{}: holds rows of \"{}\", asked for are \"{}\"; give another file or remove it",
                  file.string(), rows.about, what));
}

/// Rows by their place in the file. Each new row is written at once, behind the others if its place is there.
class KeptRows {
 public:
  /// Takes the rows that the file and `more` files hold. What a triangle test costs is no measurement, so
  /// they get the cost that is asked for now.
  KeptRows(std::filesystem::path file, std::span<const std::filesystem::path> more, std::string about,
           const TriangleCost& triangle)
      : file_(std::move(file)), about_(std::move(about)) {
    if (std::filesystem::exists(file_)) take(own_rows(), triangle);
    for (const std::filesystem::path& each : more) take(read_rows_about(each, about_), triangle);
    // Written before the long run, so that a file that cannot be written is reported at once.
    write_all();
  }

  [[nodiscard]] bool has(const SweepPoint& point) const { return rows_.contains(key_of(point)); }
  void add(const SweepRow& row) {
    const RowKey key = keep(row);
    const std::span<const SweepColumn> columns = columns_of(contents().rows);
    if (key != rows_.rbegin()->first || columns.data() != columns_.data() || was_changed())
      return write_all();
    const std::string line = host::csv_line(to_cells(row, columns));
    host::append_to_file(file_, line);
    bytes_ += line.size();
  }
  [[nodiscard]] RowsFile contents() const {
    RowsFile file{about_, {}};
    for (const auto& [key, row] : rows_) file.rows.push_back(row);
    return file;
  }

 private:
  void write_all() {
    const RowsFile all = contents();
    write_rows(file_, all);
    columns_ = columns_of(all.rows);
    bytes_ = to_text(all).size();
  }
  /// By another run, which may have given it other columns.
  [[nodiscard]] bool was_changed() const {
    std::error_code error;
    return std::filesystem::file_size(file_, error) != bytes_;
  }
  /// A run that was killed, or a copy that broke off, may have cut the file. What its last line would say is
  /// measured again.
  [[nodiscard]] RowsFile own_rows() const {
    const std::string text = host::read_file(file_, "cannot read the rows");
    for (const bool intervals : {false, true})
      if (head_text(about_, intervals).starts_with(text)) return {};
    const std::size_t end = text.rfind('\n');
    const std::string whole = end == std::string::npos ? text : text.substr(0, end + 1);
    return required_about(parse_rows(whole, file_.string()), file_, about_);
  }
  void take(RowsFile rows, const TriangleCost& triangle) {
    for (SweepRow& row : rows.rows) {
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
  std::string about_;
  std::map<RowKey, SweepRow> rows_;
  // Of the file, as this run left it.
  std::span<const SweepColumn> columns_;
  std::uintmax_t bytes_ = 0;
};

}  // namespace

RowsFile resume(const ResumableSweep& sweep) {
  std::vector<SweepPoint> points = sweep.points;
  KeptRows rows(sweep.file, sweep.more, about_sweep(sweep.program, *sweep.scene, *sweep.bvh, sweep.options),
                sweep.options.triangle);
  std::erase_if(points, [&](const SweepPoint& point) { return rows.has(point); });
  run_sweep(*sweep.scene, *sweep.bvh, points, sweep.options, [&](const SweepRow& row) { rows.add(row); });
  return rows.contents();
}

RowsFile read_rows_about(const std::filesystem::path& file, const std::string& about) {
  return required_about(read_rows(file), file, about);
}

}  // namespace hitpipe::sim
