/// @file
/// The dual active-set method of Goldfarb and Idnani (1983) for small dense programs.
#pragma once

#include <array>

#include "baselines/qp/quadratic_program.hpp"

namespace bqsa::baselines {

/// Starts at the minimum without constraints and adds the most violated row, equalities first; a
/// multiplier that would turn negative drops its row. Every point on the way is the minimum subject to
/// the active rows, further from the start than the one before.
///
/// With G = L Lᵀ it works on y = Lᵀx, where G is the identity, and on rows of unit length there. Of the
/// active rows N it keeps an orthogonal Q and a triangular R with QᵀN = [R; 0] (the publication's J is
/// L^-T Q), updated by rotations. What counts as what, relative to |bound| + the largest |y| so far:
///
///   violated beyond 1e-10;
///   dependent on the active rows, of which it is a combination: of its length less is new than 1e-13 of
///     the coefficients, which is rounding;
///   as good as kept: dependent, and violated by no more than those roundings account for. Such a row is
///     left as it is, so that consistent rows are not called infeasible;
///   infeasible: a dependent row is violated by more and no active row can make place, or |y| exceeds
///     1e4 times the largest of |bounds| and |y| at the start: rows that meet, if at all, far beyond
///     everything that the program speaks of.
///
/// In the end y and u are corrected for what rounding the steps left over.
///
/// D. Goldfarb, A. Idnani: A Numerically Stable Dual Method for Solving Strictly Convex Quadratic
/// Programs. Mathematical Programming 27, 1983.
class ActiveSet {
 public:
  /// Does not allocate. `iterations` counts rows added and dropped.
  void solve(const QuadraticProgram& program, QpSolution& solution);

 private:
  struct Active {
    int row = 0;
    double side = 0;  ///< of an inequality: 1 at the lower bound, -1 at the upper
    double multiplier = 0;
    bool equality = false;
  };

  void start(const QuadraticProgram& program);
  QpStatus run();
  bool add_equality(int row);
  Active most_violated() const;
  QpStatus add_inequality(Active constraint);
  void step_towards(const Active& constraint);
  int blocking(double& step) const;
  void move(double step);
  void append(const Active& constraint);
  void drop(int position);
  void correct();
  double bound(const Active& constraint) const;
  double surplus(const Active& constraint) const;
  double doubtful(const Active& constraint) const;
  double reach(double bound) const;

  // The program where G is the identity:
  QpMatrix factor_;            // Lᵀ
  QpVector y_start_;           // the minimum without constraints
  QpRows rows_;                // of unit length
  QpRowVector lower_, upper_;  // of those
  QpRowVector scale_;          // from E to those; 1 for empty rows

  // Where the search is:
  QpVector y_;
  QpMatrix basis_, triangle_;                   // Q, R
  std::array<Active, kMaxQpVariables> active_;  // the first `count_`

  // Of the row that is being added:
  QpVector d_;            // Qᵀn
  QpVector z_, r_;        // primal and dual step
  double curvature_ = 0;  // zᵀn

  double size_ = 0;     // largest |y| so far
  double largest_ = 0;  // |y| beyond which there is no solution
  int n_ = 0;
  int m_ = 0;
  int count_ = 0;
  int iterations_ = 0;
  bool independent_ = false;                    // the row that is being added, of the active ones
  std::array<bool, kMaxQpRows> passed_over_{};  // active, or equalities that depend on those
  std::array<bool, kMaxQpRows> as_good_as_kept_{};  // by the active rows as they are
};

}  // namespace bqsa::baselines
