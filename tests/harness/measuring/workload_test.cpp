// What the detectors are measured on: sizes, splits of NM, and the draw of arms and obstacles.

#include "harness/measuring/workload.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "harness/input_error.hpp"
#include "harness/measuring/verify_detector.hpp"

namespace bqsa::harness {
namespace {

TEST(WorkloadSize, HasTheAskedNumbersOfPairs) {
  for (const int dimension : {2, 3}) {
    for (const int nk : {1, 2, 3, 7, 10, 27, 100, 121, 1000, 9999, 10000}) {
      for (const int nm : {1, 2, 3, 12, 25, 97, 200, 600, 1000, 10000}) {
        const WorkloadSize size = workload_size(dimension, nk, nm);
        EXPECT_EQ(size.dimension, dimension);
        EXPECT_EQ(size.pairs(), nk);
        EXPECT_EQ(size.point_pairs(), nm);
        EXPECT_LE(size.links, 10);
        for (int more = size.links + 1; more <= 10; ++more) EXPECT_NE(nk % more, 0) << nk;
      }
    }
  }
}

TEST(WorkloadSize, SplitsPointsAsTheHeaderSays) {
  const auto split = [](int dimension, int nm) {
    const WorkloadSize size = workload_size(dimension, 27, nm);
    return std::pair(size.test_points.link, size.test_points.obstacle);
  };
  EXPECT_EQ(split(2, 600), std::pair(15, 40));  // gaps of 21 and 24 mm
  EXPECT_EQ(split(2, 10000), std::pair(50, 200));
  EXPECT_EQ(split(2, 1), std::pair(1, 1));
  EXPECT_EQ(split(3, 1000), std::pair(8, 125));  // in space an obstacle needs more of them
}

/// Whether the split is a good one: no other divisor may see many more hits.
TEST(WorkloadSize, SplitsPointsToMissFew) {
  for (const int dimension : {2, 3}) {
    for (const int nm : {200, 600, 1000}) {
      Workload workload = make_workload(workload_size(dimension, 200, nm), 5);
      const ReferenceAnswers reference = reference_answers(workload, 20'000);
      const Detector& detector = detector_named("test_points_vectorized");
      const int chosen = verify_detector(detector, workload, reference).missed;
      for (int link = 1; link <= nm; ++link) {
        if (nm % link != 0) continue;
        workload.size.test_points = {.link = link, .obstacle = nm / link};
        const Verification other = verify_detector(detector, workload, reference);
        EXPECT_LT(chosen, other.missed + 0.04 * other.hits)
            << dimension << ' ' << nm << ' ' << link;
      }
    }
  }
}

TEST(WorkloadSize, RejectsWhatIsNone) {
  const auto message = [](int dimension, int nk, int nm) -> std::string {
    try {
      workload_size(dimension, nk, nm);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  for (const std::string& said : {message(4, 27, 600), message(2, 0, 600), message(3, 27, -1)}) {
    EXPECT_THAT(said, testing::StartsWith("workload: expected dimension 2 or 3 and positive nk"));
  }
  EXPECT_THAT(message(4, 27, 600), testing::EndsWith("got 4, 27 and 600"));
}

/// Of all bits (FNV-1a).
std::uint64_t fingerprint(const Workload& workload) {
  std::uint64_t hash = 0xcbf29ce484222325;
  const auto add = [&hash](const double* data, Eigen::Index size) {
    std::vector<unsigned char> bytes(static_cast<std::size_t>(size) * sizeof(double));
    std::memcpy(bytes.data(), data, bytes.size());
    for (const unsigned char byte : bytes) hash = (hash ^ byte) * 0x100000001b3;
  };
  for (const Eigen::Matrix3Xd& pose : workload.poses) add(pose.data(), pose.size());
  for (const Ellipsoid& shape : workload.obstacles) {
    add(shape.center().data(), 3);
    add(shape.semi_axes().data(), 3);
    add(shape.rotation().data(), 9);
  }
  return hash;
}

/// The seed, nothing else, decides: not what was drawn before, and not the machine.
TEST(Workload, IsTheSameEveryTime) {
  for (const int dimension : {2, 3}) {
    const WorkloadSize size = workload_size(dimension, 27, 600);
    const std::uint64_t first = fingerprint(make_workload(size, 1));
    EXPECT_NE(first, fingerprint(make_workload(size, 2)));
    EXPECT_EQ(first, fingerprint(make_workload(size, 1)));
    EXPECT_EQ(first, dimension == 2 ? 5973805191209257651u : 10068714984606219279u);
  }
}

TEST(Workload, OfASmallerSizeIsPartOfALarger) {
  for (const int dimension : {2, 3}) {
    const Workload large = make_workload({.dimension = dimension, .links = 9, .obstacles = 30}, 3);
    const Workload small = make_workload({.dimension = dimension,
                                          .links = 4,
                                          .obstacles = 7,
                                          .test_points = {.link = 3, .obstacle = 5}},
                                         3);
    EXPECT_EQ(small.obstacles.size(), 7u);
    for (std::size_t j = 0; j < small.obstacles.size(); ++j) {
      EXPECT_EQ(small.obstacles[j].center(), large.obstacles[j].center());
      EXPECT_EQ(small.obstacles[j].unit_map(), large.obstacles[j].unit_map());
    }
    ASSERT_GE(small.poses.size(), large.poses.size());
    for (std::size_t p = 0; p < large.poses.size(); ++p) {
      EXPECT_EQ(small.poses[p], large.poses[p].leftCols(5));
    }
  }
}

TEST(Workload, HasLinksOfOneLengthAndAFairShareOfHits) {
  for (const int dimension : {2, 3}) {
    for (const int nk : {1, 3, 10, 27, 1000}) {
      SCOPED_TRACE(testing::Message() << "dimension " << dimension << ", nk " << nk);
      const Workload workload = make_workload(workload_size(dimension, nk, 600), 1);
      ASSERT_GE(workload.poses.size(), 32u);
      ASSERT_EQ(workload.obstacles.size(), static_cast<std::size_t>(workload.size.obstacles));
      for (const Eigen::Matrix3Xd& pose : workload.poses) {
        ASSERT_EQ(pose.cols(), workload.size.links + 1);
        if (dimension == 2) {
          EXPECT_TRUE(pose.row(2).isZero(0));
        }
        for (Eigen::Index i = 0; i + 1 < pose.cols(); ++i) {
          EXPECT_NEAR((pose.col(i + 1) - pose.col(i)).norm(), kLinkLength, 1e-15);
        }
      }
      int hits = 0;
      const ReferenceAnswers reference = reference_answers(workload);
      for (const double clearance : reference.clearance) hits += clearance <= 0;
      const double share =
          static_cast<double>(hits) / static_cast<double>(reference.clearance.size());
      EXPECT_GT(share, 0.05);
      EXPECT_LT(share, 0.30);
    }
  }
}

TEST(Workload, ObstaclesOfThePlaneAreEmbeddedEllipses) {
  for (const Ellipsoid& shape : make_workload(workload_size(2, 1000, 1), 1).obstacles) {
    EXPECT_EQ(shape.center().z(), 0);
    EXPECT_EQ(shape.semi_axes().z(), shape.semi_axes().head<2>().maxCoeff());
    EXPECT_EQ(shape.rotation().col(2), Eigen::Vector3d::UnitZ());
  }
}

}  // namespace
}  // namespace bqsa::harness
