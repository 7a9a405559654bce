#include "sim/core/recorded_answers.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "host/text.hpp"
#include "rays/world/int_triangle.hpp"
#include "sim/operands/number_file.hpp"

namespace hitpipe::sim {

namespace {

enum Column : std::size_t { hit, number, t, ray, query, failed, rays_in_flight };
const std::vector<std::string> needed{"hit", "number", "t"};
const std::vector<std::string> optional{
    "ray", "query", "failed",    "rays_in_flight", "face",       "distance", "w0",
    "w1",  "w2",    "exact_hit", "exact_number",   "exact_face", "exact_t",  "exact_distance"};

/// The rays that one core has answered.
struct Answered {
  std::vector<bool> rays;
  std::size_t count = 0;
};

class Reader {
 public:
  Reader(const std::string& file, std::span<const AskedRay> rays, const std::string& rays_file)
      : lines_(file, needed, optional), rays_(rays), rays_file_(rays_file), words_(lines_.columns()) {}

  std::vector<AnswerOfRay> all() {
    std::vector<AnswerOfRay> made;
    while (const std::optional<NumberLine> line = lines_.next()) {
      lines_.words(*line, words_);
      const std::size_t place = ray_of(*line);
      made.push_back({place, answer_of(*line)});
    }
    if (answered_.empty()) throw std::runtime_error(fmt::format("{}: holds no answer", lines_.name()));
    for (const auto& [core, answered] : answered_) {
      if (answered.count == rays_.size()) continue;
      const auto first = std::find(answered.rays.begin(), answered.rays.end(), false) - answered.rays.begin();
      throw std::runtime_error(
          fmt::format("{}: ray {} has no answer{}; each of the {} rays of {} needs one", lines_.name(), first,
                      core.empty() ? "" : " with rays_in_flight " + core, rays_.size(), rays_file_));
    }
    return made;
  }

 private:
  template <class Number>
  Number number_of(const NumberLine& line, Column column, Number least, Number most,
                   std::string_view more = "") {
    const auto value = host::number_in<Number>(words_[column]);
    if (!value || *value < least || *value > most)
      lines_.reject(
          line, fmt::format("{} is \"{}\"; allowed is a whole number from {} to {}{}", lines_.column(column),
                            host::shortened(words_[column]), least, most, more));
    return *value;
  }

  /// Counts the answer, too.
  std::size_t ray_of(const NumberLine& line) {
    Answered& answered = answered_[std::string(words_[rays_in_flight])];
    answered.rays.resize(rays_.size());
    std::size_t place = answered.count;
    if (!words_[ray].empty())
      place = number_of<std::size_t>(line, ray, 0, rays_.size() - 1, ", a ray of " + rays_file_);
    else if (place == rays_.size())
      lines_.reject(line, fmt::format("is one answer too many; {} has {} rays", rays_file_, rays_.size()));
    if (answered.rays[place])
      lines_.reject(line, fmt::format("ray {} has an answer already; allowed is one", place));
    answered.rays[place] = true;
    ++answered.count;
    const std::string_view asks = rays_[place].query == ref::Query::any ? "any" : "nearest";
    if (const std::string_view said = words_[query]; !said.empty() && said != asks)
      lines_.reject(line, fmt::format("query is \"{}\"; ray {} of {} asks for {}", host::shortened(said),
                                      place, rays_file_, asks));
    return place;
  }

  RecordedAnswer answer_of(const NumberLine& line) {
    RecordedAnswer answer;
    const std::string_view said = words_[hit];
    if (!said.empty() && said != "0" && said != "1")
      lines_.reject(line, fmt::format("hit is \"{}\"; allowed are 1, 0, and nothing where there is no answer",
                                      host::shortened(said)));
    if (!words_[failed].empty())
      answer.failed = static_cast<hls::Failure>(
          number_of<int>(line, failed, hls::not_failed, static_cast<int>(hls::failure_texts.size()) - 1));
    answer.given = !said.empty() && answer.failed == hls::not_failed;
    if (!answer.given || said == "0") return answer;
    answer.triangle = number_of<std::uint32_t>(line, number, 0, ref::IntHit::none - 1);
    if (words_[t].empty()) return answer;
    answer.t = host::number_in<std::int64_t>(words_[t]);
    if (!answer.t)
      lines_.reject(line, fmt::format("t is \"{}\"; allowed is a whole number, or nothing",
                                      host::shortened(words_[t])));
    return answer;
  }

  NumberFile lines_;
  std::span<const AskedRay> rays_;
  const std::string& rays_file_;
  std::vector<std::string_view> words_;       ///< of the line, by column
  std::map<std::string, Answered> answered_;  ///< by rays in flight
};

}  // namespace

std::vector<AnswerOfRay> read_recorded_answers(const std::string& file, std::span<const AskedRay> rays,
                                               const std::string& rays_file) {
  return Reader(file, rays, rays_file).all();
}

}  // namespace hitpipe::sim
