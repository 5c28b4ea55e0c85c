#include "harness/scenario/self_collision_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "harness/judge/judge.hpp"

namespace bqsa::harness {
namespace {

/// A pair of links that would be judged.
std::pair<int, int> read_pair(const YamlValue& value, const SelfScene& all_pairs) {
  const std::string expected = "a pair of link numbers, as [2, 5]";
  const std::vector<YamlValue> numbers = value.list(expected, 2);
  const int last = all_pairs.kinematics().points() - 1;
  std::pair<int, int> pair{numbers[0].whole_number(1, last), numbers[1].whole_number(1, last)};
  if (pair.first > pair.second) std::swap(pair.first, pair.second);
  const bool judged = std::any_of(all_pairs.pairs().begin(), all_pairs.pairs().end(),
                                  [&](const LinkPair& candidate) {
                                    return all_pairs.link(candidate.first).number == pair.first &&
                                           all_pairs.link(candidate.second).number == pair.second;
                                  });
  if (!judged) {
    value.fail("two links of some length that do not follow each other",
               fmt::format("links {} and {}", pair.first, pair.second));
  }
  return pair;
}

void check_start(const YamlValue& value, const Problem& problem,
                 const SelfCollision& self_collision, const Units& units) {
  const SelfScene scene(problem, self_collision);
  PointPositions positions;
  scene.kinematics().place(problem.start, positions);
  for (const LinkPair& pair : scene.pairs()) {
    const double clearance = scene.read(positions, pair, FclQuestion::kHit).clearance;
    if (!(clearance < -Judge::kTouching)) continue;
    value.fail("a start at which no two links collide",
               fmt::format("{}, {} deep in each other; skip: [[{}, {}]] leaves them out",
                           scene.show(pair), units.show(-clearance), scene.link(pair.first).number,
                           scene.link(pair.second).number));
  }
}

}  // namespace

std::optional<SelfCollision> read_self_collision(const YamlValue& value, const Problem& problem,
                                                 const Units& units) {
  if (!value.is_mapping() && value.choice({"true", "false"}) == "false") return std::nullopt;
  bool thick = true;
  for (std::size_t link = 0; link < problem.chain.links().size(); ++link) {
    thick = thick && problem.radius_of(link) > 0;
  }
  if (!thick) {
    value.fail("links with a radius, robot.link_radius, for self-collision to be judged",
               "links without");
  }
  SelfCollision self_collision;
  if (value.is_mapping()) {
    value.expect_keys({"skip"});
    const SelfScene all_pairs(problem, {});
    for (const YamlValue& pair : value.get("skip", "a list of pairs").list("a list of pairs")) {
      self_collision.skip.push_back(read_pair(pair, all_pairs));
    }
  }
  check_start(value, problem, self_collision, units);
  return self_collision;
}

}  // namespace bqsa::harness
