// A page of HTML that needs no other file, no network and no script. Drawings are inline SVG, pictures are
// data URIs. Wide tables and drawings scroll in their own frame, so that a telephone can show the page.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/report/picture.hpp"
#include "cli/text/table.hpp"

namespace hitpipe::cli {

/// Escapes text so that HTML shows it literally, in attributes too.
[[nodiscard]] std::string escaped(std::string_view text);

/// Base64 by RFC 4648, with padding.
[[nodiscard]] std::string base64(std::string_view bytes);

/// Formats a number for readers: whole numbers in groups of three digits, others with four significant
/// digits. Any other text stays as it is.
[[nodiscard]] std::string readable_number(const std::string& cell);

struct PageTable {
  std::string caption;
  std::vector<std::string> columns;            ///< headings in words
  std::vector<std::vector<std::string>> rows;  ///< printed as they are; numbers are aligned on the right
};

/// What the colours of a map mean, from `low` to `high`.
struct PageScale {
  std::string low;
  std::string high;
};

struct PagePicture {
  std::string caption;
  std::string alternative;  ///< text for readers who cannot see it
  std::string png;          ///< the file's bytes
  int width = 0;            ///< in pixels
  int height = 0;
  std::vector<PageScale> scale;  ///< one for a map, none for other pictures
};

class Page {
 public:
  explicit Page(std::string title);

  void heading(const std::string& text);
  void paragraph(const std::string& text);
  void list(const std::vector<std::pair<std::string, std::string>>& names_and_values);
  void table(const PageTable& table);
  /// Side by side if there is room.
  void pictures(const std::vector<PagePicture>& pictures);
  /// `svg` is as gnuplot or Graphviz writes it. Its identifiers are made unique in the page.
  void drawing(const std::string& svg, const std::string& alternative, const std::string& caption);
  /// With its title above the caption. A wide one is made smaller if there is less room.
  void plot(const DrawnPicture& drawn, const std::string& caption);
  void commands(const std::vector<std::string>& lines);
  /// Hides everything up to close() until the reader opens it.
  void open(const std::string& summary);
  void close();

  [[nodiscard]] std::string html() const;

 private:
  /// `caption` is HTML.
  void figure(const std::string& classes, const std::string& svg, const std::string& alternative,
              const std::string& caption);

  std::string title_;
  std::string body_;
  std::vector<std::pair<std::string, std::string>> contents_;  // identifier and heading
  int drawings_ = 0;
};

/// The cells of rows, formatted for readers.
[[nodiscard]] PageTable page_table(const std::string& caption, const std::vector<Row>& rows);

/// A heading in words: a column of a CSV file is called "clock_mhz", on a page "clock, MHz". Text that is no
/// name of a column stays as it is.
[[nodiscard]] std::string column_heading(std::string_view column);

}  // namespace hitpipe::cli
