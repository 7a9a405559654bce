// Memories of a machine (machine.hpp says how they work), and words of memories as records.
//   constexpr Block<"free_rays", &DoorBits::rays, &DoorBits::ray> free_rays;
//   struct Best : List<best, best_number> {};
//   constexpr Block<"bests", &BestBits::rays, Best> bests;
// In step() memory[bests] has ask(place), word(), which is a record then, and write(enable, place, parts...).
#pragma once

#include "hls/machines/record.hpp"

namespace hitpipe::hls {

namespace detail {
template <class F, auto... Parts>
constexpr auto total_width(const F& format, List<Parts...>) {
  return (0_w + ... + Parts.width(format));
}
/// The bits behind that part.
template <class Part, class F, auto First, auto... Rest>
constexpr auto width_behind(const F& format, List<First, Rest...>) {
  if constexpr (std::is_same_v<std::remove_const_t<decltype(First)>, Part>)
    return total_width(format, List<Rest...>());
  else
    return width_behind<Part>(format, List<Rest...>());
}
}  // namespace detail

/// A word as a record. The first part is in the high bits.
template <class Parts, class F, class X>
class Record {
 public:
  constexpr Record(const F& format, const X& word) : format_(format), word_(word) {}
  template <class Part>
  constexpr auto operator[](Part part) const {
    static_assert(Parts::Items::template has<Part>, "the word does not have this part");
    const auto low = detail::width_behind<Part>(format_, typename Parts::Items());
    const auto bits = slice(word_, low + part.width(format_) - 1_w, low);
    if constexpr (Part::is_signed)
      return as_signed(bits);
    else
      return bits;
  }
  static constexpr typename Parts::Items parts() { return {}; }
  constexpr const X& word() const { return word_; }

 private:
  F format_;
  X word_;
};

/// A word that is no memory's, as a record.
template <class Parts, class F, class X>
constexpr Record<Parts, F, X> record_of(const F& format, const X& word) {
  return {format, word};
}
/// Its width.
template <class Parts>
inline constexpr auto record_width =
    [](const auto& format) { return detail::total_width(format, typename Parts::Items()); };

/// Words that are numbers of W bits.
template <auto W>
struct Plain {
  template <class F>
  static constexpr auto width(const F& format) {
    return number_in<W>(format);
  }
  template <class F, class X>
  static constexpr X read(const F& /*format*/, const X& word) {
    return word;
  }
  template <class... X>
  static constexpr bool takes = sizeof...(X) == 1;
};
/// Words that are records.
template <class Parts>
struct Packed {
  template <class F>
  static constexpr auto width(const F& format) {
    return detail::total_width(format, typename Parts::Items());
  }
  template <class F, class X>
  static constexpr Record<Parts, F, X> read(const F& format, const X& word) {
    return {format, word};
  }
  template <class... X>
  static constexpr bool takes = sizeof...(X) == 1 || sizeof...(X) == Parts::Items::count;
};

/// `Contents` gives the words of a rom.
template <Name N, auto Words, class Word, MemoryKind Kind, auto Contents = nullptr, auto Exists = true,
          bool IsApart = false>
struct MemoryOf {
  using Content = Word;
  template <class F>
  static constexpr bool exists(const F& format) {
    return number_in<Exists>(format) != 0;
  }
  template <class F>
  static constexpr MemoryShape shape(const F& format) {
    MemoryShape made{N.text, number_in<Words>(format), Word::width(format), Kind};
    if constexpr (Kind == MemoryKind::rom) made.contents = Contents();
    made.is_apart = IsApart;
    return made;
  }
};
template <Name N, auto Words, class Parts>
using BlockOf = MemoryOf<N, Words, Packed<Parts>, MemoryKind::block>;
template <Name N, auto Words, auto W>
using Block = MemoryOf<N, Words, Plain<W>, MemoryKind::block>;
/// No word is read while it is written.
template <Name N, auto Words, auto W>
using BlockApart = MemoryOf<N, Words, Plain<W>, MemoryKind::block, nullptr, true, true>;
template <Name N, auto Words, auto W>
using Lookup = MemoryOf<N, Words, Plain<W>, MemoryKind::lookup>;
template <Name N, auto Words, class Parts>
using LookupOf = MemoryOf<N, Words, Packed<Parts>, MemoryKind::lookup>;
/// Only in formats where that holds.
template <Name N, auto Words, auto W, auto Exists>
using LookupIf = MemoryOf<N, Words, Plain<W>, MemoryKind::lookup, nullptr, Exists>;
template <Name N, auto Words, class Parts, auto Exists>
using LookupOfIf = MemoryOf<N, Words, Packed<Parts>, MemoryKind::lookup, nullptr, Exists>;
template <Name N, auto Words, auto W, auto Exists>
using BlockIf = MemoryOf<N, Words, Plain<W>, MemoryKind::block, nullptr, Exists>;
template <Name N, auto Words, class Parts, auto Exists>
using BlockOfIf = MemoryOf<N, Words, Packed<Parts>, MemoryKind::block, nullptr, Exists>;
template <Name N, auto Words, auto W>
using Single = MemoryOf<N, Words, Plain<W>, MemoryKind::single>;
template <Name N, auto Contents, auto Words, auto W>
using Rom = MemoryOf<N, Words, Plain<W>, MemoryKind::rom, Contents>;

namespace detail {
template <class Memory, class Item>
struct MemorySlot {
  Memory value{};
};
template <class Memory, class Items>
struct MemorySlots;
template <class Memory, auto... Items>
struct MemorySlots<Memory, List<Items...>> : MemorySlot<Memory, std::remove_const_t<decltype(Items)>>... {
  template <class Item>
  constexpr Memory& of() {
    return static_cast<MemorySlot<Memory, Item>&>(*this).value;
  }
  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    [[maybe_unused]] const auto visit_one = [&](auto item) {
      if (item.exists(format)) visit(item.shape(format), self.template of<decltype(item)>());
    };
    (visit_one(Items), ...);
  }
};
}  // namespace detail

/// A memory of a machine in a format.
template <class Item, class F, class Memory>
class Access {
 public:
  constexpr Access(const F& format, Memory& memory) : format_(format), memory_(memory) {}

  constexpr void ask(const auto& place) const { memory_.ask(place); }
  constexpr auto word() const { return content(memory_.word(Content::width(format_))); }
  constexpr auto read(const auto& place) const {
    return content(memory_.read(place, Content::width(format_)));
  }
  template <class... Parts>
  constexpr void write(const auto& enable, const auto& place, const Parts&... parts) const {
    static_assert(Content::template takes<Parts...>, "a word is written as a whole, or all its parts");
    memory_.write(enable, place, one_word(parts...));
  }
  constexpr void access(const auto& writes, const auto& place, const auto& word) const {
    memory_.access(writes, place, word);
  }

 private:
  using Content = typename Item::Content;
  constexpr auto content(const auto& word) const { return Content::read(format_, word); }
  static constexpr auto one_word(const auto& x) { return x; }
  static constexpr auto one_word(const auto& x, const auto&... y) { return cat(x, y...); }

  const F& format_;
  Memory& memory_;
};

/// The memories of a list, in a format.
template <class List, class F, class Memory>
class Accesses {
 public:
  using All = detail::MemorySlots<Memory, typename List::Items>;
  constexpr Accesses(const F& format, All& all) : format_(format), all_(all) {}
  template <class Item>
  constexpr Access<Item, F, Memory> operator[](Item) const {
    static_assert(List::template has<Item>, "the machine does not have this memory");
    return {format_, all_.template of<Item>()};
  }

 private:
  const F& format_;
  All& all_;
};

}  // namespace hitpipe::hls
