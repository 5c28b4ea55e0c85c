/// @file
/// What a method has made of the obstacles of a problem, at every tick.
#pragma once

#include <cstddef>
#include <vector>

#include "bqsa/problem.hpp"

namespace bqsa {

/// Of every obstacle a shape: of those that move one at every tick, of others one for all.
template <typename Shape>
class ShapesOverTime {
 public:
  /// @param seen  makes the Shape of an Ellipsoid
  template <typename Seen>
  void assign(const std::vector<Obstacle>& obstacles, const Seen& seen) {
    shapes_.clear();
    first_.assign(1, 0);
    first_.reserve(obstacles.size() + 1);
    for (const Obstacle& obstacle : obstacles) {
      if (!obstacle.moves()) shapes_.push_back(seen(obstacle.shape));
      for (const Ellipsoid& shape : obstacle.motion) shapes_.push_back(seen(shape));
      first_.push_back(shapes_.size());
    }
  }

  const Shape& at(int obstacle, int tick) const {
    const std::size_t first = first_[static_cast<std::size_t>(obstacle)];
    const bool moves = first_[static_cast<std::size_t>(obstacle) + 1] > first + 1;
    return shapes_[first + (moves ? static_cast<std::size_t>(tick) : 0)];
  }

 private:
  std::vector<Shape> shapes_;
  std::vector<std::size_t> first_;  ///< of every obstacle, and where the last one ends
};

}  // namespace bqsa
