#include "bqsa/neighbourhood/box_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

#include "bqsa/batch/instruction_set.hpp"
#include "support/allocation_guard.hpp"
#include "support/sampling.hpp"

namespace bqsa {
namespace {

using Eigen::Vector3d;
using test_support::Generator;
using test_support::log_uniform;
using test_support::random_vector;
using test_support::uniform;

/// A box as it was wanted, before it was rounded.
struct Wanted {
  Vector3d low, high, stretch;

  GrowingBox box() const { return GrowingBox::around(low, high, stretch); }

  /// How far the segment is away on the axis on which that is most, in extended precision [m].
  long double gap(const Vector3d& p1, const Vector3d& p2, double d) const {
    long double widest = -std::numeric_limits<long double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const long double growth = static_cast<long double>(d) * stretch(axis);
      widest = std::max({widest, low(axis) - growth - std::max(p1(axis), p2(axis)),
                         std::min(p1(axis), p2(axis)) - (high(axis) + growth)});
    }
    return widest;
  }
};

std::vector<Wanted> random_boxes(Generator& generator, int count, double half_width) {
  std::vector<Wanted> boxes;
  for (int i = 0; i < count; ++i) {
    const Vector3d center = random_vector<3>(generator, half_width);
    const Vector3d half =
        Vector3d::NullaryExpr([&](Eigen::Index) { return log_uniform(generator, 1e-3, 0.2); });
    boxes.push_back({center - half, center + half, half * log_uniform(generator, 1, 1e3)});
  }
  return boxes;
}

struct Tree {
  std::vector<std::int32_t> ids;
  BoxTree tree;

  explicit Tree(const std::vector<Wanted>& wanted) {
    std::vector<GrowingBox> boxes;
    for (const Wanted& one : wanted) boxes.push_back(one.box());
    for (std::size_t i = 0; i < boxes.size(); ++i) ids.push_back(static_cast<std::int32_t>(i));
    tree = BoxTree(boxes, ids);
  }
};

class BoxTreeTest : public ::testing::Test {
 protected:
  ~BoxTreeTest() override { use_instruction_set(instruction_sets().front().name); }
};

TEST_F(BoxTreeTest, FindsEveryBoxThatIsNearAndHardlyAnyOther) {
  for (const InstructionSet& set : instruction_sets()) {
    use_instruction_set(set.name);
    Generator generator(1);
    int near = 0, found_too_many = 0;
    for (const int count : {0, 1, 15, 16, 17, 255, 257, 5000}) {
      const std::vector<Wanted> wanted = random_boxes(generator, count, 2);
      const Tree tree(wanted);
      std::vector<std::int32_t> positions(wanted.size());
      for (int query = 0; query < 60; ++query) {
        const Vector3d p1 = random_vector<3>(generator, 2);
        const Vector3d p2 = query % 5 == 0 ? p1 : p1 + random_vector<3>(generator, 0.3);
        const double margin = uniform(generator, 0, 0.1);
        const double d = log_uniform(generator, 1e-5, 0.1);
        const BoxesFound found = tree.tree.search(p1, p2, margin, d, positions);
        ASSERT_TRUE(found.all);
        std::vector<bool> is_found(wanted.size());
        for (std::size_t k = 0; k < found.count; ++k) {
          is_found[static_cast<std::size_t>(tree.tree.id(positions[k]))] = true;
        }
        for (std::size_t i = 0; i < wanted.size(); ++i) {
          const long double gap = wanted[i].gap(p1, p2, d);
          ASSERT_TRUE(is_found[i] || gap > margin) << set.name << " of " << count;
          near += gap <= margin;
          const double growth = d * wanted[i].stretch.maxCoeff();
          found_too_many += is_found[i] && gap > margin + 1e-5 * (1 + growth);
        }
      }
    }
    EXPECT_GT(near, 1000);
    EXPECT_EQ(found_too_many, 0);
  }
}

TEST_F(BoxTreeTest, BoxesThatTouchExactlyAreFoundByAllInstructionSets) {
  // Numbers that single precision holds, and some that it does not.
  for (const double half : {0.25, 0.1, 1.0 / 3}) {
    for (const double center : {0.0, 3.0, -1.7, 1234.1}) {
      const Tree tree({{Vector3d::Constant(center - half), Vector3d::Constant(center + half),
                        Vector3d::Constant(2)}});
      for (const InstructionSet& set : instruction_sets()) {
        use_instruction_set(set.name);
        std::int32_t position = 0;
        for (int axis = 0; axis < 3; ++axis) {
          for (const double side : {-1, 1}) {
            Vector3d p = Vector3d::Constant(center);
            p(axis) = center + side * (half + 2 * 0.125 + 0.5);
            EXPECT_EQ(tree.tree.search(p, p, 0.5, 0.125, {&position, 1}).count, 1U)
                << set.name << ' ' << half << ' ' << center;
          }
        }
      }
    }
  }
}

TEST_F(BoxTreeTest, AGapIsNeverMoreThanItIs) {
  Generator generator(2);
  int wide = 0;
  for (const Wanted& wanted : random_boxes(generator, 5000, 50)) {
    const Vector3d p1 = random_vector<3>(generator, 50);
    const Vector3d p2 = p1 + random_vector<3>(generator, 1);
    const double d = log_uniform(generator, 1e-5, 1);
    const long double exact = wanted.gap(p1, p2, d);
    const double found = wanted.box().gap(p1, p2, d);
    ASSERT_LE(found, exact);
    EXPECT_GT(found, exact - 1e-4L * std::max(1.0L, std::abs(exact)));
    wide += exact > 0;
  }
  EXPECT_GT(wide, 1000);
}

TEST_F(BoxTreeTest, WhatIsBeyondSinglePrecisionIsFoundAllTheSame) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const Vector3d all = Vector3d::Constant(kInfinite);
  const Tree tree({{-all, all, Vector3d::Zero()},
                   {Vector3d::Constant(1e300), Vector3d::Constant(1e301), Vector3d::Ones()},
                   {Vector3d::Constant(1), Vector3d::Constant(2), Vector3d::Constant(1e300)}});
  std::vector<std::int32_t> positions(3);
  const BoxesFound found = tree.tree.search(Vector3d::Zero(), Vector3d::Zero(), 0, 1e-4, positions);
  std::vector<std::int32_t> ids;
  for (std::size_t k = 0; k < found.count; ++k) ids.push_back(tree.tree.id(positions[k]));
  std::ranges::sort(ids);
  EXPECT_EQ(ids, (std::vector<std::int32_t>{0, 2}));

  // Nor are lanes without a box taken for one.
  positions.resize(kBoxGroup);
  for (const double margin : {1e300, kInfinite}) {
    EXPECT_EQ(tree.tree.search(Vector3d::Zero(), Vector3d::Zero(), margin, 1e300, positions).count,
              3U);
  }
}

TEST_F(BoxTreeTest, SaysWhenThereIsNotEnoughRoom) {
  Generator generator(3);
  const Tree tree(random_boxes(generator, 100, 0.1));
  std::vector<std::int32_t> positions(100);
  const Vector3d p = Vector3d::Zero();
  EXPECT_TRUE(tree.tree.search(p, p, 1, 0.1, positions).all);
  const BoxesFound found = tree.tree.search(p, p, 1, 0.1, std::span(positions).first(99));
  EXPECT_FALSE(found.all);
  EXPECT_EQ(found.count, 99U);
}

TEST_F(BoxTreeTest, LooksAtFewBoxesOfManyAndDoesNotAllocate) {
  // A thousand times as many boxes of the same density.
  Generator generator(4);
  std::vector<double> asked_on_average;
  for (const int count : {1000, 1'000'000}) {
    const double half_width = 0.5 * std::cbrt(count / 8.0);
    std::vector<Wanted> wanted;
    for (int i = 0; i < count; ++i) {
      const Vector3d center = random_vector<3>(generator, half_width);
      const Vector3d half = Vector3d::Constant(0.05);
      wanted.push_back({center - half, center + half, Vector3d::Ones()});
    }
    const Tree tree(wanted);
    EXPECT_LT(tree.tree.bytes(), static_cast<std::size_t>(count) * 45);
    std::vector<std::int32_t> positions(1000);
    std::uint64_t asked = 0;
    constexpr int kQueries = 500;
    const test_support::AllocationGuard guard;
    for (int query = 0; query < kQueries; ++query) {
      const Vector3d p1 = random_vector<3>(generator, half_width - 0.5);
      const Vector3d p2 = p1 + random_vector<3>(generator, 0.3);
      asked += tree.tree.search(p1, p2, 0.1, 1e-3, positions).asked;
    }
    EXPECT_EQ(guard.allocations(), 0U);
    asked_on_average.push_back(static_cast<double>(asked) / kQueries);
  }
  EXPECT_LT(asked_on_average[1], 3 * asked_on_average[0]);
  EXPECT_LT(asked_on_average[1], 1000);
}

}  // namespace
}  // namespace bqsa
