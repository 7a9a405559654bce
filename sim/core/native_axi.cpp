#include "sim/core/native_axi.hpp"

#include <algorithm>

#include "rtl_gen/core/axi.hpp"
#include "rtl_gen/graph/word.hpp"

namespace hitpipe::sim {

namespace {

using rtl::PinBits;

constexpr int word_bits = 64;

PinWords zeros(int width) {
  return PinWords(static_cast<std::size_t>((width + word_bits - 1) / word_bits));
}

/// At most 64 bits of a number.
std::uint64_t bits_from(const PinWords& from, int low, int width) {
  const auto word = static_cast<std::size_t>(low / word_bits);
  const int shift = low % word_bits;
  std::uint64_t bits = from[word] >> shift;
  if (shift > 0 && word + 1 < from.size()) bits |= from[word + 1] << (word_bits - shift);
  return bits & static_cast<std::uint64_t>(rtl::ones_below(width));
}
/// Puts them where there is 0.
void put_bits(PinWords& to, int low, std::uint64_t bits) {
  const auto word = static_cast<std::size_t>(low / word_bits);
  const int shift = low % word_bits;
  to[word] |= bits << shift;
  if (shift > 0 && word + 1 < to.size()) to[word + 1] |= bits >> (word_bits - shift);
}

}  // namespace

NativeAxi::NativeAxi(const rtl::Core& core) : of_(rtl::behind_axi(core)), core_(core) {
  for (const rtl::Pin& pin : of_.interface.pins) outside_.push_back(zeros(pin.width));
  for (const rtl::Part& part : of_.parts) {
    std::vector<PinWords>& pins = inside_.emplace_back();
    for (const rtl::Pin& pin : part.interface.pins) pins.push_back(zeros(pin.width));
    machines_.push_back(part.machine != nullptr ? part.machine->native(part.format) : nullptr);
  }
}

void NativeAxi::set(std::size_t pin, const PinWords& words) {
  PinWords& to = outside_[pin];
  std::copy(words.begin(), words.end(), to.begin());
  const int above = of_.interface.pins[pin].width % word_bits;
  if (above != 0) to.back() &= static_cast<std::uint64_t>(rtl::ones_below(above));
  settled_ = false;
}

const PinWords& NativeAxi::get(std::size_t pin) {
  settle();
  return outside_[pin];
}

std::uint64_t NativeAxi::bits(const PinBits& of) {
  return bits_from(at(of.part, of.pin), of.low, of.width);
}

bool NativeAxi::lets_through(const rtl::Gate& gate) {
  if (gate.equals) return bits(gate.bits) == bits(*gate.equals);
  return (bits(gate.bits) != 0) != gate.inverted;
}

void NativeAxi::drive(const rtl::Joint& joint) {
  PinWords& to = at(joint.part, joint.pin);
  std::fill(to.begin(), to.end(), 0);
  int low = 0;
  for (const rtl::Source::Piece& piece : joint.from.pieces) {
    for (int done = 0; done < piece.width; done += word_bits) {
      const int width = std::min(word_bits, piece.width - done);
      put_bits(to, low + done,
               piece.bits ? bits_from(at(piece.bits->part, piece.bits->pin), piece.bits->low + done, width)
                          : piece.constant);
    }
    low += piece.width;
  }
  const bool passes =
      std::ranges::all_of(joint.from.gates, [&](const rtl::Gate& gate) { return lets_through(gate); });
  if (!passes) to[0] = 0;
  if (joint.from.inverted) to[0] ^= 1;
}

void NativeAxi::settle() {
  if (settled_) return;
  settled_ = true;
  for (std::size_t i = 0; i < of_.parts.size(); ++i) {
    const std::vector<rtl::Pin>& pins = of_.parts[i].interface.pins;
    std::vector<std::uint64_t> small(pins.size());
    std::vector<rtl::Word> given(pins.size());
    if (machines_[i] != nullptr)
      machines_[i]->give(small.data());
    else
      core_.outputs(given.data());
    std::size_t output = 0;
    for (std::size_t pin = 0; pin < pins.size(); ++pin) {
      if (pins[pin].is_input) continue;
      inside_[i][pin][0] =
          machines_[i] != nullptr ? small[output] : static_cast<std::uint64_t>(given[output]);
      ++output;
    }
  }
  for (const rtl::Joint& joint : of_.joints) drive(joint);
}

void NativeAxi::step() {
  settle();
  settled_ = false;
  for (std::size_t i = 0; i < of_.parts.size(); ++i) {
    const std::vector<rtl::Pin>& pins = of_.parts[i].interface.pins;
    bool reset = false;
    std::vector<const std::uint64_t*> taken_from;
    std::vector<rtl::Word> inputs;
    for (std::size_t pin = 0; pin < pins.size(); ++pin) {
      if (pins[pin].role == rtl::Pin::Role::reset) reset = inside_[i][pin][0] != 0;
      if (!pins[pin].is_input || pins[pin].role == rtl::Pin::Role::reset ||
          pins[pin].role == rtl::Pin::Role::clock)
        continue;
      taken_from.push_back(inside_[i][pin].data());
      inputs.emplace_back(inside_[i][pin][0]);
    }
    if (machines_[i] != nullptr)
      machines_[i]->take(taken_from.data(), reset);
    else
      core_.step(inputs.data(), reset);
  }
}

}  // namespace hitpipe::sim
