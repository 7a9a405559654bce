#include "sim/operands/operands.hpp"

#include <algorithm>
#include <exception>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "host/parallel.hpp"

namespace hitpipe::sim {

namespace {

// A thread's work at a time. Its text is kept until the text of the earlier tests is written.
constexpr std::size_t tests_per_part = 1024;

struct Numbered {
  NumberLine line;
  std::uint64_t number = 0;  ///< of the ray or box, from 1
};

struct KeptBoxes {
  Boxes boxes;
  std::uint64_t line;
};

/// Rays with a box each, or with some of the kept boxes.
struct Part {
  std::vector<Numbered> rays;
  std::vector<Numbered> boxes;
  std::size_t first_kept = 0;
  std::size_t end_kept = 0;
};

/// Cuts the tests into parts.
class Parts {
 public:
  Parts(const OperandFiles& files, RayFile& rays, BoxFile& boxes)
      : all_pairs_(files.all_pairs), rays_(rays), boxes_(boxes) {
    while (all_pairs_) {
      const auto line = boxes_.lines().next();
      if (!line) break;
      kept_.push_back({boxes_.boxes(*line), line->number});
    }
    if (all_pairs_ && kept_.empty()) no_numbers(boxes_.lines());
  }

  [[nodiscard]] const std::vector<KeptBoxes>& kept() const { return kept_; }

  /// Nothing when all tests have been given.
  [[nodiscard]] std::optional<Part> next() {
    Part part = all_pairs_ ? with_kept() : line_by_line();
    if (!part.rays.empty()) return part;
    if (number_ == 0) no_numbers(rays_.lines());
    return std::nullopt;
  }

 private:
  [[noreturn]] static void no_numbers(const NumberFile& file) {
    throw std::runtime_error(fmt::format("{}: there is no line below the names of the columns", file.name()));
  }

  Part line_by_line() {
    Part part;
    while (part.rays.size() < tests_per_part) {
      auto ray = rays_.lines().next();
      auto box = boxes_.lines().next();
      if (ray.has_value() != box.has_value()) {
        const NumberFile& longer = ray ? rays_.lines() : boxes_.lines();
        const NumberFile& shorter = ray ? boxes_.lines() : rays_.lines();
        longer.reject(
            ray ? *ray : *box,
            fmt::format("{} has no line for it, only {}; line i of the one file is tested with line i of the "
                        "other, or all with all",
                        shorter.name(), number_));
      }
      if (!ray) break;
      ++number_;
      part.rays.push_back({*std::move(ray), number_});
      part.boxes.push_back({*std::move(box), number_});
    }
    return part;
  }

  Part with_kept() {
    Part part;
    if (first_kept_ > 0) {
      part.rays.push_back(last_);
    } else {
      while (part.rays.empty() || (part.rays.size() + 1) * kept_.size() <= tests_per_part) {
        auto ray = rays_.lines().next();
        if (!ray) break;
        part.rays.push_back({*std::move(ray), ++number_});
      }
    }
    if (part.rays.empty()) return part;
    last_ = part.rays.back();
    part.first_kept = first_kept_;
    part.end_kept = std::min(first_kept_ + tests_per_part, kept_.size());
    first_kept_ = part.end_kept == kept_.size() ? 0 : part.end_kept;
    return part;
  }

  bool all_pairs_;
  RayFile& rays_;
  BoxFile& boxes_;
  std::vector<KeptBoxes> kept_;
  std::uint64_t number_ = 0;    ///< of the last ray
  std::size_t first_kept_ = 0;  ///< where the last ray goes on
  Numbered last_;
};

/// Answers tests and writes them down.
class Answers {
 public:
  Answers(BoxTest& test, const TestLayout& layout) : test_(test), layout_(layout) {}

  void start(const ref::Ray& ray, const Numbered& place) {
    judged_.ray = ray;
    judged_.ray_number = place.number;
    line_.ray_line = place.line.number;
    test_.start(ray);
  }
  void answer(const Boxes& boxes, std::uint64_t number, std::uint64_t line) {
    judged_.boxes = boxes;
    judged_.box_number = number;
    line_.box_line = line;
    const bool pair = layout_.boxes_per_test() > 1;
    const std::array<bool, 2> hits =
        pair ? test_.siblings(boxes[0], boxes[1]) : std::array<bool, 2>{test_.hit(boxes[0]), false};
    ++counts_.tests;
    for (std::size_t box = 0; box < layout_.boxes_per_test(); ++box) {
      judged_.exact[box] = test_.meets(judged_.ray, boxes[box]);
      count(hits[box], judged_.exact[box]);
    }
    judged_.operands = test_.operands();
    judged_.results = test_.results();
    judged_.of_parent = pair && !layout_.reports(judged_.results, hits);
    if (layout_.form() == TestForm::hex) {
      vectors_.push_back({{judged_.operands.begin(), judged_.operands.end()},
                          {judged_.results.begin(), judged_.results.end()}});
    } else {
      layout_.append(judged_, text_);
    }
  }
  [[nodiscard]] std::string take_text() {
    if (layout_.form() == TestForm::hex) text_ = layout_.vectors(std::exchange(vectors_, {}));
    return std::exchange(text_, {});
  }
  [[nodiscard]] OperandCounts take_counts() { return std::exchange(counts_, {}); }

 private:
  void count(bool hit, bool exact) {
    counts_.hits += hit ? 1 : 0;
    counts_.exact_hits += exact ? 1 : 0;
    counts_.false_hits += hit && !exact ? 1 : 0;
    if (hit || !exact) return;
    ++counts_.false_misses;
    if (!counts_.false_miss) counts_.false_miss = line_;
  }

  BoxTest& test_;
  const TestLayout& layout_;
  JudgedTest judged_;
  OperandCounts::Place line_{};
  std::vector<rtl::Vector> vectors_;
  std::string text_;
  OperandCounts counts_;
};

/// A thread's place: a unit of its own, and a part with its outcome.
struct Slot {
  std::unique_ptr<BoxTest> test;
  Part part;
  std::string text;
  OperandCounts counts;
  std::exception_ptr failure;
};

void run(Slot& slot, const TestLayout& layout, const RayFile& rays, const BoxFile& boxes,
         const std::vector<KeptBoxes>& kept) {
  Answers answers(*slot.test, layout);
  try {
    for (std::size_t i = 0; i < slot.part.rays.size(); ++i) {
      answers.start(rays.ray(slot.part.rays[i].line), slot.part.rays[i]);
      if (!slot.part.boxes.empty()) {
        const Numbered& box = slot.part.boxes[i];
        answers.answer(boxes.boxes(box.line), box.number, box.line.number);
      }
      for (std::size_t k = slot.part.first_kept; k < slot.part.end_kept; ++k)
        answers.answer(kept[k].boxes, k + 1, kept[k].line);
    }
  } catch (...) {
    slot.failure = std::current_exception();
  }
  slot.text = answers.take_text();
  slot.counts = answers.take_counts();
}

}  // namespace

OperandCounts& OperandCounts::operator+=(const OperandCounts& later) {
  tests += later.tests;
  hits += later.hits;
  exact_hits += later.exact_hits;
  false_hits += later.false_hits;
  false_misses += later.false_misses;
  if (!false_miss) false_miss = later.false_miss;
  return *this;
}

OperandCounts write_operands(const MakeBoxTest& make, const TestLayout& layout, const OperandOptions& options,
                             const std::function<void(std::string_view)>& write) {
  RayFile rays(options.files.rays, options.placement);
  BoxFile boxes(options.files.boxes, options.placement, layout.boxes_per_test());
  Parts parts(options.files, rays, boxes);
  std::vector<Slot> slots(2 * static_cast<std::size_t>(std::max(1, options.threads)));
  for (Slot& slot : slots) slot.test = make();
  write(layout.head());
  OperandCounts counts;
  std::exception_ptr unreadable;
  for (bool more = true; more;) {
    std::size_t filled = 0;
    try {
      while (filled < slots.size()) {
        std::optional<Part> part = parts.next();
        if (!part) break;
        slots[filled++].part = *std::move(part);
      }
    } catch (...) {
      unreadable = std::current_exception();  // unless an earlier line is bad
    }
    more = filled == slots.size();
    host::for_each_index(filled, options.threads,
                         [&](std::size_t i) { run(slots[i], layout, rays, boxes, parts.kept()); });
    for (std::size_t i = 0; i < filled; ++i) {
      if (slots[i].failure) std::rethrow_exception(slots[i].failure);
      write(slots[i].text);
      counts += slots[i].counts;
    }
    if (unreadable) std::rethrow_exception(unreadable);
    if (const auto share = rays.lines().share()) options.progress(*share);
  }
  return counts;
}

}  // namespace hitpipe::sim
