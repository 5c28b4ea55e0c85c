#include "harness/judge/true_obstacle.hpp"

namespace bqsa::harness {

std::vector<TrueObstacle> ellipsoids_as_told(const Problem& problem) {
  std::vector<TrueObstacle> truth;
  truth.reserve(problem.obstacles.size());
  for (const Obstacle& obstacle : problem.obstacles) {
    truth.push_back({.name = obstacle.name, .first = static_cast<int>(truth.size())});
  }
  return truth;
}

}  // namespace bqsa::harness
