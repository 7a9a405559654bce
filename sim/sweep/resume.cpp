#include "sim/sweep/resume.hpp"

#include <map>
#include <stdexcept>

#include <fmt/format.h>

#include "host/files.hpp"

namespace hitpipe::sim {

namespace {

/// The rows, if they are about this.
RowsFile required_about(RowsFile rows, const std::filesystem::path& file, const std::string& what) {
  if (rows.about == what) return rows;
  throw std::runtime_error(
      fmt::format("{}: holds rows of \"{}\", asked for are \"{}\"; give another file or remove it",
                  file.string(), rows.about, what));
}

/// Rows by their place in the file. Each new row is written at once.
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
    write_rows(file_, contents());
  }

  [[nodiscard]] bool has(const SweepPoint& point) const { return rows_.contains(key_of(point)); }
  void add(const SweepRow& row) {
    keep(row);
    write_rows(file_, contents());
  }
  [[nodiscard]] RowsFile contents() const {
    RowsFile file{about_, {}};
    for (const auto& [key, row] : rows_) file.rows.push_back(row);
    return file;
  }

 private:
  /// A copy that broke off may have cut the file. What its last line would say is measured again.
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
  void keep(const SweepRow& row) {
    rows_.insert_or_assign(key_of(row.design, row.bits, row.rays_in_flight, row.interval), row);
  }

  std::filesystem::path file_;
  std::string about_;
  std::map<RowKey, SweepRow> rows_;
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
