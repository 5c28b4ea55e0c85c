// Declared parameters: what may be set, what is refused in which words, what is recorded.

#include "bqsa/parameters.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace bqsa {
namespace {

using Texts = std::vector<std::pair<std::string, std::string>>;

ParameterValues example() {
  return ParameterValues({{"gain", "1/s", 2.5, 0, 10, "of the correction"},
                          integer_parameter("points", "-", 8, 1, 100, "test points a link"),
                          choice_parameter("law", {"mk", "gpm"}, "how the arm is repelled")});
}

/// The message with which setting `name` to `text` is refused.
std::string refusal(ParameterValues values, const std::string& name, const std::string& text) {
  try {
    values.set(name, text);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Parameters, StartAtTheirDefaults) {
  const ParameterValues values = example();
  EXPECT_EQ(values.number("gain"), 2.5);
  EXPECT_EQ(values.integer("points"), 8);
  EXPECT_EQ(values.choice("law"), "mk");
  EXPECT_EQ(values.as_text(), (Texts{{"gain", "2.5"}, {"points", "8"}, {"law", "mk"}}));
  EXPECT_EQ(values.non_defaults(), Texts{});
}

TEST(Parameters, TakeTextAndRecordWhatDiffers) {
  ParameterValues values = example();
  values.set("gain", "1e-1");
  values.set("points", "100");
  values.set("law", "gpm");
  EXPECT_EQ(values.number("gain"), 0.1);
  EXPECT_EQ(values.integer("points"), 100);
  EXPECT_EQ(values.choice("law"), "gpm");
  EXPECT_EQ(values.non_defaults(), (Texts{{"gain", "0.1"}, {"points", "100"}, {"law", "gpm"}}));
  values.set("gain", "2.50");
  values.set("law", "mk");
  EXPECT_EQ(values.non_defaults(), (Texts{{"points", "100"}})) << "back at the default";
}

TEST(Parameters, TextReadsBackAsTheSameNumber) {
  for (const double number : {0.1, 1.0 / 3, 1e-9, 9.999999999999998, 0.0}) {
    ParameterValues values({{"x", "m", 1, 0, 10, "a number"}});
    values.set("x", ParameterValues({{"x", "m", number, 0, 10, "a number"}}).as_text()[0].second);
    EXPECT_EQ(values.number("x"), number);
  }
}

TEST(Parameters, BoundsAreInclusive) {
  EXPECT_EQ(refusal(example(), "gain", "0"), "accepted");
  EXPECT_EQ(refusal(example(), "gain", "10"), "accepted");
  EXPECT_EQ(refusal(example(), "points", "1"), "accepted");
  EXPECT_NE(refusal(example(), "points", "101"), "accepted");
}

TEST(Parameters, RefuseWhatIsNoNumberInRange) {
  for (const std::string text : {"10.001", "-0.1", "nan", "inf", "-inf", "1e999", "", " 1", "1 ",
                                 "1,5", "1.5x", "fast", "0x10", "+1"}) {
    EXPECT_EQ(refusal(example(), "gain", text),
              "parameter 'gain': expected a number from 0 to 10 [1/s], got '" + text + "'");
  }
}

TEST(Parameters, RefuseAFractionWhereAWholeNumberIsMeant) {
  EXPECT_EQ(refusal(example(), "points", "2.5"),
            "parameter 'points': expected a whole number from 1 to 100 [-], got '2.5'");
  EXPECT_EQ(refusal(example(), "points", "3.0"), "accepted");
}

TEST(Parameters, RefuseAnUndeclaredChoice) {
  EXPECT_EQ(refusal(example(), "law", "MK"), "parameter 'law': expected one of mk, gpm, got 'MK'");
}

TEST(Parameters, RefuseAnUnknownName) {
  EXPECT_EQ(refusal(example(), "Gain", "1"),
            "unknown parameter 'Gain': expected one of gain, points, law");
  EXPECT_EQ(refusal(ParameterValues({}), "gain", "1"),
            "unknown parameter 'gain': expected none (the method has no parameters)");
}

TEST(Parameters, KeepTheirValueWhenARefusalIsThrown) {
  ParameterValues values = example();
  values.set("gain", "3");
  EXPECT_THROW(values.set("gain", "11"), ParameterError);
  EXPECT_EQ(values.number("gain"), 3);
}

}  // namespace
}  // namespace bqsa
