#include "harness/generator/generator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "harness/generator/draw_obstacle.hpp"
#include "harness/generator/draw_path.hpp"
#include "harness/generator/draw_scene.hpp"
#include "harness/generator/nominal_motion.hpp"
#include "harness/generator/random_stream.hpp"
#include "harness/generator/scenario_draft.hpp"
#include "harness/generator/witness_motion.hpp"
#include "harness/input_error.hpp"
#include "harness/judge/judge.hpp"

namespace bqsa::harness {
namespace {

constexpr double kDuration = 5;  // [s]
constexpr int kTicks = 200;
constexpr int kAttempts = 10000;
constexpr int kAttemptsOfAnArm = 20;  // before another random arm is drawn

constexpr int kFewestLinks = 5;  // of planar arms
constexpr int kMostLinks = 9;
constexpr int kMostPlanarObstacles = 4;
constexpr int kMostSpatialObstacles = 3;
constexpr int kMostInClutter = 10;

/// Where paths stay, of the arm's reach.
constexpr double kNearest = 0.2;
constexpr double kFarthest = 0.95;
constexpr double kFarthestStretched = 0.996;

/// How many obstacles of a scenario are put on links and how many near them.
struct ObstaclePlan {
  int on_links = 0;  ///< beyond the first
  int near = 0;
};

/// What is drawn once for an index, so that no filter makes some of it rarer.
struct Structure {
  Arm arm;
  ObstaclePlan plan;
};

Structure draw_structure(const Family& family, int index, const std::vector<Arm>& spatial_arms,
                         RandomStream random) {
  const bool planar = family.planar && (!family.spatial || index % 2 == 0);
  const auto turn = static_cast<std::size_t>(family.planar ? index / 2 : index);
  Structure structure{planar                 ? planar_arm(random.whole(kFewestLinks, kMostLinks))
                      : spatial_arms.empty() ? random_arm(random)
                                             : spatial_arms[turn % spatial_arms.size()],
                      {}};
  if (family.obstacles == ObstacleKind::kSome) {
    const int more = random.whole(0, (planar ? kMostPlanarObstacles : kMostSpatialObstacles) - 1);
    for (int i = 0; i < more; ++i) {
      ++(random.chance(0.5) ? structure.plan.on_links : structure.plan.near);
    }
  }
  if (family.obstacles == ObstacleKind::kClutter) {
    const int more = random.whole(1, kMostInClutter - 1);
    for (int i = 0; i < more; ++i) {
      ++(random.chance(0.3) ? structure.plan.on_links : structure.plan.near);
    }
  }
  if (family.obstacles == ObstacleKind::kMoving) structure.plan.near = random.chance(1.0 / 3);
  return structure;
}

/// An arm at a random start and a path from there, no obstacles. None where there is no such path.
std::optional<ScenarioDraft> draw_task(const Family& family, const Arm& arm, RandomStream& random) {
  ScenarioDraft draft{.robot = arm.chain,
                      .limits = arm.limits,
                      .link_radii = arm.link_radii,
                      .robot_name = arm.name};
  draft.duration = kDuration;
  draft.ticks = kTicks;
  draft.start.resize(arm.start_low.size());
  for (Eigen::Index j = 0; j < draft.start.size(); ++j) {
    draft.start(j) = rounded(random.uniform(arm.start_low(j), arm.start_high(j)));
  }
  ChainPose pose;
  SerialChain(arm.chain).forward(draft.start, pose);
  if (family.paths == PathKind::kLineOrArc) {
    draft.path = draw_line_or_arc(pose.tip(), arm.chain.dimension, family.solids, random);
  } else if (family.paths == PathKind::kReachingIn) {
    draft.path = draw_reaching_line(pose.tip(), arm.center, random);
  } else {
    const std::optional<PathDraft> path = draw_stretching_arc(pose.tip(), arm, random);
    if (!path) return std::nullopt;
    draft.path = *path;
  }
  return draft;
}

/// Why the nominal motion is of no use.
std::optional<Filter> objection(const Family& family, const Arm& arm,
                                const NominalMotion& nominal) {
  const bool stretched = family.paths == PathKind::kStretchingArc;
  const double farthest = stretched ? kFarthestStretched : kFarthest;
  if (!nominal.path_within(arm.center, kNearest * arm.reach, farthest * arm.reach)) {
    return Filter::kReach;
  }
  if (!nominal.keeps_limits()) return Filter::kLimits;
  if (!stretched && !nominal.tracks()) return Filter::kTracking;
  return std::nullopt;
}

/// What obstacles are held against.
struct Motions {
  NominalMotion nominal;
  std::optional<ArmMotion> witness = {};  ///< of families that have them
  int placements = kPlacements;           ///< draws of an obstacle until its place is given up
};

/// Why an obstacle may not stand where it does.
std::optional<Filter> objection(const Motions& motions, const PlacedShape& obstacle) {
  if (!motions.nominal.start_is_clear(obstacle)) return Filter::kStart;
  if (!motions.nominal.path_is_clear(obstacle)) return Filter::kTipPath;
  if (!motions.nominal.inner_links_are_clear(obstacle)) return Filter::kInnerLinks;
  if (motions.witness && !keeps_clear(*motions.witness, obstacle)) return Filter::kWitness;
  return std::nullopt;
}

/// Which of the obstacles that are drawn together the nominal arm has to hit.
enum class Hit { kNone, kFirst, kAny };

bool is_hit(const NominalMotion& nominal, const std::vector<ObstacleDraft>& drafts, Hit hit) {
  const auto end = hit == Hit::kFirst ? drafts.begin() + 1 : drafts.end();
  return std::any_of(drafts.begin(), end, [&nominal](const ObstacleDraft& draft) {
    return nominal.outer_link_hits(PlacedShape(draft, nominal.problem()));
  });
}

/// Obstacles drawn together until none is objected to and the nominal arm hits what it has to. None
/// if that does not come about.
template <typename Draw>
std::optional<std::vector<ObstacleDraft>> place(const Motions& motions, Hit hit, Draw&& draw,
                                                RandomStream& random, Rejections& rejections) {
  const NominalMotion& nominal = motions.nominal;
  const Problem& problem = nominal.problem();
  for (int i = 0; i < motions.placements; ++i) {
    std::vector<ObstacleDraft> drafts = draw(nominal, random);
    std::optional<Filter> why;
    for (const ObstacleDraft& draft : drafts) {
      if (!why) why = objection(motions, PlacedShape(draft, problem));
    }
    if (!why && hit != Hit::kNone && !is_hit(nominal, drafts, hit)) why = Filter::kNoHit;
    if (!why) return drafts;
    rejections.count(*why);
  }
  return std::nullopt;
}

/// All obstacles of a scenario. None if one of them found no place.
std::optional<std::vector<ObstacleDraft>> place_all(const Family& family, const ObstaclePlan& plan,
                                                    const Motions& motions, RandomStream& random,
                                                    Rejections& rejections) {
  using Drafts = std::vector<ObstacleDraft>;
  Drafts all;
  const auto add = [&](Hit hit, const auto& draw) {
    std::optional<Drafts> placed = place(motions, hit, draw, random, rejections);
    if (placed) all.insert(all.end(), placed->begin(), placed->end());
    return placed.has_value();
  };
  const auto on_link = [&family](const auto& motion, auto& stream) {
    return Drafts{family.solids ? draw_solid_on_link(motion, stream)
                                : draw_on_link(motion, stream)};
  };
  const auto near = [&family](const auto& motion, auto& stream) {
    return Drafts{family.solids ? draw_solid_near(motion, stream) : draw_near(motion, stream)};
  };
  const auto moving = [](const auto& motion, auto& stream) {
    return Drafts{draw_moving(motion, stream)};
  };
  const auto gap = [](const auto& motion, auto& stream) {
    const auto [first, second] = draw_gap(motion, stream);
    return Drafts{first, second};
  };

  bool placed = false;
  switch (family.obstacles) {
    case ObstacleKind::kSome:
    case ObstacleKind::kOne:
    case ObstacleKind::kClutter:
      placed = add(Hit::kFirst, on_link);
      break;
    case ObstacleKind::kMoving:
      placed = add(Hit::kFirst, moving);
      break;
    case ObstacleKind::kGap:
      placed = add(Hit::kFirst, gap);
      break;
    case ObstacleKind::kCorridor:
      placed = add(Hit::kAny, draw_corridor);
      break;
    case ObstacleKind::kShelf:
      placed = add(Hit::kAny, draw_shelf);
      break;
  }
  for (int i = 0; placed && i < plan.on_links; ++i) placed = add(Hit::kNone, on_link);
  for (int i = 0; placed && i < plan.near; ++i) placed = add(Hit::kNone, near);
  if (!placed) return std::nullopt;
  for (std::size_t i = 0; i < all.size(); ++i) all[i].name = fmt::format("obstacle_{}", i + 1);
  return all;
}

/// A scenario without its name, and how it is solved.
struct Drawn {
  ScenarioDraft draft;
  Trajectory witness = {};
};

/// One attempt at a scenario. None if a filter objects to it, which is counted.
std::optional<Drawn> draw_scenario(const Family& family, const Structure& structure,
                                   RandomStream& random, Rejections& rejections) {
  const auto rejected = [&rejections](Filter filter) {
    rejections.count(filter);
    return std::nullopt;
  };
  std::optional<ScenarioDraft> draft = draw_task(family, structure.arm, random);
  if (!draft) return rejected(Filter::kReach);
  Motions motions{NominalMotion(to_problem(*draft))};
  const std::optional<Filter> why = objection(family, structure.arm, motions.nominal);
  if (why) return rejected(*why);
  const bool moving = family.obstacles == ObstacleKind::kMoving;
  if (family.solids && !moving) motions.placements = kPlacementsOfSolids;
  if (family.witnesses) {
    motions.witness = draw_witness(motions.nominal.problem(), random);
    if (!motions.witness) return rejected(Filter::kWitnessMotion);
  }
  const auto obstacles = place_all(family, structure.plan, motions, random, rejections);
  if (!obstacles) return rejected(Filter::kUnplaceable);
  draft->obstacles = *obstacles;
  if (!motions.witness) return Drawn{*draft};
  const Trajectory witness = motions.witness->trajectory();
  const Judgement judgement = Judge(to_problem(*draft), to_truth(*draft)).judge(witness);
  if (!judgement.success()) return rejected(Filter::kWitnessJudged);
  if (family.solids) draft->reference_clearance = rounded(judgement.clearance);
  return Drawn{*draft, witness};
}

}  // namespace

const std::vector<Family>& families() {
  static const std::vector<Family> kFamilies = {
      {.name = "planar",
       .summary = "planar arms of 5 to 9 links, 1 to 4 ellipses on and near the links",
       .planar = true},
      {.name = "spatial",
       .summary = "iiwa 14 and Panda in turn, 1 to 3 ellipsoids on and near the links",
       .spatial = true},
      {.name = "moving",
       .summary = "planar and spatial arms in turn, an obstacle that moves into a link",
       .planar = true,
       .spatial = true,
       .obstacles = ObstacleKind::kMoving},
      {.name = "singular",
       .summary = "planar and spatial arms in turn, nearly stretched on the way, one obstacle",
       .planar = true,
       .spatial = true,
       .paths = PathKind::kStretchingArc,
       .obstacles = ObstacleKind::kOne},
      {.name = "narrow",
       .summary = "planar arms, two ellipses with a gap of 40 to 120 mm beside a link",
       .planar = true,
       .obstacles = ObstacleKind::kGap},
      {.name = "planar_any",
       .summary = "as planar, but none is known to have a solution and many have none",
       .planar = true,
       .witnesses = false},
      {.name = "clutter",
       .summary = "the arms of robots/ in turn, 2 to 10 solids on and near the links",
       .spatial = true,
       .solids = true,
       .obstacles = ObstacleKind::kClutter},
      {.name = "corridor",
       .summary = "the arms of robots/ in turn, between two walls",
       .spatial = true,
       .solids = true,
       .obstacles = ObstacleKind::kCorridor},
      {.name = "shelf",
       .summary = "the arms of robots/ in turn reach into a shelf of five boards",
       .spatial = true,
       .solids = true,
       .paths = PathKind::kReachingIn,
       .obstacles = ObstacleKind::kShelf},
      {.name = "crossing",
       .summary = "the arms of robots/ in turn, an obstacle that moves into a link",
       .spatial = true,
       .solids = true,
       .obstacles = ObstacleKind::kMoving},
      {.name = "stretched",
       .summary = "the arms of robots/ in turn, nearly stretched on the way, one solid",
       .spatial = true,
       .solids = true,
       .paths = PathKind::kStretchingArc,
       .obstacles = ObstacleKind::kOne},
      {.name = "any_arm",
       .summary = "random arms of 6 to 8 joints, 2 to 10 solids on and near the links",
       .solids = true,
       .obstacles = ObstacleKind::kClutter},
  };
  return kFamilies;
}

const Family* find_family(std::string_view name) {
  const std::vector<Family>& all = families();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [name](const Family& family) { return family.name == name; });
  return found == all.end() ? nullptr : &*found;
}

std::string family_names() {
  std::string names;
  for (const Family& family : families()) names += (names.empty() ? "" : ", ") + family.name;
  return names;
}

const char* name_of(Filter filter) {
  switch (filter) {
    case Filter::kReach:
      return "reach";
    case Filter::kLimits:
      return "joint_limits";
    case Filter::kTracking:
      return "tracking";
    case Filter::kWitnessMotion:
      return "witness_motion";
    case Filter::kUnplaceable:
      return "unplaceable";
    case Filter::kWitnessJudged:
      return "witness_judged";
    case Filter::kStart:
      return "start";
    case Filter::kTipPath:
      return "tip_path";
    case Filter::kInnerLinks:
      return "inner_links";
    case Filter::kWitness:
      return "witness";
    case Filter::kNoHit:
      return "no_hit";
  }
  return "";
}

std::vector<Arm> arms_of(const Family& family, const std::filesystem::path& robots) {
  if (!family.spatial) return {};
  return family.solids ? real_arms(robots) : spatial_arms(robots);
}

std::string generated_name(const Family& family, std::uint64_t seed, int index) {
  return fmt::format("{}_s{}_{:05}", family.name, seed, index);
}

GeneratedScenario generate(const Family& family, std::uint64_t seed, int index,
                           const std::vector<Arm>& spatial_arms, Rejections& rejections) {
  const auto number = static_cast<std::uint64_t>(&family - families().data());
  const auto place_in_family = static_cast<std::uint64_t>(index);
  Structure structure =
      draw_structure(family, index, spatial_arms, RandomStream{seed, number, place_in_family, 0});
  const bool random_arms = !family.planar && !family.spatial;
  for (std::uint64_t attempt = 1; attempt <= kAttempts; ++attempt) {
    if (random_arms && attempt % kAttemptsOfAnArm == 0) {
      RandomStream another{seed, number, place_in_family, attempt, 1};
      structure.arm = random_arm(another);
    }
    RandomStream random{seed, number, place_in_family, attempt};
    std::optional<Drawn> drawn = draw_scenario(family, structure, random, rejections);
    if (!drawn) continue;
    ScenarioDraft& draft = drawn->draft;
    draft.name = generated_name(family, seed, index);
    draft.description =
        fmt::format("Generated by bqsa-bench, family {}, seed {}, index {}, generator version {}",
                    family.name, seed, index, kGeneratorVersion);
    return {draft.name, to_yaml(draft), drawn->witness};
  }
  std::string counts;
  for (int k = 0; k < kFilters; ++k) {
    const auto filter = static_cast<Filter>(k);
    counts +=
        fmt::format("{}{} {}", counts.empty() ? "" : ", ", name_of(filter), rejections[filter]);
  }
  throw InputError(fmt::format(
      "{}: expected an arm that allows scenario {}, got none in {} attempts; rejected: {}",
      family.name, index, kAttempts, counts));
}

}  // namespace bqsa::harness
