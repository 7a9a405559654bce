#include "cli/report/report_page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <regex>
#include <utility>

#include <fmt/format.h>

#include "host/text.hpp"
#include "sw_ref/render/colour_map.hpp"

namespace hitpipe::cli {

namespace {

constexpr std::string_view page_style = R"(
:root{color-scheme:light}
*{box-sizing:border-box}
body{margin:0 auto;max-width:1440px;padding:16px;font:16px/1.5 system-ui,sans-serif;color:#1a1a1a;background:#fff}
h1{font-size:1.7rem;line-height:1.2;margin:.4em 0}
h2{font-size:1.25rem;margin:2em 0 .5em;padding-top:.6em;border-top:1px solid #ccc}
p{max-width:110ch;overflow-wrap:anywhere}
a{color:#00588c}
nav ul{display:flex;flex-wrap:wrap;gap:.2em 1.2em;padding:0;list-style:none}
dl{display:grid;grid-template-columns:max-content 1fr;gap:.2em 1em;margin:1em 0}
dt{color:#555}dd{margin:0;overflow-wrap:anywhere}
.scroll{overflow:auto;margin:1em 0}
.rows{max-height:85vh;border-bottom:1px solid #ccc}
.rows thead th{position:sticky;top:0;z-index:1;background:#fff;box-shadow:inset 0 -2px #666}
.rows td:first-child,.rows th:first-child{position:sticky;left:0;background:#fff}
.rows th:first-child{z-index:2}
table{border-collapse:separate;border-spacing:0;font-size:.8rem;font-variant-numeric:tabular-nums}
.caption{margin-bottom:0;font-size:.9rem;color:#444}
th,td{padding:.25em .55em;border-bottom:1px solid #ddd;text-align:left;white-space:nowrap}
thead th{vertical-align:bottom;white-space:normal;font-weight:600}
td.t{white-space:normal;overflow-wrap:anywhere;min-width:24ch}
td.n{text-align:right}
tbody tr:hover{background:#f3f6fa}
figure{margin:1.2em 0}
figcaption{font-size:.9rem;color:#333;max-width:110ch;overflow-wrap:anywhere}
.drawing svg{display:block;max-width:none}
.plot svg{width:100%;min-width:760px;max-width:1250px;height:auto}
.pictures{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,320px),1fr));gap:1.2em;align-items:start}
.pictures figure{margin:0}
.pictures img{display:block;width:100%;height:auto;image-rendering:pixelated;background:#000}
.scale{display:flex;gap:.5em;align-items:center;font-size:.85rem;margin:.4em 0}
.scale i{flex:1;height:12px}
pre{white-space:pre-wrap;overflow-wrap:anywhere;background:#f4f4f4;padding:.8em;font-size:.85rem;border-radius:4px}
summary{cursor:pointer;padding:.3em 0;font-weight:600}
@media(max-width:600px){body{padding:12px}dl{grid-template-columns:1fr;gap:0}dd{margin-bottom:.5em}}
)";

constexpr double least_wide_px = 760;  // as in the style of .plot
/// A number, with the separators that readable_number() puts in.
bool is_number(std::string cell) {
  std::erase(cell, ',');
  if (cell.ends_with('%')) cell.pop_back();
  return host::number_in<double>(cell).has_value();
}

std::string colours() {
  std::string stops;
  for (int i = 0; i <= 8; ++i) {
    const auto [red, green, blue] = ref::viridis(static_cast<float>(i) / 8.0F);
    stops += fmt::format(",#{:02x}{:02x}{:02x}", red, green, blue);
  }
  return stops;
}

/// The class of a table's cell: a number, or a text so long that it is broken.
const char* class_of(const std::string& cell) {
  constexpr std::size_t long_text = 40;
  return is_number(cell) ? " class=\"n\"" : cell.size() > long_text ? " class=\"t\"" : "";
}

/// The <svg> element with a size, identifiers and a name of its own.
std::string inline_svg(std::string svg, int number, const std::string& alternative) {
  svg.erase(0, std::min(svg.find("<svg"), svg.size()));
  svg = std::regex_replace(svg, std::regex("<!--[^>]*-->|<title>[^<]*</title>|<desc>[^<]*</desc>"), "");
  const std::string prefix = fmt::format("d{}-", number);
  svg = std::regex_replace(svg, std::regex("(\\sid=[\"'])"), "$1" + prefix);
  svg = std::regex_replace(svg, std::regex("(href=[\"']#|url\\(#)"), "$1" + prefix);
  return svg.insert(std::min<std::size_t>(4, svg.size()),
                    fmt::format(" role=\"img\" aria-label=\"{}\"", escaped(alternative)));
}

using Words = std::pair<std::string_view, std::string_view>;

/// The longest endings first.
constexpr std::array<Words, 13> unit_words{{{"_mm2_ns", ", mm² ns"},
                                            {"_mm2_ms", ", mm² ms"},
                                            {"_lut_ms", ", LUT ms"},
                                            {"_lut", ", LUT"},
                                            {"_per_million", " in a million"},
                                            {"_mm2", ", mm²"},
                                            {"_mhz", ", MHz"},
                                            {"_pct", ", %"},
                                            {"_ns", ", ns"},
                                            {"_ms", ", ms"},
                                            {"_kib", ", KiB"},
                                            {"mrays_s", "million rays a second"},
                                            {"_a_ray", " a ray"}}};

constexpr std::array<Words, 5> heading_words{{{"stage delay", "clock period"},
                                              {"area delay", "area × clock period"},
                                              {"area run time", "area × run time"},
                                              {"area per box", "area for each box"},
                                              {"rtl", "RTL"}}};

}  // namespace

std::string escaped(std::string_view text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      case '\'':
        html += "&#39;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t taken = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (k < taken ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= taken ? digits[word >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string readable_number(const std::string& cell) {
  const std::optional<double> value = host::number_in<double>(cell);
  if (!value || !std::isfinite(*value)) return cell;
  std::string text = cell;
  if (cell.find_first_of(".eE") != std::string::npos && cell.size() > 7)
    text = std::abs(*value) >= 1e4 ? fmt::format("{:.0f}", *value) : fmt::format("{:.4g}", *value);
  if (text.find_first_not_of("-0123456789") != std::string::npos) return text;
  for (std::size_t at = text.size(); at > 3 && text[at - 4] != '-';) text.insert(at -= 3, ",");
  return text;
}

Page::Page(std::string title) : title_(std::move(title)) {}

void Page::heading(const std::string& text) {
  const std::string id = fmt::format("s{}", contents_.size() + 1);
  contents_.emplace_back(id, text);
  body_ += fmt::format("<h2 id=\"{}\">{}</h2>\n", id, escaped(text));
}

void Page::paragraph(const std::string& text) {
  body_ += fmt::format("<p>{}</p>\n", escaped(text));
}

void Page::list(const std::vector<std::pair<std::string, std::string>>& names_and_values) {
  body_ += "<dl>\n";
  for (const auto& [name, value] : names_and_values)
    body_ += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escaped(name), escaped(value));
  body_ += "</dl>\n";
}

void Page::table(const PageTable& table) {
  // The caption is outside of what scrolls.
  body_ += fmt::format(
      "<p class=\"caption\">{0}</p>\n<div class=\"scroll rows\" tabindex=\"0\"><table "
      "aria-label=\"{0}\">\n<thead><tr>",
      escaped(table.caption));
  for (const std::string& name : table.columns)
    body_ += fmt::format("<th scope=\"col\">{}</th>", escaped(name));
  body_ += "</tr></thead>\n<tbody>\n";
  for (const std::vector<std::string>& row : table.rows) {
    body_ += "<tr>";
    for (const std::string& cell : row) body_ += fmt::format("<td{}>{}</td>", class_of(cell), escaped(cell));
    body_ += "</tr>\n";
  }
  body_ += "</tbody></table></div>\n";
}

void Page::pictures(const std::vector<PagePicture>& pictures) {
  body_ += "<div class=\"pictures\">\n";
  for (const PagePicture& p : pictures) {
    body_ +=
        fmt::format("<figure><img src=\"data:image/png;base64,{}\" alt=\"{}\" width=\"{}\" height=\"{}\">\n",
                    base64(p.png), escaped(p.alternative), p.width, p.height);
    for (const PageScale& scale : p.scale) {
      body_ += fmt::format(
          "<div class=\"scale\">{}<i style=\"background:linear-gradient(90deg{})\"></i>{}</div>\n",
          escaped(scale.low), colours(), escaped(scale.high));
    }
    body_ += fmt::format("<figcaption>{}</figcaption></figure>\n", escaped(p.caption));
  }
  body_ += "</div>\n";
}

void Page::drawing(const std::string& svg, const std::string& alternative, const std::string& caption) {
  figure("drawing", svg, alternative, escaped(caption));
}

void Page::plot(const DrawnPicture& drawn, const std::string& caption) {
  std::string text = caption;
  if (drawn.unnamed > 0)
    text += fmt::format(" Labels without room: {}; {}.gp names all marks.", drawn.unnamed, drawn.name);
  figure(drawn.width_px < least_wide_px ? "drawing" : "drawing plot", drawn.svg, drawn.title,
         fmt::format("<strong>{}.</strong> {}", escaped(drawn.title), escaped(text)));
}

void Page::figure(const std::string& classes, const std::string& svg, const std::string& alternative,
                  const std::string& caption) {
  body_ += fmt::format(
      "<figure class=\"{}\"><div class=\"scroll\" tabindex=\"0\">{}</div>\n"
      "<figcaption>{}</figcaption></figure>\n",
      classes, inline_svg(svg, ++drawings_, alternative), caption);
}

void Page::commands(const std::vector<std::string>& lines) {
  body_ += "<pre tabindex=\"0\">";
  for (const std::string& line : lines) body_ += escaped(line) + "\n";
  body_ += "</pre>\n";
}

void Page::open(const std::string& summary) {
  body_ += fmt::format("<details><summary>{}</summary>\n", escaped(summary));
}

void Page::close() {
  body_ += "</details>\n";
}

std::string Page::html() const {
  std::string links;
  for (const auto& [id, name] : contents_)
    links += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", id, escaped(name));
  // An empty icon, so that no browser asks for one.
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n"
      "<h1>{0}</h1>\n<nav "
      "aria-label=\"Contents\"><ul>\n{2}</ul></nav>\n<main>\n{3}</main>\n</body>\n</html>\n",
      escaped(title_), page_style, links, body_);
}

std::string column_heading(std::string_view column) {
  std::string unit;
  for (const auto& [ending, text] : unit_words) {
    if (!column.ends_with(ending)) continue;
    unit = text;
    column.remove_suffix(ending.size());
    break;
  }
  std::string heading(column);
  std::replace(heading.begin(), heading.end(), '_', ' ');
  for (const auto& [name, text] : heading_words) {
    if (const std::size_t at = heading.find(name); at != std::string::npos)
      heading.replace(at, name.size(), text);
  }
  return heading + unit;
}

PageTable page_table(const std::string& caption, const std::vector<Row>& rows) {
  PageTable table{caption, {}, {}};
  if (rows.empty()) return table;
  for (const auto& [key, value] : rows.front().items()) table.columns.push_back(column_heading(key));
  for (const Row& row : rows) {
    std::vector<std::string> cells;
    for (const auto& [key, value] : row.items())
      cells.push_back(value.is_null()     ? ""
                      : value.is_string() ? value.get<std::string>()
                                          : readable_number(value.dump()));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

}  // namespace hitpipe::cli
