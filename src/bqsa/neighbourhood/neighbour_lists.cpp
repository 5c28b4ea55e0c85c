#include "bqsa/neighbourhood/neighbour_lists.hpp"

#include <cassert>
#include <limits>
#include <utility>

#include "bqsa/geometry/segment_test.hpp"

namespace bqsa {
namespace {

constexpr std::size_t kMostNeighbours = 1024;
constexpr std::size_t kMostBoxes = 4096;  // found by one search

constexpr std::size_t kShort = 4, kLong = 24;  // lists after which the skin grows, and shrinks
// Of the link's distance from the base.
constexpr double kFirstSkin = 1.0 / 16, kLeastSkin = 1.0 / 64, kLargestSkin = 1.0 / 4;

constexpr double kLeastReach = 1e-4;  // for which lists are made [m]
constexpr double kMoreReach = 2;      // times what is asked, so that more can be asked

// More and less than a way by what its comparison with another may be rounded.
constexpr double kRoundedUp = 1 + 1e-12, kRoundedDown = 1 - 1e-6;

}  // namespace

NeighbourLists::NeighbourLists(std::shared_ptr<const ObstacleIndex> index, FreeBy free_by,
                               WorkCounters& counters)
    : index_(std::move(index)), free_by_(free_by), counters_(&counters) {
  const std::size_t obstacles = index_->obstacles().size();
  for (List& list : lists_) list.neighbours.reserve(std::min(obstacles, kMostNeighbours));
  scratch_.resize(std::min(obstacles, kMostBoxes));
}

void NeighbourLists::make(const Passage& passage, List& list) {
  const Link& link = passage.link;
  const auto middle = [&passage](int point) -> Eigen::Vector3d {
    return 0.5 * (passage.from.p_WO.col(point) + passage.to.p_WO.col(point));
  };
  const Eigen::Vector3d base = passage.to.p_WO.col(0);
  const bool first = list.reach < 0, crowded = list.everything;
  const std::size_t length = list.neighbours.size();
  list.ends << middle(link.start), middle(link.end);
  list.period = index_->period(passage.tick);

  const double scale = std::max((list.start() - base).norm(), (list.end() - base).norm());
  const double needed = kRoundedUp * std::sqrt(way_squared(list, passage));
  list.everything = !std::isfinite(scale + needed + passage.distance);
  if (list.everything) {
    list.reach = -1;  // holds for no other passage
    return;
  }
  if (first) {
    list.skin = kFirstSkin * scale;
  } else {
    const double factor = crowded || length > kLong ? 0.5 : length <= kShort ? 2 : 1;
    list.skin = std::clamp(factor * list.skin, kLeastSkin * scale, kLargestSkin * scale);
  }
  const double asked = std::max(passage.distance, kLeastReach);
  list.reach = std::max(kMoreReach * asked, list.reach / 2);
  if (fill(std::max(list.skin, 2 * needed), list)) return;
  list.reach = asked;
  list.everything = !fill(needed, list);
}

/// Makes the list for a skin and its reach. False if it is too long.
bool NeighbourLists::fill(double skin, List& list) {
  const double proven = kRoundedUp * skin;
  list.skin_squared = skin * skin;
  list.clear_squared = list.skin_squared;
  list.neighbours.clear();
  bool fits = true;
  const bool all_visited = index_->visit_near(
      list.start(), list.end(), proven, list.reach, list.period, *counters_, scratch_,
      [&](int obstacle, double gap) {
        if (gap > proven) return;
        const double way = clear_way(obstacle, gap, list);
        if (way > proven) return;
        fits = fits && list.neighbours.size() < kMostNeighbours;
        if (!fits) return;
        const float squared = way > 0 ? static_cast<float>(kRoundedDown * way * way) : 0;
        list.neighbours.push_back({obstacle, squared});
        list.clear_squared = std::min<double>(list.clear_squared, squared);
      });
  std::ranges::sort(list.neighbours, {}, &Neighbour::obstacle);
  if (!fits || !all_visited) list.clear_squared = 0;  // of those that are missing nothing is known
  list.clear = std::sqrt(list.clear_squared);
  return fits && all_visited;
}

/// How far the list's link may go, at least, until the obstacle comes within reach [m]. In space that is
/// the distance to the ellipsoid scaled by sigma = 1 + reach / a_min (ObstacleIndex), by the plane that
/// supports it at the vertex (`separation`).
double NeighbourLists::clear_way(int obstacle, double gap, const List& list) const {
  if (free_by_ == FreeBy::kShadows || !index_->rests(obstacle, list.period)) return gap;
  const Ellipsoid& shape = index_->shape(obstacle, list.period);
  const double rounding = ObstacleIndex::rounding(shape);
  if (!(rounding <= 0.25)) return gap;
  const Eigen::Vector3d& axes = shape.semi_axes();
  ++counters_->quadratics;
  const Eigen::Vector3d u1 = unit_point(shape, list.start());
  const Eigen::Vector3d u2 = unit_point(shape, list.end());
  const Eigen::Vector3d u = u1 + vertex(polar_form<double, 3>(u1, u2)) * (u2 - u1);
  const double steepness = (shape.unit_map().transpose() * u).norm();
  if (!(steepness > 0)) return gap;
  const double length = (list.end() - list.start()).norm();
  const double distance = list.reach + ObstacleIndex::rounding_of_distance(length);
  const double sigma = (1 + distance / axes.minCoeff()) * (1 + 2 * rounding);
  constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();
  const double rounded = kRounding * axes.maxCoeff() * (u1.norm() + u2.norm());
  const double way = (std::min(u.dot(u1), u.dot(u2)) - sigma * u.norm()) / steepness - rounded;
  return std::max(gap, way);
}

}  // namespace bqsa
