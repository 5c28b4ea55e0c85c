#include "harness/fingerprint.hpp"

#include <cstddef>
#include <string_view>

namespace bqsa::harness {
namespace {

class Hash {
 public:
  Hash& bytes(const void* data, std::size_t size) {
    constexpr std::uint64_t kPrime = 0x100000001b3;
    const auto* byte = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ byte[i]) * kPrime;
    return *this;
  }
  Hash& add(double number) { return bytes(&number, sizeof number); }
  Hash& add(int number) { return bytes(&number, sizeof number); }
  Hash& add(std::size_t number) { return bytes(&number, sizeof number); }
  Hash& add(std::string_view text) { return add(text.size()).bytes(text.data(), text.size()); }

  template <typename Derived>
  Hash& add(const Eigen::PlainObjectBase<Derived>& matrix) {
    const auto size = static_cast<std::size_t>(matrix.size());
    return add(size).bytes(matrix.data(), size * sizeof(double));
  }

  Hash& add(const Ellipsoid& shape) {
    return add(shape.center()).add(shape.semi_axes()).add(shape.rotation()).add(shape.unit_map());
  }

  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325;
};

void add_chain(const SerialChain& chain, Hash& hash) {
  const ChainDescription& description = chain.description();
  hash.add(description.dimension).add(static_cast<int>(description.convention));
  hash.add(description.rows.size());
  for (const DhRow& row : description.rows) {
    hash.add(row.a).add(row.alpha).add(row.d).add(row.offset);
  }
  for (const JointPlacement& placement : description.placements) {
    hash.add(placement.R_PJ).add(placement.p_PJ).add(static_cast<int>(placement.type));
  }
  hash.add(description.R_WB).add(description.p_WB).add(description.p_LT).add(description.R_LT);
  hash.add(chain.joints()).add(chain.points());
  for (const Link& link : chain.links()) hash.add(link.number).add(link.start).add(link.end);
  for (int j = 0; j < chain.joints(); ++j) {
    for (int k = 0; k < chain.points(); ++k) hash.add(chain.reach(j, k));
  }
}

}  // namespace

std::uint64_t fingerprint(const Problem& problem) {
  Hash hash;
  hash.add(problem.name);
  add_chain(problem.chain, hash);
  hash.add(problem.obstacles.size());
  for (const Obstacle& obstacle : problem.obstacles) {
    hash.add(obstacle.name).add(obstacle.shape).add(obstacle.motion.size());
    for (const Ellipsoid& state : obstacle.motion) hash.add(state);
  }
  hash.add(problem.ticks).add(problem.dt);
  for (int tick = 0; tick <= problem.ticks; ++tick) {
    hash.add(problem.desired_tip(problem.time(tick)));
  }
  hash.add(static_cast<int>(problem.task_kind)).add(problem.orientation_tolerance);
  for (int tick = 0; problem.has_orientation() && tick <= problem.ticks; ++tick) {
    hash.add(problem.rotation_at(problem.time(tick)));
  }
  hash.add(problem.start);
  hash.add(problem.limits.lower).add(problem.limits.upper).add(problem.limits.max_velocity);
  hash.add(problem.link_radius).add(problem.margin).add(problem.tolerance);
  hash.add(problem.link_radii.size());
  for (const double radius : problem.link_radii) hash.add(radius);
  return hash.value();
}

}  // namespace bqsa::harness
