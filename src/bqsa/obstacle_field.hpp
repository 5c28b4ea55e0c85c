/// @file
/// The obstacles as a BQSA variant sees them: grown by an offset, asked by the quadratic test.
#pragma once

#include <vector>

#include "bqsa/geometry/segment_test.hpp"
#include "bqsa/problem.hpp"
#include "bqsa/work_counters.hpp"

namespace bqsa {

/// All obstacles of a problem in Dim dimensions, every semi-axis longer by one common offset. The
/// offset gives links of radius r room to be and keeps results off the contact threshold; that it
/// is enough is proven afterwards by MotionCertificate, which looks at the obstacles as they are.
template <int Dim>
class ObstacleField {
 public:
  /// Takes over the obstacles; planar fields take the plane section of each. Quadratics are counted
  /// in `counters`, which must outlive the field. May allocate.
  void assign(const std::vector<Obstacle>& obstacles, WorkCounters& counters);

  /// Grows every obstacle, as given to `assign`, by `offset` [m]. Does not allocate.
  void grow(double offset);

  int size() const { return static_cast<int>(grown_.size()); }
  const EllipsoidN<Dim>& operator[](int obstacle) const {
    return grown_[static_cast<std::size_t>(obstacle)];
  }

  /// The quadratic of one link and one obstacle (paper, Eqs. 19-22) in polar form.
  PolarForm<double> quadratic(const ChainPose& pose, const Link& link, int obstacle) const;

  /// The first obstacle, counted from `from`, that the link hits; -1 if none.
  int first_hit(const ChainPose& pose, const Link& link, int from = 0) const;

 private:
  std::vector<EllipsoidN<Dim>> shapes_;
  std::vector<EllipsoidN<Dim>> grown_;
  double offset_ = 0;
  WorkCounters* counters_ = nullptr;
};

}  // namespace bqsa
