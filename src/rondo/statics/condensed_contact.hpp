// SPDX-License-Identifier: BSD-3-Clause
/// @file  Signorini–Coulomb contact of a linear elastic body, condensed on its candidates: all of
/// them coupled by a dense compliance (docs/theory.md, 6.4). Contact frames: in each pair of rows
/// the first is normal (> 0 separates), the second tangential.
/// Method: block Gauss–Seidel (Jourdan, Alart, Jean, CMAME 155 (1998) 31) to find who is open, who
/// sticks and who slips; a direct solve of those that press then gives the forces to round-off.
/// Where the sweeps do not find it, Lemke's pivoting on the law as a linear complementarity problem
/// (Klarbring, Ing.-Arch. 60 (1990) 529).
#pragma once
#include <Eigen/Core>
#include <utility>
#include <vector>

#include "rondo/contact/law.hpp"
#include "rondo/core/vec2.hpp"
#include "rondo/statics/lemke.hpp"

namespace rondo::statics {

/// The coefficient of friction μ >= 0 of each candidate.
class CandidateFriction {
 public:
  CandidateFriction(double all) noexcept : all_(all) {}  // NOLINT(*-explicit-*): a constant is one
  /// @param each (m)
  explicit CandidateFriction(std::vector<double> each) noexcept : each_(std::move(each)) {}

  /// @pre candidate < m
  [[nodiscard]] double operator[](std::size_t candidate) const noexcept {
    return each_.empty() ? all_ : each_[candidate];
  }
  /// Whether there is a coefficient for each of m candidates.
  [[nodiscard]] bool suits(std::size_t m) const noexcept {
    return each_.empty() || each_.size() == m;
  }

 private:
  double all_ = 0.0;
  std::vector<double> each_;  ///< empty: all have the same
};

/// Rows 2j, 2j + 1 of a vector are candidate j of m.
struct CondensedProblem {
  const Eigen::MatrixXd& compliance;  ///< (2m, 2m) G = H K⁻¹ Hᵀ, symmetric and positive [m²/N]
  Eigen::VectorXd free;               ///< (2m) gap and slip without any force           [m]
  CandidateFriction friction = 0.0;   ///< μ_j                                           [-]
};

struct CondensedSolution {
  Eigen::VectorXd force;                ///< (2m) in: where to start; out: r            [N/m]
  std::vector<contact::Status> status;  ///< (m)
};

struct CondensedLimits {
  double tolerance = 1e-12;  ///< of the relative residual (6.4d)                        [-]
  int sweeps_before_pivoting = 300;
  int sweeps = 5000;  ///< in all; those after the pivoting where that found nothing
};

enum class Pivoting {
  none,   ///< not needed
  used,   ///< ended on a solution; the residual tells whether it is one
  failed  ///< found none, by round-off: there is one (docs/theory.md, 6.4)
};

struct CondensedReport {
  bool converged = false;
  int sweeps = 0;
  int direct_solves = 0;
  Pivoting pivoting = Pivoting::none;
  int pivots = 0;
  double residual = 0.0;  ///< relative (6.4d)                                           [-]
};

/// A single candidate: w = free + block r with a symmetric positive block.
struct BlockProblem {
  Vec2 free;  ///< [m]
  double normal = 0.0, mixed = 0.0,
         shear = 0.0;  ///< block [[normal, mixed], [mixed, shear]] [m²/N]
};

/// The law (6.4b) of one candidate in closed form. Where normal <= μ |mixed| there may be no
/// solution; then the force is zero and the residual tells.
contact::LocalSolution solve_block(const BlockProblem& problem, double friction) noexcept;

/// Largest law residual, each candidate's own with 1/G_nn as the mass, over the largest |r|; where
/// there is no force, over the largest |free|/G_nn (6.4d).                                   [-]
/// @param w (2m) gap and slip under r [m]
double condensed_residual(const CondensedProblem& problem, const Eigen::VectorXd& r,
                          const Eigen::VectorXd& w);

/// The law as a linear complementarity problem without units (6.4f): forces over `force`, gaps and
/// slips over `length`; z = (r_n, r_t + μ r_n, backward slip), y = (gap, forward slip, μ r_n -
/// r_t), with the μ of each candidate. The compliance need not be symmetric here.
struct ComplementaryForm {
  Lcp lcp;              ///< of 3m
  double length = 0.0;  ///< largest |free| [m]
  double force = 0.0;   ///< length over the mean of G's diagonal [N/m]
};
ComplementaryForm make_complementary(const CondensedProblem& problem);

[[nodiscard]] CondensedReport solve_condensed(const CondensedProblem& problem,
                                              const CondensedLimits& limits,
                                              CondensedSolution& solution);

}  // namespace rondo::statics
