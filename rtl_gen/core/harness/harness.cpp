// A small system: a core behind AXI, a memory with a random latency, and a host. It loads the image and the rays of the
// scene file, sends the rays, and compares every answer. Then it damages image, memory, rays and registers, and resets
// the core: an answer is right or says why it has failed. Registers begin with random bits; in every cycle they are
// compared with what has passed. hitpipe writes this folder beside a core; core.hpp and features.hpp alone differ from
// core to core.
//   make harness    builds and runs it: PASS and exit code 0, or FAIL and exit code 1
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "core.hpp"
#include "damage.hpp"
#include "host.hpp"
#include "scene.hpp"
#include "system.hpp"

int main(int count, char** arguments) {
  Verilated::threadContextp()->randSeed(1);
  Verilated::threadContextp()->randReset(2);  // registers and memories begin with random bits
  Verilated::commandArgs(count, arguments);   // +verilator+seed+N and its kind
  System system(static_cast<uint64_t>(Verilated::threadContextp()->randSeed()));
  const Scene scene = SceneFile().read();
  const std::vector<Ray>& rays = scene.rays;
  system.memory = scene.blocks;

  registers(system);
  system.reset(1);
  system.read_all();
  Host host(system, rays);
  host.start(host.blocks());
  host.trace(rays.size());
  const uint64_t hits = host.hits;
  damage(system, host);

  // Soft resets with reads on their way, or what is offered, and then hard ones.
  for (int i = 0; i < 20; ++i) {
    // After a reset there may be few rays, and never more than the core has room for.
    host.start(host.blocks(), 0xffffffffu,
               i % 4 == 0 ? CORE_RAYS + 1 + system.random() % CORE_RAYS : 1 + system.random() % CORE_RAYS);
    host.trace(i % 8 < 2 ? 2 * CORE_RAYS : 3);
    host.fill();
    host.hold(i % 2 == 1, i % 4 > 1);
    host.stop();
    if (i % 4 == 0) system.read_all();
  }
  reset_hard(system, host);
  host.start(host.blocks());
  host.trace(100);
  std::printf("PASS %zu rays, %" PRIu64 " hits\n", rays.size(), hits);
}
