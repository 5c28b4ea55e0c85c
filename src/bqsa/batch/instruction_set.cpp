#include "bqsa/batch/instruction_set.hpp"

#include <hwy/highway.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace bqsa {
namespace {

struct Target {
  std::int64_t bit;
  InstructionSet set;
};

/// Best first; what is compiled is settled in cmake/targets.cmake.
constexpr Target kTargets[] = {{HWY_AVX3, {"AVX3", 64}},
                               {HWY_AVX2, {"AVX2", 32}},
                               {HWY_SSE4, {"SSE4", 16}},
                               {HWY_SCALAR, {"SCALAR", 8}}};

std::vector<InstructionSet> supported() {
  std::vector<InstructionSet> sets;
  for (const Target& target : kTargets) {
    const bool compiled = (HWY_TARGETS & target.bit) != 0;
    const bool runs = ((hwy::SupportedTargets() | HWY_STATIC_TARGET) & target.bit) != 0;
    if (compiled && runs) sets.push_back(target.set);
  }
  return sets;
}

const InstructionSet* chosen = nullptr;

}  // namespace

std::span<const InstructionSet> instruction_sets() {
  static const std::vector<InstructionSet> kSets = supported();
  return kSets;
}

const InstructionSet& instruction_set() {
  return chosen != nullptr ? *chosen : instruction_sets().front();
}

void use_instruction_set(std::string_view name) {
  const std::span<const InstructionSet> sets = instruction_sets();
  const auto set = std::ranges::find(sets, name, &InstructionSet::name);
  if (set == sets.end()) {
    throw std::invalid_argument("instruction set '" + std::string(name) +
                                "': this processor cannot run it, or nothing is compiled for it");
  }
  const auto* target =
      std::ranges::find_if(kTargets, [name](const Target& each) { return each.set.name == name; });
  hwy::SetSupportedTargetsForTest(target->bit);
  hwy::GetChosenTarget().Update(target->bit);
  chosen = &*set;
}

}  // namespace bqsa
