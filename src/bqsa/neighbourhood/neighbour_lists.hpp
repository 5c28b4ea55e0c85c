/// @file
/// Which obstacles are near each link: lists that stay valid while the arm moves on a little.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "bqsa/neighbourhood/obstacle_index.hpp"

namespace bqsa {

/// By what obstacles are told to be free.
enum class FreeBy {
  kSpace,    ///< the quadratic in space, or in the plane of a planar problem
  kShadows,  ///< the shadows on the coordinate planes
};

/// A link on its way from one pose to the other, and how far from it obstacles matter.
struct Passage {
  int tick;  ///< at which it arrives
  const Link& link;
  const ChainPose& from;
  const ChainPose& to;
  double sag;       ///< by which it may leave the straight way [m]
  double distance;  ///< up to which obstacles matter [m]
};

/// Verlet lists, as in molecular dynamics (Verlet, Phys. Rev. 159, 1967, 98-103): for each link the
/// obstacles that could come near it while its ends stay within a *skin* of where they were when the list
/// was made. Each is listed with how far the ends may go before it has to be asked. So most ticks
/// compare where the ends are with where they were, and ask nothing. What is left of all these ways at one
/// pose is room around it for the whole arm; most ticks find it by one comparison for all links.
///
/// Lists change no answer: they leave out only what is proven to be free (ObstacleIndex). A list is made
/// anew when its link leaves the skin, when more distance is asked than it was made for, or when
/// obstacles on the move go on to their next period. The skin grows while lists are short and shrinks while
/// they are long.
///
/// Lists are of bounded size: where more than 1,000 obstacles are near a link, all of the problem are
/// asked. Asking does not allocate.
class NeighbourLists {
 public:
  NeighbourLists(std::shared_ptr<const ObstacleIndex> index, FreeBy free_by,
                 WorkCounters& counters);

  const std::shared_ptr<const ObstacleIndex>& index() const { return index_; }

  /// Whether the lists that there are prove the passage of all links free. Makes no list.
  /// @param passage  of the arm; its link is not looked at
  bool all_clear(std::span<const Link> links, const Passage& passage) {
    return is_around_clear_pose(passage) || find_clear_pose(links, passage);
  }

  /// The first obstacle, counted from `from`, that is not proven to be free and for which `asked(obstacle)` is
  /// true; -1 if none.
  template <typename Asked>
  int find(const Passage& passage, int from, const Asked& asked) {
    List& list = lists_[static_cast<std::size_t>(passage.link.end)];
    double way = way_squared(list, passage);
    if (!covers(list, passage) || !(way <= list.skin_squared)) {
      make(passage, list);
      way = way_squared(list, passage);
    }
    if (list.everything) {
      for (int j = from; j < static_cast<int>(index_->obstacles().size()); ++j) {
        if (asked(j)) return j;
      }
      return -1;
    }
    if (way < list.clear_squared) return -1;
    for (const Neighbour& neighbour : list.neighbours) {
      if (neighbour.obstacle < from || way < neighbour.clear_squared) continue;
      if (asked(neighbour.obstacle)) return neighbour.obstacle;
    }
    return -1;
  }

  /// The same for all that are not proven to be free, in increasing order.
  template <typename Visit>
  void visit(const Passage& passage, const Visit& each) {
    find(passage, 0, [&each](int obstacle) {
      each(obstacle);
      return false;
    });
  }

 private:
  struct Neighbour {
    std::int32_t obstacle;
    float clear_squared;  ///< square of the way up to which it is free [m²]
  };
  struct List {
    Eigen::Vector3d start = Eigen::Vector3d::Zero();  ///< of the link when the list was made
    Eigen::Vector3d end = Eigen::Vector3d::Zero();
    int period = -1;           ///< of obstacles on the move
    double reach = -1;         ///< distance for which it was made [m]
    double skin = 0;           ///< wanted [m]
    double skin_squared = 0;   ///< of the skin that it has
    double clear_squared = 0;  ///< square of the way up to which all obstacles are free [m²]
    double clear = 0;          ///< that way [m]
    bool everything = false;   ///< asks all obstacles
    std::vector<Neighbour> neighbours = {};  ///< in increasing order
  };

  /// A pose that lists have proven to be free, with room around it.
  struct ClearPose {
    ChainPose::Columns<kMaxPoints> p_WO;
    int period = -1;    ///< of obstacles on the move
    double reach = -1;  ///< distance up to which nothing is there [m]
    double way = 0;     ///< that all points may go until something may be [m]
  };

  /// By the norm over all points at once, which is no less than any point's way.
  bool is_around_clear_pose(const Passage& passage) const {
    const double straight = clear_pose_.way - passage.sag;
    const double squared = straight * straight;
    return passage.distance <= clear_pose_.reach &&
           clear_pose_.period == index_->period(passage.tick) && straight > 0 &&
           (passage.to.p_WO - clear_pose_.p_WO).squaredNorm() < squared &&
           (passage.from.p_WO - clear_pose_.p_WO).squaredNorm() < squared;
  }

  /// Square of how far the link's ends are, in both poses, from where they were, at most [m²].
  static double ends_squared(const List& list, const Passage& passage) {
    const auto of_pose = [&](const ChainPose& pose) {
      return std::max((pose.p_WO.col(passage.link.start) - list.start).squaredNorm(),
                      (pose.p_WO.col(passage.link.end) - list.end).squaredNorm());
    };
    const double squared = of_pose(passage.to);
    return &passage.from == &passage.to ? squared : std::max(squared, of_pose(passage.from));
  }

  /// The same for all of the passage.
  static double way_squared(const List& list, const Passage& passage) {
    const double squared = ends_squared(list, passage);
    if (passage.sag == 0) return squared;
    const double way = std::sqrt(squared) + passage.sag;
    return way * way;
  }

  bool covers(const List& list, const Passage& passage) const {
    return passage.distance <= list.reach && list.period == index_->period(passage.tick);
  }

  bool find_clear_pose(std::span<const Link> links, const Passage& passage);
  void make(const Passage& passage, List& list);
  bool fill(double skin, List& list);
  double clear_way(int obstacle, double gap, const List& list) const;

  std::shared_ptr<const ObstacleIndex> index_;
  FreeBy free_by_;
  std::array<List, kMaxPoints> lists_;  ///< by the link's end
  ClearPose clear_pose_;
  std::vector<std::int32_t> scratch_;
  WorkCounters* counters_;
};

}  // namespace bqsa
