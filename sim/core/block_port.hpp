// How a core reads memory: each block by itself, or lines for its own cache.
#pragma once

#include <cstdint>
#include <memory>

#include "rays/image/core_image.hpp"
#include "sim/core/core_pins.hpp"
#include "sim/core/memory_model.hpp"

namespace hitpipe::sim {

/// In each cycle change_settings(), request(), show() and end() are called once.
class BlockPort {
 public:
  struct Request {
    bool asks;         ///< the core wants a block
    bool granted;      ///< and memory, or the core's cache, takes the request
    bool of_triangle;  ///< of no record
  };

  virtual ~BlockPort() = default;

  /// At random.
  virtual void change_settings() {}
  virtual Request request() = 0;
  /// What memory gives in this cycle.
  virtual void show() = 0;
  /// After the core's step. Says whether a block has come to its ray since request().
  virtual bool end() = 0;
  /// Of blocks in the core's cache, if it has one: there, and on its way.
  std::uint64_t hits = 0, joins = 0;

  [[nodiscard]] const MemoryModel& memory() const { return memory_; }

 protected:
  BlockPort(CorePins& pins, const ref::CoreImage& image, const MemoryOptions& memory)
      : pins_(pins), memory_(image.blocks, memory) {}
  /// What the core requests goes to memory.
  void ask_memory();

  CorePins& pins_;
  MemoryModel memory_;
};

/// The one that the core has. Pins and image must outlive it. Throws as MemoryModel does.
[[nodiscard]] std::unique_ptr<BlockPort> make_block_port(CorePins& pins, const ref::CoreImage& image,
                                                         const MemoryOptions& memory);

}  // namespace hitpipe::sim
