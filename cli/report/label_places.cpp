#include "cli/report/label_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace hitpipe::cli {

namespace {

constexpr double font_size = 12.0;
constexpr double gap = 3.0;       // between mark and label
constexpr double overhang = 4.0;  // of a label that begins or ends above its mark
constexpr int steps_off = 16;     // how many lines above and below are tried
constexpr std::array<double, 6> steps_out{0, 10, 25, 50, 90, 140};

// What is bad about a place, in units of a longer line.
constexpr double on_another = 10'000;  // the label lies on a mark or a label
constexpr double on_line = 5'000;      // it lies on a line of the plot
constexpr double line_on_one = 1'000;  // its line lies on a mark or a label
constexpr double line_in_stack = 20;   // its line leaves its mark across one that covers it
constexpr double lines_cross = 300;
constexpr double has_line = 10;
constexpr int most_rounds = 50;
constexpr int most_tries = 12;   // before a label is left out
constexpr double grazed = 0.75;  // of a mark: a line may lie on the rest

struct Rectangle {
  double left, right, low, high;

  [[nodiscard]] bool meets(const Rectangle& other) const {
    return left < other.right && other.left < right && low < other.high && other.low < high;
  }
};

struct Leader : PlotSegment {
  [[nodiscard]] bool meets(const Rectangle& r) const {
    double begin = 0;
    double end = 1;
    const auto within = [&](double start, double along, double low, double high) {
      if (along == 0) return start > low && start < high;
      const double a = (low - start) / along;
      const double b = (high - start) / along;
      begin = std::max(begin, std::min(a, b));
      end = std::min(end, std::max(a, b));
      return begin < end;
    };
    return within(from.x, to.x - from.x, r.left, r.right) && within(from.y, to.y - from.y, r.low, r.high);
  }
  [[nodiscard]] bool meets(const Leader& other) const {
    return side(other.from) != side(other.to) && other.side(from) != other.side(to);
  }
  [[nodiscard]] bool side(const Mark& p) const {
    return (to.x - from.x) * (p.y - from.y) > (to.y - from.y) * (p.x - from.x);
  }
};

Rectangle box_of(const Mark& m, double share = 1) {
  const double radius = share * m.radius;
  return {m.x - radius, m.x + radius, m.y - radius, m.y + radius};
}

/// A place that a label may take.
struct Candidate {
  LabelPlace place;
  Rectangle box;
  Leader line;
  double cost;  ///< without the other labels
};

/// Labels are readable if they cost less.
constexpr double least_bad = line_on_one;

/// What is bad about two labels together.
double badness_of(const Candidate& a, const Candidate& b) {
  double cost = a.box.meets(b.box) ? on_another : 0;
  if (a.place.line && a.line.meets(b.box)) cost += line_on_one;
  if (b.place.line && b.line.meets(a.box)) cost += line_on_one;
  if (a.place.line && b.place.line && a.line.meets(b.line)) cost += lines_cross;
  return cost;
}

/// All places in the plot, the best beside the mark on the right. Without any, the first.
std::vector<Candidate> candidates_of(std::span<const Mark> marks, std::size_t of, double width,
                                     const Mark& size, std::span<const PlotSegment> lines) {
  const Mark& m = marks[of];
  std::vector<Candidate> all;
  const auto add = [&](const LabelPlace& p) {
    const Rectangle box{p.left, p.right, p.middle - line_height / 2, p.middle + line_height / 2};
    const bool inside = box.left >= 0 && box.right <= size.x && box.low >= 0 && box.high <= size.y;
    if (!inside && !all.empty()) return;
    const Leader line{{m, {p.anchor(), p.middle}}};
    double cost = inside ? 0 : on_another;
    if (p.line) cost += has_line + std::hypot(line.to.x - m.x, line.to.y - m.y);
    if (!p.line) cost += p.align == Align::left && p.middle == m.y ? 0 : p.middle == m.y ? 1 : 3;
    for (std::size_t i = 0; i < marks.size(); ++i) {
      const Rectangle mark = box_of(marks[i]);
      if (box.meets(mark)) cost += on_another;
      if (i != of && p.line && line.meets(box_of(marks[i], grazed)))
        cost += cover(m, marks[i]) ? line_in_stack : line_on_one;
    }
    for (const PlotSegment& each : lines)
      if (Leader{each}.meets(box)) cost += on_line;
    all.push_back({p, box, line, cost});
  };
  for (int up = -steps_off; up <= steps_off; ++up) {
    const double middle = m.y + line_height * up;
    const bool off = std::abs(up) > 1;
    for (const double out : steps_out) {
      const double farther = m.radius + gap + out + (up == 0 ? 0 : line_height);
      const bool line = up != 0 || out > 0;
      add({m.x + farther, m.x + farther + width, middle, Align::left, line});
      add({m.x - farther - width, m.x - farther, middle, Align::right, line});
    }
    if (up == 0) continue;
    add({m.x - width / 2, m.x + width / 2, middle, Align::centre, off});
    add({m.x - overhang, m.x - overhang + width, middle, Align::left, off});
    add({m.x + overhang - width, m.x + overhang, middle, Align::right, off});
  }
  return all;
}

/// Which places labels take.
class Choice {
 public:
  explicit Choice(std::vector<std::vector<Candidate>> candidates)
      : candidates_(std::move(candidates)), chosen_(candidates_.size()), order_(candidates_.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
  }

  /// Each label takes the best place that the others leave it, until no label moves. A move lessens the sum
  /// of all costs, so this ends.
  void settle() {
    bool moved = true;
    for (int round = 0; moved && round < most_rounds; ++round) {
      moved = false;
      for (const std::size_t i : order_) {
        double least = chosen_[i] == nullptr ? any : cost(i, *chosen_[i], any);
        for (const Candidate& candidate : candidates_[i]) {
          const double its = cost(i, candidate, least);
          if (its >= least) continue;
          least = its;
          chosen_[i] = &candidate;
          moved = true;
        }
      }
    }
  }

  /// The least readable label, if not all can be read.
  [[nodiscard]] std::optional<std::size_t> worst() const {
    std::optional<std::size_t> found;
    double most = least_bad;
    for (const std::size_t i : order_) {
      const double its = unreadable(i);
      if (its < most) continue;
      most = its;
      found = i;
    }
    return found;
  }

  /// All labels lose their places, and this one is the first to take one.
  void begin_with(std::size_t label) {
    std::fill(chosen_.begin(), chosen_.end(), nullptr);
    const auto at = std::find(order_.begin(), order_.end(), label);
    std::rotate(order_.begin(), at, at + 1);
  }

  void leave_out(std::size_t label) {
    std::erase(order_, label);
    chosen_[label] = nullptr;
  }

  [[nodiscard]] std::vector<LabelPlace> places() const {
    std::vector<LabelPlace> places;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      places.push_back((chosen_[i] == nullptr ? &candidates_[i].front() : chosen_[i])->place);
      places.back().clear = chosen_[i] != nullptr;
    }
    return places;
  }

 private:
  /// What keeps readers from a label or its mark; not lines that are long or cross.
  [[nodiscard]] double unreadable(std::size_t label) const {
    const auto if_bad = [](double cost) { return cost < least_bad ? 0 : cost; };
    double sum = if_bad(chosen_[label]->cost);
    for (std::size_t j = 0; j < chosen_.size(); ++j)
      if (j != label && chosen_[j] != nullptr) sum += if_bad(badness_of(*chosen_[label], *chosen_[j]));
    return sum;
  }

  static constexpr double any = std::numeric_limits<double>::infinity();

  [[nodiscard]] double cost(std::size_t label, const Candidate& candidate, double enough) const {
    double sum = candidate.cost;
    for (std::size_t j = 0; j < chosen_.size() && sum < enough; ++j)
      if (j != label && chosen_[j] != nullptr) sum += badness_of(candidate, *chosen_[j]);
    return sum;
  }

  std::vector<std::vector<Candidate>> candidates_;
  std::vector<const Candidate*> chosen_;
  std::vector<std::size_t> order_;  ///< of the labels that are in
};

}  // namespace

bool cover(const Mark& a, const Mark& b) {
  return box_of(a).meets(box_of(b));
}

double text_width(std::string_view text) {
  // Of DejaVu Sans, the widest font that is usual for sans-serif; in font sizes.
  double width = 0;
  for (const char c : text) {
    if ((static_cast<unsigned char>(c) & 0xC0U) == 0x80U) continue;  // of a letter that has begun
    const bool narrow = std::string_view("fijlrt/,.-:;'| ()").find(c) != std::string_view::npos;
    const bool wide = std::string_view("mwMW+%@=<>").find(c) != std::string_view::npos;
    width += narrow ? 0.42 : wide ? 1.0 : c >= 'A' && c <= 'Z' ? 0.8 : 0.64;
  }
  return font_size * width;
}

std::vector<LabelPlace> place_labels(std::span<const Mark> marks, std::span<const std::string> texts,
                                     Mark plot_size, std::span<const PlotSegment> lines) {
  std::vector<std::vector<Candidate>> candidates;
  for (std::size_t i = 0; i < texts.size(); ++i)
    candidates.push_back(candidates_of(marks, i, text_width(texts[i]), plot_size, lines));
  Choice choice(std::move(candidates));
  choice.settle();
  int tries = 0;
  for (std::optional<std::size_t> worst = choice.worst(); worst; worst = choice.worst()) {
    if (tries++ < most_tries) {
      choice.begin_with(*worst);
    } else {
      choice.leave_out(*worst);
    }
    choice.settle();
  }
  return choice.places();
}

}  // namespace hitpipe::cli
