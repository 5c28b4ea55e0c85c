/// @file
/// Build and machine as every file of results names them.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "harness/results/provenance.hpp"

namespace bqsa::harness {

/// Its keys are version, commit, dirty, compiler, build_type, flags, assertions, sanitizers, libraries.
nlohmann::ordered_json build_json(const BuildInfo& build);

/// Its keys are processor, cores, governor, load_average, os, date.
nlohmann::ordered_json machine_json(const MachineState& machine);

}  // namespace bqsa::harness
