/// @file
/// How the time of a control step grows with the number of obstacles while their density stays the same.
#pragma once

#include <span>
#include <vector>

#include "bqsa/method.hpp"
#include "harness/measuring/contest.hpp"

namespace bqsa::harness {

/// The arm of `lonely_problem`, its tip going to and fro on a quarter of a circle around the base: so far and so fast
/// that it leaves the skin of neighbour lists again and again.
Problem wandering_problem(int dimension);

/// Obstacles all around the arm of `wandering_problem`, one in each cell of a lattice of 0.3 m, drawn from a
/// seed; the arm moves in the corridor that those leave which would come closer to its nominal motion
/// than kBystanderClearance. From the arm outwards: a shorter list is the start of a longer one, and once
/// there are some hundreds of obstacles (in space: some thousands), more are further away.
std::vector<Obstacle> draw_crowd(const Problem& wandering, int count);

/// What a method in its control loop took among so many obstacles.
struct CrowdedSteps {
  int obstacles = 0;
  int infeasible = 0;     ///< steps in which the method gave up
  double prepare_s = 0;   ///< of `prepare`, wall time [s]
  double median_s = 0;    ///< of a step [s]
  double worst_s = 0;     ///< of all steps after the warm-up [s]
  double quadratics = 0;  ///< a step, on average
  double mean_s = 0;      ///< of a step, those that make lists included [s]
  double bounds = 0;  ///< a step, on average; 0 says that no list was made, and then the times do
                      ///< not tell what making one takes
  double first_bounds = 0;  ///< of the very first step, which has to make all lists
  double index_bytes = 0;   ///< an obstacle: of the index of neighbour lists [bytes]
};

/// Runs the method in the control loop through two periods of the motion to get warm and through `periods`
/// more, each step timed. The clock's own time, some 10 to 200 ns, is in the times.
/// @param dimension  2 or 3
CrowdedSteps run_crowded(const MethodEntry& method, int dimension, int obstacles, int periods = 10,
                         const ContestClock& clock = thread_cpu_seconds);

/// The slope of log(quantity) over log(obstacles), by least squares; at least two numbers of obstacles.
double growth_exponent(std::span<const CrowdedSteps> runs, double CrowdedSteps::*quantity);

}  // namespace bqsa::harness
