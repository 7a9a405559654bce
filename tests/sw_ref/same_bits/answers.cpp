// Prints a sum of all that scenes answer: answers THREADS. It must be the same from every compiler, at every level of
// optimisation, for any number of threads and with either width of vectors.
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <vector>

#include "host/parallel.hpp"
#include "rays/trace/ray_queries.hpp"
#include "rays/world/int_mesh.hpp"

namespace {

namespace ref = hitpipe::ref;

/// Numbers by integers alone, so that no compiler's order of evaluation or rounding matters.
class Numbers {
 public:
  std::uint32_t next() {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return static_cast<std::uint32_t>(state_ >> 33U);
  }
  /// In [-1, 1], of few or of many bits.
  float coordinate(bool coarse) {
    return coarse ? static_cast<float>(static_cast<int>(next() % 17) - 8) * 0.125F
                  : static_cast<float>(static_cast<int>(next() >> 7U) - (1 << 23)) * 0x1p-23F;
  }
  glm::vec3 point(bool coarse) {
    glm::vec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = coordinate(coarse);
    return p;
  }

 private:
  std::uint64_t state_ = 2005;
};

/// FNV-1a of the bytes of numbers.
class Sum {
 public:
  template <class Number>
  void add(const Number& number) {
    std::array<unsigned char, sizeof(Number)> bytes;
    std::memcpy(bytes.data(), &number, sizeof number);
    for (const unsigned char byte : bytes) sum_ = (sum_ ^ byte) * 1099511628211U;
  }
  [[nodiscard]] std::uint64_t value() const { return sum_; }

 private:
  std::uint64_t sum_ = 14695981039346656037U;
};

std::uint64_t answers(const ref::RayQueries& queries, const std::vector<ref::Ray>& rays, int threads) {
  std::vector<std::uint64_t> sums(rays.size());
  hitpipe::host::for_each_index(rays.size(), threads, [&](std::size_t i) {
    Sum sum;
    const ref::NearestHit hit = queries.nearest(rays[i], ref::HitDetail::weights);
    sum.add(hit.triangle);
    sum.add(hit.t);
    sum.add(hit.weights);
    sum.add(queries.any(rays[i]));
    const ref::CrossingCount count = queries.count(rays[i]);
    sum.add(count.crossings);
    sum.add(count.sides);
    sum.add(count.ties);
    std::vector<ref::RayCrossing> all;
    queries.all(rays[i], all);
    for (const ref::RayCrossing& crossing : all) {
      sum.add(crossing.triangle);
      sum.add(crossing.t);
      sum.add(crossing.side);
    }
    sums[i] = sum.value();
  });
  Sum sum;
  for (const std::uint64_t of_ray : sums) sum.add(of_ray);
  return sum.value();
}

}  // namespace

int main(int count, char** arguments) {
  const int threads = count > 1 ? std::atoi(arguments[1]) : 1;
  Numbers numbers;
  ref::Mesh mesh;
  for (std::uint32_t i = 0; i < 700; ++i) {
    const glm::vec3 middle = numbers.point(i % 2 == 0);
    for (int corner = 0; corner < 3; ++corner)
      mesh.vertices.push_back(middle * 0.75F + numbers.point(i % 2 == 0) * 0.25F);
    mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  std::vector<ref::Ray> rays(3'000);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    rays[i].origin = numbers.point(i % 3 == 0);
    do {
      rays[i].direction = numbers.point(i % 3 == 0);
    } while (rays[i].direction == glm::vec3(0));
  }
  ref::BuildOptions options = ref::surface_area_build;
  options.padding = 0;
  const ref::Bvh bvh = ref::build_bvh(mesh, options);
  const ref::IntMesh on_grid = ref::int_mesh(mesh, 20);
  const ref::Bvh of_grid = ref::build_bvh(on_grid.mesh, options);
  for (const ref::VectorWidth width : {ref::VectorWidth::four, ref::VectorWidth::best}) {
    std::printf(
        "%016llx %016llx\n",
        static_cast<unsigned long long>(answers(*ref::float_queries(mesh, bvh, width), rays, threads)),
        static_cast<unsigned long long>(
            answers(*ref::int_queries(on_grid, &of_grid, {.coord = 20, .finer = 1, .slope = 20}, width), rays,
                    threads)));
  }
}
