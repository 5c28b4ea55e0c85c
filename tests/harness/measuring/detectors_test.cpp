// All detectors against a reference in 113-bit arithmetic that shares no code with them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "harness/input_error.hpp"
#include "harness/judge/exact_distance.hpp"
#include "harness/measuring/detector.hpp"
#include "support/allocation_guard.hpp"
#include "support/exact_segment_test.hpp"

namespace bqsa::harness {
namespace {

using test_support::AllocationGuard;
using test_support::exact_segment_test;
using test_support::ExactSegmentTest;
using test_support::Quad;

/// Least level on the link, in 113 bits: negative in the ellipsoid's interior, not a distance.
double least_level(const ExactSegmentTest& exact) {
  if (exact.towards > 0 && exact.beyond > 0) {
    return static_cast<double>(exact.area2 / exact.length2 - 1);
  }
  return static_cast<double>(std::min(exact.start_level, exact.end_level));
}

double least_level(const Workload& workload, std::size_t pose, int link, int obstacle) {
  const Ellipsoid& shape = workload.obstacles[static_cast<std::size_t>(obstacle)];
  const Eigen::Vector3d p1 = workload.poses[pose].col(link);
  const Eigen::Vector3d p2 = workload.poses[pose].col(link + 1);
  if (workload.size.dimension == 3) return least_level(exact_segment_test<3>(shape, p1, p2));
  return least_level(exact_segment_test<2>(planar_section(shape), p1.head<2>(), p2.head<2>()));
}

std::vector<std::uint8_t> answers(Detection& detection, const Workload& workload,
                                  std::size_t pose) {
  // Nothing is taken over from before.
  std::vector<std::uint8_t> hit(static_cast<std::size_t>(workload.size.pairs()), 77);
  detection.detect(static_cast<int>(pose), hit);
  return hit;
}

struct Case {
  const Detector* detector;
  int dimension;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const Detector& detector : detectors()) {
    for (const int dimension : {2, 3}) {
      if (detector.is_for(dimension)) all.push_back({&detector, dimension});
    }
  }
  return all;
}

std::string case_name(const testing::TestParamInfo<Case>& info) {
  return std::string(info.param.detector->name) + (info.param.dimension == 2 ? "_plane" : "_space");
}

class Detectors : public testing::TestWithParam<Case> {
 protected:
  const Detector& detector_ = *GetParam().detector;
};

INSTANTIATE_TEST_SUITE_P(All, Detectors, testing::ValuesIn(cases()), case_name);

/// Level of a touch that is left to the tolerance of libraries, and to the rounding of the paper's form
/// and of float; with semi-axes from 5 cm on 5e-5 is at least 1.2 um.
double left_out(Accuracy accuracy) { return accuracy == Accuracy::kExact ? 1e-12 : 5e-5; }

/// Float must find every hit, and may find a few more; of a library's, none by more than 10 um.
double left_out_of_hits(Accuracy accuracy) {
  if (accuracy == Accuracy::kSinglePrecision) return 4e-4;
  return accuracy == Accuracy::kConservative ? 1e-12 : left_out(accuracy);
}

double left_out_of_free(Accuracy accuracy) {
  if (accuracy == Accuracy::kSinglePrecision) return 4e-2;
  return accuracy == Accuracy::kConservative ? 5e-4 : left_out(accuracy);
}

TEST_P(Detectors, KeepTheirPromiseAgainst113Bits) {
  int hits = 0, free = 0, near = 0, missed = 0, false_alarms = 0;
  for (const std::uint64_t seed : {11u, 12u, 13u}) {
    // Not square, so that links and obstacles cannot be mistaken for each other.
    const Workload workload = make_workload({.dimension = GetParam().dimension,
                                             .links = 7,
                                             .obstacles = 12,
                                             .test_points = {.link = 5, .obstacle = 20}},
                                            seed);
    const std::unique_ptr<Detection> detection = detector_.prepare(workload);
    for (std::size_t pose = 0; pose < workload.poses.size(); ++pose) {
      const std::vector<std::uint8_t> hit = answers(*detection, workload, pose);
      for (int j = 0; j < workload.size.obstacles; ++j) {
        for (int i = 0; i < workload.size.links; ++i) {
          const std::uint8_t answer = hit[static_cast<std::size_t>(j * workload.size.links + i)];
          ASSERT_LE(answer, 1);
          const double level = least_level(workload, pose, i, j);
          if (-left_out_of_hits(detector_.accuracy) < level &&
              level < left_out_of_free(detector_.accuracy)) {
            ++near;
          } else if (level < 0) {
            ++hits;
            missed += answer == 0;
          } else {
            ++free;
            false_alarms += answer == 1;
          }
        }
      }
    }
  }
  EXPECT_GT(hits, 2000);
  EXPECT_GT(free, 20000);
  EXPECT_LT(near, detector_.accuracy == Accuracy::kSinglePrecision ? 500 : 10);
  switch (detector_.accuracy) {
    case Accuracy::kExact:
    case Accuracy::kLibrary:
    case Accuracy::kSinglePrecision:
    case Accuracy::kPaper:
    case Accuracy::kConservative:
      EXPECT_EQ(missed, 0);
      EXPECT_EQ(false_alarms, 0);
      break;
    case Accuracy::kPaperConservative:
      EXPECT_EQ(missed, 0);
      EXPECT_GT(false_alarms, 0) << "the converse of Lemma 1 is false";
      break;
    case Accuracy::kSampled:
      EXPECT_GT(missed, 0);
      EXPECT_LT(missed, hits);
      EXPECT_GT(false_alarms, 0) << "what is within the margin";
      break;
  }
}

/// Free links moved towards the obstacle, or just into it, along the shortest way. What moved them is
/// judged again in 113 bits.
Workload next_to_touching(int dimension, double gap) {
  Workload workload = make_workload({.dimension = dimension, .links = 1, .obstacles = 1}, 25);
  const Ellipsoid& shape = workload.obstacles.front();
  std::vector<Eigen::Matrix3Xd> moved;
  for (const Eigen::Matrix3Xd& pose : workload.poses) {
    const SegmentDistance apart = exact_distance(pose.col(0), pose.col(1), shape);
    if (apart.distance == 0) continue;
    moved.push_back(pose.colwise() + (gap - apart.distance) * apart.normal);
  }
  workload.poses = moved;
  return workload;
}

TEST_P(Detectors, TellHitFromFreeRightNextToTouching) {
  if (detector_.accuracy == Accuracy::kSampled) return;
  const bool in_float = detector_.accuracy == Accuracy::kConservative;
  const bool in_single = detector_.accuracy == Accuracy::kSinglePrecision;
  const double gap = detector_.accuracy == Accuracy::kExact || in_float ? 1e-11 : 2e-6;
  for (const double signed_gap : {in_float    ? 2e-4
                                  : in_single ? 1e-3
                                              : gap,
                                  in_single ? -1e-5 : -gap}) {
    const Workload workload = next_to_touching(GetParam().dimension, signed_gap);
    const std::unique_ptr<Detection> detection = detector_.prepare(workload);
    int wrong = 0;
    for (std::size_t pose = 0; pose < workload.poses.size(); ++pose) {
      const bool hit = signed_gap < 0;
      ASSERT_EQ(least_level(workload, pose, 0, 0) <= 0, hit);
      wrong += answers(*detection, workload, pose).front() != hit;
    }
    EXPECT_GT(workload.poses.size(), 700u);
    if (signed_gap > 0 && detector_.accuracy == Accuracy::kPaperConservative) continue;
    EXPECT_EQ(wrong, 0) << "of " << workload.poses.size() << " with a gap of " << signed_gap;
  }
}

TEST_P(Detectors, AnswerTheSameInAnyOrderOfPoses) {
  const Workload workload =
      make_workload({.dimension = GetParam().dimension, .links = 4, .obstacles = 5}, 21);
  const std::unique_ptr<Detection> detection = detector_.prepare(workload);
  std::vector<std::vector<std::uint8_t>> forwards;
  constexpr std::size_t kPoses = 50;
  for (std::size_t p = 0; p < kPoses; ++p) forwards.push_back(answers(*detection, workload, p));
  for (std::size_t p = kPoses; p-- > 0;) EXPECT_EQ(answers(*detection, workload, p), forwards[p]);
}

TEST_P(Detectors, AnswerForASinglePair) {
  const Workload workload =
      make_workload({.dimension = GetParam().dimension, .links = 1, .obstacles = 1}, 22);
  const std::unique_ptr<Detection> detection = detector_.prepare(workload);
  int hits = 0;
  for (std::size_t p = 0; p < workload.poses.size(); ++p) {
    hits += answers(*detection, workload, p).front();
  }
  EXPECT_GT(hits, 0);
  EXPECT_LT(hits, static_cast<int>(workload.poses.size()));
}

/// Libraries may: that is their own affair.
TEST(OwnDetectors, DoNotAllocate) {
  if (!test_support::kCountsAllocations) GTEST_SKIP() << "the sanitizer brings its own malloc";
  int checked = 0;
  for (const auto& [detector, dimension] : cases()) {
    if (detector->accuracy == Accuracy::kLibrary ||
        detector->accuracy == Accuracy::kSinglePrecision) {
      continue;
    }
    const Workload workload =
        make_workload({.dimension = dimension, .links = 9, .obstacles = 3}, 23);
    const std::unique_ptr<Detection> detection = detector->prepare(workload);
    std::vector<std::uint8_t> hit(27);
    const AllocationGuard guard;
    for (int pose = 0; pose < 20; ++pose) detection->detect(pose, hit);
    EXPECT_EQ(guard.allocations(), 0u) << detector->name;
    ++checked;
  }
  EXPECT_EQ(checked, 22);
}

/// Lemma 1 as stated, with shadows judged in 113 bits: a hit is what hits in all three planes.
TEST(Projections, HitWhereAllThreeShadowsDo) {
  const Workload workload = make_workload({.dimension = 3, .links = 7, .obstacles = 12}, 24);
  const std::unique_ptr<Detection> detection = detector_named("bqsa_projections").prepare(workload);
  int of_planes[4] = {};  // pairs that hit in so many planes
  for (std::size_t pose = 0; pose < workload.poses.size(); ++pose) {
    const std::vector<std::uint8_t> hit = answers(*detection, workload, pose);
    for (std::size_t pair = 0; pair < hit.size(); ++pair) {
      const auto i = static_cast<Eigen::Index>(pair % 7);
      int planes = 0;
      bool touching = false;
      for (int k = 0; k < 3; ++k) {
        Eigen::Matrix<double, 2, 3> selector;
        selector << Eigen::RowVector3d::Unit(k), Eigen::RowVector3d::Unit((k + 1) % 3);
        const double level = least_level(exact_segment_test<2>(
            shadow(workload.obstacles[pair / 7], selector), selector * workload.poses[pose].col(i),
            selector * workload.poses[pose].col(i + 1)));
        planes += level <= 0;
        touching = touching || std::abs(level) < left_out(Accuracy::kPaperConservative);
      }
      if (touching) continue;
      EXPECT_EQ(hit[pair], planes == 3) << planes;
      ++of_planes[planes];
    }
  }
  for (const int count : of_planes) EXPECT_GT(count, 100);
}

/// An upright link through the middle of a disk, and one beside it.
Workload vertical_links() {
  Workload workload{
      .size = {.dimension = 2, .links = 1, .obstacles = 1}, .poses = {}, .obstacles = {}};
  for (const double x : {1.0, 1.5}) {
    Eigen::Matrix3Xd pose(3, 2);
    pose << x, x, 0.35, 0.65, 0, 0;
    workload.poses.push_back(pose);
  }
  workload.obstacles.push_back(embedded(rotated_ellipse({1.0, 0.5}, {0.0625, 0.0625}, 0)));
  return workload;
}

TEST(PaperForm, CallsAVerticalLinkFreeThatAllOthersSeeHit) {
  const Workload workload = vertical_links();
  for (const Detector& detector : detectors()) {
    if (!detector.in_plane) continue;
    const std::unique_ptr<Detection> detection = detector.prepare(workload);
    const int defect = detector.accuracy == Accuracy::kPaper;
    EXPECT_EQ(answers(*detection, workload, 0).front(), 1 - defect) << detector.name;
    EXPECT_EQ(answers(*detection, workload, 1).front(), 0) << detector.name;
  }
}

TEST(DetectorList, NamesAndLabelsAreUnique) {
  std::set<std::string_view> names, labels;
  for (const Detector& detector : detectors()) {
    names.insert(detector.name);
    labels.insert(detector.label);
    EXPECT_TRUE(detector.in_plane || detector.in_space) << detector.name;
    EXPECT_EQ(&detector_named(detector.name), &detector);
  }
  EXPECT_EQ(names.size(), detectors().size());
  EXPECT_EQ(labels.size(), detectors().size());
}

TEST(DetectorList, SaysWhatThereIs) {
  try {
    detector_named("bqsb");
    FAIL() << "no exception";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::StartsWith("detector: expected one of bqsa_paper, "));
    EXPECT_THAT(error.what(), testing::HasSubstr("ccd_mpr"));
    EXPECT_THAT(error.what(), testing::EndsWith("got 'bqsb'"));
  }
}

}  // namespace
}  // namespace bqsa::harness
