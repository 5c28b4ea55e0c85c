#include "bqsa/bqsa_settings.hpp"

namespace bqsa {

std::vector<ParameterDeclaration> bqsa_parameters(const BqsaSettings& defaults) {
  const BqsaSettings& d = defaults;
  return {
      {"increment", "rad", d.increment, 1e-5, 0.1,
       "clamping increment dTheta; where the exit is computed, only the unit of how closely"},
      {"search_range", "rad", d.search_range, 1e-4, 3.15,
       "largest way one link is clamped in one tick, d_max"},
      integer_parameter("max_increments", "-", d.max_increments, 1, 1000000,
                        "clamping increments, and turns to a computed exit, of one tick, at most"),
      integer_parameter(
          "settling", "-", d.settling, 0, 40,
          "halvings of an increment, to which a link is settled between colliding and free"),
      {"safety_offset", "m", d.safety_offset, 1e-7, 0.1,
       "distance aimed at beyond link radius and margin, at ticks"},
      integer_parameter("retries", "-", d.retries, 0, 30,
                        "doublings of safety_offset when a motion cannot be certified"),
      {"s0", "m", d.ik.singular_threshold, 0, 10,
       "smallest singular value below which the inverse kinematics is damped"},
      {"lambda_max", "m", d.ik.lambda_max, 0, 10, "largest damping factor"},
      {"residual_bound", "m/s", d.ik.residual_bound, 1e-12, 10,
       "largest task-velocity residual that damping may cause (Lemma 2's epsilon)"},
      {"rank_threshold", "-", d.ik.rank_threshold, 0, 1e-3,
       "singular values below this part of the largest count as zero"},
      {"limit_band", "-", d.joint_limits.band, 0, 0.5,
       "part of a joint's range at either end from which it is sent back; 0: joint limits are not "
       "avoided"},
      {"limit_gain", "1/s", d.joint_limits.gain, 0, 1000,
       "speed at which it is sent back, for each radian or metre into that part"},
  };
}

void read_bqsa_parameters(const ParameterValues& values, BqsaSettings& settings) {
  settings.increment = values.number("increment");
  settings.search_range = values.number("search_range");
  settings.max_increments = values.integer("max_increments");
  settings.settling = values.integer("settling");
  settings.safety_offset = values.number("safety_offset");
  settings.retries = values.integer("retries");
  settings.ik.singular_threshold = values.number("s0");
  settings.ik.lambda_max = values.number("lambda_max");
  settings.ik.residual_bound = values.number("residual_bound");
  settings.ik.rank_threshold = values.number("rank_threshold");
  settings.joint_limits.band = values.number("limit_band");
  settings.joint_limits.gain = values.number("limit_gain");
}

}  // namespace bqsa
