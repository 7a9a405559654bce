// What a family of number formats says about itself. A family is a struct of ints, at most eight, with
//   fields      how a user writes each of the ints
//   condition   what must hold between them, in words; this and all below may be missing
//   valid()     the condition as a function
//   example()   a format for messages, if the struct's default is none
//   alias       another name of the default format
//   single      true: the default format is the only one of this family, and is written by its alias
//   type        the template that is the format with widths known when the code is compiled: "IntFormat";
//               optional numbers have the struct's default there too
#pragma once

namespace hitpipe {
namespace hls {

/// A number of a format. In 20/24 the number 24 has "/" before it and is the t of n/t.
struct FormatField {
  const char* before;
  const char* letter;
  int least, most;
  const char* most_in_words = nullptr;  ///< "2n-1": it depends on other numbers
  bool optional = false;                ///< not written when it is that of the struct's default
};

/// The formats of a pipeline with a compiled host function of their own, for speed. All others run with
/// widths as values.
template <class... Formats>
struct FormatList {};

}  // namespace hls
}  // namespace hitpipe
