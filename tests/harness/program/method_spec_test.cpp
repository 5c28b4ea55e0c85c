#include "harness/method_spec.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace bqsa::harness {
namespace {

using ::testing::HasSubstr;

std::vector<MethodEntry> known() {
  MethodEntry plain;
  plain.name = "plain";
  MethodEntry tuned;
  tuned.name = "tuned";
  tuned.parameters = {{"gain", "1/s", 2, 0, 10, "gain"},
                      integer_parameter("points", "-", 8, 1, 64, "points"),
                      choice_parameter("search", {"fast", "slow"}, "search")};
  return {plain, tuned};
}

TEST(MethodSpec, NamesAMethodWithItsDefaults) {
  const MethodSpec spec = parse_method_spec("tuned", known());
  EXPECT_EQ(spec.parameters.number("gain"), 2);
  EXPECT_EQ(changed_parameters(spec.parameters), "");
  EXPECT_EQ(variant_name(spec), "tuned");
}

TEST(MethodSpec, SetsParametersWhateverTheirOrder) {
  const MethodSpec spec = parse_method_spec("tuned:search=slow,gain=2.5", known());
  EXPECT_EQ(spec.parameters.number("gain"), 2.5);
  EXPECT_EQ(spec.parameters.choice("search"), "slow");
  EXPECT_EQ(changed_parameters(spec.parameters), "gain=2.5,search=slow");
  EXPECT_EQ(variant_name(spec),
            variant_name(parse_method_spec("tuned:gain=2.50,search=slow", known())));
}

TEST(MethodSpec, IsThePlainMethodIfAllValuesAreDefaults) {
  EXPECT_EQ(variant_name(parse_method_spec("tuned:gain=2,points=8", known())), "tuned");
}

TEST(MethodSpec, HashesChangedParametersWithFnv1a) {
  // FNV-1a, 32 bits, of "gain=2.5", computed apart from this program.
  EXPECT_EQ(variant_name(parse_method_spec("tuned:gain=2.5", known())), "tuned@91a23648");
}

struct Refused {
  const char* name;
  const char* text;
  const char* message;
};

void PrintTo(const Refused& refused, std::ostream* out) { *out << refused.text; }

class MethodSpecRefuses : public ::testing::TestWithParam<Refused> {};

TEST_P(MethodSpecRefuses, WithAMessage) {
  try {
    parse_method_spec(GetParam().text, known());
    FAIL() << "accepted " << GetParam().text;
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(GetParam().message));
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, MethodSpecRefuses,
    ::testing::Values(
        Refused{"UnknownMethod", "other", "unknown method 'other': expected one of plain, tuned"},
        Refused{"NoMethod", "", "unknown method ''"},
        Refused{"UnknownParameter", "tuned:gian=1",
                "unknown parameter 'gian': expected one of gain"},
        Refused{"ParameterOfAMethodWithout", "plain:gain=1", "unknown parameter 'gain'"},
        Refused{"AboveRange", "tuned:gain=11",
                "'gain': expected a number from 0 to 10 [1/s], got '11'"},
        Refused{"NotANumber", "tuned:gain=nan", "got 'nan'"},
        Refused{"NotWhole", "tuned:points=1.5", "expected a whole number"},
        Refused{"UnknownChoice", "tuned:search=best", "expected one of fast, slow, got 'best'"},
        Refused{"NoValue", "tuned:x", "method 'tuned:x': expected key=value, got 'x'"},
        Refused{"EmptyValue", "tuned:gain=", "got ''"},
        Refused{"NothingAfterColon", "tuned:", "expected key=value, got ''"},
        Refused{"TrailingComma", "tuned:gain=1,", "expected key=value, got ''"},
        Refused{"GivenTwice", "tuned:gain=1,gain=2", "parameter 'gain': given twice"}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace bqsa::harness
