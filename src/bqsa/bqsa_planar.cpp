#include "bqsa/bqsa_planar.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace bqsa {
namespace {

/// Turns tried before the exit is searched for in increments.
constexpr int kMaxTurns = 12;

/// Furthest that a turn may go beyond one that hits [increments].
constexpr double kLargestTurn = 8;

}  // namespace

BqsaSettings default_settings(PlanarVariant variant) {
  BqsaSettings settings;
  if (variant == PlanarVariant::kPaper) {
    settings.release = Release::kNever;
    settings.corrections = 0;
    settings.settling = 0;
  }
  return settings;
}

void BqsaPlanar::prepare(const Problem& problem) {
  if (problem.dimension() != 2 || problem.chain.points() != problem.chain.joints() + 1 ||
      !problem.chain.in_plane()) {
    throw std::invalid_argument("planar BQSA needs a planar arm in standard form without a tool");
  }
  BackwardSearch::prepare(problem);
  obstacles_.assign(problem, counters_, neighbours());
  release_.assign(problem, task_, obstacles_, settings_, counters_);
  self_motion_.assign(problem.chain, counters_);
}

/// From the tip to the base: frees every link of q_ that is in category 3, 4 or 5 with any obstacle.
/// After link i, the links i .. n are free; so one sweep suffices.
Infeasible BqsaPlanar::free_links(const StepInput& input, StepOutput& output) {
  const std::span<const Link> links = problem_->chain.links();
  for (std::size_t k = links.size(); k-- > 0;) {
    const Link& link = links[k];
    const int first = obstacles_.first_hit(pose_, link);
    if (first < 0) continue;
    const int first_clamp = output.clamp_count;
    for (int j = first; j >= 0; j = obstacles_.first_hit(pose_, link, j + 1)) {
      record_clamp({.link = link.number, .obstacle = j}, output);
    }
    Clamp clamp;
    if (!free_link(link.number, input.q, clamp)) {
      output.link = link.number;
      output.obstacle = first;
      return Infeasible::kNoFreeConfiguration;
    }
    for (int c = first_clamp; c < output.clamp_count; ++c) {
      Clamp& recorded = output.clamps[static_cast<std::size_t>(c)];
      recorded.anchor = clamp.anchor;
      recorded.offset = clamp.offset;
      recorded.increments = c == first_clamp ? clamp.increments : 0;
    }
    forward();
  }
  return Infeasible::kNot;
}

/// Joints clamping (paper, section 3.3): turns link i until it and the links up to the anchor are free:
/// to the exit if `find_exit` finds it, otherwise in steps of dTheta to both sides, the side it came from
/// first. The first anchor is the link's own outer end, as in the paper; where that fails, O_{a+1}
/// further out.
bool BqsaPlanar::free_link(int link, const JointVector& q_last, Clamp& clamp) {
  const double came_from = q_last.head(link).sum() - q_.head(link).sum();
  const double first = came_from < 0 ? -1 : 1;
  for (int anchor = std::max(link, 3); anchor <= problem_->chain.joints(); ++anchor) {
    // Links inside of link i are freed later in the sweep. For i <= 3 that would move link i again, as a
    // self-motion takes three links: there all of them must be free at once.
    const int lowest = link <= 3 ? 1 : link;
    if (variant_ == PlanarVariant::kExact &&
        find_exit(link, anchor, lowest, first, q_last, clamp)) {
      return true;
    }
    std::array<Side, 2> sides{Side{first, 0, q_, pose_}, Side{-first, 0, q_, pose_}};
    while (sides[0].open || sides[1].open) {
      for (Side& side : sides) {
        if (!side.open) continue;
        if (!take_increment()) return false;
        ++clamp.increments;
        if (!advance(side, link, anchor, lowest, q_last)) continue;
        settle(side, link, anchor, lowest, q_last);
        q_ = side.q;
        clamp.anchor = anchor;
        clamp.offset = side.direction * side.offset;
        return true;
      }
    }
  }
  return false;
}

/// Turns the link out by the secant method on the gap between what hits and its obstacle, until the links
/// lowest .. anchor are free, and no further beyond the exit than halvings would leave them. The first
/// turn goes to `side` and as far as depth and lever ask for; if it only leads deeper, the way out is
/// on the other side. False if that leads to no exit.
bool BqsaPlanar::find_exit(int link, int anchor, int lowest, double side, const JointVector& q_last,
                           Clamp& clamp) {
  const double resolution = std::ldexp(settings_.increment, -settings_.settling);
  const double furthest = kLargestTurn * settings_.increment;
  const Link& turned = problem_->chain.links()[static_cast<std::size_t>(link - 1)];
  const double lever = (pose_.p_WO.col(turned.end) - pose_.p_WO.col(turned.start)).norm();
  Contact contact{&turned, obstacles_.first_hit(pose_, turned)};
  hit_ = {0, q_, pose_};
  double offset = side * std::min(furthest, -gap(pose_, contact) / lever + 0.5 * resolution);
  double free = side * std::numeric_limits<double>::infinity();  // the nearest offset found free
  for (int k = 0; k < kMaxTurns && std::abs(offset) <= settings_.search_range; ++k) {
    if (!take_increment()) return false;
    ++clamp.increments;
    trial_ = hit_;
    trial_.offset = offset;
    const double turn = offset - hit_.offset;
    if (!self_motion_.turn_link(link, anchor, turn, trial_.q, trial_.pose)) return false;
    // Within an increment of the limits the increments decide: another anchor may have a better exit.
    const double whole = settings_.increment * std::ceil(std::abs(offset) / settings_.increment);
    const JointVector q_whole = q_ + whole / std::abs(offset) * (trial_.q - q_);
    if (forbidden_step(*problem_, q_last, trial_.q) != Infeasible::kNot ||
        forbidden_step(*problem_, q_last, q_whole) != Infeasible::kNot) {
      return false;
    }
    const bool hits = find_contact(trial_.pose, lowest, anchor, contact);
    const double gap_hit = gap(hit_.pose, contact);
    const double gap_trial = gap(trial_.pose, contact);
    const double slope = (gap_trial - gap_hit) / turn;
    if (!hits) {
      if (std::min(gap_trial, gap_trial - gap_hit) <= std::abs(slope) * resolution) {
        q_ = trial_.q;
        clamp.anchor = anchor;
        clamp.offset = offset;
        return true;
      }
      free = offset;
    } else if (gap_trial > gap_hit) {
      hit_ = trial_;
    } else if (k == 0) {
      side = -side;
      free = -free;
    } else {
      return false;
    }
    const double exit = offset - gap_trial / slope + 0.5 * side * resolution;
    const double way = side * (exit - hit_.offset);  // from the last that hits
    const double most = side * (free - hit_.offset);
    if (way > 0 && way < most) {
      offset = hit_.offset + side * std::min(way, furthest);
    } else if (std::isfinite(most)) {
      offset = hit_.offset + 0.5 * side * most;
    } else {
      return false;
    }
  }
  return false;
}

/// Whether any of the links lowest .. highest hits; if so, puts the pair in `contact`, whose link
/// is asked first.
bool BqsaPlanar::find_contact(const ChainPose& pose, int lowest, int highest,
                              Contact& contact) const {
  const auto hits = [&](const Link& link) {
    const int obstacle = obstacles_.first_hit(pose, link);
    if (obstacle >= 0) contact = {&link, obstacle};
    return obstacle >= 0;
  };
  const Link& first = *contact.link;
  if (hits(first)) return true;
  for (const Link& link : problem_->chain.links()) {
    if (link.number < lowest || link.number > highest || &link == &first) continue;
    if (hits(link)) return true;
  }
  return false;
}

/// What a pair keeps beyond the distance to keep [m].
double BqsaPlanar::gap(const ChainPose& pose, const Contact& contact) const {
  return obstacles_.proximity(pose, *contact.link, contact.obstacle).distance -
         obstacles_.distance(*contact.link);
}

/// One more increment to one side. True if the links lowest .. anchor are free there.
bool BqsaPlanar::advance(Side& side, int link, int anchor, int lowest, const JointVector& q_last) {
  side.offset += settings_.increment;
  side.open = side.offset <= settings_.search_range &&
              self_motion_.turn_link(link, anchor, side.direction * settings_.increment, side.q,
                                     side.pose) &&
              forbidden_step(*problem_, q_last, side.q) == Infeasible::kNot;
  return side.open && links_free(side.pose, lowest, anchor);
}

/// Turns a link that was just freed back towards the obstacle, as far as it stays free.
void BqsaPlanar::settle(Side& side, int link, int anchor, int lowest, const JointVector& q_last) {
  double free = 0;
  double colliding = settings_.increment;
  for (int halving = 0; halving < settings_.settling; ++halving) {
    const double middle = 0.5 * (free + colliding);
    JointVector q = side.q;
    candidate_ = side.pose;
    if (self_motion_.turn_link(link, anchor, side.direction * (free - middle), q, candidate_) &&
        links_free(candidate_, lowest, anchor) &&
        forbidden_step(*problem_, q_last, q) == Infeasible::kNot) {
      side.q = q;
      side.pose = candidate_;
      side.offset -= middle - free;
      free = middle;
    } else {
      colliding = middle;
    }
  }
}

/// Step 5 of the paper variant: the clamping velocity phi moves joints 1 .. a+1 in the kernel of J, the
/// weights W hold the others. It falls back to the clamped configuration where it would collide.
MotionCertificate::Result BqsaPlanar::finish(const StepInput& input, const JointVector& q_predicted,
                                             StepOutput& output) {
  output.guard_fired = false;
  if (variant_ == PlanarVariant::kPaper && output.clamp_count > 0) {
    int anchor = 0;
    for (int c = 0; c < output.clamp_count; ++c) {
      anchor = std::max(anchor, output.clamps[static_cast<std::size_t>(c)].anchor);
    }
    const int n = problem_->chain.joints();
    JointVector weights = JointVector::Ones(n);
    weights.tail(std::max(0, n - anchor - 1)).setConstant(settings_.clamped_weight);  // Eq. 23
    const JointVector phi = (q_ - q_predicted) / problem_->dt;                        // Eq. 24
    const JointVector q_clamped = q_;
    q_ = hybrid_step(input.q, weights, phi);  // Eqs. 17, 18
    forward();
    if (links_free(pose_, 1, n) && forbidden_step(*problem_, input.q, q_) == Infeasible::kNot) {
      const MotionCertificate::Result motion = certify(input);
      if (motion.certified) return motion;
    }
    output.guard_fired = true;
    q_ = q_clamped;
    forward();
  }
  return certify(input);
}

/// Whether the links numbered lowest .. highest hit nothing.
bool BqsaPlanar::links_free(const ChainPose& pose, int lowest, int highest) const {
  for (const Link& link : problem_->chain.links()) {
    if (link.number < lowest || link.number > highest) continue;
    if (obstacles_.first_hit(pose, link) >= 0) return false;
  }
  return true;
}

}  // namespace bqsa
