#include "bqsa/envelope/quickhull.hpp"

#include <algorithm>
#include <stdexcept>
#include <unordered_map>
#include <utility>

namespace bqsa {
namespace {

__extension__ typedef __int128 Wide;  // the alias form does not silence -Wpedantic

Cell difference(const Cell& a, const Cell& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// The plane of three points.
struct Plane {
  Cell at;
  std::array<Wide, 3> normal;

  Plane(const Cell& a, const Cell& b, const Cell& c) : at(a) {
    const Cell u = difference(b, a), v = difference(c, a);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
      normal[k] = static_cast<Wide>(u[l]) * v[m] - static_cast<Wide>(u[m]) * v[l];
    }
  }

  bool exists() const { return normal[0] != 0 || normal[1] != 0 || normal[2] != 0; }

  /// Six times the volume of the tetrahedron: positive for p on the outer side.
  Wide height(const Cell& p) const {
    const Cell w = difference(p, at);
    return normal[0] * w[0] + normal[1] * w[1] + normal[2] * w[2];
  }
};

/// A triangle of the growing hull, counterclockwise from outside.
struct Facet {
  std::array<int, 3> corners;
  std::array<int, 3> neighbours;  ///< across the edge from corner k to corner k + 1
  Plane plane;
  std::vector<int> outside;  ///< points above this facet
  bool alive = true;
};

/// Points on the grid, and the hull that grows around them.
class Quickhull {
 public:
  /// @param cells  points; of flat ones up to three more are added that make them solid
  explicit Quickhull(std::vector<Cell> cells) : cells_(std::move(cells)) {
    given_ = static_cast<int>(cells_.size());
    start();
    for (std::size_t next = 0; next < facets_.size(); ++next) {
      if (facets_[next].alive && !facets_[next].outside.empty())
        add_furthest(static_cast<int>(next));
    }
  }

  int span() const { return span_; }
  const std::vector<Facet>& facets() const { return facets_; }

 private:
  const Cell& cell(int point) const { return cells_[static_cast<std::size_t>(point)]; }
  Facet& facet(int number) { return facets_[static_cast<std::size_t>(number)]; }

  /// A point beyond the grid along an axis, the first one that `fits`.
  template <typename Fits>
  int artificial(const Fits& fits) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Cell apex = cells_.front();
      apex[axis] = std::int64_t{2} << kGridBits;
      if (!fits(apex)) continue;
      cells_.push_back(apex);
      return static_cast<int>(cells_.size()) - 1;
    }
    throw std::logic_error("convex hull: no axis leaves a flat");
  }

  /// The given point for which `size` is largest, or -1 if it is zero for all.
  template <typename Size>
  int largest(const Size& size) const {
    int result = -1;
    auto most = decltype(size(cells_.front())){};
    for (int i = 0; i < given_; ++i) {
      const auto value = size(cell(i));
      if (!(value > most)) continue;
      most = value;
      result = i;
    }
    return result;
  }

  /// A tetrahedron, of given points as far as they span it.
  void start() {
    span_ = 3;
    const Cell a = cells_.front();
    int ib = largest([&](const Cell& p) -> Wide {
      const Cell w = difference(p, a);
      return static_cast<Wide>(w[0]) * w[0] + static_cast<Wide>(w[1]) * w[1] +
             static_cast<Wide>(w[2]) * w[2];
    });
    if (ib < 0) {
      span_ = 0;
      ib = artificial([](const Cell&) { return true; });
    }
    const Cell b = cell(ib);
    // Floating point only chooses among points; that the plane exists is decided exactly.
    int ic = largest([&](const Cell& p) -> long double {
      const Plane plane(a, b, p);
      long double sum = 0;
      for (const Wide n : plane.normal) sum += std::abs(static_cast<long double>(n));
      return sum;
    });
    if (ic < 0) {
      span_ = std::min(span_, 1);
      ic = artificial([&](const Cell& p) { return Plane(a, b, p).exists(); });
    }
    const Cell c = cell(ic);
    const Plane base(a, b, c);
    int id = largest([&](const Cell& p) -> Wide {
      const Wide height = base.height(p);
      return height < 0 ? -height : height;
    });
    if (id < 0) {
      span_ = std::min(span_, 2);
      id = artificial([&](const Cell& p) { return base.height(p) != 0; });
    }
    if (base.height(cell(id)) > 0) std::swap(ib, ic);
    // Below the base abc is d.
    add_facet({0, ib, ic}, {3, 2, 1});
    add_facet({0, ic, id}, {0, 2, 3});
    add_facet({ic, ib, id}, {0, 3, 1});
    add_facet({ib, 0, id}, {0, 1, 2});
    std::vector<int> all(cells_.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
    assign(all, 0);
  }

  void add_facet(const std::array<int, 3>& corners, const std::array<int, 3>& neighbours) {
    facets_.push_back(
        {corners, neighbours, Plane(cell(corners[0]), cell(corners[1]), cell(corners[2])), {}});
  }

  /// Hands each point to the first facet from number `first` on that it is above; drops the others.
  void assign(const std::vector<int>& points, std::size_t first) {
    for (const int point : points) {
      for (std::size_t f = first; f < facets_.size(); ++f) {
        if (facets_[f].plane.height(cell(point)) <= 0) continue;
        facets_[f].outside.push_back(point);
        break;
      }
    }
  }

  /// A facet that stays, and the edge of the visible part along it.
  struct HorizonEdge {
    int from, to;  ///< as the visible facet has them
    int beyond;
  };

  /// The facets that p is above, from one of them on, marked dead, and their outline.
  std::vector<HorizonEdge> remove_visible(int number, const Cell& p, std::vector<int>& orphans) {
    std::vector<HorizonEdge> horizon;
    std::vector<int> stack{number};
    facet(number).alive = false;
    while (!stack.empty()) {
      Facet& here = facet(stack.back());
      stack.pop_back();
      orphans.insert(orphans.end(), here.outside.begin(), here.outside.end());
      here.outside = {};
      for (std::size_t k = 0; k < 3; ++k) {
        Facet& next = facet(here.neighbours[k]);
        if (!next.alive) continue;
        if (next.plane.height(p) > 0) {
          next.alive = false;
          stack.push_back(here.neighbours[k]);
        } else {
          horizon.push_back({here.corners[k], here.corners[(k + 1) % 3], here.neighbours[k]});
        }
      }
    }
    return horizon;
  }

  /// Replaces what the furthest point above the facet sees by a cone of new facets.
  void add_furthest(int number) {
    const std::vector<int>& outside = facet(number).outside;
    const Plane plane = facet(number).plane;
    const int apex = *std::max_element(outside.begin(), outside.end(), [&](int a, int b) {
      return plane.height(cell(a)) < plane.height(cell(b));
    });
    std::vector<int> orphans;
    const std::vector<HorizonEdge> horizon = remove_visible(number, cell(apex), orphans);
    const std::size_t first = facets_.size();
    std::unordered_map<int, int> starting_at, ending_at;  // corner of the horizon to new facet
    for (const HorizonEdge& edge : horizon) {
      const int created = static_cast<int>(facets_.size());
      add_facet({edge.from, edge.to, apex}, {edge.beyond, -1, -1});
      Facet& beyond = facet(edge.beyond);
      for (std::size_t k = 0; k < 3; ++k) {
        if (beyond.corners[k] == edge.to && beyond.corners[(k + 1) % 3] == edge.from) {
          beyond.neighbours[k] = created;
        }
      }
      starting_at[edge.from] = created;
      ending_at[edge.to] = created;
    }
    for (std::size_t f = first; f < facets_.size(); ++f) {
      facets_[f].neighbours[1] = starting_at.at(facets_[f].corners[1]);
      facets_[f].neighbours[2] = ending_at.at(facets_[f].corners[0]);
    }
    assign(orphans, first);
  }

  std::vector<Cell> cells_;
  std::vector<Facet> facets_;
  int given_ = 0;
  int span_ = 3;
};

}  // namespace

GridHull grid_hull(const std::vector<Cell>& points) {
  const Quickhull quickhull(points);
  GridHull hull{{}, quickhull.span()};
  for (const Facet& facet : quickhull.facets()) {
    if (facet.alive) hull.triangles.push_back(facet.corners);
  }
  return hull;
}

}  // namespace bqsa
