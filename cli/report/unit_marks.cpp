#include "cli/report/unit_marks.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::cli {

namespace {

constexpr double apart = 2 * mark_radius;

bool cover(const Mark& a, const Mark& b) {
  return std::abs(a.x - b.x) < apart - 1e-6 && std::abs(a.y - b.y) < apart - 1e-6;
}

/// "24/24", "24/28" and "16/16" become "24/24,28 16/16".
std::string joined(const std::vector<std::string>& formats) {
  std::vector<std::pair<std::string, std::vector<std::string>>> by_head;
  for (const std::string& format : formats) {
    const std::size_t slash = format.find('/');
    const std::string head = slash == std::string::npos ? format : format.substr(0, slash + 1);
    if (by_head.empty() || by_head.back().first != head || slash == std::string::npos)
      by_head.emplace_back(head, std::vector<std::string>());
    if (slash != std::string::npos) by_head.back().second.push_back(format.substr(slash + 1));
  }
  std::vector<std::string> texts;
  for (const auto& [head, tails] : by_head) texts.push_back(head + fmt::format("{}", fmt::join(tails, ",")));
  return fmt::format("{}", fmt::join(texts, " "));
}

/// Some units of a design, at their middle.
struct Cluster {
  std::string design;
  std::vector<std::string> formats;
  Mark sum{0, 0};
  double units = 0;

  [[nodiscard]] Mark middle() const { return {sum.x / units, sum.y / units}; }
  void add(const Cluster& other) {
    formats.insert(formats.end(), other.formats.begin(), other.formats.end());
    sum = {sum.x + other.sum.x, sum.y + other.sum.y};
    units += other.units;
  }
};

/// Joins what belongs to one design and would cover, until nothing does.
std::vector<Cluster> clusters_of(std::span<const sim::SweepRow> units, std::span<const Mark> places) {
  std::vector<Cluster> clusters;
  for (std::size_t i = 0; i < units.size(); ++i)
    clusters.push_back({units[i].design, {units[i].bits}, places[i], 1});
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    for (std::size_t j = i + 1; j < clusters.size(); ++j) {
      if (clusters[i].design != clusters[j].design || !cover(clusters[i].middle(), clusters[j].middle()))
        continue;
      clusters[i].add(clusters[j]);
      clusters.erase(clusters.begin() + static_cast<std::ptrdiff_t>(j));
      i = static_cast<std::size_t>(-1);  // the middle has moved: look at all again
      break;
    }
  }
  return clusters;
}

/// Marks that stand in one row because they would cover one another.
struct MarkRow {
  std::vector<std::size_t> marks;  ///< from left to right
  Mark middle{0, 0};

  [[nodiscard]] Mark place(std::size_t i) const {
    const double from_middle = static_cast<double>(i) - (static_cast<double>(marks.size()) - 1) / 2;
    return {middle.x + apart * from_middle, middle.y};
  }
  [[nodiscard]] bool covers(const MarkRow& other) const {
    for (std::size_t i = 0; i < marks.size(); ++i) {
      for (std::size_t j = 0; j < other.marks.size(); ++j) {
        if (cover(place(i), other.place(j))) return true;
      }
    }
    return false;
  }
};

void stand_side_by_side(std::vector<UnitMark>& marks) {
  std::vector<MarkRow> rows;
  for (std::size_t i = 0; i < marks.size(); ++i) rows.push_back({{i}, marks[i].place});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = i + 1; j < rows.size(); ++j) {
      if (!rows[i].covers(rows[j])) continue;
      MarkRow joint{rows[i].marks, {0, 0}};
      joint.marks.insert(joint.marks.end(), rows[j].marks.begin(), rows[j].marks.end());
      std::stable_sort(joint.marks.begin(), joint.marks.end(),
                       [&](std::size_t a, std::size_t b) { return marks[a].place.x < marks[b].place.x; });
      const auto size = static_cast<double>(joint.marks.size());
      for (const std::size_t mark : joint.marks) {
        joint.middle.x += marks[mark].place.x / size;
        joint.middle.y += marks[mark].place.y / size;
      }
      rows[i] = joint;
      rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(j));
      i = static_cast<std::size_t>(-1);
      break;
    }
  }
  for (const MarkRow& row : rows) {
    for (std::size_t i = 0; i < row.marks.size(); ++i) marks[row.marks[i]].place = row.place(i);
  }
}

}  // namespace

std::vector<UnitMark> unit_marks(std::span<const sim::SweepRow> units, std::span<const Mark> places) {
  std::map<std::string, bool> single;
  for (const sim::SweepRow& unit : units)
    single[unit.design] = rtl::find_design(unit.design).default_format.family().single;
  std::vector<UnitMark> marks;
  for (const Cluster& cluster : clusters_of(units, places))
    marks.push_back({cluster.design, single[cluster.design] ? cluster.design : joined(cluster.formats),
                     cluster.middle()});
  stand_side_by_side(marks);
  return marks;
}

}  // namespace hitpipe::cli
