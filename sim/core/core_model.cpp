#include "sim/core/core_model.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "hls/machines/best_hits.hpp"
#include "hls/machines/reader.hpp"
#include "hls/machines/walk_format.hpp"
#include "hls/world/core_format.hpp"
#include "rtl_gen/core/wires.hpp"
#include "rtl_gen/machine/machine.hpp"
#include "sw_ref/trace/int_major_pair.hpp"
#include "sw_ref/world/int_tracer.hpp"

namespace hitpipe::sim {

namespace core_parts {

using rtl::Word;

int ray_bits_of(const CoreModelOptions& options) {
  return std::max(1, hls::count_bits(options.rays));
}

void check_options(const ref::CoreImage& image, const CoreModelOptions& options) {
  ref::check_box_format(options.world, options.boxes);
  const auto check = [](const char* what, std::int64_t value, std::int64_t least, std::int64_t most) {
    if (value < least || value > most)
      throw std::invalid_argument(fmt::format("{} {}: allowed is {} to {}", what, value, least, most));
  };
  check("rays in flight", options.rays, 1, 256);
  check("bits of places on a stack", options.stack_bits, 1, 6);
  check("levels", options.levels, 2, ref::CoreImage::most_levels);
  check("bits of a block's number", options.address_bits, 4, 32);
  check("steps of a ray", options.most_steps, 1, hls::low_mask(hls::step_count_bits));
  check("cycles from ray to ray", options.door_interval, 1, 10'000);
  check("cycles of a pair test", options.pair_latency, 1, 10'000);
  check("cycles of a triangle test", options.triangle_latency, 1, 10'000);
  check("cycles from triangle to triangle", options.triangle_interval, 1, 10'000);
  check("blocks of the image", static_cast<std::int64_t>(image.blocks.size()), 1,
        std::int64_t{1} << options.address_bits);
}

/// A machine with the words on its ports.
class Node {
 public:
  Node(const char* name, const rtl::Format& format) : native_(rtl::machine_called(name)->native(format)) {
    const rtl::MachineGraph graph = rtl::machine_called(name)->graph(format);
    for (const hls::Field& field : graph.inputs) input_places_.emplace(field.name, input_places_.size());
    for (const hls::Field& field : graph.outputs) output_places_.emplace(field.name, output_places_.size());
    inputs_.resize(input_places_.size());
    outputs_.resize(output_places_.size());
  }

  /// They stay where they are.
  [[nodiscard]] Word& input(std::string_view name) { return inputs_[input_places_.at(std::string(name))]; }
  [[nodiscard]] const Word& output(std::string_view name) const {
    return outputs_[output_places_.at(std::string(name))];
  }
  void give() { native_->outputs(outputs_.data()); }
  void step(bool reset) { native_->step(inputs_.data(), reset); }

 private:
  std::unique_ptr<rtl::NativeMachine> native_;
  std::map<std::string, std::size_t> input_places_, output_places_;
  std::vector<Word> inputs_, outputs_;
};

/// Results on their way through a pipeline.
template <class Result>
class Pipe {
 public:
  void enter(std::uint64_t due, const Result& result) { waiting_.emplace_back(due, result); }
  [[nodiscard]] std::optional<Result> leave(std::uint64_t now) {
    if (waiting_.empty() || waiting_.front().first > now) return std::nullopt;
    const Result result = waiting_.front().second;
    waiting_.pop_front();
    return result;
  }

 private:
  std::deque<std::pair<std::uint64_t, Result>> waiting_;
};

struct PairResult {
  std::uint32_t ray;
  ref::PairAnswer boxes;
};
struct TriangleResult {
  std::uint32_t ray;
  std::optional<std::int64_t> t;
};

/// What the core's door keeps of a ray in flight.
struct InFlight {
  std::size_t job = 0;
  ref::IntRay endless;  ///< with the greatest length: the unit does not know the ray's
  std::optional<ref::MajorDistances> distances;
  ref::RayInterval interval;  ///< in the record that it reads
};

constexpr std::uint32_t triangle_tag = 1U << 31;
constexpr std::uint64_t longest_silence = 10'000'000;

class Machines {
 public:
  Machines(const ref::CoreImage& image, const CoreModelOptions& options, const MemoryOptions& memory)
      : options_(options),
        ray_bits_(ray_bits_of(options)),
        walker_("walker", hls::WalkBits{options.boxes.length(), options.address_bits, options.levels,
                                        options.stack_bits, ray_bits_}),
        reader_("reader", hls::ReaderBits{options.address_bits, ray_bits_}),
        best_hits_("best_hits",
                   hls::BestBits{options.world.distance(),
                                 options.world.finer + options.world.fraction - options.boxes.fraction,
                                 options.boxes.length(), ray_bits_}),
        divider_("divider", hls::CoreBits{options.world, ray_bits_}),
        memory_(image.blocks, memory),
        rays_(static_cast<std::size_t>(options.rays)) {
    const std::map<std::string_view, Node*> nodes{
        {"walker", &walker_}, {"reader", &reader_}, {"best_hits", &best_hits_}, {"divider", &divider_}};
    for (const rtl::Wire& wire : rtl::core_wires)
      wires_.emplace_back(&nodes.at(wire.from)->output(wire.output), &nodes.at(wire.to)->input(wire.input));
    for (std::uint32_t ray = 0; ray < rays_.size(); ++ray) free_.push_back(ray);
    walker_.input("most_steps") = options.most_steps;
    reader_.input("last") = image.blocks.size() - 1;
    for (Node* node : {&walker_, &reader_, &best_hits_, &divider_}) node->step(true);
  }

  void run(std::span<const CoreJob> jobs, std::span<CoreAnswer> answers,
           const std::function<void(double)>& progress) {
    std::size_t next = 0, ended = 0;
    std::uint64_t silent = 0;
    while (ended < jobs.size()) {
      for (Node* node : nodes()) node->give();
      for (const auto& [from, to] : wires_) *to = *from;
      offer_ray(jobs, next);
      go();
      ask();
      take_block();
      test();
      if (best_answers_ != 0) {
        take_answer(answers);
        ++ended;
        silent = 0;
        if (progress && ended % 4096 == 0)
          progress(static_cast<double>(ended) / static_cast<double>(jobs.size()));
      } else if (++silent > longest_silence) {
        throw std::logic_error("the core gives no answers");
      }
      for (Node* node : nodes()) node->step(false);
      answer_ = memory_.step();
      ++now_;
    }
    counts_.cycles = now_;
  }

  [[nodiscard]] const CoreCounts& counts() const { return counts_; }
  [[nodiscard]] const MemoryCounts& memory_counts() const { return memory_.counts(); }

 private:
  [[nodiscard]] std::array<Node*, 4> nodes() { return {&walker_, &reader_, &best_hits_, &divider_}; }

  void offer_ray(std::span<const CoreJob> jobs, std::size_t& next) {
    const bool offers = next < jobs.size() && !free_.empty() && now_ >= door_open_;
    new_ray_ = offers ? 1 : 0;
    if (!offers) return;
    const std::uint32_t ray = free_.front();
    const CoreJob& job = jobs[next];
    begun_ = ray;
    length_ = static_cast<Word>(job.ray.length);
    any_ = job.any ? 1 : 0;
    if (best_takes_ == 0) return;
    free_.pop_front();
    InFlight& flight = rays_[ray];
    flight.job = next++;
    flight.endless = job.ray;
    flight.endless.length = options_.world.largest_distance();
    flight.distances.emplace(ref::major_ray(job.ray, options_.boxes), options_.boxes);
    door_open_ = now_ + static_cast<std::uint64_t>(options_.door_interval);
    ++counts_.rays;
  }

  /// A unit gets the interval with the record, so it is kept until that comes.
  void go() {
    if (walker_goes_ == 0) return;
    rays_[static_cast<std::size_t>(walker_of_)].interval = {static_cast<std::int64_t>(walker_near_),
                                                            static_cast<std::int64_t>(walker_far_)};
  }

  void ask() {
    const bool asks = reader_asks_ != 0;
    const bool granted = asks && memory_.ready();
    granted_ = granted ? 1 : 0;
    counts_.idle += asks ? 0 : 1;
    counts_.refused += asks && !granted ? 1 : 0;
    if (!granted) return;
    const bool triangle = reader_triangle_ != 0;
    memory_.ask(static_cast<std::uint32_t>(reader_wanted_),
                static_cast<std::uint32_t>(reader_asker_) | (triangle ? triangle_tag : 0));
    ++(triangle ? counts_.triangles : counts_.records);
  }

  void take_block() {
    reads_record_ = reads_triangle_ = 0;
    if (!answer_) return;
    const std::uint32_t ray = answer_->tag & ~triangle_tag;
    const InFlight& flight = rays_[ray];
    if ((answer_->tag & triangle_tag) != 0) {
      const ref::CoreTriangle triangle = ref::triangle_of(answer_->block);
      reads_triangle_ = 1;
      triangle_reader_ = ray;
      number_ = triangle.number;
      const auto crossing = ref::int_crossing(flight.endless, triangle.triangle, options_.world);
      triangles_waiting_.push_back({ray, crossing ? std::optional(crossing->t) : std::nullopt});
      return;
    }
    const ref::CoreRecord record = ref::record_of(answer_->block);
    const auto count = [&](std::size_t child) -> Word {
      const std::int32_t own = record.counts[child];
      if (own == ref::PairChild::none) return 0;
      return own == ref::PairChild::branch ? (1U << hls::child_count_bits) - 1 : static_cast<Word>(own);
    };
    reads_record_ = 1;
    record_reader_ = ray;
    block_ = record.pointer;
    count_0_ = count(0);
    count_1_ = count(1);
    pairs_.enter(now_ + static_cast<std::uint64_t>(options_.pair_latency),
                 {ray, ref::test_pair(*flight.distances, record.boxes, flight.interval)});
  }

  /// The results of both units.
  void test() {
    const Word mask = hls::low_mask(options_.boxes.length());
    tested_ = 0;
    if (const auto pair = pairs_.leave(now_)) {
      const auto of = [&](std::int64_t t) { return static_cast<Word>(t) & mask; };
      tested_ = 1;
      tested_ray_ = pair->ray;
      hit_0_ = pair->boxes.hit[0] ? 1 : 0;
      hit_1_ = pair->boxes.hit[1] ? 1 : 0;
      near_0_ = of(pair->boxes.interval[0].near);
      far_0_ = of(pair->boxes.interval[0].far);
      near_1_ = of(pair->boxes.interval[1].near);
      far_1_ = of(pair->boxes.interval[1].far);
      second_first_ = pair->boxes.second_first ? 1 : 0;
    }
    if (!triangles_waiting_.empty() && now_ >= triangle_free_) {
      triangles_.enter(now_ + static_cast<std::uint64_t>(options_.triangle_latency),
                       triangles_waiting_.front());
      triangles_waiting_.pop_front();
      triangle_free_ = now_ + static_cast<std::uint64_t>(options_.triangle_interval);
    }
    divides_ = miss_ = 0;
    const auto triangle = triangles_.leave(now_);
    if (!triangle) return;
    if (!triangle->t) {
      miss_ = 1;
      misser_ = triangle->ray;
      return;
    }
    // det = 2^(S+F) and num = T make this T.
    const int scale = options_.world.slope + options_.world.fraction;
    const auto halves = [](Word x, int width, Word& high, Word& low) {
      high = x >> (width / 2);
      low = x & hls::low_mask(width / 2);
    };
    divides_ = 1;
    divided_ray_ = triangle->ray;
    halves(Word{1} << scale, options_.world.determinant(), det_high_, det_low_);
    halves(static_cast<Word>(*triangle->t), options_.world.volume(), num_high_, num_low_);
    ++counts_.hits;
  }

  void take_answer(std::span<CoreAnswer> answers) {
    const auto ray = static_cast<std::uint32_t>(best_answered_);
    const std::size_t job = rays_[ray].job;
    answers[job] = {.hit = {.triangle = static_cast<std::uint32_t>(best_number_),
                            .t = static_cast<std::int64_t>(best_t_)},
                    .failed = best_failed_ != 0};
    counts_.failed += answers[job].failed ? 1 : 0;
    free_.push_back(ray);
  }

  CoreModelOptions options_;
  int ray_bits_;
  Node walker_, reader_, best_hits_, divider_;
  MemoryModel memory_;
  std::vector<InFlight> rays_;
  std::deque<std::uint32_t> free_;
  std::vector<std::pair<const Word*, Word*>> wires_;
  std::optional<MemoryAnswer> answer_;
  Pipe<PairResult> pairs_;
  Pipe<TriangleResult> triangles_;
  std::deque<TriangleResult> triangles_waiting_;
  std::uint64_t now_ = 0, door_open_ = 0, triangle_free_ = 0;
  CoreCounts counts_;

  // Ports that no machine is wired to.
  const Word &walker_goes_ = walker_.output("goes"), &walker_of_ = walker_.output("of"),
             &walker_near_ = walker_.output("enters_at"), &walker_far_ = walker_.output("leaves_at");
  Word &reads_record_ = walker_.input("reads"), &record_reader_ = walker_.input("read_ray"),
       &block_ = walker_.input("block"), &count_0_ = walker_.input("count_0"),
       &count_1_ = walker_.input("count_1"), &tested_ = walker_.input("tested"),
       &tested_ray_ = walker_.input("ray"), &hit_0_ = walker_.input("hit_0"),
       &hit_1_ = walker_.input("hit_1"), &second_first_ = walker_.input("second_first"),
       &near_0_ = walker_.input("near_0"), &far_0_ = walker_.input("far_0"),
       &near_1_ = walker_.input("near_1"), &far_1_ = walker_.input("far_1");
  const Word &reader_asks_ = reader_.output("asks"), &reader_wanted_ = reader_.output("wanted"),
             &reader_asker_ = reader_.output("asker"), &reader_triangle_ = reader_.output("triangle");
  Word &granted_ = reader_.input("granted"), &miss_ = reader_.input("miss"),
       &misser_ = reader_.input("misser");
  const Word &best_takes_ = best_hits_.output("takes"), &best_answers_ = best_hits_.output("answers"),
             &best_answered_ = best_hits_.output("answered"), &best_t_ = best_hits_.output("answer_t"),
             &best_number_ = best_hits_.output("answer_number"),
             &best_failed_ = best_hits_.output("answer_failed");
  Word &new_ray_ = best_hits_.input("new_ray"), &begun_ = best_hits_.input("begun"),
       &length_ = best_hits_.input("length"), &any_ = best_hits_.input("any"),
       &reads_triangle_ = best_hits_.input("reads"), &triangle_reader_ = best_hits_.input("read_ray"),
       &number_ = best_hits_.input("number");
  Word &divides_ = divider_.input("hit"), &divided_ray_ = divider_.input("ray"),
       &det_high_ = divider_.input("det_high"), &det_low_ = divider_.input("det_low"),
       &num_high_ = divider_.input("num_high"), &num_low_ = divider_.input("num_low");
};

}  // namespace core_parts

CoreModel::CoreModel(const ref::CoreImage& image, const CoreModelOptions& options,
                     const MemoryOptions& memory) {
  core_parts::check_options(image, options);
  machines_ = std::make_unique<core_parts::Machines>(image, options, memory);
}
CoreModel::~CoreModel() = default;

void CoreModel::run(std::span<const CoreJob> jobs, std::span<CoreAnswer> answers,
                    const std::function<void(double)>& progress) {
  machines_->run(jobs, answers, progress);
}
const CoreCounts& CoreModel::counts() const {
  return machines_->counts();
}
const MemoryCounts& CoreModel::memory_counts() const {
  return machines_->memory_counts();
}

}  // namespace hitpipe::sim
