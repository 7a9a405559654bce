// Who sends rays and takes answers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <type_traits>
#include <vector>

#include "bits.hpp"
#include "core.hpp"
#include "doors.hpp"
#include "scene.hpp"
#include "system.hpp"

// The host. A ray's tag is a place among those in flight.
class Host {
 public:
  uint64_t hits = 0, failed = 0;  // of the last trace

  Host(System& system, const std::vector<Ray>& rays)
      : system_(system), rays_(rays), blocks_(system.memory.size()) {}

  // Says where the image is. There are no rays.
  void start(uint64_t blocks, uint32_t steps = 0xffffffffu, uint32_t rays = CORE_RAYS) {
    if (system_.read(CORE_REG_STATUS) != CORE_IDLE)
      fail("the status before a start, register", CORE_REG_STATUS);
    system_.place_image();
    const uint64_t base = system_.first_block * CORE_BLOCK_BYTES;
    system_.write(CORE_REG_BASE_LOW, static_cast<uint32_t>(base));
    system_.write(CORE_REG_BASE_HIGH, static_cast<uint32_t>(base >> 32));
    system_.write(CORE_REG_LAST_BLOCK, static_cast<uint32_t>(blocks - 1));
    system_.write(CORE_REG_MOST_STEPS, steps);
    system_.write(CORE_REG_MOST_RAYS, rays);
    system_.episodes.each([&](auto& one) { one.start(system_); });
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
      if (most < uint64_t{2} * CORE_RAYS && system_.random.one_in(500))
        system_.lite.ask_write(CORE_REG_MOST_RAYS, static_cast<uint32_t>(most + 1), 15);
    }
    quiet();
    // A very small image has few rays that come to what is wrong.
    if (why != 0 && failed == 0 && blocks_ > 100 && !few) fail("no ray has failed for", why);
    uint32_t status = CORE_IDLE;
    if (failed != 0) status |= CORE_FAILED(why);
    if (system_.errors_given != 0) status |= CORE_BUS_ERROR;
    system_.episodes.each([&](auto& one) { status |= one.status(); });
    system_.errors_given = 0;
    if (system_.read(CORE_REG_STATUS) != status) fail("the status, register", CORE_REG_STATUS);
    if (system_.counter(CORE_COUNT_RAYS) != count) fail("the counter of rays, register", CORE_COUNT_RAYS);
    if (system_.counter(CORE_COUNT_ANSWERS) != count)
      fail("the counter of answers, register", CORE_COUNT_ANSWERS);
    uint64_t records = 0, triangles = 0;
    for (size_t i = 0; i < count; ++i) {
      records += rays_[i].records;
      triangles += rays_[i].triangles;
    }
    const bool is_whole = why == 0 && !spoils;
    if (is_whole && system_.counter(CORE_COUNT_RECORDS) != records)
      fail("records that rays read, register", CORE_COUNT_RECORDS);
    if (is_whole && system_.counter(CORE_COUNT_TRIANGLES) != triangles)
      fail("triangles that rays read, register", CORE_COUNT_TRIANGLES);
    if (system_.counter(CORE_COUNT_HITS) != hits) fail("the counter of hits, register", CORE_COUNT_HITS);
    system_.episodes.each([&](auto& one) { one.check_counters(system_); });
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
      if ((!requests || (top.m_axi_arvalid && system_.reads_on_their_way() == 0)) &&
          (!answers || doors.m_axis_hit_tvalid))
        break;
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
    if (system_.read(CORE_REG_STATUS) & CORE_RESETTING)
      fail("a soft reset does not end, register", CORE_REG_STATUS);
    if (system_.reads_on_their_way() != 0) fail("reads after a soft reset:", system_.reads_on_their_way());
    system_.write(CORE_REG_STATUS, 0xffffffffu);
    system_.write(CORE_REG_CLEAR_COUNTERS, 0);
  }
  uint64_t blocks() const { return blocks_; }
  size_t sent() const { return sent_; }
  size_t answered() const { return answered_; }
  // Nothing is offered, and no answer is taken.
  void quiet() {
    system_.doors.s_axis_ray_tvalid = 0;
    system_.doors.m_axis_hit_tready = 0;
  }
  // One clock cycle. Rays have gaps now and then, and an answer may wait. Returns whether one came.
  bool cycle(size_t count, uint64_t why, bool spoils, bool takes = true) {
    Doors& doors = system_.doors;
    system_.episodes.each([&](auto& one) { one.announce(system_.lite, system_.random); });
    // A ray that was offered stays until it is taken.
    if (!doors.s_axis_ray_tvalid || taken_) offers_ = !system_.random.one_in(4);
    doors.s_axis_ray_tvalid = offers_ && sent_ < count && !free_tags_.empty();
    taken_ = doors.s_axis_ray_tvalid && doors.s_axis_ray_tready;
    if (doors.s_axis_ray_tvalid) {
      doors.s_axis_ray_tid =
          static_cast<std::remove_reference_t<decltype(doors.s_axis_ray_tid)>>(free_tags_.front());
      core_ray ray = rays_[sent_].ray;
      if (spoils && sent_ % 3 == 0) Episodes::spoil(ray);
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

 private:
  void end_reset() {
    system_.registers.end_reset();
    system_.episodes.each([](auto& one) { one.end_reset(); });
  }
  void take(uint64_t why, bool spoils) {
    const core_hit hit = hit_of(system_.doors);
    const auto found = in_flight_.find(system_.doors.m_axis_hit_tid);
    if (found == in_flight_.end()) fail("an answer of no ray, tag", system_.doors.m_axis_hit_tid);
    const size_t place = found->second;
    const Ray& ray = rays_[place];
    if (hit.failed ? hit.failed != why : !is_answer(hit, ray)) fail("the answer of ray", place);
    if (spoils && (place % 3 == 0) != (hit.failed != 0))
      fail("the answer of a ray that is none or is one", place);
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
