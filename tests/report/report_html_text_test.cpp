#include "report/report_html_text.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tcm_icp {
namespace {

TEST(HtmlText, EscapesMarkupAndWhatIsNoCharacter) {
  EXPECT_EQ(html::escaped("a<b>&\"'"), "a&lt;b&gt;&amp;&quot;&#39;");
  EXPECT_EQ(html::escaped("\u70B9 \U0001F600"), "\u70B9 \U0001F600");
  EXPECT_EQ(html::escaped("\n\x7F"), "\uFFFD\uFFFD");
  EXPECT_EQ(html::escaped("\xC0\xAF"), "\uFFFD\uFFFD") << "overlong";
  EXPECT_EQ(html::escaped("\xED\xA0\x80"), "\uFFFD\uFFFD\uFFFD") << "surrogate";
  EXPECT_EQ(html::escaped("\xE7\x82"), "\uFFFD\uFFFD") << "cut short";
  EXPECT_EQ(html::escaped("\uFFFF"), "\uFFFD") << "not allowed in XML";
}

TEST(HtmlText, LongNamesBreakAfterFolders) {
  EXPECT_EQ(html::file_name("a.ply"), "<bdi class=\"file\">a.ply</bdi>");
  EXPECT_EQ(html::file_name("yard/one//a<.ply"), "<bdi class=\"file\">yard/<wbr/>one/<wbr/>/<wbr/>a&lt;.ply</bdi>");
}

TEST(HtmlText, GivesThreeDigits) {
  EXPECT_EQ(html::figure(12345.6), "12346");
  EXPECT_EQ(html::figure(12.345), "12.3");
  EXPECT_EQ(html::figure(-0.0012345), "-0.00123");
  EXPECT_EQ(html::figure(1.2e-16), "1.2e-16");
  EXPECT_EQ(html::figure(0.0), "0");
  EXPECT_EQ(html::figure(std::nan("")), "\u2013");
  EXPECT_EQ(html::figure(Json(0.5), 1000), "500");
  EXPECT_EQ(html::figure(Json()), "\u2013");
  EXPECT_EQ(html::norm(Json{3, 4, 0}), "5.00");
  EXPECT_EQ(html::norm(Json{3, nullptr}), "\u2013");
  EXPECT_EQ(html::percent(Json(0.456)), "46\u202F%");
  EXPECT_EQ(html::count(Json(1234567)), "1\u202F234\u202F567");
}

}  // namespace
}  // namespace tcm_icp
