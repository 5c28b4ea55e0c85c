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
/// compare where the ends are with where they were, and ask nothing.
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

  /// Whether there are lists that prove the passage free, for each of the links. Makes no list.
  /// @param passage  of the arm; its own link is not looked at
  bool all_clear(std::span<const Link> links, const Passage& passage) const {
    const int period = index_->period(passage.tick);
    return std::ranges::all_of(links, [&](const Link& link) {
      const List& list = lists_[static_cast<std::size_t>(link.end)];
      const double straight = list.clear - passage.sag;
      const double squared = straight * straight;
      const auto stays = [&](const ChainPose& pose) {
        return (pose.p_WO.middleCols<2>(link.start) - list.ends).squaredNorm() < squared ||
               ends_squared(list, link, pose) < squared;
      };
      return list.reach >= passage.distance && list.period == period && straight > 0 &&
             stays(passage.to) && stays(passage.from);
    });
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
    Eigen::Matrix<double, 3, 2> ends =
        Eigen::Matrix<double, 3, 2>::Zero();  ///< of the link when it was made
    int period = -1;                          ///< of obstacles on the move
    double reach = -1;                        ///< distance for which it was made [m]
    double skin = 0;                          ///< wanted [m]
    double skin_squared = 0;                  ///< of the skin that it has
    double clear_squared = 0;  ///< square of the way up to which all obstacles are free [m²]
    double clear = 0;          ///< that way [m]
    bool everything = false;   ///< asks all obstacles
    std::vector<Neighbour> neighbours = {};  ///< in increasing order

    Eigen::Vector3d start() const { return ends.col(0); }
    Eigen::Vector3d end() const { return ends.col(1); }
  };

  /// Square of how far the link's ends are from where they were, at most [m²]. No number if one of them is none: then
  /// the link's end is none, which std::max keeps as its first.
  static double ends_squared(const List& list, const Link& link, const ChainPose& pose) {
    return std::max((pose.p_WO.col(link.end) - list.end()).squaredNorm(),
                    (pose.p_WO.col(link.start) - list.start()).squaredNorm());
  }

  /// The same in both poses; no number if one of the second is none.
  static double ends_squared(const List& list, const Passage& passage) {
    const double squared = ends_squared(list, passage.link, passage.to);
    return &passage.from == &passage.to
               ? squared
               : std::max(squared, ends_squared(list, passage.link, passage.from));
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

  void make(const Passage& passage, List& list);
  bool fill(double skin, List& list);
  double clear_way(int obstacle, double gap, const List& list) const;

  std::shared_ptr<const ObstacleIndex> index_;
  FreeBy free_by_;
  std::array<List, kMaxPoints> lists_;  ///< by the link's end
  std::vector<std::int32_t> scratch_;
  WorkCounters* counters_;
};

}  // namespace bqsa
