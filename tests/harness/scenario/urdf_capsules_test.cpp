// Radii of links by collision geometry: containment by sampling where KDL has the links, and least
// radii worked out by hand.
#include "harness/scenario/urdf_capsules.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <kdl/tree.hpp>
#include <kdl/treefksolverpos_recursive.hpp>
#include <kdl_parser/kdl_parser.hpp>
#include <numbers>
#include <string>

#include "support/sampling.hpp"

namespace bqsa::harness {
namespace {

using Eigen::Vector3d;
using test_support::Generator;
using test_support::uniform;

/// Corners of a tetrahedron, whatever the mesh is called.
std::vector<Vector3d> tetrahedron(const std::string&) {
  return {{0.1, 0, 0}, {-0.05, 0.08, 0}, {0, -0.06, 0.02}, {0, 0, 0.12}};
}

/// A piece of collision geometry that the test has made: its URDF, and how to sample its surface.
struct Piece {
  std::string link;
  std::string text;
  std::function<Vector3d(Generator&)> surface;  ///< in the link's frame
};

Piece random_piece(Generator& generator, const std::string& link) {
  const Vector3d p = test_support::random_vector<3>(generator, 0.1);
  const Vector3d rpy = test_support::random_vector<3>(generator, 1.4);
  const Eigen::Matrix3d R = (Eigen::AngleAxisd(rpy.z(), Vector3d::UnitZ()) *
                             Eigen::AngleAxisd(rpy.y(), Vector3d::UnitY()) *
                             Eigen::AngleAxisd(rpy.x(), Vector3d::UnitX()))
                                .toRotationMatrix();
  const double a = uniform(generator, 0.02, 0.2), b = uniform(generator, 0.02, 0.2),
               c = uniform(generator, 0.02, 0.2);
  std::string geometry;
  std::function<Vector3d(Generator&)> local;
  switch (generator() % 4) {
    case 0:
      geometry = fmt::format("<sphere radius='{}'/>", a);
      local = [a](Generator& g) -> Vector3d { return a * test_support::random_direction<3>(g); };
      break;
    case 1:
      geometry = fmt::format("<box size='{} {} {}'/>", a, b, c);
      local = [a, b, c](Generator& g) -> Vector3d {
        Vector3d x = test_support::random_vector<3>(g, 1);
        x /= x.cwiseAbs().maxCoeff();
        if (g() % 4 == 0) x = x.cwiseSign();  // a corner
        return x.cwiseProduct(Vector3d(a, b, c)) / 2;
      };
      break;
    case 2:
      geometry = fmt::format("<cylinder radius='{}' length='{}'/>", a, b);
      local = [a, b](Generator& g) -> Vector3d {
        const double angle = uniform(g, -std::numbers::pi, std::numbers::pi);
        const double z = g() % 2 == 0 ? b / 2 : uniform(g, -b / 2, b / 2);
        return {a * std::cos(angle), a * std::sin(angle), z};
      };
      break;
    default:
      geometry = fmt::format("<mesh filename='package://some/part.stl' scale='{} {} {}'/>", a * 5,
                             b * 5, -c * 5);
      local = [a, b, c](Generator& g) -> Vector3d {
        const std::vector<Vector3d> corners = tetrahedron("");
        Vector3d weights(-std::log(uniform(g, 1e-9, 1)), -std::log(uniform(g, 1e-9, 1)),
                         -std::log(uniform(g, 1e-9, 1)));
        weights /= weights.sum();
        const std::size_t without = g() % 4;
        Vector3d x = Vector3d::Zero();
        for (std::size_t k = 0, w = 0; k < 4; ++k) {
          if (k != without) x += weights(static_cast<Eigen::Index>(w++)) * corners[k];
        }
        return 5 * x.cwiseProduct(Vector3d(a, b, -c));
      };
  }
  return {link,
          fmt::format("<collision><origin xyz='{} {} {}' rpy='{} {} {}'/><geometry>{}</geometry>"
                      "</collision>",
                      p.x(), p.y(), p.z(), rpy.x(), rpy.y(), rpy.z(), geometry),
          [R, p, local](Generator& g) -> Vector3d { return p + R * local(g); }};
}

struct RandomRobot {
  std::string text;
  std::vector<Piece> pieces;  ///< of the links that have to be contained
  int joints = 0;             ///< of the chain from link0 to the tip
  std::string tip;
};

/// A chain of any joints, some with the origin of the one before, with fixed links aside, and aside of
/// these links that move, which need not be contained.
RandomRobot random_robot(Generator& generator) {
  RandomRobot robot;
  std::string joints_text;
  const auto add_link = [&](const std::string& name, bool contained) {
    robot.text += fmt::format("<link name='{}'>", name);
    for (std::uint64_t k = generator() % 3; k > 0; --k) {
      const Piece piece = random_piece(generator, name);
      robot.text += piece.text;
      if (contained) robot.pieces.push_back(piece);
    }
    robot.text += "</link>";
  };
  const auto add_joint = [&](const std::string& name, const std::string& type,
                             const std::string& parent, const std::string& child) {
    const Vector3d p = generator() % 3 == 0
                           ? Vector3d::Zero()
                           : Vector3d(test_support::random_vector<3>(generator, 0.4));
    const Vector3d rpy = test_support::random_vector<3>(generator, 1.4);
    const Vector3d axis = test_support::random_direction<3>(generator);
    joints_text += fmt::format(
        "<joint name='{}' type='{}'><parent link='{}'/><child link='{}'/><origin xyz='{} {} {}' "
        "rpy='{} {} {}'/><axis xyz='{} {} {}'/><limit lower='-0.3' upper='0.5' effort='1' "
        "velocity='1'/></joint>",
        name, type, parent, child, p.x(), p.y(), p.z(), rpy.x(), rpy.y(), rpy.z(), axis.x(),
        axis.y(), axis.z());
  };
  add_link("link0", true);
  const int count = 3 + static_cast<int>(generator() % 5);
  for (int j = 0; j < count; ++j) {
    const std::string parent = fmt::format("link{}", j), child = fmt::format("link{}", j + 1);
    const std::string type = generator() % 4 == 0   ? "fixed"
                             : generator() % 3 == 0 ? "prismatic"
                                                    : "revolute";
    if (type != "fixed") ++robot.joints;
    add_link(child, true);
    add_joint(fmt::format("joint{}", j), type, parent, child);
    const std::string aside = fmt::format("aside{}", j), finger = fmt::format("finger{}", j);
    add_link(aside, true);
    add_joint(fmt::format("fix{}", j), "fixed", child, aside);
    add_link(finger, false);
    add_joint(fmt::format("grip{}", j), "revolute", aside, finger);
  }
  robot.tip = fmt::format("link{}", count);
  robot.text = "<robot name='r'>" + robot.text + joints_text + "</robot>";
  return robot;
}

double distance(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const double squared = (b - a).squaredNorm();
  const double s = squared > 0 ? std::clamp((p - a).dot(b - a) / squared, 0.0, 1.0) : 0;
  return (p - a - s * (b - a)).norm();
}

TEST(UrdfCapsules, ContainAllCollisionGeometryWhereverTheJointsAre) {
  Generator generator(1);
  int points = 0, robots = 0, tight = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const RandomRobot robot = random_robot(generator);
    if (robot.joints == 0 || robot.pieces.empty()) continue;
    const UrdfChain read = read_urdf_chain(robot.text, "link0", robot.tip);
    const SerialChain chain(read.chain);
    if (chain.links().empty()) continue;
    const std::vector<double> radii =
        least_link_radii(robot.text, "link0", robot.tip, read.chain, read.limits, tetrahedron);
    ASSERT_EQ(radii.size(), chain.links().size());
    KDL::Tree tree;
    ASSERT_TRUE(kdl_parser::treeFromString(robot.text, tree));
    KDL::TreeFkSolverPos_recursive forward(tree);
    ++robots;
    std::vector<double> closest(radii.size(), 1);  // of a sampled point to the capsule's surface
    for (int k = 0; k < 20; ++k) {
      KDL::JntArray all(tree.getNrOfJoints());
      JointVector q(chain.joints());
      for (int j = 0; j < chain.joints(); ++j) {
        const double at_an_end = generator() % 2 == 0 ? -0.3 : 0.5;
        q(j) = generator() % 3 == 0 ? at_an_end : uniform(generator, -0.3, 0.5);
        const auto segment = std::ranges::find_if(tree.getSegments(), [&](const auto& entry) {
          return entry.second.segment.getJoint().getName() ==
                 read.joints[static_cast<std::size_t>(j)];
        });
        all(segment->second.q_nr) = q(j);
      }
      ChainPose pose;
      chain.forward(q, pose);
      for (const Piece& piece : robot.pieces) {
        KDL::Frame X;
        ASSERT_GE(forward.JntToCart(all, X, piece.link), 0);
        for (int sample = 0; sample < 10; ++sample, ++points) {
          const Vector3d local = piece.surface(generator);
          const KDL::Vector at = X * KDL::Vector(local.x(), local.y(), local.z());
          double outside = 1;
          for (std::size_t i = 0; i < radii.size(); ++i) {
            const Link& link = chain.links()[i];
            const double beyond = distance({at.x(), at.y(), at.z()}, pose.p_WO.col(link.start),
                                           pose.p_WO.col(link.end)) -
                                  radii[i];
            outside = std::min(outside, beyond);
            closest[i] = std::min(closest[i], std::abs(beyond));
          }
          ASSERT_LE(outside, 1e-9) << "robot " << trial << ", link " << piece.link;
        }
      }
    }
    for (std::size_t i = 0; i < radii.size(); ++i) tight += radii[i] > 0 && closest[i] < 1e-3;
  }
  EXPECT_GT(robots, 80);
  EXPECT_GT(points, 100'000);
  EXPECT_GT(tight, 100);
}

/// Three joints about z, with 0.5 m along x between the first two and none to the third, then a tool:
/// links 1 (base, 0.2 m along z), 2, and 4.
std::vector<double> radii_of(const std::string& base, const std::string& upper,
                             const std::string& elbow, const std::string& hand,
                             const std::string& second_type = "revolute") {
  const auto link = [](const std::string& name, const std::string& geometry) {
    return fmt::format("<link name='{}'>{}</link>", name, geometry);
  };
  const auto joint = [](const std::string& name, const std::string& type, const std::string& parent,
                        const std::string& child, const std::string& xyz, const std::string& axis) {
    return fmt::format(
        "<joint name='{}' type='{}'><parent link='{}'/><child link='{}'/><origin xyz='{}'/>"
        "<axis xyz='{}'/><limit lower='-0.1' upper='0.3' effort='1' velocity='1'/></joint>",
        name, type, parent, child, xyz, axis);
  };
  const std::string text = "<robot name='r'>" + link("base", base) + link("upper", upper) +
                           link("elbow", elbow) + link("hand", hand) + link("tool", "") +
                           joint("one", "revolute", "base", "upper", "0 0 0.2", "0 0 1") +
                           joint("two", second_type, "upper", "elbow", "0.5 0 0",
                                 second_type == "prismatic" ? "1 0 0" : "0 0 1") +
                           joint("three", "revolute", "elbow", "hand", "0 0 0", "0 1 0") +
                           joint("four", "fixed", "hand", "tool", "0.1 0 0", "0 0 1") + "</robot>";
  const UrdfChain read = read_urdf_chain(text, "base", "tool");
  return least_link_radii(text, "base", "tool", read.chain, read.limits, tetrahedron);
}

std::string at(const std::string& xyz, const std::string& geometry) {
  return fmt::format("<collision><origin xyz='{}'/><geometry>{}</geometry></collision>", xyz,
                     geometry);
}

TEST(UrdfCapsules, AreAsThinAsTheirGeometryAllows) {
  // A box beside the middle of link 2, and one beyond its end.
  EXPECT_DOUBLE_EQ(radii_of("", at("0.2 0.1 0", "<box size='0.2 0.04 0.06'/>"), "", "")[1],
                   std::hypot(0.12, 0.03));
  EXPECT_DOUBLE_EQ(radii_of("", at("0.5 0 0", "<box size='0.2 0.04 0.06'/>"), "", "")[1],
                   std::hypot(std::hypot(0.1, 0.02), 0.03));
  // A ball off the line of link 1, and one before its start.
  EXPECT_DOUBLE_EQ(radii_of(at("0.3 0 0.1", "<sphere radius='0.05'/>"), "", "", "")[0], 0.35);
  EXPECT_DOUBLE_EQ(radii_of(at("0 0 -0.1", "<sphere radius='0.05'/>"), "", "", "")[0], 0.15);
  // A cylinder along link 1 that reaches 30 mm beyond its end: its rim, to the prism around it.
  const double rim =
      radii_of(at("0 0 0.13", "<cylinder radius='0.04' length='0.2'/>"), "", "", "")[0];
  EXPECT_GE(rim, std::hypot(0.04, 0.03));
  EXPECT_LE(rim, std::hypot(0.04 * (1 + 1e-5), 0.03));
  // The tetrahedron, on the tool: twice as long along z.
  EXPECT_DOUBLE_EQ(radii_of("", "", "", at("0 0 0", "<mesh filename='t.stl' scale='1 1 2'/>"))[2],
                   0.24);
  EXPECT_EQ(radii_of("", "", "", at("0 0 0", "<sphere radius='0.02'/>")),
            (std::vector<double>{0, 0, 0.02}));
}

TEST(UrdfCapsules, ALinkWithoutLengthIsHeldByTheNeighbourThatGrowsLess) {
  const std::string ball = at("0.03 0 0", "<sphere radius='0.05'/>");
  EXPECT_EQ(radii_of("", at("0 0 0", "<sphere radius='0.06'/>"), ball, ""),
            (std::vector<double>{0, 0.08, 0}));
  EXPECT_EQ(radii_of("", "", ball, at("0 0 0", "<sphere radius='0.06'/>")),
            (std::vector<double>{0, 0, 0.08}));
  EXPECT_EQ(radii_of("", "", ball, at("0 0 0", "<sphere radius='0.09'/>")),
            (std::vector<double>{0, 0, 0.09}));
}

/// A column, a shoulder without length that turns on it, and an arm 0.4 m out along x.
std::vector<double> radii_with_shoulder(const std::string& shoulder, const std::string& turning,
                                        const std::string& lifting) {
  const std::string text = fmt::format(
      "<robot name='r'><link name='base'/><link name='shoulder'>{}</link><link name='arm'/>"
      "<link name='tip'/>"
      "<joint name='a' type='continuous'><parent link='base'/><child link='shoulder'/>"
      "<origin xyz='0 0 0.3'/><axis xyz='{}'/></joint>"
      "<joint name='b' type='continuous'><parent link='shoulder'/><child link='arm'/>"
      "<axis xyz='{}'/></joint>"
      "<joint name='c' type='fixed'><parent link='arm'/><child link='tip'/>"
      "<origin xyz='0.4 0 0'/></joint></robot>",
      shoulder, turning, lifting);
  const UrdfChain read = read_urdf_chain(text, "base", "tip");
  return least_link_radii(text, "base", "tip", read.chain, read.limits, tetrahedron);
}

TEST(UrdfCapsules, ALinkThatTurnsAboutItsNeighbourIsHeldByAllOfThat) {
  // Down along the column, whichever way the axis points; not if the axis leans.
  const std::string down = at("0 0 -0.15", "<box size='0.08 0.06 0.3'/>");
  for (const char* axis : {"0 0 1", "0 0 -1"}) {
    const std::vector<double> radii = radii_with_shoulder(down, axis, "0 1 0");
    EXPECT_NEAR(radii[0], 0.05, 1e-12) << axis;
    EXPECT_EQ(radii[1], 0) << axis;
  }
  EXPECT_NEAR(radii_with_shoulder(down, "0 0.01 1", "0 1 0")[0], std::hypot(0.3, 0.05), 1e-9);
  // Out along the arm, which turns about itself.
  const std::string out = at("0.2 0 0", "<box size='0.4 0.06 0.08'/>");
  for (const char* axis : {"1 0 0", "-1 0 0"}) {
    const std::vector<double> radii = radii_with_shoulder(out, "0 0 1", axis);
    EXPECT_EQ(radii[0], 0) << axis;
    EXPECT_NEAR(radii[1], 0.05, 1e-12) << axis;
  }
}

/// Link 2 ends 0.4 to 0.8 m out; a ball at 0.7 m is beyond its end where that is nearest.
TEST(UrdfCapsules, ALinkThatChangesItsLengthIsThickEnoughAtBothEnds) {
  const auto thick = [](const std::string& place) {
    return radii_of("", at(place, "<sphere radius='0.05'/>"), "", "", "prismatic")[1];
  };
  EXPECT_DOUBLE_EQ(thick("0.7 0 0"), 0.35);
  EXPECT_DOUBLE_EQ(thick("0.3 0.1 0"), 0.15);
}

std::string refusal(const std::string& geometry) {
  try {
    radii_of(geometry, "", "", "");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(UrdfCapsules, RefuseWhatHasNoSize) {
  EXPECT_EQ(refusal(""),
            "expected collision geometry of the links from 'base' to 'tool', got none");
  EXPECT_EQ(refusal(at("0 0 0", "<sphere radius='-0.1'/>")),
            "link 'base': expected collision geometry of positive size, got a length of -0.1");
  EXPECT_EQ(refusal(at("0 0 0", "<box size='0.1 0 0.1'/>")),
            "link 'base': expected collision geometry of positive size, got a length of 0");
  EXPECT_EQ(refusal(at("0 0 0", "<sphere radius='0.1'/>")), "no error");
}

TEST(UrdfCapsules, RefuseWhatIsBeyondRange) {
  const std::string beyond =
      "link 'base': expected collision geometry within 1000000 m of the joint before it, got some "
      "beyond";
  EXPECT_EQ(refusal(at("0 0 0", "<mesh filename='m.stl' scale='1e308 1e308 1e308'/>") +
                    at("0 0 0", "<sphere radius='0.1'/>")),
            beyond);
  EXPECT_EQ(refusal(at("2e6 0 0", "<sphere radius='0.1'/>")), beyond);
  EXPECT_EQ(refusal(at("0 0 0", "<sphere radius='2e6'/>")), beyond);
  EXPECT_EQ(refusal(at("9e5 0 0", "<sphere radius='0.1'/>")), "no error");
}

}  // namespace
}  // namespace bqsa::harness
