#include "rtl_gen/core/harness_text.hpp"

namespace hitpipe::rtl {

const std::string_view harness_host =
    R"(// The host. A ray's tag is a place among those in flight.
class Host {
 public:
  uint64_t hits = 0, failed = 0;  // of the last trace

  Host(System& system, const std::vector<Ray>& rays) : system_(system), rays_(rays), blocks_(system.memory.size()) {}

  // Says where the image is. There are no rays.
  void start(uint64_t blocks, uint32_t steps = 0xffffffffu) {
    if (system_.read(CORE_REG_STATUS) != CORE_IDLE) fail("the status before a start, register", CORE_REG_STATUS);
    system_.place_image();
    const uint64_t base = system_.first_block * CORE_BLOCK_BYTES;
    system_.write(CORE_REG_BASE_LOW, static_cast<uint32_t>(base));
    system_.write(CORE_REG_BASE_HIGH, static_cast<uint32_t>(base >> 32));
    system_.write(CORE_REG_LAST_BLOCK, static_cast<uint32_t>(blocks - 1));
    system_.write(CORE_REG_MOST_STEPS, steps);
    system_.write(CORE_REG_MOST_RAYS, CORE_RAYS);
    system_.write(CORE_REG_CLEAR_COUNTERS, 0);
  }
  // Sends so many rays, and compares the answers. Where something is wrong, `why` is why a ray may fail. If
  // `spoils`, every third ray is none.
  void trace(size_t count, uint64_t why = 0, bool spoils = false) {
    in_flight_.assign(CORE_RAYS, rays_.size());
    free_tags_.clear();
    for (size_t tag = 0; tag < in_flight_.size(); ++tag)
      if (CORE_TAG_BITS > 8 || tag < size_t{1} << CORE_TAG_BITS % 16) free_tags_.push_back(tag);
    sent_ = answered_ = hits = failed = 0;
    for (uint64_t silent = 0; answered_ < count; ++silent) {
      if (silent > 1'000'000) fail("no answer; answered", answered_);
      if (cycle(count, why, spoils)) silent = 0;
    }
    quiet();
    // A very small image has few rays that come to what is wrong.
    if (why != 0 && failed == 0 && blocks_ > 100) fail("no ray has failed for", why);
    uint32_t status = CORE_IDLE;
    if (failed != 0) status |= CORE_FAILED(why);
    if (system_.errors_given != 0) status |= CORE_BUS_ERROR;
    system_.errors_given = 0;
    if (system_.read(CORE_REG_STATUS) != status) fail("the status, register", CORE_REG_STATUS);
    if (system_.counter(CORE_COUNT_RAYS) != count) fail("the counter of rays, register", CORE_COUNT_RAYS);
    if (system_.counter(CORE_COUNT_ANSWERS) != count) fail("the counter of answers, register", CORE_COUNT_ANSWERS);
    if (system_.counter(CORE_COUNT_HITS) != hits) fail("the counter of hits, register", CORE_COUNT_HITS);
    system_.write(CORE_REG_STATUS, 0xffffffffu);
    if (system_.read(CORE_REG_STATUS) != CORE_IDLE) fail("the status stays, register", CORE_REG_STATUS);
    system_.write(CORE_REG_CLEAR_COUNTERS, 0);
  }
  // Sends rays, and leaves them while memory takes long to read for them. There is room for more rays.
  void fill() {
    trace(1);
    for (int i = 0; i < 2'000 || system_.reads_on_their_way() == 0; ++i) {
      system_.slowest = i < 1'900 ? 60 : 1000;
      cycle(answered_ + CORE_RAYS / 2 + CORE_RAYS % 2, 0, false);
    }
    system_.slowest = 60;
    quiet();
  }
  // Gives up the rays that are in the core.
  void stop() {
    Vcore_module_axi& top = system_.top;
    system_.write(CORE_REG_CONTROL, CORE_SOFT_RESET);
    // Meanwhile the core takes no ray, and gives no answer but the one that it has offered.
    top.s_axis_ray_tvalid = top.m_axis_hit_tready = 1;
    for (int i = 0; system_.reads_on_their_way() != 0; ++i) {
      if (top.s_axis_ray_tready) fail("a soft reset takes a ray; sent", sent_);
      if (i > 0 && top.m_axis_hit_tvalid) fail("a soft reset gives an answer, tag", top.m_axis_hit_tid);
      system_.step();
    }
    top.s_axis_ray_tvalid = 0;
    for (int i = 0; system_.read(CORE_REG_STATUS) != CORE_IDLE; ++i)
      if (i > 1'000) fail("a soft reset does not end, register", CORE_REG_STATUS);
    top.m_axis_hit_tready = 0;
    if (system_.reads_on_their_way() != 0) fail("reads after a soft reset:", system_.reads_on_their_way());
    system_.write(CORE_REG_CLEAR_COUNTERS, 0);
  }
  uint64_t blocks() const { return blocks_; }

 private:
  void quiet() {
    system_.top.s_axis_ray_tvalid = 0;
    system_.top.m_axis_hit_tready = 0;
  }
  // One clock cycle. Rays have gaps now and then, and an answer may wait. Returns whether one came.
  bool cycle(size_t count, uint64_t why, bool spoils) {
    Vcore_module_axi& top = system_.top;
    // A ray that was offered stays until it is taken.
    if (!top.s_axis_ray_tvalid || taken_) offers_ = !system_.now_and_then();
    top.s_axis_ray_tvalid = offers_ && sent_ < count && !free_tags_.empty();
    taken_ = top.s_axis_ray_tvalid && top.s_axis_ray_tready;
    if (top.s_axis_ray_tvalid) {
      top.s_axis_ray_tid = free_tags_.back();
      core_ray ray = rays_[sent_].ray;
      if (spoils && sent_ % 3 == 0) SPOIL;
      uint8_t bytes[CORE_RAY_BYTES];
      core_pack_ray(bytes, &ray);
      put_bytes(top.s_axis_ray_tdata, bytes, CORE_RAY_BYTES);
      if (taken_) {
        in_flight_[free_tags_.back()] = sent_++;
        free_tags_.pop_back();
      }
    }
    top.m_axis_hit_tready = !system_.now_and_then();
    const bool comes = top.m_axis_hit_tvalid && top.m_axis_hit_tready;
    if (comes) take(why, spoils);
    system_.step();
    return comes;
  }
  void take(uint64_t why, bool spoils) {
    uint8_t bytes[CORE_HIT_BYTES];
    core_hit hit;
    get_bytes(system_.top.m_axis_hit_tdata, bytes, CORE_HIT_BYTES);
    core_unpack_hit(&hit, bytes);
    size_t& place = in_flight_.at(system_.top.m_axis_hit_tid);
    if (place == rays_.size()) fail("an answer of no ray, tag", system_.top.m_axis_hit_tid);
    const Ray& ray = rays_[place];
    const bool same = ray.ray.any ? (hit.number != CORE_NO_HIT) == (ray.number != CORE_NO_HIT)
                              : hit.number == ray.number && hit.t == ray.tWEIGHTS_SAME;
    if (hit.failed ? hit.failed != why : !same) fail("the answer of ray", place);
    if (spoils && (place % 3 == 0) != (hit.failed != 0)) fail("the answer of a ray that is none or is one", place);
    failed += hit.failed != 0;
    hits += !hit.failed && hit.number != CORE_NO_HIT;
    place = rays_.size();
    free_tags_.push_back(system_.top.m_axis_hit_tid);
    ++answered_;
  }

  System& system_;
  const std::vector<Ray>& rays_;
  uint64_t blocks_;
  std::vector<size_t> in_flight_, free_tags_;
  size_t sent_ = 0, answered_ = 0;
  bool offers_ = false, taken_ = false;
};

template <class Number>
void read(std::FILE* file, Number& number) {
  const char* const format = std::is_same_v<Number, float> ? "%f" : std::is_signed_v<Number> ? "%" SCNd64 : "%" SCNu64;
  if (std::fscanf(file, format, &number) != 1) fail("core_module_scene.txt is cut at byte", static_cast<uint64_t>(std::ftell(file)));
}

// Damage, and what the core says of it. The image is right before and after.
void damage(System& system, Host& host) {
  enum : uint64_t { no_ray = 1, steps, levels, outside, unread };
  const std::vector<System::Block> image = system.memory;
  const size_t some = 100;
  host.trace(some, no_ray, true);
  system.errors = 2;
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
  // The root leads to its own record.
  for (int byte = 20; byte < 24; ++byte) system.memory[0][byte] = 0;
  host.trace(some, levels);
  // To a block that the core cannot name, or that the image does not have.
  system.memory[0][23] = 0x80;
  host.trace(some, outside);
  system.memory = image;
  // The image of another grid, and the block of another kind.
  system.memory[0][31] ^= 1;
  host.trace(some, unread);
  system.memory[0][31] ^= 0x21;
  host.trace(some, unread);
  system.memory = image;
  system.write(CORE_REG_BASE_LOW, 0x20);
  if (system.read(CORE_REG_STATUS) != (CORE_IDLE | CORE_BASE_ERROR)) fail("a base of 32 bytes, register", CORE_REG_BASE_LOW);
  system.write(CORE_REG_STATUS, CORE_BASE_ERROR);
}

// Registers keep what is written, and the largest number in place of a larger one.
void registers(System& system) {
  const auto keeps = [&](uint8_t address, uint32_t value, uint64_t kept) {
    system.write(address, value);
    if (system.read(address) != static_cast<uint32_t>(kept)) fail("what a register keeps, register", address);
  };
  const auto at_most = [](uint64_t value, int bits) { return std::min(value, (uint64_t{1} << bits) - 1); };
  for (const uint32_t value : {0x55555555u, 0xaaaaaaaau, 0xffffffffu, 0x33333u, 0xccccu, 0x12u, 0u}) {
    keeps(CORE_REG_BASE_LOW, value, value & (~uint64_t{0} >> (64 - CORE_ADDRESS_BITS)) & ~63u);
    keeps(CORE_REG_BASE_HIGH, value, value & (~uint64_t{0} >> (64 - CORE_ADDRESS_BITS)) >> 32);
    keeps(CORE_REG_LAST_BLOCK, value, at_most(value, CORE_BLOCK_BITS));
    keeps(CORE_REG_MOST_STEPS, value, at_most(value, 20));
  }
  keeps(CORE_REG_MOST_RAYS, 0, 0);
  keeps(CORE_REG_STATUS, 0xffffffffu, CORE_IDLE);
  keeps(CORE_REG_IDENTITY, 0, CORE_IDENTITY);
}

int main(int count, char** arguments) {
  Verilated::commandArgs(count, arguments);  // +verilator+seed+N and its kind
  System system;
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
WEIGHTS_READ    }
  }
  std::fclose(file);

  if (system.read(CORE_REG_IDENTITY) != CORE_IDENTITY) fail("identity, register", CORE_REG_IDENTITY);
  if (system.read(CORE_REG_VERSION) != CORE_VERSION) fail("version, register", CORE_REG_VERSION);
  if (system.read(CORE_REG_FORMAT) != CORE_FORMAT) fail("format, register", CORE_REG_FORMAT);
  if (system.read(CORE_REG_SHAPE) != CORE_SHAPE) fail("shape, register", CORE_REG_SHAPE);
  if (system.read(CORE_REG_PORTS) != CORE_PORTS) fail("ports, register", CORE_REG_PORTS);
  registers(system);
  Host host(system, rays);
  host.start(host.blocks());
  host.trace(rays.size());
  const uint64_t hits = host.hits;
  damage(system, host);

  // Soft resets with reads on their way, and a hard one. With one identifier the bus must be quiet for that.
  for (int i = 0; i < 20; ++i) {
    host.start(host.blocks());
    host.fill();
    host.stop();
  }
  host.start(host.blocks());
  host.fill();
  if (CORE_HAS_ONE_ID) host.stop();
  system.reset();
  host.start(host.blocks());
  host.trace(100);
  std::printf("PASS %zu rays, %" PRIu64 " hits\n", rays.size(), hits);
}
)";

}  // namespace hitpipe::rtl
