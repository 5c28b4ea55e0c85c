/// @file
/// What a reactive method was told in a run on one of the paper's scenes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bqsa/method.hpp"

namespace bqsa {

struct RecordedTick {
  StepInput input;
  JointVector q_next;  ///< the method's answer [rad]
  bool cleared;        ///< a link was moved away from an obstacle
};

/// A file of scenarios/, by its name.
Problem paper_scene(const std::string& name);

/// The method of this name with its default parameters, prepared; the problem outlives it.
std::unique_ptr<ReactiveMethod> prepared_method(const std::string& name, const Problem& problem);

/// All ticks to the end, or to the first infeasible one.
std::vector<RecordedTick> recorded_run(ReactiveMethod& method, const Problem& problem);

}  // namespace bqsa
