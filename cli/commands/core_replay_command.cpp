#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.hpp"
#include "cli/options/core_scene_options.hpp"
#include "cli/options/design_options.hpp"
#include "cli/options/values.hpp"
#include "cli/text/help.hpp"
#include "cli/text/progress.hpp"
#include "cli/text/table.hpp"
#include "rays/image/core_image.hpp"
#include "rays/world/int_ray.hpp"
#include "sim/core/recorded_answers.hpp"
#include "sim/core/replay.hpp"
#include "sim/operands/ray_list.hpp"
#include "sw_ref/core/image_scene.hpp"

namespace hitpipe::cli {

namespace {

struct ReplayCommand {
  std::string image;
  std::string rays;
  std::string answers;
  std::optional<std::string> bits;  ///< as the user wrote it
  int threads = 1;
  OutputFormat format = OutputFormat::text;
};

/// The first ones lead to the fault, and more would hide the counts.
constexpr std::size_t most_shown = 10;

/// An answer that is not good, with what is right.
struct BadAnswer {
  sim::AnswerOfRay answer;
  sim::RightAnswer right;
  sim::Judgement judgement;
};

struct Judged {
  std::map<std::pair<sim::Verdict, std::string_view>, std::uint64_t> counts;  ///< by verdict and reason
  std::uint64_t bad = 0;
  std::vector<BadAnswer> shown;  ///< the first bad ones
};

/// In the format that the user names. Without: n is the image's, the origins' grid is one bit finer, and S is n.
ref::IntScene scene_of(const ReplayCommand& command) {
  const ref::CoreImage image = read_core_image(command.image);
  hls::WorldBits bits;
  bits.coord = bits.slope = image.header.coord_bits;
  if (command.bits) bits = parse_bits<hls::WorldBits>(*command.bits);
  check_grid(image, bits, command.bits.value_or(""));
  return ref::image_scene(image, bits, std::filesystem::path(command.image).stem().string());
}

Judged judge_all(const ReplayCommand& command) {
  std::optional<Progress> progress("reading the image");
  const ref::IntScene scene = scene_of(command);
  const std::vector<sim::AskedRay> rays = sim::read_ray_list(command.rays, scene.scene.to_cube);
  const std::vector<sim::AnswerOfRay> answers =
      sim::read_recorded_answers(command.answers, rays, command.rays);
  progress.emplace("judging");
  const std::vector<sim::RightAnswer> right =
      sim::right_answers(scene, rays, command.threads, [&](double share) { progress->show(share); });
  Judged judged;
  for (std::size_t verdict = 0; verdict + 1 < sim::verdict_names.size(); ++verdict)
    judged.counts[{static_cast<sim::Verdict>(verdict), {}}] = 0;
  for (const sim::AnswerOfRay& each : answers) {
    const sim::AskedRay& asked = rays[each.ray];
    const sim::Judgement judgement =
        sim::judge(scene, ref::int_ray(asked.ray, scene.bits), asked.query, each.answer, right[each.ray]);
    ++judged.counts[{judgement.verdict, judgement.reason}];
    if (judgement.good()) continue;
    ++judged.bad;
    if (judged.shown.size() < most_shown) judged.shown.push_back({each, right[each.ray], judgement});
  }
  return judged;
}

std::string name_of(sim::Verdict verdict) {
  return std::string(sim::verdict_names[static_cast<std::size_t>(verdict)]);
}

template <class Number>
Row cell(const std::optional<Number>& number) {
  return number ? Row(*number) : Row();
}

Row row_of(const BadAnswer& bad) {
  const auto& [given, right, judgement] = bad;
  return {{"ray", given.ray},
          {"verdict", name_of(judgement.verdict)},
          {"number", cell(given.answer.triangle)},
          {"t", cell(given.answer.t)},
          {"right_number", cell(right.triangle)},
          {"right_t", right.triangle ? Row(right.t) : Row()}};
}

/// Numbers without commas, because they are names, and nothing where there is none.
std::string bad_answers_text(const std::vector<Row>& rows) {
  std::vector<std::vector<Cell>> lines(1);
  for (const auto& [key, value] : rows.front().items()) lines[0].push_back({key, key != "verdict"});
  for (const Row& row : rows) {
    std::vector<Cell>& line = lines.emplace_back();
    for (const Row& value : row)
      line.push_back({value.is_null()     ? ""
                      : value.is_string() ? value.get<std::string>()
                                          : value.dump(),
                      !value.is_string()});
  }
  return aligned(lines);
}

void print_judged(const Judged& judged, OutputFormat format) {
  std::vector<Row> counts, shown;
  for (const auto& [judgement, count] : judged.counts)
    counts.push_back(
        {{"verdict", name_of(judgement.first)}, {"answers", count}, {"reason", judgement.second}});
  for (const BadAnswer& each : judged.shown) shown.push_back(row_of(each));
  if (format == OutputFormat::json) {
    for (std::size_t i = 0; i < shown.size(); ++i)  // too wide for text
      shown[i]["reason"] = judged.shown[i].judgement.reason;
    fmt::print("{}", record_text({{"verdicts", counts}, {"bad_answers", shown}}, format));
    return;
  }
  fmt::print("{}", table_text(counts, format));
  if (format == OutputFormat::text && !shown.empty())
    fmt::print("\n{} of {} bad answers:\n{}", shown.size(), judged.bad, bad_answers_text(shown));
}

int replay(const ReplayCommand& command) {
  const Judged judged = judge_all(command);
  print_judged(judged, command.format);
  return judged.bad == 0 ? 0 : 1;
}

}  // namespace

CLI::App* add_core_replay_command(CLI::App& core, int& exit_code) {
  CLI::App* const command =
      core.add_subcommand("replay", "Judge answers that were recorded: a board's, another tracer's");
  const auto options = std::make_shared<ReplayCommand>();
  options->threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  as_input(command->add_option("image", options->image, "The image of `core image` that was traced"))
      ->required()
      ->type_name("FILE");
  as_input(command->add_option("--rays", options->rays,
                               "The rays that were asked: .bin or .rays, or CSV with the columns "
                               "ox,oy,oz,dx,dy,dz[,length,any]. They must begin in the image's cube"))
      ->required()
      ->type_name("FILE");
  as_input(command->add_option("--answers", options->answers,
                               "Their answers: CSV with the columns hit,number,t[,ray,query,failed], or as "
                               "`core trace --answers` writes it"))
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--bits", options->bits,
                   "Format of the integer world, n+gsS. n is the image's, and the default n+1sn")
      ->type_name("FORMAT");
  add_count_option(*command, "--threads", options->threads, {1, 1024},
                   "Number of threads; results do not depend on it")
      ->capture_default_str();
  add_format_option(*command, options->format);
  add_examples(*command, {"hitpipe core replay spheres.bin --rays rays.csv --answers answers.csv",
                          "hitpipe core replay a.bin --bits 16+1s16 --rays a.csv --answers b.csv"});
  command->callback([options, &exit_code] { exit_code = replay(*options); });
  return command;
}

}  // namespace hitpipe::cli
