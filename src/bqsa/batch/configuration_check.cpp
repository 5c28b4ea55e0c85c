#include "bqsa/batch/configuration_check.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>

#include "bqsa/batch/ellipsoid_around.hpp"

namespace bqsa {
namespace {

constexpr double kEps = 0x1p-24;
constexpr double kLargestSum = 38'000;  // of an angle and an offset [rad]

static_assert(batch::Arm::kMaxJoints == kMaxJoints);

double largest_offset(const SerialChain& chain) {
  double largest = 0;
  for (const DhRow& row : chain.description().rows) {
    largest = std::max(largest, std::abs(row.offset));
  }
  return largest;
}

batch::Arm arm_of(const SerialChain& chain, double largest_angle) {
  const ChainDescription& description = chain.description();
  batch::Arm arm{};
  arm.joints = chain.joints();
  arm.modified = description.convention == DhConvention::kModified;
  arm.has_tool = chain.points() > chain.joints() + 1;
  arm.largest_angle = static_cast<float>(largest_angle);
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 0; k < 3; ++k) arm.base[axis][k] = static_cast<float>(description.R_WB(k, axis));
    arm.tool[axis] = static_cast<float>(description.p_LT(axis));
  }
  for (std::size_t j = 0; j < description.rows.size(); ++j) {
    const DhRow& row = description.rows[j];
    arm.rows[j] = {.a = static_cast<float>(row.a),
                   .d = static_cast<float>(row.d),
                   .cos_alpha = static_cast<float>(std::cos(row.alpha)),
                   .sin_alpha = static_cast<float>(std::sin(row.alpha)),
                   .offset = static_cast<float>(row.offset),
                   .ends_link = std::hypot(row.a, row.d) > 0};
  }
  return arm;
}

/// What the end-points of the chain are within; the error by the class comment.
Workspace workspace_of(const SerialChain& chain, double largest_angle) {
  const ChainDescription& description = chain.description();
  Workspace space{.reach = description.p_LT.norm(), .link_length = description.p_LT.norm()};
  for (const DhRow& row : description.rows) {
    space.reach += std::abs(row.a) + std::abs(row.d);
    space.link_length = std::max(space.link_length, std::hypot(row.a, row.d));
  }
  const double largest_sum = largest_angle + largest_offset(chain);
  double frame = 2 * kEps;
  for (const DhRow& row : description.rows) {
    frame += (20 + 2 * largest_sum) * kEps;
    space.point_error +=
        (std::abs(row.a) + std::abs(row.d)) * (frame + 4 * kEps) + 2 * kEps * space.reach;
  }
  space.point_error += description.p_LT.norm() * (frame + 5 * kEps) + 3 * kEps * space.reach;
  // A chain without any length is a point, which no workspace is.
  space.link_length = std::max(space.link_length, kEps);
  space.reach = std::max(space.reach, kEps) + space.point_error;
  return space;
}

void validate(double clearance, double largest_angle) {
  if (!(clearance >= 0) || !std::isfinite(clearance)) {
    throw std::invalid_argument("configuration check: the clearance must not be negative");
  }
  if (!(largest_angle >= 0) || !std::isfinite(largest_angle)) {
    throw std::invalid_argument("configuration check: the largest angle must not be negative");
  }
}

}  // namespace

ConfigurationArray::ConfigurationArray(int joints, int count)
    : joints_(joints),
      count_(count),
      angles_(blocks() * kBlock * static_cast<std::size_t>(joints)) {}

void ConfigurationArray::set(int index, const JointVector& q) {
  assert(0 <= index && index < count_ && q.size() == joints_);
  float* angle = angles_.data() + static_cast<std::ptrdiff_t>(index / kBlock) * joints_ * kBlock +
                 index % kBlock;
  for (std::ptrdiff_t j = 0; j < joints_; ++j) angle[j * kBlock] = static_cast<float>(q(j));
}

ConfigurationCheck::ConfigurationCheck(const SerialChain& chain, std::span<const Ellipsoid> shapes,
                                       double clearance, double largest_angle)
    : origin_(chain.description().p_WB),
      clearance_(clearance),
      has_rows_(!chain.description().is_placed()),
      obstacles_(ObstacleBatch<2, float>(0, {})) {
  validate(clearance, largest_angle);
  largest_angle = std::min(largest_angle, kLargestSum - largest_offset(chain));
  arm_ = arm_of(chain, largest_angle);
  const Workspace workspace = workspace_of(chain, largest_angle);
  point_error_ = workspace.point_error;
  const int count = static_cast<int>(shapes.size());
  if (chain.dimension() == 3) {
    obstacles_.emplace<ObstacleBatch<3, float>>(count, workspace);
  } else {
    obstacles_.emplace<ObstacleBatch<2, float>>(count, workspace);
  }
  for (int j = 0; j < count; ++j) set(j, shapes[static_cast<std::size_t>(j)]);
}

void ConfigurationCheck::set(int obstacle, const Ellipsoid& shape) {
  const Ellipsoid from_base(shape.center() - origin_, shape.semi_axes(), shape.rotation());
  if (auto* in_space = std::get_if<ObstacleBatch<3, float>>(&obstacles_)) {
    in_space->set(obstacle, ellipsoid_around(from_base, clearance_));
  } else {
    std::get<ObstacleBatch<2, float>>(obstacles_)
        .set(obstacle, ellipsoid_around(planar_section(from_base), clearance_));
  }
}

void ConfigurationCheck::certainly_free(const ConfigurationArray& configurations,
                                        std::span<std::uint16_t> free) const {
  assert(configurations.joints() == arm_.joints && free.size() == configurations.blocks());
  if (!has_rows_) {
    std::ranges::fill(free, std::uint16_t{0});
    return;
  }
  batch::ArmPass pass{.arm = &arm_,
                      .angles = configurations.data(),
                      .blocks = static_cast<int>(configurations.blocks()),
                      .coefficients = nullptr,
                      .obstacles = 0};
  if (const auto* in_space = std::get_if<ObstacleBatch<3, float>>(&obstacles_)) {
    pass.coefficients = in_space->coefficients();
    pass.obstacles = in_space->size();
    batch::free_masks_space(pass, free.data());
  } else {
    const auto& in_plane = std::get<ObstacleBatch<2, float>>(obstacles_);
    pass.coefficients = in_plane.coefficients();
    pass.obstacles = in_plane.size();
    batch::free_masks_plane(pass, free.data());
  }
  const int last = configurations.count() % ConfigurationArray::kBlock;
  if (last != 0) free.back() = static_cast<std::uint16_t>(free.back() & ((1U << last) - 1));
}

}  // namespace bqsa
