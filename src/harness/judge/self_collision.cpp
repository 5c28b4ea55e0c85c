#include "harness/judge/self_collision.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/judge/fcl_links.hpp"
#include "harness/judge/link_distance.hpp"

namespace bqsa::harness {
namespace {

bool is_skipped(const SelfCollision& self_collision, int a, int b) {
  return std::any_of(self_collision.skip.begin(), self_collision.skip.end(),
                     [a, b](const std::pair<int, int>& pair) {
                       return pair == std::pair(a, b) || pair == std::pair(b, a);
                     });
}

}  // namespace

SelfScene::SelfScene(const Problem& problem, const SelfCollision& self_collision)
    : kinematics_(problem.chain.description()),
      turns_about_own_origin_(problem.chain.description().turns_about_own_origin()),
      radii_(kinematics_.links().size()) {
  for (std::size_t i = 0; i < radii_.size(); ++i) radii_[i] = problem.radius_of(i);
  const int links = static_cast<int>(kinematics_.links().size());
  for (int first = 0; first < links; ++first) {
    for (int second = first + 2; second < links; ++second) {
      if (is_skipped(self_collision, link(first).number, link(second).number)) continue;
      pairs_.push_back({first, second});
    }
  }
}

int SelfScene::first_joint_between(const LinkPair& pair) const {
  const int end = link(pair.first).end;
  return turns_about_own_origin_ ? end - 1 : std::min(end, kinematics_.joints());
}

std::string SelfScene::show(const LinkPair& pair) const {
  return fmt::format("link {} and link {}", link(pair.first).number, link(pair.second).number);
}

PairReading SelfScene::read(const PointPositions& positions, const LinkPair& pair,
                            FclQuestion question) const {
  const auto capsule = [&](int index) -> LinkCapsule {
    return {positions.points[static_cast<std::size_t>(link(index).start)],
            positions.points[static_cast<std::size_t>(link(index).end)], radius(index)};
  };
  const LinkCapsule a = capsule(pair.first), b = capsule(pair.second);
  const LinkDistance exact = link_distance(a.start, a.end, b.start, b.end);
  PairReading reading;
  reading.clearance = exact.distance - reach(pair);
  reading.normal = exact.normal;
  reading.offset = std::max(exact.normal.dot(a.start), exact.normal.dot(a.end));
  const bool hit = fcl_links_collide(a, b);
  if (hit || question == FclQuestion::kHit) {
    reading.contradiction = contradiction(reading.clearance, hit);
  } else {
    const double size = (a.end - a.start).norm() + (b.end - b.start).norm();
    reading.contradiction =
        contradiction(reading.clearance, FclAnswer{hit, fcl_links_distance(a, b)}, size);
  }
  return reading;
}

}  // namespace bqsa::harness
