// How rays come into a core, and answers out of it: through its ports, or through rings in memory.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>

#include "sim/core/core_pins.hpp"
#include "sim/core/ray_fields.hpp"

namespace hitpipe::sim {

/// In each cycle offer(), answer() and end() are called once.
class RayPort {
 public:
  struct Offer {
    const CoreJob* job;
    std::size_t tag;
  };
  struct Answer {
    std::size_t tag;
    CoreAnswer answer;
  };

  virtual ~RayPort() = default;

  /// A ray that is to go in, behind others. Its tag at the port is one that is `tag` modulo the number of tags.
  void push(const Offer& offer) { waiting_.push_back(offer); }
  [[nodiscard]] bool waits(std::size_t tag) const {
    return std::ranges::find(waiting_, tag, &Offer::tag) != waiting_.end();
  }

  /// Whether the core begins a ray.
  virtual bool offer() = 0;
  virtual std::optional<Answer> answer() = 0;
  /// Whether an answer leaves the core, once answer() was called.
  [[nodiscard]] virtual bool gives() const = 0;
  /// Inputs and outputs are those of the cycle.
  virtual void end() {}
  /// An answer could not be written, so the core stands still.
  [[nodiscard]] virtual bool has_failed() const { return false; }
  /// Rays that fit in, those in the core among them.
  [[nodiscard]] virtual rtl::Word room() const = 0;

  void tags(std::size_t count) { tags_ = count; }

 protected:
  explicit RayPort(CorePins& pins) : pins_(pins) {}

  /// As the core is given it, some of them with other numbers.
  [[nodiscard]] std::vector<rtl::Word> fields_of(const CoreJob& job);
  [[nodiscard]] virtual int width_of_field(std::size_t field) const = 0;
  [[nodiscard]] rtl::Word tag_of(std::size_t tag);

  CorePins& pins_;
  std::deque<Offer> waiting_;  ///< that the core has not taken
  std::size_t tags_ = 1;

 private:
  void spoil(std::vector<rtl::Word>& fields);
};

/// The one that the core has. The pins must outlive it.
[[nodiscard]] std::unique_ptr<RayPort> make_ray_port(CorePins& pins);

}  // namespace hitpipe::sim
