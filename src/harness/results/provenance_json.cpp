#include "harness/results/provenance_json.hpp"

#include <nlohmann/json.hpp>

namespace bqsa::harness {

using Json = nlohmann::ordered_json;

Json build_json(const BuildInfo& build) {
  Json libraries = Json::object();
  for (const auto& [name, version] : build.libraries) libraries[name] = version;
  return {
      {"version", build.version},       {"commit", build.commit},         {"dirty", build.dirty},
      {"compiler", build.compiler},     {"build_type", build.build_type}, {"flags", build.flags},
      {"assertions", build.assertions}, {"sanitizers", build.sanitizers}, {"libraries", libraries}};
}

Json machine_json(const MachineState& machine) {
  return {
      {"processor", machine.processor}, {"cores", machine.cores}, {"governor", machine.governor},
      {"load_average", machine.load},   {"os", machine.os},       {"date", machine.date}};
}

}  // namespace bqsa::harness
