/// @file
/// How much thinner each link is than the thickest one.
#pragma once

#include <array>

#include "bqsa/problem.hpp"

namespace bqsa {

/// By the index of a link's end in ChainPose::p_WO: the largest radius less the link's own [m], 0 where
/// all links have one radius. What keeps the distance of the thickest link for all keeps this too much
/// of another.
using Slimness = std::array<double, kMaxPoints>;

inline Slimness slimness_of(const Problem& problem) {
  Slimness slimness{};
  const std::span<const Link> links = problem.chain.links();
  for (std::size_t i = 0; i < links.size(); ++i) {
    slimness[static_cast<std::size_t>(links[i].end)] = problem.link_radius - problem.radius_of(i);
  }
  return slimness;
}

}  // namespace bqsa
