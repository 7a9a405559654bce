// The parts of a report's page: text, numbers, pictures and drawings as HTML.
#include "cli/report/report_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hitpipe::cli::report_page_test {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Base64, IsThatOfRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::string("\xFF\xFE\x00", 3)), "//4A");
}

TEST(ReadableNumber, KeepsWhatIsShortAndWhatIsNone) {
  EXPECT_EQ(readable_number("3.176"), "3.176");
  EXPECT_EQ(readable_number("0.03084269085342762"), "0.03084");
  EXPECT_EQ(readable_number("99.99987728707483"), "100");
  EXPECT_EQ(readable_number("123456.7890123"), "123,457");
  EXPECT_EQ(readable_number("1234567"), "1,234,567");
  EXPECT_EQ(readable_number("-1234"), "-1,234");
  EXPECT_EQ(readable_number("-123"), "-123");
  EXPECT_EQ(readable_number("20/24"), "20/24");
  EXPECT_EQ(readable_number(""), "");
}

TEST(Page, ShowsTextLiterally) {
  Page page("<a> & \"b\"");
  page.paragraph("x<y");
  page.table({"c", {"rays in flight", "fp_slabs"}, {{"1,234", "int_slabs"}, {std::string(41, 'x'), ""}}});
  const std::string html = page.html();
  EXPECT_THAT(html, HasSubstr("<title>&lt;a&gt; &amp; &quot;b&quot;</title>"));
  EXPECT_THAT(html, HasSubstr("<p>x&lt;y</p>"));
  EXPECT_THAT(html, HasSubstr("<th scope=\"col\">rays in flight</th>"));
  EXPECT_THAT(html, HasSubstr("<td class=\"n\">1,234</td>"));
  EXPECT_THAT(html, HasSubstr("<th scope=\"col\">fp_slabs</th>"));
  EXPECT_THAT(html, HasSubstr("<td>int_slabs</td>"));
  EXPECT_THAT(html, HasSubstr("<td class=\"t\">xxxx")) << "a long text may be broken";
}

TEST(Page, GivesEachDrawingIdentifiersOfItsOwn) {
  const std::string svg =
      "<?xml version=\"1.0\"?>\n<!-- made by -->\n<svg width=\"9\"><title>G</title><path id=\"p\"/>"
      "<use xlink:href='#p'/><g clip-path=\"url(#p)\"/></svg>\n";
  Page page("t");
  page.drawing(svg, "first \"one\"", "c");
  page.drawing(svg, "second", "c");
  const std::string html = page.html();
  EXPECT_THAT(html, HasSubstr("<svg role=\"img\" aria-label=\"first &quot;one&quot;\" width=\"9\"><path "
                              "id=\"d1-p\"/><use xlink:href='#d1-p'/><g clip-path=\"url(#d1-p)\"/></svg>"));
  EXPECT_THAT(html, HasSubstr("<path id=\"d2-p\"/><use xlink:href='#d2-p'/>"));
  EXPECT_THAT(html, Not(HasSubstr("<?xml")));
}

TEST(Page, SaysTheTitleOfAPlotAndWhichLabelsItLacks) {
  DrawnPicture drawn{
      .name = "p", .title = "a < b", .script = {}, .svg = "<svg></svg>", .pdf = {}, .width_px = 1000};
  Page page("t");
  page.plot(drawn, "c & d.");
  drawn.width_px = 317;
  drawn.unnamed = 3;
  page.plot(drawn, "e.");
  const std::string html = page.html();
  EXPECT_THAT(html, HasSubstr("<figure class=\"drawing plot\">"));
  EXPECT_THAT(html, HasSubstr("<figcaption><strong>a &lt; b.</strong> c &amp; d.</figcaption>"));
  EXPECT_THAT(html, HasSubstr("<figure class=\"drawing\">")) << "a narrow picture is not made wider";
  EXPECT_THAT(html, HasSubstr("e. Labels without room: 3; p.gp names all marks.</figcaption>"));
}

TEST(ColumnHeading, IsWordsWithTheUnitAtTheEnd) {
  EXPECT_EQ(column_heading("clock_mhz"), "clock, MHz");
  EXPECT_EQ(column_heading("stage_delay_ns"), "clock period, ns");
  EXPECT_EQ(column_heading("area_per_box_mm2"), "area for each box, mm²");
  EXPECT_EQ(column_heading("whole_area_run_time_mm2_ms"), "whole area × run time, mm² ms");
  EXPECT_EQ(column_heading("extra_box_tests_pct"), "extra box tests, %");
  EXPECT_EQ(column_heading("false_hits_per_million"), "false hits in a million");
  EXPECT_EQ(column_heading("rtl_mismatches"), "RTL mismatches");
  EXPECT_EQ(column_heading("32"), "32");
}

}  // namespace
}  // namespace hitpipe::cli::report_page_test
