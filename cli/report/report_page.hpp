// A page of HTML that needs nothing but itself: no network, no script; drawings are inline SVG, pictures data
// URIs. Wide tables and drawings scroll within their own frame, so that a telephone can show the page.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hitpipe::cli {

/// Text as HTML shows it literally, in an attribute too.
[[nodiscard]] std::string escaped(std::string_view text);

/// RFC 4648, with padding.
[[nodiscard]] std::string base64(std::string_view bytes);

/// A number for readers: whole ones in groups of three digits, others to four significant ones. Anything else
/// stays as it is.
[[nodiscard]] std::string readable_number(const std::string& cell);

struct PageTable {
  std::string caption;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< as they are printed; numbers are put to the right
};

/// What the colours of a map stand for, from `low` to `high`.
struct PageScale {
  std::string low;
  std::string high;
};

struct PagePicture {
  std::string caption;
  std::string alternative;  ///< for those who do not see it
  std::string png;          ///< the file's bytes
  int width = 0;            ///< in pixels
  int height = 0;
  std::vector<PageScale> scale;  ///< one of a map, else none
};

class Page {
 public:
  explicit Page(std::string title);

  void heading(const std::string& text);
  void paragraph(const std::string& text);
  void list(const std::vector<std::pair<std::string, std::string>>& names_and_values);
  void table(const PageTable& table);
  /// Side by side where there is room.
  void pictures(const std::vector<PagePicture>& pictures);
  /// `svg` as gnuplot or Graphviz writes it; its identifiers are made unique in the page.
  void drawing(const std::string& svg, const std::string& alternative, const std::string& caption);
  /// The same, made somewhat smaller where there is less room.
  void plot(const std::string& svg, const std::string& alternative, const std::string& caption);
  void commands(const std::vector<std::string>& lines);
  /// What follows until close() is hidden until the reader opens it.
  void open(const std::string& summary);
  void close();

  [[nodiscard]] std::string html() const;

 private:
  void figure(const std::string& classes, const std::string& svg, const std::string& alternative,
              const std::string& caption);

  std::string title_;
  std::string body_;
  std::vector<std::pair<std::string, std::string>> contents_;  // identifier and heading
  int drawings_ = 0;
};

}  // namespace hitpipe::cli
