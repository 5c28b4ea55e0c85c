// Chains read from URDF, against Orocos KDL's reading of the same text.
#include "harness/scenario/urdf_chain.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>
#include <kdl/tree.hpp>
#include <kdl_parser/kdl_parser.hpp>
#include <numbers>
#include <random>
#include <string>

#include "bqsa/tip_task.hpp"
#include "harness/judge/judge_kinematics.hpp"
#include "harness/scenario/scenario_files.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;

std::string joint_text(const std::string& name, const std::string& type, const std::string& parent,
                       const std::string& child, const std::string& inside) {
  return fmt::format("<joint name='{}' type='{}'><parent link='{}'/><child link='{}'/>{}</joint>",
                     name, type, parent, child, inside);
}

std::string robot_text(const std::string& links_and_joints) {
  return "<robot name='r'>" + links_and_joints + "</robot>";
}

/// Draws robots: a chain of joints that turn about any axis or slide along it, fixed joints among
/// them, and branches.
class RandomRobot {
 public:
  /// @param sliding  in how many of three places of four joints a prismatic joint may stand
  explicit RandomRobot(unsigned seed, unsigned sliding = 0) : random_(seed), sliding_(sliding) {}

  std::string text(int joints) {
    std::string text = "<link name='link0'/>";
    for (int j = 0; j < joints; ++j) {
      const std::string parent = fmt::format("link{}", j), child = fmt::format("link{}", j + 1);
      const std::string branch = fmt::format("branch{}", j);
      text += fmt::format("<link name='{}'/><link name='{}'/>", child, branch);
      text += joint_text(fmt::format("joint{}", j + 1), type(j), parent, child, inside());
      text += joint_text(fmt::format("aside{}", j), "prismatic", parent, branch, inside());
    }
    return robot_text(text);
  }

  double angle() { return 3 * uniform_(random_); }

 private:
  std::string type(int j) const {
    return j % 4 == 1 ? "fixed" : j % 4 == 2 ? "continuous" : slides_(j) ? "prismatic" : "revolute";
  }

  std::string inside() {
    std::string axis =
        fmt::format("{} {} {}", uniform_(random_), uniform_(random_), uniform_(random_));
    const double pick = uniform_(random_);
    if (pick < -0.5) axis = "0 0 1";
    if (pick > 0.8) axis = "0 0 -1";
    // As files have it: half a turn that is none, to six digits.
    const std::string roll = pick > 0.3 ? "3.14159" : fmt::format("{}", angle());
    return fmt::format(
        "<origin xyz='{} {} {}' rpy='{} {} {}'/><axis xyz='{}'/>"
        "<limit lower='-3' upper='3' effort='1' velocity='2'/>",
        uniform_(random_), uniform_(random_), uniform_(random_), roll, angle(), angle(), axis);
  }

  bool slides_(int j) const { return (static_cast<unsigned>(j) * 7 + sliding_) % 3 < sliding_; }

  std::mt19937 random_;
  unsigned sliding_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

TEST(UrdfChain, HasTheKinematicsThatKdlReadsFromTheSameText) {
  int robots = 0, sliding = 0;
  for (unsigned seed = 1; seed <= 50; ++seed, ++robots) {
    RandomRobot random(seed, seed % 4);
    const std::string text = random.text(9);
    const std::string tip = fmt::format("link{}", 5 + seed % 5);
    KDL::Tree tree;
    ASSERT_TRUE(kdl_parser::treeFromString(text, tree));
    KDL::Chain kdl;
    ASSERT_TRUE(tree.getChain("link1", tip, kdl));

    const UrdfChain read = read_urdf_chain(text, "link1", tip);
    const SerialChain chain(read.chain);
    const JudgeKinematics judge(read.chain);
    sliding += chain.has_prismatic_joints() ? 1 : 0;
    ASSERT_EQ(chain.joints(), static_cast<int>(kdl.getNrOfJoints()));
    KDL::ChainFkSolverPos_recursive forward(kdl);
    KDL::ChainJntToJacSolver jacobian(kdl);
    for (int k = 0; k < 20; ++k) {
      JointVector q(chain.joints());
      KDL::JntArray q_kdl(kdl.getNrOfJoints());
      for (int j = 0; j < chain.joints(); ++j)
        q(j) = q_kdl(static_cast<unsigned>(j)) = random.angle();
      ChainPose pose;
      chain.forward(q, pose);
      KDL::Frame frame;
      ASSERT_GE(forward.JntToCart(q_kdl, frame), 0);
      const Vector3d expected(frame.p.x(), frame.p.y(), frame.p.z());
      EXPECT_LT((pose.tip() - expected).norm(), 1e-12) << "robot " << seed;
      PointPositions positions;
      judge.place(q, positions);
      EXPECT_LT((positions.tip() - expected).norm(), 1e-12) << "robot " << seed;
      const Eigen::Matrix3d R_kdl =
          Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(frame.M.data);
      EXPECT_LT((chain.tip_rotation(pose) - R_kdl).norm(), 1e-12) << "robot " << seed;
      EXPECT_LT((judge.tip_rotation(q) - R_kdl).norm(), 1e-12) << "robot " << seed;

      // Every joint's origin once it has moved, at which the links end.
      unsigned segment = 0;
      for (int j = 0; j < chain.joints(); ++j) {
        while (kdl.getSegment(segment).getJoint().getType() == KDL::Joint::None) ++segment;
        KDL::Frame before, after;
        ASSERT_GE(forward.JntToCart(q_kdl, before, static_cast<int>(segment)), 0);
        ASSERT_GE(forward.JntToCart(q_kdl, after, static_cast<int>(segment) + 1), 0);
        const KDL::Vector origin = chain.is_prismatic(j)
                                       ? after.p
                                       : before * kdl.getSegment(segment).getJoint().JointOrigin();
        EXPECT_LT((pose.p_WO.col(j + 1) - Vector3d(origin.x(), origin.y(), origin.z())).norm(),
                  1e-12)
            << "robot " << seed << " joint " << j;
        EXPECT_LT((positions.points[static_cast<std::size_t>(j) + 1] - pose.p_WO.col(j + 1)).norm(),
                  1e-12);
        ++segment;
      }

      KDL::Jacobian J_kdl(kdl.getNrOfJoints());
      ASSERT_GE(jacobian.JntToJac(q_kdl, J_kdl), 0);
      TaskJacobian J;
      chain.jacobian(pose, chain.points() - 1, J);
      EXPECT_LT((J - J_kdl.data.topRows(3)).cwiseAbs().maxCoeff(), 1e-10) << "robot " << seed;
      J_kdl.data.bottomRows(3) *= kOrientationLength;
      TipTask(chain, TaskKind::kPose).jacobian(pose, J);
      EXPECT_LT((J - J_kdl.data).cwiseAbs().maxCoeff(), 1e-10) << "robot " << seed;
      TipTask(chain, TaskKind::kAxis).jacobian(pose, J);
      const Eigen::MatrixXd angular_T = R_kdl.transpose() * J_kdl.data.bottomRows(3);
      EXPECT_LT((J.bottomRows(2) - angular_T.topRows(2)).cwiseAbs().maxCoeff(), 1e-10)
          << "robot " << seed;
    }
  }
  EXPECT_EQ(robots, 50);
  EXPECT_GT(sliding, 25);
}

/// Bounds of how far points are from axes, on which certificates of motions rest.
TEST(UrdfChain, ReachIsABoundAndNotFarFromTheLargestDistance) {
  RandomRobot random(77);
  const SerialChain chain(read_urdf_chain(random.text(9), "link0", "link9").chain);
  const JudgeKinematics judge(chain.description());
  Eigen::MatrixXd largest = Eigen::MatrixXd::Zero(chain.joints(), chain.points());
  for (int k = 0; k < 2000; ++k) {
    JointVector q(chain.joints());
    for (int j = 0; j < chain.joints(); ++j) q(j) = random.angle() * std::numbers::pi / 3;
    ChainPose pose;
    chain.forward(q, pose);
    for (int j = 0; j < chain.joints(); ++j) {
      for (int p = j + 1; p < chain.points(); ++p) {
        const Vector3d arm = pose.p_WO.col(p) - pose.pivot_W.col(j);
        const Vector3d axis = pose.axis_W.col(j);
        const double distance = arm.cross(axis).norm();
        if (j < chain.moving_joints(p)) largest(j, p) = std::max(largest(j, p), distance);
        if (j >= chain.moving_joints(p)) {
          EXPECT_LT(distance, 1e-12) << j << ' ' << p;
        }
        EXPECT_LE(distance, judge.reach(j, p) + 1e-12) << j << ' ' << p;
      }
    }
  }
  double seen = 0, bound = 0;
  for (int j = 0; j < chain.joints(); ++j) {
    for (int p = j + 1; p < chain.points(); ++p) {
      EXPECT_LE(largest(j, p), chain.reach(j, p) + 1e-12);
      seen += largest(j, p);
      bound += chain.reach(j, p);
    }
  }
  EXPECT_GT(seen, 0.5 * bound);
}

/// What certificates and the judge rest on: speeds of points by finite differences, joint by joint.
TEST(UrdfChain, SpeedBoundsHoldAndAreNotFarFromTheLargestSpeed) {
  constexpr double kTravel = 0.8, kStep = 1e-6;
  RandomRobot random(78, 2);
  const SerialChain chain(read_urdf_chain(random.text(9), "link0", "link9").chain);
  const JudgeKinematics judge(chain.description());
  const int n = chain.joints();
  const JointVector travel = JointVector::Constant(n, kTravel);
  Eigen::MatrixXd largest = Eigen::MatrixXd::Zero(n, chain.points());
  for (int k = 0; k < 3000; ++k) {
    JointVector q(n);
    for (int j = 0; j < n; ++j) {
      q(j) = chain.is_prismatic(j) ? kTravel / 3 * random.angle() : random.angle();
    }
    for (int j = 0; j < n; ++j) {
      ChainPose before, after;
      chain.forward(q - kStep * JointVector::Unit(n, j), before);
      chain.forward(q + kStep * JointVector::Unit(n, j), after);
      const Eigen::RowVectorXd speed = (after.p_WO - before.p_WO).colwise().norm() / (2 * kStep);
      largest.row(j) = largest.row(j).cwiseMax(speed);
    }
  }
  double seen = 0, bound = 0;
  for (int j = 0; j < n; ++j) {
    for (int p = 0; p < chain.points(); ++p) {
      EXPECT_LE(largest(j, p), chain.speed_bound(j, p, travel) + 1e-8) << j << ' ' << p;
      EXPECT_LE(largest(j, p), judge.speed_bound(j, p, travel) + 1e-8) << j << ' ' << p;
      seen += largest(j, p);
      bound += chain.speed_bound(j, p, travel);
    }
  }
  EXPECT_GT(seen, 0.5 * bound);
}

constexpr const char* kTwoLinks =
    "<link name='a'/><link name='b'/><link name='c'/><link name='side'/>";

std::string two_joints(const std::string& first, const std::string& second,
                       const std::string& type = "revolute") {
  return robot_text(std::string(kTwoLinks) + joint_text("one", "revolute", "a", "b", first) +
                    joint_text("two", type, "b", "c", second) +
                    joint_text("three", "fixed", "a", "side", ""));
}

constexpr const char* kGood =
    "<origin xyz='1 0 0'/><axis xyz='0 0 1'/><limit lower='-1' upper='2' effort='0' velocity='3'/>";

TEST(UrdfChain, HasTheLimitsOfItsJoints) {
  const UrdfChain read = read_urdf_chain(
      two_joints(kGood, "<axis xyz='0 1 0'/><limit effort='0' velocity='4'/>", "continuous"), "a",
      "c");
  EXPECT_EQ(read.joints, (std::vector<std::string>{"one", "two"}));
  EXPECT_EQ(read.limits.lower(0), -1);
  EXPECT_EQ(read.limits.upper(0), 2);
  EXPECT_EQ(read.limits.lower(1), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(read.limits.upper(1), std::numeric_limits<double>::infinity());
  EXPECT_EQ(read.limits.max_velocity, (JointVector(2) << 3, 4).finished());
}

std::string refusal(const std::string& urdf, const std::string& base = "a",
                    const std::string& tip = "c") {
  try {
    read_urdf_chain(urdf, base, tip);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(UrdfChain, AJointThatSlidesHasLimitsInMetres) {
  const UrdfChain read = read_urdf_chain(two_joints(kGood, kGood, "prismatic"), "a", "c");
  ASSERT_EQ(read.chain.placements.size(), 2u);
  EXPECT_EQ(read.chain.placements[0].type, JointType::kRevolute);
  EXPECT_EQ(read.chain.placements[1].type, JointType::kPrismatic);
  EXPECT_EQ(read.limits.lower, (JointVector(2) << -1, -1).finished());
  EXPECT_EQ(read.limits.upper, (JointVector(2) << 2, 2).finished());
  EXPECT_EQ(read.limits.max_velocity, (JointVector(2) << 3, 3).finished());
  EXPECT_EQ(refusal(two_joints(kGood, "<axis xyz='0 1 0'/>", "prismatic")),
            "expected a robot in URDF, got one of which the parser says: Joint [two] is of type "
            "PRISMATIC without limits");
}

/// A rail whose carriage starts in the base's origin: the link has no length there, and is one.
TEST(UrdfChain, ALinkThatEndsAtAPrismaticJointIsOneOfAnyLength) {
  const std::string text = two_joints(
      "<origin xyz='0 0 1'/><axis xyz='0 1 0'/><limit lower='-1' upper='2' effort='0' "
      "velocity='3'/>",
      "<axis xyz='1 0 0'/><limit lower='-1' upper='2' effort='0' velocity='3'/>", "prismatic");
  const SerialChain chain(read_urdf_chain(text, "a", "c").chain);
  ASSERT_EQ(chain.links().size(), 2u);
  EXPECT_EQ(chain.links()[1].number, 2);
  EXPECT_EQ(chain.moving_joints(2), 2);
  ChainPose pose;
  for (const double slide : {0.0, 0.5, -0.25}) {
    chain.forward((JointVector(2) << 0.3, slide).finished(), pose);
    EXPECT_NEAR((pose.p_WO.col(2) - pose.p_WO.col(1)).norm(), std::abs(slide), 1e-15);
  }
}

TEST(UrdfChain, RefusesWhatItCannotUseAndSaysWhy) {
  EXPECT_EQ(refusal(two_joints(kGood, kGood)), "no error");
  EXPECT_EQ(refusal(two_joints(kGood, kGood), "a", "gripper"),
            "expected one of the robot's links, got 'gripper'; there are 'a', 'b', 'c', 'side'");
  EXPECT_EQ(refusal("<robot name='r'><link/></robot>"),
            "expected one of the robot's links, got 'a'; there are ''");
  EXPECT_EQ(refusal(two_joints(kGood, kGood), "world", "c"),
            "expected one of the robot's links, got 'world'; there are 'a', 'b', 'c', 'side'");
  EXPECT_EQ(refusal(two_joints(kGood, kGood), "side", "c"),
            "expected a tip link that hangs from 'side', got 'c', which hangs from 'b', 'a'");
  EXPECT_EQ(refusal(two_joints(kGood, kGood), "c", "a"),
            "expected a tip link that hangs from 'c', got 'a', which hangs from nothing");
  EXPECT_EQ(refusal(two_joints(kGood, kGood), "a", "a"),
            "expected 1 to 16 joints that move between 'a' and 'a', got 0");
  EXPECT_EQ(refusal(two_joints(kGood, kGood, "prismatic")), "no error");
  EXPECT_EQ(refusal(two_joints(kGood, "", "floating")),
            "joint 'two': expected a revolute, continuous, prismatic or fixed joint, got floating");
  EXPECT_EQ(refusal(two_joints(kGood, std::string(kGood) + "<mimic joint='one'/>")),
            "joint 'two': expected a joint of its own, got one that mimics 'one'");
  EXPECT_EQ(refusal(two_joints(
                kGood, "<axis xyz='0 0 0'/><limit lower='-1' upper='2' effort='0' velocity='3'/>")),
            "joint 'two': expected an axis of some length, got (0, 0, 0)");
  EXPECT_EQ(refusal(two_joints(kGood, "<limit lower='1' upper='-2' effort='0' velocity='3'/>")),
            "joint 'two': expected a lower limit not above the upper one, got 1 and -2");
  EXPECT_EQ(refusal(two_joints(kGood, "<limit lower='1' upper='2' effort='0' velocity='0'/>")),
            "joint 'two': expected a positive velocity limit, as other joints have one, got 0");
}

TEST(UrdfChain, RefusesWhatIsNoTree) {
  const auto fixed = [](const std::string& name, const std::string& parent,
                        const std::string& child) {
    return joint_text(name, "fixed", parent, child, "");
  };
  EXPECT_EQ(refusal(robot_text(std::string(kTwoLinks) + fixed("one", "a", "b") +
                               fixed("two", "b", "a") + fixed("three", "c", "side")),
                    "c", "a"),
            "expected a tree of links, got a circle through 'a'");
  EXPECT_EQ(
      refusal(robot_text(std::string(kTwoLinks) + fixed("one", "a", "c") + fixed("two", "b", "c") +
                         fixed("three", "a", "b") + fixed("four", "a", "side"))),
      "link 'c': expected one joint that it hangs from, got 'one' and 'two'");
}

TEST(UrdfChain, RefusesTextThatTheParserWouldNotSurvive) {
  std::string nested;
  for (int i = 0; i < 100'000; ++i) nested += "<a>";
  EXPECT_EQ(refusal(nested), "expected a robot of at most 10000 elements of XML, got 100000");
}

TEST(UrdfChain, RefusesAnAxisBeyondRange) {
  EXPECT_EQ(
      refusal(two_joints(
          kGood, "<axis xyz='1e200 0 0'/><limit lower='-1' upper='2' effort='0' velocity='3'/>")),
      "joint 'two': expected an axis of some length, got (1e+200, 0, 0)");
}

std::string turning_at(const std::string& xyz) {
  return "<origin xyz='" + xyz +
         "'/><axis xyz='0 0 1'/><limit lower='-1' upper='2' effort='0' velocity='3'/>";
}

TEST(UrdfChain, RefusesLengthsBeyondRange) {
  EXPECT_EQ(refusal(two_joints(turning_at("6e5 0 0"), turning_at("0 0 -9e5"))), "no error");
  EXPECT_EQ(
      refusal(two_joints(kGood, turning_at("0 1e308 0"))),
      "joint 'two': expected an origin within 1000000 m of the joint before it, got one beyond");
  EXPECT_EQ(refusal(two_joints(kGood, "<limit lower='-1' upper='2e6' effort='0' velocity='3'/>",
                               "prismatic")),
            "joint 'two': expected limits within 1000000 m, got -1 and 2000000");
}

/// What programs write for nothing is no link, so that those beside it follow each other.
TEST(UrdfChain, RoundingLeavesNoLinks) {
  const auto links = [](const std::string& xyz) {
    const std::string urdf = two_joints(turning_at("0 0 0.3"), turning_at(xyz));
    return SerialChain(read_urdf_chain(urdf, "a", "c").chain).links().size();
  };
  EXPECT_EQ(links("0 0 -1.1102e-16"), links("0 0 0"));
  EXPECT_EQ(links("0 0 1e-9"), links("0 0 0") + 1);
}

TEST(UrdfChain, SaysWhatTheParserSaysOfTextThatIsNoUrdf) {
  for (const std::string text : {"", "<robot", "<robot name='r'/>", "<sdf/>", "plain",
                                 "<robot name='r'><link name='a'/><link name='a'/></robot>"}) {
    const std::string message = refusal(text);
    EXPECT_TRUE(message.starts_with("expected a robot in URDF, got one of which the parser says: "))
        << text << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
    EXPECT_GT(message.size(), 65u) << message;
  }
}

}  // namespace
}  // namespace bqsa::harness
