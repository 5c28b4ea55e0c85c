#include "harness/generator/draw_spot.hpp"

#include <span>
#include <vector>

namespace bqsa::harness {

using Eigen::Vector3d;

Spot draw_spot(const NominalMotion& nominal, int first_tick, int last_tick, int first_link,
               RandomStream& random) {
  const std::span<const Link> all = nominal.problem().chain.links();
  std::vector<std::size_t> links;
  for (std::size_t link = 0; link < all.size(); ++link) {
    if (all[link].number >= first_link) links.push_back(link);
  }
  Spot spot{.tick = random.whole(first_tick, last_tick)};
  const auto last = static_cast<int>(links.size()) - 1;
  spot.link = links[static_cast<std::size_t>(random.whole(0, last))];
  const Link& link = all[spot.link];
  const ChainPose& pose = nominal.pose(spot.tick);
  const Vector3d from = pose.p_WO.col(link.start);
  const Vector3d to = pose.p_WO.col(link.end);
  spot.point = from + random.uniform(0.1, 0.9) * (to - from);
  spot.along = (to - from).normalized();
  const Vector3d any = random.direction(nominal.problem().dimension());
  spot.sideways = (any - any.dot(spot.along) * spot.along).normalized();
  return spot;
}

Spot draw_middle_spot(const NominalMotion& nominal, RandomStream& random) {
  const int quarter = nominal.problem().ticks / 4;
  return draw_spot(nominal, quarter, 3 * quarter, kFirstOuterLink, random);
}

}  // namespace bqsa::harness
