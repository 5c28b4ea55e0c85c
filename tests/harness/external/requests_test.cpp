#include "harness/external/requests.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>
#include <random>

#include "harness/scenario/scenario.hpp"
#include "support/prismatic_arms.hpp"

namespace bqsa::harness {
namespace {

using Json = nlohmann::json;

Json prepared(const Problem& problem) {
  return Json::parse(prepare_request(problem, {}, ParameterValues({})));
}

Problem problem_of(const char* scenario) {
  return load_scenario(std::string(BQSA_SOURCE_DIR "/scenarios/") + scenario + ".yaml").problem;
}

Eigen::Vector3d vector_of(const Json& list) {
  return {list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>()};
}

Eigen::Matrix3d matrix_of(const Json& rows) {
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 3; ++i) matrix.row(i) = vector_of(rows.at(static_cast<std::size_t>(i)));
  return matrix;
}

TEST(Requests, DoublesSurvive) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-300, 300);
  for (int i = 0; i < 1000; ++i) {
    StepInput input;
    input.q = Eigen::Vector2d(std::ldexp(mantissa(random), exponent(random)), 0.1);
    input.p_WT_desired.x() = mantissa(random);
    input.t = 1.0 / 3;
    const Json request = Json::parse(step_request(input));
    ASSERT_EQ(request["q"].at(0).get<double>(), input.q(0)) << i;
    ASSERT_EQ(vector_of(request["p_WT_desired"]), input.p_WT_desired) << i;
    ASSERT_EQ(request["t"].get<double>(), input.t);
  }
}

/// The arm as a reader of the documentation builds it from `at_zero`: product of exponentials.
Eigen::Vector3d by_exponentials(const Json& robot, std::size_t point, const JointVector& q) {
  const Json& zero = robot["at_zero"];
  Eigen::Vector3d p = vector_of(zero["points"][point]);
  for (int j = zero["moving_joints"][point].get<int>() - 1; j >= 0; --j) {
    const auto joint = static_cast<std::size_t>(j);
    const Eigen::Vector3d pivot = vector_of(zero["pivots"][joint]);
    const Eigen::Vector3d axis = vector_of(zero["axes"][joint]);
    if (robot["joint_types"][joint] == "prismatic") {
      p += q(j) * axis;
    } else {
      p = pivot + Eigen::AngleAxisd(q(j), axis) * (p - pivot);
    }
  }
  return p;
}

/// The tip's frame likewise.
Eigen::Matrix3d rotation_by_exponentials(const Json& robot, const JointVector& q) {
  Eigen::Matrix3d R = matrix_of(robot["at_zero"]["tip_rotation"]);
  for (auto j = static_cast<std::size_t>(q.size()); j-- > 0;) {
    if (robot["joint_types"][j] == "prismatic") continue;
    R = Eigen::AngleAxisd(q(static_cast<Eigen::Index>(j)), vector_of(robot["at_zero"]["axes"][j])) *
        R;
  }
  return R;
}

/// The tip and its frame as a reader builds them from the Denavit-Hartenberg rows.
Eigen::Isometry3d by_rows(const Json& dh, const JointVector& q) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = matrix_of(dh["R_WB"]);
  X.translation() = vector_of(dh["p_WB"]);
  for (int j = 0; j < q.size(); ++j) {
    const Json& row = dh["rows"][static_cast<std::size_t>(j)];
    const double angle = q(j) + row["offset"].get<double>();
    const Eigen::AngleAxisd z(angle, Eigen::Vector3d::UnitZ());
    const Eigen::AngleAxisd x(row["alpha"].get<double>(), Eigen::Vector3d::UnitX());
    const Eigen::Translation3d along_x(row["a"].get<double>(), 0, 0);
    const Eigen::Translation3d along_z(0, 0, row["d"].get<double>());
    X = dh["convention"] == "standard" ? X * z * along_z * along_x * x
                                       : X * x * along_x * z * along_z;
  }
  X.translate(vector_of(dh["p_LT"]));
  X.rotate(matrix_of(dh["R_LT"]));
  return X;
}

TEST(Requests, BothFormsOfTheRobotAreTheRobot) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> angle(-3, 3);
  test_support::Generator generator(3);
  for (const char* name : {"planar_7r", "puma560_ellipsoid", "sliding"}) {
    Problem problem = problem_of(name == std::string("sliding") ? "puma560_wall" : name);
    if (name == std::string("sliding")) {
      problem.chain = SerialChain(test_support::random_prismatic_arm(generator, 6));
    }
    ChainDescription turned = problem.chain.description();
    turned.R_LT = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    problem.chain = SerialChain(turned);
    const Json robot = prepared(problem)["problem"]["robot"];
    ASSERT_EQ(robot["joints"], problem.chain.joints());
    ASSERT_EQ(robot["dimension"], problem.dimension());
    ASSERT_EQ(robot["links"].size(), problem.chain.links().size());
    for (int i = 0; i < 20; ++i) {
      JointVector q(problem.chain.joints());
      for (double& value : q) value = angle(random);
      ChainPose pose;
      problem.chain.forward(q, pose);
      for (int k = 0; k < problem.chain.points(); ++k) {
        EXPECT_NEAR(
            (by_exponentials(robot, static_cast<std::size_t>(k), q) - pose.p_WO.col(k)).norm(), 0,
            1e-12)
            << name << ", point " << k;
      }
      const Eigen::Matrix3d R = problem.chain.tip_rotation(pose);
      EXPECT_NEAR((rotation_by_exponentials(robot, q) - R).norm(), 0, 1e-12) << name;
      if (robot["denavit_hartenberg"].is_null()) continue;
      const Eigen::Isometry3d tip = by_rows(robot["denavit_hartenberg"], q);
      EXPECT_NEAR((tip.translation() - pose.tip()).norm(), 0, 1e-12) << name;
      EXPECT_NEAR((tip.linear() - R).norm(), 0, 1e-12) << name;
    }
    for (std::size_t i = 0; i < problem.chain.links().size(); ++i) {
      EXPECT_EQ(robot["links"][i]["number"], problem.chain.links()[i].number);
      EXPECT_EQ(robot["links"][i]["start"], problem.chain.links()[i].start);
      EXPECT_EQ(robot["links"][i]["end"], problem.chain.links()[i].end);
    }
  }
}

TEST(Requests, TheProblemIsWhole) {
  Problem problem = problem_of("puma560_wall");
  problem.link_radius = 0.01;
  problem.link_radii.assign(problem.chain.links().size(), 0.01);
  problem.link_radii[1] = 0.004;
  problem.margin = 0.002;
  const Json told = prepared(problem)["problem"];
  EXPECT_EQ(told["name"], "puma560_wall");
  EXPECT_EQ(told["ticks"], problem.ticks);
  EXPECT_EQ(told["dt"].get<double>(), problem.dt);
  EXPECT_EQ(told["link_radius"].get<double>(), 0.01);
  EXPECT_EQ(told["link_radii"].get<std::vector<double>>(), problem.link_radii);
  EXPECT_EQ(told["margin"].get<double>(), 0.002);
  EXPECT_EQ(told["tolerance"].get<double>(), problem.tolerance);
  ASSERT_EQ(told["path"].size(), static_cast<std::size_t>(problem.ticks) + 1);
  for (int tick = 0; tick <= problem.ticks; ++tick) {
    EXPECT_EQ(vector_of(told["path"][static_cast<std::size_t>(tick)]),
              problem.desired_tip(problem.time(tick)));
  }
  ASSERT_EQ(told["start"].size(), 6u);
  ASSERT_EQ(told["max_step"].size(), 6u);
  for (int j = 0; j < 6; ++j) {
    EXPECT_EQ(told["start"][static_cast<std::size_t>(j)].get<double>(), problem.start(j));
    EXPECT_EQ(told["max_step"][static_cast<std::size_t>(j)].get<double>(), problem.max_step(j));
  }
  ASSERT_EQ(told["obstacles"].size(), 1u);
  const Json& obstacle = told["obstacles"][0];
  const Ellipsoid& shape = problem.obstacles[0].shape;
  EXPECT_EQ(obstacle["name"], "wall");
  EXPECT_EQ(vector_of(obstacle["center"]), shape.center());
  EXPECT_EQ(vector_of(obstacle["semi_axes"]), shape.semi_axes());
  EXPECT_EQ(matrix_of(obstacle["rotation"]), shape.rotation());
  EXPECT_TRUE(obstacle["motion"].empty());
}

TEST(Requests, TheOrientationIsToldWhereTheTaskHasOne) {
  Problem problem = problem_of("puma560_wall");
  Json told = prepared(problem)["problem"];
  EXPECT_EQ(told["task"], "position");
  EXPECT_TRUE(told["rotations"].is_null());
  problem.desired_rotation = [](double t) {
    return Eigen::AngleAxisd(t, Eigen::Vector3d(0.6, 0, 0.8)).toRotationMatrix();
  };
  problem.task_kind = TaskKind::kAxis;
  problem.orientation_tolerance = 0.03;
  told = prepared(problem)["problem"];
  EXPECT_EQ(told["task"], "axis");
  EXPECT_EQ(told["orientation_tolerance"].get<double>(), 0.03);
  ASSERT_EQ(told["rotations"].size(), static_cast<std::size_t>(problem.ticks) + 1);
  for (int tick = 0; tick <= problem.ticks; ++tick) {
    EXPECT_EQ(matrix_of(told["rotations"][static_cast<std::size_t>(tick)]),
              problem.desired_rotation(problem.time(tick)));
  }
  problem.task_kind = TaskKind::kPose;
  EXPECT_EQ(prepared(problem)["problem"]["task"], "pose");

  const StepInput input{
      .tick = 3, .R_WT_desired = problem.desired_rotation(0.3), .q = problem.start};
  EXPECT_EQ(matrix_of(Json::parse(step_request(input, true))["R_WT_desired"]), input.R_WT_desired);
  EXPECT_FALSE(Json::parse(step_request(input)).contains("R_WT_desired"));
}

TEST(Requests, LimitsAndMotionsAreToldWhereThereAreAny) {
  Problem problem = problem_of("planar_7r");
  EXPECT_TRUE(prepared(problem)["problem"]["limits"]["lower"].is_null());
  problem.limits.lower = JointVector::Constant(7, -1);
  problem.limits.lower(2) = -std::numeric_limits<double>::infinity();
  problem.limits.max_velocity = JointVector::Constant(7, 2);
  Obstacle& obstacle = problem.obstacles[1];
  for (int tick = 0; tick <= problem.ticks; ++tick) {
    const Eigen::Matrix3d R =
        Eigen::AngleAxisd(1e-3 * tick, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    obstacle.motion.emplace_back(obstacle.shape.center() + 1e-4 * tick * Eigen::Vector3d::UnitX(),
                                 obstacle.shape.semi_axes(), R);
  }
  const Json told = prepared(problem)["problem"];
  EXPECT_EQ(told["limits"]["lower"][1], -1);
  EXPECT_TRUE(told["limits"]["lower"][2].is_null()) << "this joint has none";
  EXPECT_TRUE(told["limits"]["upper"].is_null());
  EXPECT_EQ(told["max_step"][0].get<double>(), 2 * problem.dt);
  const Json& motion = told["obstacles"][1]["motion"];
  ASSERT_EQ(motion.size(), obstacle.motion.size());
  EXPECT_EQ(vector_of(motion[7]["center"]), obstacle.at(7).center());
  EXPECT_EQ(matrix_of(motion[7]["rotation"]), obstacle.at(7).rotation());
}

TEST(Requests, ParametersHaveTheirTypes) {
  const std::vector<ParameterDeclaration> declared = {
      {"gain", "1/s", 0.5, 0, 10, ""},
      integer_parameter("points", "-", 5, 1, 10, ""),
      choice_parameter("law", {"first", "second"}, "")};
  ParameterValues values(declared);
  values.set("gain", "0.1");
  values.set("law", "second");
  const Json told =
      Json::parse(prepare_request(problem_of("planar_7r"), declared, values))["parameters"];
  EXPECT_EQ(told.dump(), R"({"gain":0.1,"law":"second","points":5})");
  EXPECT_EQ(Json::parse(plan_request(2.5, ~std::uint64_t{0})).dump(),
            R"({"budget_s":2.5,"request":"plan","seed":18446744073709551615})");
}

TEST(Requests, EachIsOneLine) {
  Problem problem = problem_of("planar_7r");
  problem.obstacles[0].name = "a\nb\xff";
  for (const std::string& line :
       {describe_request(), quit_request(), prepare_request(problem, {}, ParameterValues({}))}) {
    EXPECT_EQ(line.find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace bqsa::harness
