/// @file
/// Families of random problems, made by rules that were fixed beforehand and know nothing of any
/// avoiding method.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "bqsa/method.hpp"
#include "harness/generator/arm.hpp"

namespace bqsa::harness {

/// Goes up whenever a family, seed and index give other bytes than before.
inline constexpr int kGeneratorVersion = 2;

enum class PathKind {
  kLineOrArc,      ///< well within reach
  kReachingIn,     ///< a line outwards, nearly level
  kStretchingArc,  ///< out to 97 to 99.5 % of the reach, in the middle of the motion
};

enum class ObstacleKind {
  kSome,      ///< one on an outer link of the nominal arm, up to three more there or near
  kOne,       ///< one on an outer link
  kMoving,    ///< one that meets an outer link on its way, sometimes one more at rest
  kGap,       ///< two on both sides of an outer link, one of them on it
  kClutter,   ///< one on an outer link, up to nine more there or near
  kCorridor,  ///< two walls on both sides of an outer link
  kShelf,     ///< five boards around the end of the path
};

struct Family {
  std::string name;
  std::string summary;  ///< one line
  bool planar = false;
  bool spatial = false;  ///< of both, even indices are planar; of neither, arms are random
  bool solids = false;   ///< links are capsules and obstacles at rest solids
  PathKind paths = PathKind::kLineOrArc;
  ObstacleKind obstacles = ObstacleKind::kSome;
  bool witnesses = true;  ///< every problem has a known solution
};

const std::vector<Family>& families();

/// One of families(), nullptr if none has the name.
const Family* find_family(std::string_view name);

/// For messages: `a, b, c`.
std::string family_names();

/// Why something drawn was thrown away.
enum class Filter {
  kReach,          ///< an arm and path: the path leaves the shell that it has to stay in
  kLimits,         ///< an arm and path: the nominal motion exceeds a joint limit
  kTracking,       ///< an arm and path: the nominal motion exceeds the tolerance or a largest step
  kWitnessMotion,  ///< an arm and path: no witness keeps limits, steps and tolerance
  kUnplaceable,  ///< an arm and path: one of its obstacles passed no filter in kPlacements tries, or kPlacementsOfSolids
  kWitnessJudged,  ///< an arm, path and obstacles: the judge finds fault with the witness
  kStart,          ///< an obstacle: a link is too near at the start
  kTipPath,        ///< an obstacle: the tip's path is too near
  kInnerLinks,     ///< an obstacle: the nominal links 1 and 2 come too near
  kWitness,        ///< an obstacle: the witness comes too near
  kNoHit,          ///< an obstacle that has to be hit by the nominal arm is not
};
inline constexpr int kFilters = 11;
inline constexpr int kPlacements = 30;
inline constexpr int kPlacementsOfSolids = 300;

const char* name_of(Filter filter);

/// How often each filter threw something away.
class Rejections {
 public:
  void count(Filter filter) { ++counts_[static_cast<std::size_t>(filter)]; }
  long operator[](Filter filter) const { return counts_[static_cast<std::size_t>(filter)]; }

 private:
  std::array<long, kFilters> counts_{};
};

/// The arms of a family's spatial scenarios, none if it has no such or draws them.
/// @param robots  directory of robot files
/// @throws InputError if a file that is needed cannot be used
std::vector<Arm> arms_of(const Family& family, const std::filesystem::path& robots);

struct GeneratedScenario {
  std::string name;  ///< generated_name()
  std::string yaml;  ///< the file
  /// A trajectory that the judge calls a success; without rows if the family has no witnesses.
  Trajectory witness = {};
};

/// `<family>_s<seed>_<index>`, the index of five digits.
std::string generated_name(const Family& family, std::uint64_t seed, int index);

/// Scenario `index` of a family and seed: always the same bytes, whatever else is generated.
/// @param spatial_arms  arms_of() the family, used in turn
/// @param rejections    counted up
/// @throws InputError if the arms allow no such problem
GeneratedScenario generate(const Family& family, std::uint64_t seed, int index,
                           const std::vector<Arm>& spatial_arms, Rejections& rejections);

}  // namespace bqsa::harness
