// What the host does with the system beside tracing: damage, writes to registers, resets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bits.hpp"
#include "core.hpp"
#include "doors.hpp"
#include "host.hpp"
#include "scene.hpp"
#include "system.hpp"

// Damage, and what the core says of it. The image is right before and after.
inline void damage(System& system, Host& host) {
  const std::vector<Block> image = system.memory;
  const size_t some = 100;
  host.trace(some, Why::no_ray, true);
  system.episodes.each([&](auto& one) { one.damage(system, host); });
  // A cache reads less.
  system.errors = Episodes::hides_requests ? 16 : 2;
  system.forget();
  host.trace(some, Why::unread);
  system.errors = 0;
  host.start(host.blocks(), 4);
  host.trace(some, Why::steps);
  // Half of the image, and then with nothing in the other half.
  host.start(host.blocks() / 2);
  host.trace(some, Why::outside);
  for (size_t i = host.blocks() / 2; i < host.blocks(); ++i) system.memory[i] = {};
  host.start(host.blocks());
  host.trace(some, Why::unread);
  system.memory = image;
  // The last block that is one, and others: nothing behind it is read.
  uint64_t last = host.blocks() - 1;
  while (last > 0 && image[last][CORE_BLOCK_BYTES - 1] == 0) --last;
  host.start(last + 1);
  host.trace(some / 2);
  for (int i = 0; i < 4; ++i) {
    if (last == 0) break;
    host.start(i == 0 ? last : 1 + system.random() % last);
    host.trace(some / 4, Why::outside, false, true);
  }
  host.start(host.blocks());
  // The root leads to its own record.
  for (size_t byte = 20; byte < 24; ++byte) system.memory[0][byte] = 0;
  system.memory[0][24] = 255;
  system.forget();
  host.trace(some, (1u << CORE_STEP_BITS) <= CORE_LEVELS ? Why::steps : Why::levels);
  // To a block that the core cannot name, or that the image does not have.
  system.memory[0][23] = 0x80;
  system.forget();
  host.trace(some, Why::outside);
  system.memory = image;
  // The image of another grid, and the block of another kind.
  system.memory[0][31] ^= 1;
  system.forget();
  host.trace(some, Why::unread);
  system.memory[0][31] ^= 0x21;
  system.forget();
  host.trace(some, Why::unread);
  system.memory = image;
  system.forget();
  system.write(CORE_REG_BASE_LOW, 0x20);
  if (system.read(CORE_REG_STATUS) != (CORE_IDLE | CORE_BASE_ERROR))
    fail("a base of 32 bytes, register", CORE_REG_BASE_LOW);
  system.write(CORE_REG_STATUS, CORE_BASE_ERROR);
}

// All registers are written and read, whole and in part. What they say is compared where they are read.
inline void registers(System& system) {
  system.read_all();
  // And one that nothing changes.
  std::vector<uint8_t> settings{CORE_REG_IDENTITY};
  for (const RegisterWord& each : register_words)
    if (each.is_setting) settings.push_back(static_cast<uint8_t>(each.at));
  for (int i = 0; i < 250; ++i) {
    const uint8_t at = settings[system.random() % settings.size()];
    // Not only what is too large.
    system.write(at, system.random() >> system.random() % 32,
                 system.random.one_in(2) ? 15 : system.random() % 16);
    system.read(at);
  }
  system.read_all();
}
// A reset of one cycle while much is on its way, and then of some more.
inline void reset_hard(System& system, Host& host) {
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
    // However long it is, it is one: four would give the same identifiers again.
    system.reset(i % 8 == 6 ? 5 : i % 8 == 2 ? 4 : 1);
    if (i % 4 == 0) system.read_all();
    // Four resets give the same identifiers again.
    while (i % 3 == 2 && !system.is_quiet()) system.step();
  }
}
