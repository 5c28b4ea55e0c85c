// The check that stands before every time: it must catch detectors that are wrong.

#include "harness/measuring/verify_detector.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace bqsa::harness {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// The answers of `bqsa`, spoilt.
class Spoilt : public Detection {
 public:
  explicit Spoilt(const Workload& workload) : right_(detector_named("bqsa").prepare(workload)) {}

 protected:
  void right(int pose, std::span<std::uint8_t> hit) { right_->detect(pose, hit); }

 private:
  std::unique_ptr<Detection> right_;
};

struct AlwaysFree final : Spoilt {
  using Spoilt::Spoilt;
  void detect(int, std::span<std::uint8_t> hit) override { std::fill(hit.begin(), hit.end(), 0); }
};

struct AlwaysHit final : Spoilt {
  using Spoilt::Spoilt;
  void detect(int, std::span<std::uint8_t> hit) override { std::fill(hit.begin(), hit.end(), 1); }
};

struct MissesOne final : Spoilt {
  using Spoilt::Spoilt;
  void detect(int pose, std::span<std::uint8_t> hit) override {
    right(pose, hit);
    if (pose != 17) return;
    const auto first = std::find(hit.begin(), hit.end(), 1);
    if (first != hit.end()) *first = 0;
  }
};

struct OfTheLastPose final : Spoilt {
  using Spoilt::Spoilt;
  void detect(int pose, std::span<std::uint8_t> hit) override { right(std::max(0, pose - 1), hit); }
};

template <typename Wrong>
Detector wrong(Accuracy accuracy) {
  Detector detector = detector_named("bqsa");
  detector.name = "wrong";
  detector.accuracy = accuracy;
  detector.prepare = [](const Workload& workload) -> std::unique_ptr<Detection> {
    return std::make_unique<Wrong>(workload);
  };
  return detector;
}

class VerifyDetector : public testing::Test {
 protected:
  Verification verify(const Detector& detector) const {
    return verify_detector(detector, workload_, reference_);
  }
  std::string broken(const Detector& detector) const {
    return broken_promise(detector, verify(detector));
  }

  const Workload workload_ = make_workload(workload_size(3, 60, 600), 51);
  const ReferenceAnswers reference_ = reference_answers(workload_, 100'000);
};

TEST_F(VerifyDetector, AcceptsAllDetectors) {
  for (const int dimension : {2, 3}) {
    const Workload workload = make_workload(workload_size(dimension, 60, 600), 52);
    const ReferenceAnswers reference = reference_answers(workload, 100'000);
    for (const Detector& detector : detectors()) {
      if (!detector.is_for(dimension)) continue;
      const Verification verification = verify_detector(detector, workload, reference);
      EXPECT_THAT(broken_promise(detector, verification), IsEmpty());
      EXPECT_GT(verification.hits, 300);
      EXPECT_GT(verification.free, 3000);
      const bool single = detector.accuracy == Accuracy::kSinglePrecision;
      EXPECT_LT(verification.touching, single ? 100 : 5);
      EXPECT_EQ(
          verification.hits + verification.free + verification.touching + verification.vertical,
          static_cast<int>(reference.clearance.size()));
    }
  }
}

TEST_F(VerifyDetector, CatchesWrongAnswers) {
  EXPECT_THAT(broken(wrong<AlwaysFree>(Accuracy::kExact)), HasSubstr("wrong: missed"));
  EXPECT_THAT(broken(wrong<AlwaysHit>(Accuracy::kExact)), HasSubstr("free pairs hits"));
  EXPECT_THAT(broken(wrong<MissesOne>(Accuracy::kExact)), HasSubstr("wrong: missed 1 of"));
  EXPECT_THAT(broken(wrong<MissesOne>(Accuracy::kLibrary)), HasSubstr("wrong: missed 1 of"));
  EXPECT_THAT(broken(wrong<MissesOne>(Accuracy::kPaper)), HasSubstr("wrong: missed 1 of"));
  EXPECT_THAT(broken(wrong<OfTheLastPose>(Accuracy::kExact)), HasSubstr("wrong: missed"));
}

TEST_F(VerifyDetector, HoldsAConservativeOneToItsHitsOnly) {
  EXPECT_THAT(broken(wrong<MissesOne>(Accuracy::kPaperConservative)), HasSubstr("missed 1 of"));
  EXPECT_THAT(broken(wrong<AlwaysHit>(Accuracy::kPaperConservative)), IsEmpty());
}

TEST_F(VerifyDetector, HoldsFloatToAllHitsAndToWhatIsBeyondItsBand) {
  EXPECT_THAT(broken(wrong<MissesOne>(Accuracy::kConservative)), HasSubstr("missed 1 of"));
  EXPECT_THAT(broken(wrong<AlwaysHit>(Accuracy::kConservative)), HasSubstr("free pairs hits"));
}

TEST_F(VerifyDetector, HoldsTestPointsToTheirMargin) {
  EXPECT_THAT(broken(wrong<AlwaysFree>(Accuracy::kSampled)), HasSubstr("closer than the margin"));
  EXPECT_THAT(broken(wrong<OfTheLastPose>(Accuracy::kSampled)), HasSubstr("the margin"));
  EXPECT_THAT(broken(wrong<AlwaysHit>(Accuracy::kSampled)), HasSubstr("than the margin"));
}

TEST_F(VerifyDetector, CountsWhatItFinds) {
  const Verification all_free = verify(wrong<AlwaysFree>(Accuracy::kExact));
  EXPECT_EQ(all_free.missed, all_free.hits);
  EXPECT_EQ(all_free.false_alarms, 0);
  const Verification all_hit = verify(wrong<AlwaysHit>(Accuracy::kExact));
  EXPECT_EQ(all_hit.missed, 0);
  EXPECT_EQ(all_hit.false_alarms, all_hit.free);
  EXPECT_LT(all_hit.far_alarms, all_hit.false_alarms);
  EXPECT_GT(all_hit.far_alarms, 0);
}

/// Where nothing hits, every detector would look right.
TEST_F(VerifyDetector, DoesNotAcceptAWorkloadThatShowsNothing) {
  Workload far = workload_;
  for (Eigen::Matrix3Xd& pose : far.poses) pose.array() += 10;
  const Detector& detector = detector_named("bqsa");
  const Verification verification = verify_detector(detector, far, reference_answers(far, 1000));
  EXPECT_THAT(broken_promise(detector, verification), HasSubstr("expected hits and free pairs"));
}

TEST_F(VerifyDetector, LeavesVerticalLinksToThePaper) {
  Workload vertical{
      .size = {.dimension = 2, .links = 1, .obstacles = 1}, .poses = {}, .obstacles = {}};
  Eigen::Matrix3Xd pose(3, 2);
  pose << 1, 1, 0.35, 0.65, 0, 0;
  vertical.poses.push_back(pose);
  vertical.obstacles.push_back(embedded(rotated_ellipse({1.0, 0.5}, {0.0625, 0.0625}, 0)));
  const ReferenceAnswers reference = reference_answers(vertical);
  const Verification paper = verify_detector(detector_named("bqsa_paper"), vertical, reference);
  EXPECT_EQ(paper.vertical, 1);
  EXPECT_EQ(paper.hits, 0);
  const Verification ours = verify_detector(detector_named("bqsa"), vertical, reference);
  EXPECT_EQ(ours.vertical, 0);
  EXPECT_EQ(ours.hits, 1);
}

TEST_F(VerifyDetector, AsksAsManyPosesAsItMay) {
  EXPECT_EQ(reference_answers(workload_, 1).poses, 1);
  EXPECT_EQ(reference_answers(workload_, 60 * 4 + 59).poses, 4);
  EXPECT_EQ(reference_answers(workload_, 1'000'000).poses,
            static_cast<int>(workload_.poses.size()));
}

}  // namespace
}  // namespace bqsa::harness
