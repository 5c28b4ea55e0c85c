#include "fuzz/expectations.hpp"
#include "harness/external/answers.hpp"

namespace bqsa::fuzz {
namespace {

constexpr int kTick = 7;
constexpr int kJoints = 2;
constexpr int kObstacles = 3;

/// @param read  may throw harness::AnswerError
template <typename Read>
bool accepts(Read read) {
  try {
    read();
    return true;
  } catch (const harness::AnswerError& refusal) {
    expect_message(refusal);
    return false;
  }
}

void describe(std::string_view line) {
  const MethodEntry entry = harness::read_describe_answer(line);
  ParameterValues values(entry.parameters);
  for (const auto& [name, value] : values.as_text()) values.set(name, value);
  expect(values.non_defaults().empty(), "defaults that may be given");
  expect(entry.capabilities.planar || entry.capabilities.spatial, "a method for some problem");
}

void step(std::string_view line) {
  StepInput input;
  input.tick = kTick;
  input.q = JointVector::Zero(kJoints);
  StepOutput output;
  WorkCounters counters;
  harness::read_step_answer(line, input, kObstacles, output, counters);
  expect(output.q.size() == kJoints && output.q.allFinite(), "a finite angle for each joint");
  expect(output.clamp_count >= 0 && output.clamp_count <= StepOutput::kMaxClamps,
         "room for clamps");
  for (int i = 0; i < output.clamp_count; ++i) {
    const Clamp& clamp = output.clamps[static_cast<std::size_t>(i)];
    expect(clamp.link >= 1 && clamp.link <= kMaxLinks, "clamps of links");
    expect(clamp.obstacle >= 0 && clamp.obstacle < kObstacles, "clamps of obstacles");
  }
  expect(output.obstacle >= -1 && output.obstacle < kObstacles, "an obstacle or none");
}

void plan(std::string_view line) {
  WorkCounters counters;
  const Trajectory trajectory = harness::read_plan_answer(line, kJoints, counters).trajectory;
  expect(trajectory.t.size() == trajectory.q.size(), "a time for each row");
  for (const JointVector& q : trajectory.q) {
    expect(q.size() == kJoints && q.allFinite(), "a finite angle for each joint");
  }
}

}  // namespace

bool external_answer(std::string_view bytes) {
  const bool description = accepts([&] { describe(bytes); });
  const bool nothing = accepts([&] { harness::read_prepare_answer(bytes); });
  const bool tick = accepts([&] { step(bytes); });
  const bool motion = accepts([&] { plan(bytes); });
  const int accepted = int{description} + int{nothing} + int{tick} + int{motion};
  expect(accepted <= 1, "an answer to one request, got one to several");
  return accepted == 1;
}

}  // namespace bqsa::fuzz
