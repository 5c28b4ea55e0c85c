/// @file
/// The part of a scenario file that says whether self-collision is judged.
#pragma once

#include <optional>

#include "bqsa/problem.hpp"
#include "harness/judge/self_collision.hpp"
#include "harness/scenario/units.hpp"
#include "harness/scenario/yaml_value.hpp"

namespace bqsa::harness {

/// `true`, `false`, or a mapping with the pairs of links to skip; nothing for `false`. Refuses links
/// without radius, pairs that are never judged, and a start at which a pair collides, unless by 1e-6 m
/// at most, which the judge calls touching, and free.
std::optional<SelfCollision> read_self_collision(const YamlValue& value, const Problem& problem,
                                                 const Units& units);

}  // namespace bqsa::harness
