/// @file
/// The hot paths of the project, each alone on fixed inputs, for the count of their instructions.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace bqsa {

/// Does one repetition, every time the same work. The number depends on all answers and is the same
/// every time.
using Repetition = std::function<double()>;

struct GuardedKernel {
  std::string name;                     ///< as in the baseline: `segment/polar_form/space`
  std::function<Repetition()> prepare;  ///< makes the inputs; not counted
};

/// Segment tests, obstacle fields, distances. Of pairs of link and obstacle.
std::vector<GuardedKernel> geometry_kernels();

/// The batched test, of poses, configurations and motions, with the vector instructions in use.
std::vector<GuardedKernel> batch_kernels();

/// Kinematics, inverse kinematics, certificate and the judge's check of motions, on the paper's scenes.
std::vector<GuardedKernel> motion_kernels();

/// The whole control step of the methods, on the paper's scenes.
std::vector<GuardedKernel> step_kernels();

}  // namespace bqsa
