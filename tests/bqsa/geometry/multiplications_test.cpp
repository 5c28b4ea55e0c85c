// The complexity figures, counted. The rule: every product of two numbers is one multiplication,
// products with a constant included; sums, differences and comparisons are free.

#include <gtest/gtest.h>

#include "bqsa/geometry/paper_form.hpp"
#include "bqsa/geometry/segment_test.hpp"
#include "harness/measuring/counting_scalar.hpp"

namespace bqsa {
namespace {

using harness::CountingScalar;
template <int Dim>
using CountingVector = Eigen::Matrix<CountingScalar, Dim, 1>;
template <int Dim>
using CountingMatrix = Eigen::Matrix<CountingScalar, Dim, Dim>;

/// Multiplications done by `work`; none of the tests may divide.
template <typename Work>
std::uint64_t multiplications(const Work& work) {
  CountingScalar::reset();
  work();
  EXPECT_EQ(CountingScalar::divisions(), 0u);
  return CountingScalar::multiplications();
}

const Conic<CountingScalar> kConic{2.0, 0.3, 3.0, -0.7, 0.2, -1.0};
const CountingVector<2> kStart(-1.5, 0.4);
const CountingVector<2> kEnd(1.7, -0.2);

TEST(Multiplications, OfThePaperFormAsPrinted) {
  PaperForm<CountingScalar> f;
  EXPECT_EQ(multiplications([&] { f = paper_form(kConic, kStart, kEnd); }), 22u);
  EXPECT_EQ(multiplications([&] { discriminant(f); }), 3u);
}

TEST(Multiplications, OfThePaperFormWithSharedProducts) {
  PaperForm<CountingScalar> f;
  EXPECT_EQ(multiplications([&] { f = paper_form_shared(kConic, kStart, kEnd); }), 18u);
  EXPECT_EQ(multiplications([&] { discriminant(f); }), 3u);
}

/// A chain of links that all end outside a unit ball without meeting it: the longest way through
/// `category`. Counts are a pair, of a chain of so many links that the extra first point is told
/// apart.
template <int Dim>
struct Chain {
  static constexpr int kLinks = 10;

  Chain() {
    for (int k = 0; k <= kLinks; ++k) {
      points[k].setConstant(2.0 + k);
      points[k](0) = k % 2 == 0 ? -1.0 : 1.5;
    }
  }

  CountingMatrix<Dim> unit_map = CountingMatrix<Dim>::Identity();
  CountingVector<Dim> center = CountingVector<Dim>::Zero();
  CountingVector<Dim> points[kLinks + 1];
};

/// Every point mapped once and its own level kept, for the two links that share it.
template <int Dim>
void polar_over_chain(const Chain<Dim>& chain) {
  CountingVector<Dim> u = unit_point(chain.unit_map, chain.center, chain.points[0]);
  CountingScalar level = u.dot(u) - CountingScalar(1);
  for (int k = 1; k <= Chain<Dim>::kLinks; ++k) {
    const CountingVector<Dim> next = unit_point(chain.unit_map, chain.center, chain.points[k]);
    const CountingScalar next_level = next.dot(next) - CountingScalar(1);
    const PolarForm<CountingScalar> f{level, u.dot(next) - CountingScalar(1), next_level};
    EXPECT_FALSE(is_hit(category(f))) << "link " << k;
    u = next;
    level = next_level;
  }
}

TEST(Multiplications, OfThePolarFormInThePlaneWithSharedEndPoints) {
  const Chain<2> chain;
  const std::uint64_t first_point = 3 + 2;
  EXPECT_EQ(multiplications([&] { polar_over_chain(chain); }), first_point + 9u * chain.kLinks);
}

TEST(Multiplications, OfThePolarFormInSpaceWithSharedEndPoints) {
  const Chain<3> chain;
  const std::uint64_t first_point = 6 + 3;
  EXPECT_EQ(multiplications([&] { polar_over_chain(chain); }), first_point + 14u * chain.kLinks);
}

template <int Dim>
void parameter_over_chain(const Chain<Dim>& chain) {
  CountingVector<Dim> u = unit_point(chain.unit_map, chain.center, chain.points[0]);
  for (int k = 1; k <= Chain<Dim>::kLinks; ++k) {
    const CountingVector<Dim> next = unit_point(chain.unit_map, chain.center, chain.points[k]);
    EXPECT_FALSE(is_hit(category(parameter_form<CountingScalar, Dim>(u, next)))) << "link " << k;
    u = next;
  }
}

TEST(Multiplications, OfTheParameterForm) {
  const Chain<2> plane;
  const Chain<3> space;
  EXPECT_EQ(multiplications([&] { parameter_over_chain(plane); }), 3 + 12u * plane.kLinks);
  EXPECT_EQ(multiplications([&] { parameter_over_chain(space); }), 6 + 18u * space.kLinks);
}

TEST(Multiplications, OfAPairThatSharesNothing) {
  const Chain<2> plane;
  const Chain<3> space;
  const auto alone = []<int Dim>(const Chain<Dim>& chain) {
    const CountingVector<Dim> u1 = unit_point(chain.unit_map, chain.center, chain.points[0]);
    const CountingVector<Dim> u2 = unit_point(chain.unit_map, chain.center, chain.points[1]);
    category(polar_form<CountingScalar, Dim>(u1, u2));
  };
  EXPECT_EQ(multiplications([&] { alone(plane); }), 14u);
  EXPECT_EQ(multiplications([&] { alone(space); }), 23u);
}

TEST(Multiplications, AreNotNeededWhereAnEndLiesInside) {
  const PolarForm<CountingScalar> f{-0.5, 0.1, 2.0};
  EXPECT_EQ(multiplications([&] { category(f); }), 0u);
}

}  // namespace
}  // namespace bqsa
