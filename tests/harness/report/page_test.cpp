// The template, filled: whatever the data hold, they stay data.
#include "harness/report/page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "schema_check.hpp"

namespace bqsa::harness::report {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::vector<std::string> kHostile = {
    "</script><script>alert(1)</script>",
    "<!-- <script>",
    "]]>",
    "\"quoted\" and 'quoted' and \\ and \\u003c",
    "line\nbreak\ttab",
    "\xE2\x80\xA8 and \xE2\x80\xA9",
    "\xF0\x9F\xA4\x96 and \xE2\x82\xAC",
    "@BQSA_REPORT_DATA@",
    "$& $1 %s {0}",
    std::string(10'000, '<'),
};

TEST(FilledPage, HoldsHostileTextAsTextThatReadsBack) {
  for (const std::string& text : kHostile) {
    const std::string page =
        filled_page(page_template(), {{"title", text}, {text, Json::array({text})}});
    const std::string script = script_text({{"title", text}});
    EXPECT_THAT(script, Not(HasSubstr("<")));
    EXPECT_THAT(script, Not(HasSubstr("\xE2\x80\xA8")));
    EXPECT_THAT(script, Not(HasSubstr("\xE2\x80\xA9")));
    EXPECT_THAT(script, Not(HasSubstr("\n")));
    const nlohmann::json data = data_in(page);
    EXPECT_EQ(data["title"], text);
    EXPECT_EQ(data[text][0], text);
  }
}

TEST(FilledPage, ReplacesBytesThatAreNotUtf8) {
  const nlohmann::json data = data_in(filled_page(page_template(), {{"title", "a\xff\xfe z"}}));
  EXPECT_EQ(data["title"], "a\xEF\xBF\xBD\xEF\xBF\xBD z");
}

TEST(FilledPage, HasNullForNumbersThatAreNotFinite) {
  EXPECT_EQ(text_of({std::numeric_limits<double>::quiet_NaN(),
                     std::numeric_limits<double>::infinity(), 0.1}),
            "[null,null,0.1]");
}

/// What is compiled into the program is the file, to the byte.
TEST(FilledPage, TemplateIsTheFile) {
  std::ifstream file(BQSA_SOURCE_DIR "/report/dist/template.html", std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_EQ(page_template(), text.str());
}

TEST(FilledPage, TemplateAllowsNothingFromElsewhere) {
  EXPECT_THAT(std::string(page_template()), HasSubstr("default-src 'none'"));
}

TEST(FilledPage, NeedsTheMarkExactlyOnce) {
  const Json json = {{"a", 1}};
  EXPECT_EQ(filled_page("x@BQSA_REPORT_DATA@y", json), R"(x{"a":1}y)");
  EXPECT_THROW(filled_page("xy", json), std::runtime_error);
  EXPECT_THROW(filled_page("", json), std::runtime_error);
  EXPECT_THROW(filled_page("@BQSA_REPORT_DATA@@BQSA_REPORT_DATA@", json), std::runtime_error);
}

}  // namespace
}  // namespace bqsa::harness::report
