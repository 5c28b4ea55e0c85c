/// @file
/// FCL behind a plain interface: two links as capsules. Of its calls those are used that were
/// measured to be right, in millimetres; everything here takes and returns metres.
#pragma once

#include <Eigen/Core>

namespace bqsa::harness {

/// A link as a solid.
struct LinkCapsule {
  Eigen::Vector3d start;
  Eigen::Vector3d end;
  double radius;  ///< [m], positive
};

/// Whether two links meet: the boolean of libccd. Against the exact distance it was right in all of
/// 200,000 cases (any directions, parallel, nearly parallel, equal radii, in a plane; clearances from
/// 1e-9 to 0.3 m on either side), where FCL's own solver misses contacts up to 0.4 mm deep.
bool fcl_links_collide(const LinkCapsule& a, const LinkCapsule& b);

/// Distance of links that do not collide [m]; meaningless for those that do. FCL's closed form, within
/// 1e-8 m of the exact one in those cases (nearly parallel links; else 1e-15 m).
double fcl_links_distance(const LinkCapsule& a, const LinkCapsule& b);

/// Asks the installed FCL questions with known answers: hits and misses of links that cross, that are
/// parallel, and that lie one inside the other.
/// @throws std::runtime_error naming the question that it failed
void fcl_links_self_test();

}  // namespace bqsa::harness
