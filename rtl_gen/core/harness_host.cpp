#include "rtl_gen/core/harness_text.hpp"

namespace hitpipe::rtl {

const std::string_view harness_host =
    R"(// The host. A ray's tag is a place among those in flight.
class Host {
 public:
  uint64_t hits = 0, failed = 0;  // of the last trace

  Host(System& system, const std::vector<Ray>& rays) : system_(system), rays_(rays), blocks_(system.memory.size()) {}

  // Says where the image is. There are no rays.
  void start(uint64_t blocks, uint32_t steps = 0xffffffffu, uint32_t rays = CORE_RAYS) {
    if (system_.read(CORE_REG_STATUS) != CORE_IDLE) fail("the status before a start, register", CORE_REG_STATUS);
    system_.place_image();
    const uint64_t base = system_.first_block * CORE_BLOCK_BYTES;
    system_.write(CORE_REG_BASE_LOW, static_cast<uint32_t>(base));
    system_.write(CORE_REG_BASE_HIGH, static_cast<uint32_t>(base >> 32));
    system_.write(CORE_REG_LAST_BLOCK, static_cast<uint32_t>(blocks - 1));
    system_.write(CORE_REG_MOST_STEPS, steps);
    system_.write(CORE_REG_MOST_RAYS, rays);
#if CORE_CACHE_KIB
    system_.write(CORE_REG_MOST_LINES, 1 + system_.random() % 12);
#endif
#if CORE_HAS_RINGS
    start_rings();
#endif
    system_.write(CORE_REG_CLEAR_COUNTERS, 0);
  }
  // Sends so many rays, and compares the answers. Where something is wrong, `why` is why a ray may fail. If
  // `spoils`, every third ray is none; if `few`, it may be that none fails.
  void trace(size_t count, uint64_t why = 0, bool spoils = false, bool few = false) {
    in_flight_.clear();
    free_tags_.clear();
    // Any tags that differ: the step is odd.
    constexpr uint64_t largest = ~uint64_t{0} >> (64 - CORE_TAG_BITS);
    const uint64_t step = (static_cast<uint64_t>(system_.random()) << 32 | system_.random()) | 1;
    for (uint64_t i = 0; i < CORE_RAYS && i <= largest; ++i) free_tags_.push_back(i * step & largest);
    sent_ = answered_ = hits = failed = 0;
    for (uint64_t silent = 0; answered_ < count; ++silent) {
      if (silent > 1'000'000) fail("no answer; answered", answered_);
      if (cycle(count, why, spoils)) silent = 0;
      // There may be more rays from now on.
      const uint64_t most = system_.registers.most_rays();
      if (most < 2 * CORE_RAYS && system_.random.one_in(500))
        system_.lite.ask_write(CORE_REG_MOST_RAYS, static_cast<uint32_t>(most + 1), 15);
    }
    quiet();
    // A very small image has few rays that come to what is wrong.
    if (why != 0 && failed == 0 && blocks_ > 100 && !few) fail("no ray has failed for", why);
    uint32_t status = CORE_IDLE;
    if (failed != 0) status |= CORE_FAILED(why);
    if (system_.errors_given != 0) status |= CORE_BUS_ERROR;
#if CORE_HAS_RINGS
    if (system_.rings.errors_given != 0) status |= CORE_RING_ERROR;
    system_.rings.errors_given = 0;
#endif
    system_.errors_given = 0;
    if (system_.read(CORE_REG_STATUS) != status) fail("the status, register", CORE_REG_STATUS);
    if (system_.counter(CORE_COUNT_RAYS) != count) fail("the counter of rays, register", CORE_COUNT_RAYS);
    if (system_.counter(CORE_COUNT_ANSWERS) != count) fail("the counter of answers, register", CORE_COUNT_ANSWERS);
    uint64_t records = 0, triangles = 0;
    for (size_t i = 0; i < count; ++i) {
      records += rays_[i].records;
      triangles += rays_[i].triangles;
    }
    const bool is_whole = why == 0 && !spoils;
    if (is_whole && system_.counter(CORE_COUNT_RECORDS) != records) fail("records that rays read, register", CORE_COUNT_RECORDS);
    if (is_whole && system_.counter(CORE_COUNT_TRIANGLES) != triangles)
      fail("triangles that rays read, register", CORE_COUNT_TRIANGLES);
    if (system_.counter(CORE_COUNT_HITS) != hits) fail("the counter of hits, register", CORE_COUNT_HITS);
#if CORE_CACHE_KIB
    const uint64_t found = system_.counter(CORE_COUNT_CACHE_HITS) + system_.counter(CORE_COUNT_CACHE_JOINS);
    if (found + system_.counter(CORE_COUNT_CACHE_LINES) != system_.counter(CORE_COUNT_RECORDS) + system_.counter(CORE_COUNT_TRIANGLES))
      fail("hits, joins and lines of the cache are not what rays read, register", CORE_COUNT_CACHE_HITS);
    // In each cycle a ray asks for nothing, is refused, or is granted. Some cycles pass while the counters are read.
    const uint64_t asked = system_.counter(CORE_COUNT_RECORDS) + system_.counter(CORE_COUNT_TRIANGLES) + system_.counter(CORE_COUNT_REFUSED);
    const uint64_t before = system_.counter(CORE_COUNT_CYCLES), idle = system_.counter(CORE_COUNT_IDLE), after = system_.counter(CORE_COUNT_CYCLES);
    if (asked + idle < before || asked + idle > after) fail("cycles with a question or none are not all, register", CORE_COUNT_IDLE);
#endif
    system_.write(CORE_REG_STATUS, 0xffffffffu);
    if (system_.read(CORE_REG_STATUS) != CORE_IDLE) fail("the status stays, register", CORE_REG_STATUS);
    system_.write(CORE_REG_CLEAR_COUNTERS, 0);
  }
  // Sends rays, and leaves them while memory takes long to read for them. There is room for more rays.
  void fill() {
    trace(1);
    for (int i = 0; i < 200 || system_.reads_on_their_way() == 0; ++i) {
      system_.slowest = i < 150 ? 60 : 1000;
      if (i % 64 == 0) system_.forget();
      cycle(answered_ + CORE_RAYS / 2 + CORE_RAYS % 2, 0, false);
    }
    system_.slowest = 60;
    quiet();
  }
  // Rays run until memory has refused a request for so long that no read is on its way, and the host an answer. A core
  // that has no such request or answer in some time is left as it is.
  void hold(bool requests, bool answers) {
    const Top& top = system_.top;
    const Doors& doors = system_.doors;
    system_.refuses = requests;
    for (int i = 0; i < 2'000; ++i) {
      if ((!requests || (top.m_axi_arvalid && system_.reads_on_their_way() == 0)) && (!answers || doors.m_axis_hit_tvalid)) break;
      if (i % 64 == 0) system_.forget();
      cycle(answered_ + CORE_RAYS / 2 + CORE_RAYS % 2, 0, false, !answers);
    }
    quiet();
  }
  // Gives up the rays that are in the core. What is offered may wait long.
  void stop() {
    Doors& doors = system_.doors;
    system_.write(CORE_REG_CONTROL, CORE_SOFT_RESET);
    doors.s_axis_ray_tvalid = !ends_unseen;
    unsigned requests_wait = system_.random() % 64, answers_wait = system_.random() % 64;
    while (system_.registers.resetting()) {
      if (requests_wait-- == 0) system_.refuses = false;
      if (answers_wait-- == 0) doors.m_axis_hit_tready = 1;
      if (ends_unseen && !system_.refuses && doors.m_axis_hit_tready) {
        if (!(system_.read(CORE_REG_STATUS) & CORE_RESETTING)) end_reset();
      }
      system_.step();
    }
    system_.refuses = false;
    doors.s_axis_ray_tvalid = doors.m_axis_hit_tready = 0;
    if (system_.read(CORE_REG_STATUS) & CORE_RESETTING) fail("a soft reset does not end, register", CORE_REG_STATUS);
    if (system_.reads_on_their_way() != 0) fail("reads after a soft reset:", system_.reads_on_their_way());
    system_.write(CORE_REG_STATUS, 0xffffffffu);
    system_.write(CORE_REG_CLEAR_COUNTERS, 0);
  }
  uint64_t blocks() const { return blocks_; }

 private:
  void end_reset() {
    system_.registers.end_reset();
#if CORE_HAS_RINGS
    if (system_.rings.is_busy()) fail("rings are read or written after a soft reset, register", CORE_REG_STATUS);
    system_.rings.reset();
#endif
  }
#if CORE_HAS_RINGS
  void start_rings() {
    system_.rings.place(system_.random);
    const uint64_t rays = system_.rings.rays_at, answers = system_.rings.answers_at;
    system_.write(CORE_REG_RAYS_LOW, static_cast<uint32_t>(rays));
    system_.write(CORE_REG_RAYS_HIGH, static_cast<uint32_t>(rays >> 32));
    system_.write(CORE_REG_ANSWERS_LOW, static_cast<uint32_t>(answers));
    system_.write(CORE_REG_ANSWERS_HIGH, static_cast<uint32_t>(answers >> 32));
    system_.write(CORE_REG_RING_LAST, Rings::places - 1);
  }
#endif
  void quiet() {
    system_.doors.s_axis_ray_tvalid = 0;
    system_.doors.m_axis_hit_tready = 0;
  }
  // One clock cycle. Rays have gaps now and then, and an answer may wait. Returns whether one came.
  bool cycle(size_t count, uint64_t why, bool spoils, bool takes = true) {
    Doors& doors = system_.doors;
#if CORE_HAS_RINGS
    // The core is told of rays now and then, and the host asks for an interrupt at some answer.
    system_.rings.announce(system_.lite, system_.random);
#endif
    // A ray that was offered stays until it is taken.
    if (!doors.s_axis_ray_tvalid || taken_) offers_ = !system_.random.one_in(4);
    doors.s_axis_ray_tvalid = offers_ && sent_ < count && !free_tags_.empty();
    taken_ = doors.s_axis_ray_tvalid && doors.s_axis_ray_tready;
    if (doors.s_axis_ray_tvalid) {
      doors.s_axis_ray_tid = static_cast<std::remove_reference_t<decltype(doors.s_axis_ray_tid)>>(free_tags_.front());
      core_ray ray = rays_[sent_].ray;
      if (spoils && sent_ % 3 == 0) SPOIL;
      uint8_t bytes[CORE_RAY_BYTES];
      core_pack_ray(bytes, &ray);
      put_bytes(doors.s_axis_ray_tdata, bytes, CORE_RAY_BYTES);
      if (taken_) {
        in_flight_[free_tags_.front()] = sent_++;
        free_tags_.pop_front();
      }
    }
    doors.m_axis_hit_tready = takes && !system_.random.one_in(4);
    const bool comes = doors.m_axis_hit_tvalid && doors.m_axis_hit_tready;
    if (comes) take(why, spoils);
    system_.step();
    return comes;
  }
  void take(uint64_t why, bool spoils) {
    const core_hit hit = hit_of(system_.doors);
    const auto found = in_flight_.find(system_.doors.m_axis_hit_tid);
    if (found == in_flight_.end()) fail("an answer of no ray, tag", system_.doors.m_axis_hit_tid);
    const size_t place = found->second;
    const Ray& ray = rays_[place];
    const bool same = ASKS_ANY ? (hit.number != CORE_NO_HIT) == (ray.number != CORE_NO_HIT)
                              : hit.number == ray.number && hit.t == ray.tWEIGHTS_SAME;
    if (hit.failed ? hit.failed != why : !same) fail("the answer of ray", place);
    if (spoils && (place % 3 == 0) != (hit.failed != 0)) fail("the answer of a ray that is none or is one", place);
    failed += hit.failed != 0;
    hits += !hit.failed && hit.number != CORE_NO_HIT;
    in_flight_.erase(found);
    free_tags_.push_back(system_.doors.m_axis_hit_tid);
    ++answered_;
  }

  System& system_;
  const std::vector<Ray>& rays_;
  uint64_t blocks_;
  std::map<uint64_t, size_t> in_flight_;  // rays by tag
  std::deque<uint64_t> free_tags_;
  size_t sent_ = 0, answered_ = 0;
  bool offers_ = false, taken_ = false;
};

// Damage, and what the core says of it. The image is right before and after.
void damage(System& system, Host& host) {
  enum : uint64_t { no_ray = 1, steps, levels, outside, unread };
  const std::vector<System::Block> image = system.memory;
  const size_t some = 100;
  host.trace(some, no_ray, true);
#if CORE_HAS_RINGS
  system.rings.errors = 8;
  host.trace(some, no_ray);
  system.rings.errors = 0;
#endif
  system.errors = has_cache ? 16 : 2;
  system.forget();
  host.trace(some, unread);
  system.errors = 0;
  host.start(host.blocks(), 4);
  host.trace(some, steps);
  // Half of the image, and then with nothing in the other half.
  host.start(host.blocks() / 2);
  host.trace(some, outside);
  for (size_t i = host.blocks() / 2; i < host.blocks(); ++i) system.memory[i] = {};
  host.start(host.blocks());
  host.trace(some, unread);
  system.memory = image;
  // The last block that is one, and others: nothing behind it is read.
  uint64_t last = host.blocks() - 1;
  while (last > 0 && image[last][CORE_BLOCK_BYTES - 1] == 0) --last;
  host.start(last + 1);
  host.trace(some / 2);
  for (int i = 0; i < 4; ++i) {
    if (last == 0) break;
    host.start(i == 0 ? last : 1 + system.random() % last);
    host.trace(some / 4, outside, false, true);
  }
  host.start(host.blocks());
  // The root leads to its own record.
  for (int byte = 20; byte < 24; ++byte) system.memory[0][byte] = 0;
  system.memory[0][24] = 255;
  system.forget();
  host.trace(some, (1u << CORE_STEP_BITS) <= CORE_LEVELS ? steps : levels);
  // To a block that the core cannot name, or that the image does not have.
  system.memory[0][23] = 0x80;
  system.forget();
  host.trace(some, outside);
  system.memory = image;
  // The image of another grid, and the block of another kind.
  system.memory[0][31] ^= 1;
  system.forget();
  host.trace(some, unread);
  system.memory[0][31] ^= 0x21;
  system.forget();
  host.trace(some, unread);
  system.memory = image;
  system.forget();
  system.write(CORE_REG_BASE_LOW, 0x20);
  if (system.read(CORE_REG_STATUS) != (CORE_IDLE | CORE_BASE_ERROR)) fail("a base of 32 bytes, register", CORE_REG_BASE_LOW);
  system.write(CORE_REG_STATUS, CORE_BASE_ERROR);
}

// All registers are written and read, whole and in part. What they say is compared where they are read.
void registers(System& system) {
  system.read_all();
  constexpr uint8_t settings[] = {CORE_REG_BASE_LOW, CORE_REG_BASE_HIGH, CORE_REG_LAST_BLOCK, CORE_REG_MOST_STEPS,
                                  CORE_REG_STATUS, CORE_REG_CLEAR_COUNTERS, CORE_REG_IDENTITY, CORE_REG_MOST_RAYS,
#if CORE_CACHE_KIB
                                  CORE_REG_MOST_LINES,
#endif
#if CORE_HAS_RINGS
                                  CORE_REG_RAYS_LOW, CORE_REG_RAYS_HIGH, CORE_REG_ANSWERS_LOW, CORE_REG_ANSWERS_HIGH,
                                  CORE_REG_RING_LAST, CORE_REG_INTERRUPT
#endif
  };
  for (int i = 0; i < 250; ++i) {
    const uint8_t at = settings[system.random() % sizeof settings];
    // Not only what is too large.
    system.write(at, system.random() >> system.random() % 32, system.random.one_in(2) ? 15 : system.random() % 16);
    system.read(at);
  }
  system.read_all();
}
// A reset of one cycle while much is on its way, and then of some more.
void reset_hard(System& system, Host& host) {
  for (int i = 0; i < 40; ++i) {
    host.start(host.blocks());
    if (i % 4 != 3) host.fill();
    if (i % 4 == 1) system.lite.ask_write(CORE_REG_CONTROL, CORE_SOFT_RESET, 15);
    // A part of a write has come, or answers have not been taken.
    if (i % 3 == 0) system.lite.ask_word(0xffffffffu, 15);
    if (i % 3 == 1) system.lite.ask_place(CORE_REG_MOST_RAYS);
    if (i % 3 == 2) {
      system.lite.holds = true;
      system.lite.ask_write(CORE_REG_MOST_RAYS, 1, 15);
      system.lite.ask_read(CORE_REG_STATUS);
      system.lite.ask_read(CORE_REG_STATUS);
    }
    for (unsigned cycles = 4 + system.random() % 16; cycles > 0; --cycles) system.step();
    system.reset(i % 8 == 6 ? 5 : 1);
    if (i % 4 == 0) system.read_all();
    // Four resets give the same identifiers again.
    while (i % 3 == 2 && system.reads_on_their_way() != 0) system.step();
  }
}

int main(int count, char** arguments) {
  Verilated::threadContextp()->randSeed(1);
  Verilated::threadContextp()->randReset(2);  // registers and memories begin with random bits
  Verilated::commandArgs(count, arguments);   // +verilator+seed+N and its kind
  System system(static_cast<uint64_t>(Verilated::threadContextp()->randSeed()));
  std::vector<Ray> rays;
  std::FILE* const file = std::fopen("core_module_scene.txt", "r");
  if (!file) fail("core_module_scene.txt cannot be read; line", 0);
  for (char kind; std::fscanf(file, " %c", &kind) == 1;) {
    if (kind == '#') {
      for (int c = kind; c != '\n' && c != EOF;) c = std::fgetc(file);
    } else if (kind == 'b') {
      System::Block& block = system.memory.emplace_back();
      for (size_t i = 0; i < block.size(); i += 8) {
        uint64_t word;
        read(file, word);
        for (size_t j = 0; j < 8; ++j) block[i + j] = static_cast<uint8_t>(word >> 8 * j);
      }
    } else {
      Ray& line = rays.emplace_back();
      core_ray& ray = line.ray;
RAY_FIELDS      read(file, line.number);
      read(file, line.t);
      read(file, line.records);
      read(file, line.triangles);
WEIGHTS_READ    }
  }
  std::fclose(file);

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
    host.start(host.blocks(), 0xffffffffu, i % 4 == 0 ? CORE_RAYS + 1 + system.random() % CORE_RAYS : 1 + system.random() % CORE_RAYS);
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
)";

}  // namespace hitpipe::rtl
