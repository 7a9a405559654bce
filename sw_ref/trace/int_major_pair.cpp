#include "sw_ref/trace/int_major_pair.hpp"

#include "sw_ref/trace/store_tracer.hpp"

namespace hitpipe::ref {

namespace {

class MajorPairTracer final : public Tracer {
 public:
  MajorPairTracer(hls::MajorBits bits, const Mesh& mesh, const Bvh& bvh)
      : bits_(bits), records_(bvh, bits.coord, bits.finer), leaves_(mesh, bvh) {}

  void trace(const TraceJob& job, TraceCounts& counts) const override {
    check_places(job);
    for (std::size_t i = 0; i < job.rays.size(); ++i) {
      const Ray& ray = job.rays[i];
      const IntMajorRaySetup set_up(ray, bits_);
      const MajorDistances distances(set_up.ray(), bits_);
      const auto in_results = [&](float length) { return set_up.length(length); };
      RecordWalk walk(records_, FloatWorld(leaves_, ray, Loads{job.loads}), job.query,
                      set_up.length(ray.length));
      while (!walk.done())
        walk.answer(test_pair(distances, records_.boxes(walk.record()), walk.parent()), in_results);
      job.triangles[i] = walk.hit().triangle;
      if (!job.work.empty()) job.work[i] = walk.counts();
      counts += walk.counts();
    }
  }

  [[nodiscard]] std::size_t bytes_per_node() const override { return records_.bytes_per_record; }
  [[nodiscard]] std::size_t node_count() const override { return records_.size(); }

 private:
  hls::MajorBits bits_;
  PairNodes records_;
  Leaves leaves_;
};

}  // namespace

std::unique_ptr<Tracer> major_pair_tracer(hls::MajorBits bits, const Mesh& mesh, const Bvh& bvh) {
  return std::make_unique<MajorPairTracer>(bits, mesh, bvh);
}

}  // namespace hitpipe::ref
