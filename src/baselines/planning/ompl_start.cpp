#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include "baselines/planning/ompl_planners.hpp"

namespace bqsa::baselines {
namespace {

/// Seeds of the harness are 64 bits wide, those of OMPL 32, and 0 would be the clock.
std::uint_fast32_t seed_of_ompl(std::uint64_t seed) {
  constexpr std::uint64_t kSeeds = 0xFFFFFFFF;  // 1 .. 2^32 - 1
  return static_cast<std::uint_fast32_t>(seed % kSeeds + 1);
}

}  // namespace

void start_ompl(std::uint64_t seed) {
  ompl::msg::noOutputHandler();
  ompl::RNG::setSeed(seed_of_ompl(seed));
}

}  // namespace bqsa::baselines
