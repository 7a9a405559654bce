// What a machine is made of: fields, lists of fields, memories, and the records of values that follow from
// them. A field says its name, width, sign and value after a reset once. A width is an int, a member of the
// format, or a function of it:
//   constexpr Data<"ready"> ready;
//   constexpr Data<"length", &DoorBits::distance> length;
//   inline constexpr auto left_bits = [](const auto& format) { return format.ray + 1; };
//   constexpr Control<"left", left_bits> left;
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <tuple>
#include <type_traits>

#include "hls/machines/machine.hpp"
#include "hls/num/bits.hpp"
#include "hls/num/levels.hpp"

namespace hitpipe::hls {

/// A format that the compiler knows, for example Fixed<DoorBits{20, 5}>.
template <auto B>
struct Fixed {
  static constexpr auto bits = B;
  constexpr operator std::remove_const_t<decltype(B)>() const { return B; }
};

/// A number that may depend on the format. It is an int, or a Width if the format is Fixed.
template <auto N, class Bits>
constexpr int number_in(const Bits& bits) {
  if constexpr (std::is_integral_v<decltype(N)>)
    return N;
  else
    return std::invoke(N, bits);
}
template <auto N, auto B>
constexpr Width<number_in<N>(B)> number_in(const Fixed<B>& /*format*/) {
  return {};
}
/// The type of number_in<N>(format).
template <auto N, class F>
using Number = decltype(number_in<N>(F{}));

/// The name of a field, as an argument of a template.
template <std::size_t N>
struct Name {
  char text[N]{};
  constexpr Name(const char (&letters)[N]) {
    for (std::size_t i = 0; i < N; ++i) text[i] = letters[i];
  }
  constexpr Name() = default;
};
template <std::size_t A, std::size_t B>
constexpr Name<A + B - 1> operator+(const Name<A>& a, const Name<B>& b) {
  Name<A + B - 1> both;
  for (std::size_t i = 0; i < A - 1; ++i) both.text[i] = a.text[i];
  for (std::size_t i = 0; i < B; ++i) both.text[A - 1 + i] = b.text[i];
  return both;
}

template <Name N, auto W, bool Signed, bool HasReset, std::int64_t Reset, auto Exists = true,
          bool HasStart = false>
struct FieldOf {
  static constexpr bool is_signed = Signed;
  static constexpr const char* name() { return N.text; }
  template <class F>
  static constexpr Field shape(const F& format) {
    return {N.text, width(format), Signed, HasReset, Reset, HasStart};
  }
  template <class F>
  static constexpr auto width(const F& format) {
    return number_in<W>(format);
  }
  template <class F>
  static constexpr bool exists(const F& format) {
    return number_in<Exists>(format) != 0;
  }
  template <class D, class F>
  using Value = std::conditional_t<Signed, SignedWord<D, Number<W, F>>, Word<D, Number<W, F>>>;
  using Held = FieldOf<N + Name("_1"), W, Signed, HasReset, Reset, Exists>;
};
/// A port, a part of a memory's word, or a register whose value means nothing until it has been written.
template <Name N, auto W = 1>
using Data = FieldOf<N, W, false, false, 0>;
/// The same in two's complement.
template <Name N, auto W = 1>
using SignedData = FieldOf<N, W, true, false, 0>;
/// A register that a reset sets.
template <Name N, auto W = 1, std::int64_t Reset = 0>
using Control = FieldOf<N, W, false, true, Reset>;

/// A register that no reset sets, and that begins with any number. Simulators begin with 0.
template <Name N, auto W = 1>
using Counting = FieldOf<N, W, false, false, 0, true, true>;

/// The same, only in formats where that holds.
template <Name N, auto W, auto Exists>
using DataIf = FieldOf<N, W, false, false, 0, Exists>;
template <Name N, auto W, auto Exists, std::int64_t Reset = 0>
using ControlIf = FieldOf<N, W, false, true, Reset, Exists>;

/// The register that holds a field for a cycle: "length_1" of "length".
template <auto Field>
inline constexpr typename decltype(Field)::Held held;

/// Fields, or memories. Messages of compilers are shorter if it has a name: struct In : List<a, b> {};
template <auto... Fields>
struct List {
  using Items = List;
  static constexpr std::size_t count = sizeof...(Fields);
  template <class Field>
  static constexpr bool has = (std::is_same_v<std::remove_const_t<decltype(Fields)>, Field> || ...);
};
namespace detail {
template <class All, class... Lists>
struct Joined;
template <class All>
struct Joined<All> {
  using Type = All;
};
template <class All, class... Rest>
struct Joined<All, List<>, Rest...> : Joined<All, Rest...> {};
template <auto... All, auto First, auto... More, class... Rest>
struct Joined<List<All...>, List<First, More...>, Rest...>
    : Joined<std::conditional_t<List<All...>::template has<std::remove_const_t<decltype(First)>>,
                                List<All...>, List<All..., First>>,
             List<More...>, Rest...> {};
}  // namespace detail
/// The fields of several lists, each once.
template <class... Lists>
using Join = typename detail::Joined<List<>, typename Lists::Items...>::Type;

namespace detail {
template <auto... A>
constexpr List<held<A>...> all_held(List<A...>) {
  return {};
}
}  // namespace detail
/// The registers that hold the fields of a list.
template <class Fields>
using Held = decltype(detail::all_held(typename Fields::Items()));

namespace detail {
template <class D, class F, class Field>
struct Slot {
  typename Field::template Value<D, F> value{};
};
template <class D, class F, class Items>
struct Slots;
template <class D, class F, auto... Fields>
struct Slots<D, F, List<Fields...>> : Slot<D, F, std::remove_const_t<decltype(Fields)>>... {
  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const auto visit_one = [&](auto field) {
      if (field.exists(format)) visit(field.shape(format), self[field]);
    };
    (visit_one(Fields), ...);
  }
};
}  // namespace detail

/// A value for each field of a list.
template <class D, class F, class Fields>
struct Values : detail::Slots<D, F, typename Fields::Items> {
  template <class Field>
  constexpr auto& operator[](Field) {
    static_assert(Fields::Items::template has<Field>, "the list does not have this field");
    return static_cast<detail::Slot<D, F, Field>&>(*this).value;
  }
  template <class Field>
  constexpr const auto& operator[](Field) const {
    static_assert(Fields::Items::template has<Field>, "the list does not have this field");
    return static_cast<const detail::Slot<D, F, Field>&>(*this).value;
  }
};

/// Of what step() writes a run in software keeps no list.
struct NoLog {
  constexpr void written(const char* /*field*/) const {}
};

/// A field that can be written and not read.
template <class Value, class Log>
class Written {
 public:
  constexpr Written(const char* name, Value& value, Log& log) : name_(name), value_(value), log_(log) {}
  template <class X>
  constexpr void operator=(const X& x) const {
    value_ = x;
    log_.written(name_);
  }

 private:
  const char* name_;
  Value& value_;
  Log& log_;
};
/// The same, which keeps its value where the bit is 0.
template <class Bit, class Value, class Log>
class WrittenWhere {
 public:
  constexpr WrittenWhere(const Bit& bit, const Value& now, const Written<Value, Log>& next)
      : bit_(bit), now_(now), next_(next) {}
  template <class X>
  constexpr void operator=(const X& x) const {
    next_ = select(bit_, x, now_);
  }

 private:
  const Bit& bit_;
  const Value& now_;
  Written<Value, Log> next_;
};

/// A record that can be written and not read, so the order of statements means nothing.
template <class Record, class Log>
class Writable {
 public:
  constexpr Writable(Record& record, Log& log) : record_(record), log_(log) {}
  template <class Field>
  constexpr auto operator[](Field field) const {
    using Value = std::remove_reference_t<decltype(record_[field])>;
    return Written<Value, Log>(Field::name(), record_[field], log_);
  }
  /// All parts of a word of a memory, as fields.
  constexpr void copy(const auto& word) const { copy_all(word, word.parts()); }
  /// Registers take the fields of a list that they hold.
  constexpr void hold(const auto& in, auto fields) const { hold_all(in, typename decltype(fields)::Items()); }
  /// The fields of a list, from the registers that hold them.
  constexpr void from_held(const auto& now, auto fields) const {
    copy_held(now, typename decltype(fields)::Items());
  }

 private:
  template <auto... Parts>
  constexpr void copy_all(const auto& word, List<Parts...>) const {
    ((void((*this)[Parts] = word[Parts])), ...);
  }
  template <auto... Fields>
  constexpr void hold_all(const auto& in, List<Fields...>) const {
    ((void((*this)[held<Fields>] = in[Fields])), ...);
  }
  template <auto... Fields>
  constexpr void copy_held(const auto& now, List<Fields...>) const {
    ((void((*this)[Fields] = now[held<Fields>])), ...);
  }

  Record& record_;
  Log& log_;
};

/// The next state. A register that is not written keeps its value.
template <class State, class Log>
class Next : public Writable<State, Log> {
 public:
  constexpr Next(const State& now, State& next, Log& log) : Writable<State, Log>(next, log), now_(now) {}

  template <class Bit>
  struct Where {
    const Next& next;
    const Bit& bit;
    template <class Field>
    constexpr auto operator[](Field field) const {
      using Value = std::remove_cvref_t<decltype(next.now_[field])>;
      return WrittenWhere<Bit, Value, Log>(bit, next.now_[field], next[field]);
    }
    constexpr void hold(const auto& in, auto fields) const {
      hold_all(in, typename decltype(fields)::Items());
    }
    template <auto... Fields>
    constexpr void hold_all(const auto& in, List<Fields...>) const {
      ((void((*this)[held<Fields>] = in[Fields])), ...);
    }
  };
  /// next.where(bit)[field] = x: the field keeps its value where the bit is 0.
  template <class Bit>
  constexpr Where<Bit> where(const Bit& bit) const {
    return {*this, bit};
  }

 private:
  const State& now_;
};

/// x where the bit is 1, else 0.
template <class Bit, class X>
constexpr auto only(const Bit& bit, const X& x) {
  return as_unsigned(x & spread(bit, width_of(x)));
}
/// A sum or a difference in the width of x, unsigned.
template <class X, class Y>
constexpr auto plus(const X& x, const Y& y) {
  return as_unsigned(resize(x + y, width_of(x)));
}
template <class X, class Y>
constexpr auto minus(const X& x, const Y& y) {
  return as_unsigned(resize(x - y, width_of(x)));
}
/// x is that number.
template <class D, class X>
constexpr typename D::bit is(const X& x, std::int64_t number) {
  return typename D::bit(x == D::lit(number, width_of(x)));
}
/// x in `bits` bits. What is too large becomes their largest number.
template <class D>
constexpr auto at_most(const auto& x, const auto& bits) {
  return either(
      bits < width_of(x), x,
      [&](const auto& wide) {
        const typename D::bit above = any<D>(slice(wide, width_of(wide) - 1_w, bits));
        return as_unsigned(slice(wide, bits - 1_w, 0_w) | spread(above, bits));
      },
      [](const auto& whole) { return as_unsigned(whole); });
}
/// `bits` bits do not hold x, or hold it as all ones. There are fewer of them than x has.
template <class D>
constexpr typename D::bit exceeds(const auto& x, const auto& bits) {
  using Bit = typename D::bit;
  return either(
      bits < width_of(x), x,
      [&](const auto& wide) {
        const Bit above = any<D>(slice(wide, width_of(wide) - 1_w, bits));
        return Bit(above | ~any<D>(~slice(wide, bits - 1_w, 0_w)));
      },
      [](const auto&) { return Bit(D::lit(0, 1_w)); });
}
namespace detail {
template <std::size_t First, std::size_t Count, class Parts>
constexpr auto cat_of(const Parts& parts) {
  constexpr std::size_t half = (Count + 1) / 2;
  if constexpr (Count == 1)
    return std::get<First>(parts);
  else
    return cat(cat_of<First, half>(parts), cat_of<First + half, Count - half>(parts));
}
}  // namespace detail
/// Three or more, the first in the high bits.
template <class X, class Y, class Z, class... More>
constexpr auto cat(const X& x, const Y& y, const Z& z, const More&... more) {
  return detail::cat_of<0, 3 + sizeof...(More)>(std::tie(x, y, z, more...));
}

}  // namespace hitpipe::hls
