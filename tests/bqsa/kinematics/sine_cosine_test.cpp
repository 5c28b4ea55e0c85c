// Sines and cosines against those of long double, on every instruction set that this processor runs.

#include "bqsa/kinematics/sine_cosine.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "bqsa/batch/instruction_set.hpp"
#include "support/allocation_guard.hpp"
#include "support/sampling.hpp"

namespace bqsa {
namespace {

using test_support::Generator;
using test_support::uniform;

constexpr double kBound = 2.3e-16;  // as promised

struct SineCosine : testing::Test {
  ~SineCosine() override { use_instruction_set(instruction_sets().front().name); }
};

/// Angles of every size, and those within a few rounding errors of a multiple of pi/4.
std::vector<double> awkward_angles(Generator& generator) {
  std::vector<double> angles{0, -0.0, std::numeric_limits<double>::denorm_min(), 1e-300, 1e5, -1e5};
  for (const double range : {1e-9, 0.1, 1.0, 4.0, 100.0, 1e5}) {
    for (int i = 0; i < 20000; ++i) {
      const double angle = uniform(generator, -range, range);
      angles.push_back(angle);
      const double quarter = std::numbers::pi / 4;
      const double near = std::round(angle / quarter) * quarter;
      angles.push_back(std::nextafter(near, angle));
      angles.push_back(near);
    }
  }
  return angles;
}

double error_of(double sine, double cosine, double angle) {
  const long double of_sine = std::abs(std::sin(static_cast<long double>(angle)) - sine);
  const long double of_cosine = std::abs(std::cos(static_cast<long double>(angle)) - cosine);
  return static_cast<double>(std::max(of_sine, of_cosine));
}

TEST_F(SineCosine, AreWithinOneUnitInTheLastPlaceOfOneAndTheSameOnAllInstructionSets) {
  Generator generator(81);
  std::vector<double> angles = awkward_angles(generator);
  angles.resize(angles.size() / kMaxAngles * kMaxAngles);
  std::vector<std::uint64_t> first_answers;
  for (const InstructionSet& set : instruction_sets()) {
    use_instruction_set(set.name);
    std::vector<std::uint64_t> answers;
    for (std::size_t k = 0; k < angles.size(); k += kMaxAngles) {
      Angles sine, cosine;
      sine_cosine(&angles[k], {}, kMaxAngles, sine, cosine);
      for (std::size_t i = 0; i < kMaxAngles; ++i) {
        ASSERT_LE(error_of(sine[i], cosine[i], angles[k + i]), kBound)
            << set.name << " at " << angles[k + i];
        answers.push_back(std::bit_cast<std::uint64_t>(sine[i]));
        answers.push_back(std::bit_cast<std::uint64_t>(cosine[i]));
      }
    }
    if (first_answers.empty()) first_answers = answers;
    EXPECT_EQ(answers, first_answers) << set.name;
  }
  EXPECT_GT(first_answers.size(), 700000U);
}

TEST_F(SineCosine, HoldForEveryNumberOfJointsWhateverStandsBeyondThem) {
  Generator generator(82);
  for (const InstructionSet& set : instruction_sets()) {
    use_instruction_set(set.name);
    for (int count = 1; count <= kMaxAngles; ++count) {
      Angles q, offset, sine, cosine;
      q.fill(std::numeric_limits<double>::quiet_NaN());
      offset.fill(1e300);
      for (int i = 0; i < count; ++i) {
        q[static_cast<std::size_t>(i)] = uniform(generator, -4, 4);
        offset[static_cast<std::size_t>(i)] = uniform(generator, -2, 2);
      }
      sine_cosine(q.data(), offset, count, sine, cosine);
      Angles sum{}, same_sine, same_cosine;  // with nothing beyond
      for (int i = 0; i < count; ++i) {
        const auto at = static_cast<std::size_t>(i);
        sum[at] = q[at] + offset[at];
      }
      sine_cosine(sum.data(), {}, kMaxAngles, same_sine, same_cosine);
      for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        ASSERT_LE(error_of(sine[i], cosine[i], sum[i]), kBound) << set.name << count;
        ASSERT_EQ(sine[i], same_sine[i]) << set.name << count;
        ASSERT_EQ(cosine[i], same_cosine[i]) << set.name << count;
      }
    }
  }
}

TEST_F(SineCosine, BeyondTheirRangeAreThoseOfTheStandardLibrary) {
  for (const InstructionSet& set : instruction_sets()) {
    use_instruction_set(set.name);
    for (const double large : {1.1e5, -1e9, 1e22, std::numeric_limits<double>::max()}) {
      Angles q{0.5, large}, sine, cosine;
      sine_cosine(q.data(), {}, 2, sine, cosine);
      EXPECT_EQ(sine[0], std::sin(0.5)) << set.name;
      EXPECT_EQ(sine[1], std::sin(large)) << set.name;
      EXPECT_EQ(cosine[1], std::cos(large)) << set.name;
    }
    for (const double none :
         {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
      Angles q{none}, sine, cosine;
      sine_cosine(q.data(), {}, 1, sine, cosine);
      EXPECT_TRUE(std::isnan(sine[0]) && std::isnan(cosine[0])) << set.name;
    }
  }
}

TEST_F(SineCosine, ASlightTurnAddsItsOwnRoundingOnly) {
  Generator generator(83);
  for (const InstructionSet& set : instruction_sets()) {
    use_instruction_set(set.name);
    for (int k = 0; k < 20000; ++k) {
      Angles from, to, sine, cosine;
      const double range = k % 2 == 0 ? kSlightTurn : 1e-6;
      for (std::size_t i = 0; i < kMaxAngles; ++i) {
        from[i] = uniform(generator, -4, 4);
        to[i] = from[i] + uniform(generator, -range, range);
      }
      sine_cosine(from.data(), {}, kMaxAngles, sine, cosine);
      const Angles sine_before = sine, cosine_before = cosine;
      ASSERT_TRUE(turn_slightly(from.data(), to.data(), kMaxAngles, sine, cosine));
      for (std::size_t i = 0; i < kMaxAngles; ++i) {
        const long double d = static_cast<long double>(to[i]) - from[i];
        const long double s = sine_before[i] * std::cos(d) + cosine_before[i] * std::sin(d);
        const long double c = cosine_before[i] * std::cos(d) - sine_before[i] * std::sin(d);
        ASSERT_LE(std::abs(static_cast<double>(s - sine[i])), kBound) << set.name;
        ASSERT_LE(std::abs(static_cast<double>(c - cosine[i])), kBound) << set.name;
      }
    }
  }
}

TEST_F(SineCosine, ATurnThatIsNotSlightChangesNothing) {
  for (const InstructionSet& set : instruction_sets()) {
    use_instruction_set(set.name);
    for (const double turn : {0.07, -0.07, std::numeric_limits<double>::quiet_NaN()}) {
      for (std::size_t last : {0, 6, 15}) {
        Angles from{}, to{}, sine, cosine;
        to[last] = turn;
        sine.fill(0);
        cosine.fill(1);
        EXPECT_FALSE(turn_slightly(from.data(), to.data(), kMaxAngles, sine, cosine)) << set.name;
        EXPECT_EQ(sine, Angles{}) << set.name;
      }
    }
  }
}

TEST_F(SineCosine, DoNotAllocate) {
  const Angles q{1, 2, 3};
  Angles sine, cosine;
  const test_support::AllocationGuard guard;
  sine_cosine(q.data(), {}, 3, sine, cosine);
  turn_slightly(q.data(), q.data(), 3, sine, cosine);
  EXPECT_EQ(guard.allocations(), 0U);
}

TEST_F(SineCosine, NeedNoMoreThanTheAlignmentOfNumbers) {
  struct alignas(64) Odd {
    double first = 0;
    Angles q{}, offset{}, sine{}, cosine{};
  };
  for (const InstructionSet& set : instruction_sets()) {
    use_instruction_set(set.name);
    for (int count = 1; count <= kMaxAngles; ++count) {
      Odd odd;
      for (std::size_t i = 0; i < kMaxAngles; ++i) {
        odd.q[i] = 0.3 * static_cast<double>(i);
        odd.offset[i] = -1;
      }
      const Angles turned = odd.q;
      sine_cosine(odd.q.data(), odd.offset, count, odd.sine, odd.cosine);
      EXPECT_TRUE(turn_slightly(odd.q.data(), turned.data(), count, odd.sine, odd.cosine));
      for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        EXPECT_NEAR(odd.sine[i], std::sin(odd.q[i] - 1), kBound) << set.name;
        EXPECT_NEAR(odd.cosine[i], std::cos(odd.q[i] - 1), kBound) << set.name;
      }
    }
  }
}

}  // namespace
}  // namespace bqsa
