#include "bqsa/bqsa_settings.hpp"

namespace bqsa {

std::vector<ParameterDeclaration> bqsa_parameters(const BqsaSettings& d) {
  return {
      {"increment", "rad", d.increment, 1e-6, 0.1, "clamping increment dTheta"},
      {"search_range", "rad", d.search_range, 1e-4, 3.15,
       "largest way one link is clamped in one tick, d_max"},
      integer_parameter("settling", "-", d.settling, 0, 40,
                        "halvings of the last increment, between colliding and free"),
      {"safety_offset", "m", d.safety_offset, 1e-9, 0.1,
       "distance kept from obstacles beyond link radius and margin"},
      {"clamped_weight", "-", d.clamped_weight, 1, 1e12,
       "weight of the joints that must not move (paper variant)"},
      {"s0", "m", d.ik.singular_threshold, 0, 10,
       "smallest singular value below which the inverse kinematics is damped"},
      {"lambda_max", "m", d.ik.lambda_max, 0, 10, "largest damping factor"},
      {"residual_bound", "m/s", d.ik.residual_bound, 1e-12, 10,
       "largest task-velocity residual that damping may cause (Lemma 2's epsilon)"},
      {"tip_tolerance", "m", d.tip_tolerance, 1e-12, 1e-2,
       "tip error at which a correction has converged (spatial variant)"},
      integer_parameter("corrections", "-", d.corrections, 1, 100,
                        "Newton corrections of the tip, at most (spatial variant)"),
      integer_parameter("retries", "-", d.retries, 0, 30,
                        "doublings of safety_offset when a motion cannot be certified"),
  };
}

BqsaSettings bqsa_settings(const ParameterValues& values) {
  BqsaSettings settings;
  settings.increment = values.number("increment");
  settings.search_range = values.number("search_range");
  settings.settling = values.integer("settling");
  settings.safety_offset = values.number("safety_offset");
  settings.clamped_weight = values.number("clamped_weight");
  settings.ik.singular_threshold = values.number("s0");
  settings.ik.lambda_max = values.number("lambda_max");
  settings.ik.residual_bound = values.number("residual_bound");
  settings.tip_tolerance = values.number("tip_tolerance");
  settings.corrections = values.integer("corrections");
  settings.retries = values.integer("retries");
  return settings;
}

}  // namespace bqsa
