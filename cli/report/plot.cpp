#include "cli/report/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/process.hpp"
#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::cli {

namespace {

constexpr int picture_width = 1000;
// Edges of the plot as fractions of the picture's width.
constexpr double plot_left = 0.085;
constexpr double plot_right = 0.985;
// In pixels. The picture grows with its key, and the plot keeps its size.
constexpr int plot_height = 470;
constexpr int above_plot = 46;
constexpr int axis_height = 56;  // numbers and text below the plot
constexpr int key_line_height = 20;

constexpr double margin = 0.03;         // of the length, so that marks at the ends are whole
constexpr double least_decade = 10;     // of the ends, when there is a place for "≤ 0"
constexpr double least_ratio = 1.05;    // of the ends, when all data is one number
constexpr double below_positive = 0.3;  // of the length: how far "≤ 0" stands below the least positive number
constexpr double zero_margin = 0.1;     // below it, so that labels have room there

/// The tics of a decade, from few to many.
const std::array<std::vector<double>, 5> tic_series{
    {{1}, {1, 3}, {1, 2, 5}, {1, 1.5, 2, 3, 4, 5, 7}, {1,   1.1, 1.2, 1.3, 1.4, 1.6, 1.8, 2, 2.2, 2.5, 2.8,
                                                       3.2, 3.6, 4,   4.5, 5,   5.5, 6,   7, 8,   9}}};

std::vector<double> tics_of(const std::vector<double>& decade, double least, double most) {
  std::vector<double> tics;
  for (int power = static_cast<int>(std::floor(std::log10(least))); std::pow(10, power) <= most; ++power) {
    for (const double tic : decade) {
      const double value = tic * std::pow(10, power);
      if (value >= least && value <= most) tics.push_back(value);
    }
  }
  return tics;
}

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

/// Joins marks of one design that would cover one another, until none would.
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

const char* gnuplot_name(Align align) {
  return align == Align::left ? "left" : align == Align::right ? "right" : "center";
}

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

std::string gnuplot_string(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("''") : std::string(1, c);
  return word + "'";
}

std::string run_gnuplot(const std::string& command, const std::string& script) {
  host::Outcome plotted = host::run({"gnuplot"}, {.input = script, .time_limit = host::answering_time});
  if (!plotted.succeeded() || plotted.out.empty()) {
    throw std::runtime_error(fmt::format("{}: gnuplot {}{}", command, plotted.failure(),
                                         plotted.not_found() ? "; install the package gnuplot-nox" : ""));
  }
  return std::move(plotted.out);
}

std::string plot_head(const std::string& title, std::size_t key_entries) {
  const int key_lines = static_cast<int>((key_entries + plot_key_columns - 1) / plot_key_columns);
  const int below_plot = axis_height + key_lines * key_line_height;
  const int height = above_plot + plot_height + below_plot;
  const double bottom = static_cast<double>(below_plot) / height;
  const double top = static_cast<double>(below_plot + plot_height) / height;
  return fmt::format(
      "set terminal svg size {},{} font 'sans-serif,12' background 'white' noenhanced\n"
      "set encoding utf8\nset title {} font ',14'\nset lmargin at screen {}\nset rmargin at screen {}\n"
      "set bmargin at screen {}\nset tmargin at screen {}\nset grid lc rgb '#dddddd'\n"
      "set style textbox opaque margins 0.2,0.2 fc rgb 'white' noborder\n"
      "set key at screen 0.5,0.005 center bottom horizontal Left reverse samplen 1.5 width 1 maxcols {}\n",
      picture_width, height, gnuplot_string(title), plot_left, plot_right, bottom, top, plot_key_columns);
}

Mark plot_size() {
  return {picture_width * (plot_right - plot_left), plot_height};
}

std::string data_block(const std::string& name, const std::string& lines) {
  return fmt::format("${} << END\n{}END\n", name, lines);
}

LogAxis::LogAxis(std::span<const double> values) {
  double least = 0;
  double most = 0;
  bool zero = false;
  for (const double value : values) {
    zero = zero || value <= 0;
    if (value <= 0) continue;
    least = least == 0 ? value : std::min(least, value);
    most = std::max(most, value);
  }
  if (least == 0) least = most = 1;
  if (zero) zero_ = least / std::pow(std::max(most / least, least_decade), below_positive);
  const double low = zero ? zero_ : least;
  const double ratio = std::max(most / low, least_ratio);
  least_ = low / std::pow(ratio, zero ? zero_margin : margin);
  most_ = std::max(most, low * least_ratio) * std::pow(ratio, margin);
}

double LogAxis::share(double value) const {
  return std::log(shown(value) / least_) / std::log(most_ / least_);
}

double LogAxis::at(double share) const {
  return least_ * std::pow(most_ / least_, share);
}

std::string LogAxis::tics() const {
  constexpr std::size_t enough = 4;
  std::vector<double> chosen;
  const double least = zero_ > 0 ? zero_ * 1.5 : least_;
  for (const std::vector<double>& decade : tic_series) {
    chosen = tics_of(decade, least, most_);
    if (chosen.size() >= enough) break;
  }
  std::vector<std::string> texts;
  if (zero_ > 0) texts.push_back(fmt::format("'≤ 0' {}", zero_));
  for (const double tic : chosen) texts.push_back(fmt::format("'{:.4g}' {:.4g}", tic, tic));
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::string mark_labels(std::span<const UnitMark> marks, const Mark& size) {
  std::vector<Mark> places;
  std::vector<std::string> texts;
  for (const UnitMark& mark : marks) {
    places.push_back(mark.place);
    texts.push_back(mark.name);
  }
  const std::vector<LabelPlace> found = place_labels(places, texts, size);
  std::string text;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const LabelPlace& p = found[i];
    text += fmt::format("set label {} at graph {:.4f},{:.4f} {} front boxed\n", gnuplot_string(texts[i]),
                        p.anchor() / size.x, p.middle / size.y, gnuplot_name(p.align));
    if (p.line) {
      text +=
          fmt::format("set arrow from graph {:.4f},{:.4f} to graph {:.4f},{:.4f} nohead lc rgb '#666666'\n",
                      places[i].x / size.x, places[i].y / size.y, p.anchor() / size.x, p.middle / size.y);
    }
  }
  return text;
}

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
