#include "sw_ref/trace/int_major_pair.hpp"
#include "sw_ref/trace/tracer_kinds.hpp"

namespace hitpipe::ref {

namespace {

class MajorPairTracer final : public Tracer {
 public:
  explicit MajorPairTracer(const TracerParts& parts)
      : bits_(parts.options.major_bits),
        records_(parts.bvh, bits_.coord, bits_.finer),
        scene_{&records_, &parts.mesh, parts.bvh.order, &leaf_test(parts.options.triangle_test)} {}

  void trace(const TraceJob& job, TraceCounts& counts) const override {
    check_places(job);
    counts.rays += job.rays.size();
    for (std::size_t i = 0; i < job.rays.size(); ++i) {
      const Ray& ray = job.rays[i];
      const IntMajorRaySetup set_up(ray, bits_);
      const MajorDistances distances(set_up, bits_);
      const auto in_results = [&](float length) { return set_up.length(length); };
      PairTraversal traversal(scene_, ray, job.query, set_up.length(ray.length));
      while (!traversal.done()) {
        ++counts.nodes_loaded;
        traversal.answer(test_pair(distances, records_.boxes(traversal.record()), traversal.parent()),
                         in_results);
      }
      job.triangles[i] = traversal.hit().triangle;
      const auto [box_tests, triangle_tests] = traversal.counts();
      if (!job.work.empty())
        job.work[i] = {static_cast<std::uint32_t>(box_tests), static_cast<std::uint32_t>(triangle_tests)};
      counts.box_tests += box_tests;
      counts.triangle_tests += triangle_tests;
      counts.triangles_loaded += triangle_tests;
    }
  }

  [[nodiscard]] std::size_t bytes_per_node() const override { return records_.bytes_per_record; }
  [[nodiscard]] std::size_t node_count() const override { return records_.size(); }

 private:
  hls::MajorBits bits_;
  PairNodes records_;
  PairScene<PairNodes> scene_;
};

}  // namespace

std::unique_ptr<Tracer> make_major_pair_tracer(const TracerParts& parts) {
  return std::make_unique<MajorPairTracer>(parts);
}

}  // namespace hitpipe::ref
