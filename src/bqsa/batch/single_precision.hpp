/// @file
/// How much larger an obstacle has to be for the segment test in float never to miss a hit.
///
/// Let the obstacle have the unit map T and centre c, and let a be its shortest semi-axis. Stored is the
/// obstacle scaled by 1 + rho about its centre, T' = T / (1 + rho). All roundings are relative errors
/// of at most eps = 2^-24; products and sums may be fused or not; results are normal numbers.
///
/// *Points.* A point p, all coordinates within R, comes rounded, after an error of at most eta. The
/// computed u = T' p + k, k = -T' c, then differs from the exact T'(p - c) by no more than
///
///     e = 6 eps (R sum_j |T_j| + |T c|) + eta / a      (T, p: 1 eps each; k: 1; products and sums: 4),
///
/// T_j the columns of T. A true hit has a point of the link with |T(p - c)| <= 1, so that the computed
/// u1, u2 are the ends of a segment that comes as close to 0 as
///
///     1 / (1 + rho) + e  =:  1 - tau.
///
/// *Polar form.* Let the segment's line pass 0 at the distance h; g = 1 - h². Let s1, s2 be the
/// distances of its ends from the foot, L = s1 + s2 its length. If the deepest point is an end, its
/// level 1 - |u|² >= 2 tau - tau² is found not negative if 2 tau - tau² >= 8 eps. Else the foot lies
/// between the ends, g >= 2 tau - tau², and
///
///     S11 = g - s1²,   S22 = g - s2²,   S12 = g + s1 s2,   D = S12² - S11 S22 = g L².
///
/// (Signs as in the batched test: positive inside.) Suppose both ends are found to be outside; else it
/// is a hit. The computed S_ij errs by d_ij <= 4 eps (1 + |ui| |uj|), where |ui|² <= 1 + si² and
/// |u1| |u2| <= 1 + s1 s2 + L. With g >= 28 eps, si² >= g - d_ii >= 0.71 g, so that
/// g <= 1.41 s1 s2, S12 <= 0.6025 L² and |S_ii| <= si². Then S12 exceeds its error, and the computed D
/// errs by no more than
///
///     2 S12 d12                <= eps L² (9.64 + 4.82 L + 1.21 L²)
///     |S11| d22 + |S22| d11    <= eps L² (8 + L²/2)
///     eps (S12² + |S11 S22|)   <= eps L² 0.43 L²                    (two products)
///     d12² + d11 d22           <= eps L² 1.6 + higher orders,
///
/// together less than eps (28 + 3 L²) L². So D is found not negative, and the hit is found, if
///
///     2 tau - tau² >= G = eps (28 + 3 L²),   that is   tau = 1 - sqrt(1 - G),   rho = sigma / (1 - sigma),
///     sigma = tau + e,
///
/// with L the longest link in unit coordinates, l / a + 2 e. Nothing of this costs time when testing.
///
/// *Thin obstacles.* rho scales all axes, and grows with 1/a². So axes shorter than
///
///     max(cbrt(3 eps l² A), sqrt((12 eps R + eta) A)),   A the longest semi-axis,
///
/// are first lengthened to that: the sum of what the shortest and the longest axis grow by is then about
/// least. None is left shorter than sqrt(8 eps) l, 200 eps R and 5 eta, which keeps sigma below 3/4.
///
/// *Figures*, for links of 0.4 m in a workspace of 2 m, the centre 1 m away: balls of 10 cm and of 1 cm grow
/// by 3 and 4 µm. Thin obstacles grow much more: a needle of 1 mm x 1 mm x 30 cm by 1.1 mm, 1.1 mm and
/// 1.3 mm, a sheet of 0.1 mm x 0.1 m x 10 m by 6.5 mm, 0.05 mm and 5 mm (semi-axes).
#pragma once

#include <optional>

#include "bqsa/batch/obstacle_batch.hpp"

namespace bqsa {

/// What a float batch takes for the obstacle: an ellipsoid around it, same centre and directions.
/// None if there is none that float can handle: the obstacle is then one that everything hits.
template <int Dim>
std::optional<EllipsoidN<Dim>> grown_for_float(const EllipsoidN<Dim>& shape,
                                               const Workspace& workspace);

}  // namespace bqsa
