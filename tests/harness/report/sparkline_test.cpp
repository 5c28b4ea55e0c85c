// Curves in a line of text.
#include "harness/report/sparkline.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <vector>

namespace bqsa::harness::report {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

TEST(Sparkline, HasABlockAValueFromBottomToTop) {
  EXPECT_EQ(sparkline(std::vector<float>{0, 1, 2, 3, 4, 5, 6, 7, 8}, 0, 8, Shown::kLargest, 60),
            "▁▂▃▄▅▆▇██");
}

TEST(Sparkline, ShowsTheWorstOfThoseThatShareAColumn) {
  const std::vector<float> values = {0, 8, 0, 0, 4, 0};
  EXPECT_EQ(sparkline(values, 0, 8, Shown::kLargest, 3), "█▁▅");
  EXPECT_EQ(sparkline(values, 0, 8, Shown::kSmallest, 3), "▁▁▁");
}

TEST(Sparkline, CoversAllValues) {
  for (std::size_t size = 1; size < 200; ++size) {
    for (std::size_t at = 0; at < size; ++at) {
      std::vector<float> values(size, 0);
      values[at] = 1;
      const std::string line = sparkline(values, 0, 1, Shown::kLargest, 60);
      EXPECT_NE(line.find("█"), std::string::npos) << at << " of " << size;
      EXPECT_EQ(line.size(), std::min<std::size_t>(size, 60) * 3);
    }
  }
}

TEST(Sparkline, HoldsWhatIsOutsideAndLeavesGapsForWhatIsNoNumber) {
  EXPECT_EQ(sparkline(std::vector<float>{-5, kNone, 50}, 0, 8, Shown::kSmallest, 60), "▁ █");
  EXPECT_EQ(sparkline(std::vector<float>{kNone, 8}, 0, 8, Shown::kSmallest, 1), "█");
  EXPECT_EQ(sparkline(std::vector<float>{3, 3}, 3, 3, Shown::kLargest, 60), "▁▁");
  EXPECT_EQ(sparkline({}, 0, 1, Shown::kLargest, 60), "");
}

TEST(Locale, IsThatOfTheFirstVariableThatIsSet) {
  const auto is_utf8 = [](const char* all, const char* ctype, const char* lang) {
    setenv("LC_ALL", all, 1);
    setenv("LC_CTYPE", ctype, 1);
    setenv("LANG", lang, 1);
    return locale_is_utf8();
  };
  EXPECT_TRUE(is_utf8("", "", "C.UTF-8"));
  EXPECT_TRUE(is_utf8("", "", "de_DE.utf8"));
  EXPECT_TRUE(is_utf8("en_US.UTF-8", "C", "C"));
  EXPECT_FALSE(is_utf8("C", "C.UTF-8", "C.UTF-8"));
  EXPECT_FALSE(is_utf8("", "POSIX", "C.UTF-8"));
  EXPECT_FALSE(is_utf8("", "", ""));
}

}  // namespace
}  // namespace bqsa::harness::report
