// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contacts that share nodes: one problem for all of them, and its solver (docs/theory.md,
/// 4.7). Contact frames: x is normal (> 0 separates), y is tangential (t = J n).
/// Block Gauss–Seidel: Jourdan, Alart, Jean, CMAME 155 (1998) 31. Newton on statuses: Alart,
/// Curnier, CMAME 92 (1991) 353.
#pragma once
#include <span>
#include <vector>

#include "rondo/contact/coupled/band.hpp"
#include "rondo/contact/coupled/block.hpp"
#include "rondo/contact/law.hpp"
#include "rondo/core/vec2.hpp"

namespace rondo::contact {

/// Relative velocities w = free + W r; each contact obeys (4.3) with its own bounce and friction.
struct CoupledProblem {
  std::vector<Vec2> free;        ///< (nc) w without impulses                          [m/s]
  std::vector<double> bounce;    ///< (nc) ε of restitution_shift(): added to w_n      [m/s]
  std::vector<double> friction;  ///< (nc) μ                                            [-]
  std::vector<int> row_start;    ///< (nc + 1) W in compressed rows of blocks
  std::vector<int> column;       ///< columns ascend; every row has its diagonal block
  std::vector<Block> blocks;     ///< nearly symmetric; on the diagonal see solve_block  [m/kg]
  std::vector<double> mass;      ///< (nc) scale of the residual, 1/|W_jj|              [kg/m]

  [[nodiscard]] std::size_t size() const noexcept { return free.size(); }
};

struct CoupledLimits {
  double tolerance = 1e-12;     ///< largest residual (4.5) of a solution, see coupled_residual
  int most_iterations = 10000;  ///< sweeps and Newton steps together
};

struct CoupledResult {
  int iterations = 0;      ///< sweeps and Newton steps
  double residual = 0.0;   ///< coupled_residual of the impulses returned
  bool converged = false;  ///< residual <= tolerance
};

/// Memory of the solver, kept from one problem to the next: it grows, and only with a problem
/// larger than all before.
struct CoupledWorkspace {
  std::vector<Vec2> current, candidate;  ///< (nc) iterates of the sweeps, to be judged
  std::vector<Vec2> anchor, step_from;   ///< (nc) of Newton's method
  std::vector<Vec2> velocity;            ///< (nc)
  std::vector<int> order;                ///< (nc) contacts in the order of the matrix
  std::vector<int> unknown;              ///< (nc) first unknown of a contact, -1: open
  std::vector<Status> status;            ///< (nc)
  std::vector<double> side;              ///< (nc) of slip, ±1
  std::vector<double> step;              ///< (unknowns)
  BandLu matrix;
};

/// Impulses that obey the law at all contacts together: sweeps of block Gauss–Seidel, and where
/// they are slow Newton's method on statuses (4.7b). `impulse` (nc) comes in as a warm start (zeros
/// where there is none) and leaves as the best found; `status` (nc) is that of the solution. A
/// problem that no iterate solves to the tolerance is reported, with its best residual.
/// @post r_n >= 0, |r_t| <= μ r_n to round-off.
[[nodiscard]] CoupledResult solve_coupled(const CoupledProblem& problem,
                                          const CoupledLimits& limits, std::span<Vec2> impulse,
                                          std::span<Status> status, CoupledWorkspace& work);

/// The law at one contact with a general block: w = free + W r (4.7a).
/// The only solution where W_nn > μ|W_nt|, one of several on other symmetric W with det W > 0.
/// If W is singular, as with modes that let a point move one way only, the contact stays open and
/// the residual shows the error.
[[nodiscard]] LocalSolution solve_block(const Block& delassus, Vec2 free, double bounce,
                                        double friction) noexcept;

/// W_jj.
[[nodiscard]] const Block& diagonal_block(const CoupledProblem& problem, std::size_t j) noexcept;

/// w = free + W r into `velocity` (nc).
void coupled_velocities(const CoupledProblem& problem, std::span<const Vec2> impulse,
                        std::span<Vec2> velocity) noexcept;

}  // namespace rondo::contact
