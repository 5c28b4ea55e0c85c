#include <algorithm>
#include <cmath>

#include "fuzz/expectations.hpp"
#include "harness/trajectory_csv.hpp"

namespace bqsa::fuzz {
namespace {

bool same(double a, double b) {
  return (a == b || (std::isnan(a) && std::isnan(b))) && std::signbit(a) == std::signbit(b);
}

void expect_same(const Trajectory& a, const Trajectory& b) {
  expect(a.t.size() == b.t.size() && a.q.size() == b.q.size(), "as many rows");
  for (std::size_t row = 0; row < a.t.size(); ++row) {
    expect(same(a.t[row], b.t[row]), "the same times");
    expect(std::equal(a.q[row].begin(), a.q[row].end(), b.q[row].begin(), b.q[row].end(), same),
           "the same angles");
  }
}

bool read_for(int joints, std::string_view bytes) {
  Trajectory trajectory;
  try {
    trajectory = harness::read_trajectory(written("t.csv", bytes), joints);
  } catch (const harness::InputError& refusal) {
    expect_message(refusal);
    return false;
  }
  expect(trajectory.t.size() == trajectory.q.size(), "a time for each row");
  for (const JointVector& q : trajectory.q) expect(q.size() == joints, "all joints in each row");
  if (trajectory.q.empty()) return true;  // what is written of none is documented not to be read
  const std::filesystem::path again = directory() / "again.csv";
  harness::write_trajectory(again, trajectory);
  expect_same(trajectory, harness::read_trajectory(again, joints));
  return true;
}

}  // namespace

bool trajectory(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, bytes.find('\n'));
  const auto joints = static_cast<int>(std::count(head.begin(), head.end(), ','));
  constexpr int kTwo = 2;
  if (joints == kTwo || joints < 1 || joints > kMaxJoints) return read_for(kTwo, bytes);
  expect(!read_for(kTwo, bytes), "a trajectory of other joints to be refused");
  return read_for(joints, bytes);
}

}  // namespace bqsa::fuzz
