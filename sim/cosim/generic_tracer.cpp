#include "sim/cosim/generic_tracer.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "sim/cosim/walk.hpp"
#include "sim/software/step_feed.hpp"

namespace hitpipe::sim {

namespace {

class GenericTracer final : public ref::Tracer {
 public:
  GenericTracer(const rtl::Design& design, const TracedUnit& unit, const ref::Mesh& mesh, const ref::Bvh& bvh)
      : feed_(make_feed(design, unit.format, bvh, unit.coarse)),
        evaluate_(design.evaluate(unit.format)),
        results_(design.results(unit.format)),
        operand_count_(design.ports(unit.format).size()),
        scene_{feed_.get(), &bvh, &mesh},
        bytes_per_node_(sim::bytes_per_node(design, unit.format, unit.coarse)) {
    if (unit.ends) return;
    feed_ = with_step(std::move(feed_), endless_step(design.ports(unit.format)));
    scene_.feed = feed_.get();
  }

  void trace(const ref::TraceJob& job, ref::TraceCounts& counts) const override {
    ref::check_places(job);
    with_walk(scene_, results_, [&](const auto& walk) { trace(walk, job, counts); });
  }
  [[nodiscard]] std::size_t bytes_per_node() const override { return bytes_per_node_; }
  [[nodiscard]] std::size_t node_count() const override { return scene_.bvh->nodes.size(); }

 private:
  template <class Walk>
  void trace(const Walk& walk, const ref::TraceJob& job, ref::TraceCounts& counts) const {
    constexpr std::size_t slot = 0;
    const std::unique_ptr<RayFeed> rays = feed_->unit(1);
    std::vector<std::int64_t> operands(operand_count_);
    std::vector<std::int64_t> results(results_.size());
    for (std::size_t i = 0; i < job.rays.size(); ++i) {
      typename Walk::Traversal traversal =
          walk.start(*rays, slot, job.rays[i], job.query, ref::Loads{job.loads});
      while (!traversal.done()) {
        Walk::ask(*rays, slot, traversal, operands.data());
        evaluate_(operands.data(), results.data());
        walk.answer(*rays, slot, traversal, results.data());
      }
      job.triangles[i] = traversal.hit().triangle;
      if (!job.work.empty()) job.work[i] = traversal.counts();
      counts += traversal.counts();
    }
  }

  std::unique_ptr<SceneFeed> feed_;
  rtl::Evaluate evaluate_;
  std::vector<hls::Result> results_;
  std::size_t operand_count_;
  WalkScene scene_;
  std::size_t bytes_per_node_;
};

}  // namespace

std::unique_ptr<ref::Tracer> generic_tracer(const rtl::Design& design, const TracedUnit& unit,
                                            const ref::Mesh& mesh, const ref::Bvh& bvh) {
  return std::make_unique<GenericTracer>(design, unit, mesh, bvh);
}

std::unique_ptr<ref::Tracer> make_tracer(const rtl::Design& design, const TracedUnit& unit,
                                         const ref::Mesh& mesh, const ref::Bvh& bvh) {
  const Software& software = software_of(design);
  return software.tracer == nullptr ? generic_tracer(design, unit, mesh, bvh)
                                    : software.tracer(unit, mesh, bvh);
}

std::size_t bytes_per_node(const rtl::Design& design, const Format& format, const ref::CoarseAxes& coarse) {
  if (const auto own = software_of(design).bytes_per_node; own != nullptr) return own(format, coarse);
  std::size_t bits = 0;
  for (const rtl::Port& port : design.ports(format)) {
    if (port.role != hls::Role::plane_low && port.role != hls::Role::plane_high) continue;
    bits += static_cast<std::size_t>(
        port.width -
        coarse.dropped[static_cast<std::size_t>(port.axis) - static_cast<std::size_t>(hls::Axis::x)]);
  }
  return (bits + 7) / 8 + sizeof(ref::BvhNode::count) + sizeof(ref::BvhNode::first);
}

}  // namespace hitpipe::sim
