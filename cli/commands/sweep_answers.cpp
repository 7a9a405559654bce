#include "cli/commands/sweep_answers.hpp"

#include <memory>

#include <fmt/format.h>

#include "sim/operands/traced_list.hpp"

namespace hitpipe::cli {

SweepAnswers::SweepAnswers(const std::string& file, sim::SweepOptions& options)
    : file_(file, {"design", "bits", "rays_in_flight", "ii"}) {
  if (!wanted()) return;
  options.answered = [this](const sim::SweepPoint& point, std::span<const std::uint32_t> triangles) {
    found_.insert({sim::key_of(point), {point, {triangles.begin(), triangles.end()}}});
  };
}

void SweepAnswers::write(const ref::Scene& scene, const ref::Bvh& bvh, const sim::SweepOptions& options,
                         const Row& notes) {
  const std::unique_ptr<ref::Tracer> reference = ref::make_tracer(scene.mesh, bvh, {});
  const sim::TracedList exact = sim::trace_list(*reference, options.rays, options.threads);
  for (const auto& entry : found_) {
    const sim::SweepPoint& point = entry.second.first;
    const std::vector<std::uint32_t>& triangles = entry.second.second;
    const std::vector<std::string> unit{std::string(point.design->name), to_string(point.format),
                                        fmt::format("{}", point.rays_in_flight),
                                        fmt::format("{}", point.interval)};
    file_.add(unit, options.rays, [&](std::size_t ray) {
      return sim::answer_of(scene, options.rays[ray], triangles[ray], exact.triangles[ray]);
    });
  }
  file_.finish(notes);
}

}  // namespace hitpipe::cli
