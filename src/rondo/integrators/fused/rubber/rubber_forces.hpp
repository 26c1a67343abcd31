// SPDX-License-Identifier: BSD-3-Clause
/// @file  Forces of elements of rubber in the steps of a run, all at u_{n+1}, by blocks that
/// threads share; the strain history of their viscous branches.
#pragma once
#include <span>
#include <vector>

#include "rondo/integrators/fused/rubber/rubber_plan.hpp"

namespace rondo::dynamics {

/// Energies of all elements, summed in the order of the blocks [J/m].
struct RubberEnergy {
  double stored = 0.0;              ///< at t_{n+1}, in branches too
  double dissipation_before = 0.0;  ///< dissipation of the branches, in the half step to t_{n+1}
  double dissipation_after = 0.0;   ///< in the half step after it
  double least = 0.0;               ///< smallest det F at a point [-]
};

class RubberForces {
 public:
  /// As make_rubber_plan(). Branches are relaxed at u_0: what has rested for long.
  /// @param u (n) u_0 of the nodes [m]. @throws std::bad_alloc
  RubberForces(const Model& model, std::span<const int> row, int zero, std::size_t n_row_packs,
               std::span<const Vec2> u, const kernels::RubberTable& table);

  [[nodiscard]] std::size_t n_blocks() const noexcept { return plan_.blocks.size(); }
  /// Evaluates one block. @param now (rows, 2) u_{n+1}, rows of zeros for clamped nodes
  void evaluate(const double* now, std::size_t block) noexcept;
  /// Energies by the blocks as they were evaluated last.
  [[nodiscard]] RubberEnergy energy() const noexcept;

  /// For the rows: once all blocks are evaluated.
  [[nodiscard]] const kernels::RubberRows& rows() const noexcept { return rows_; }
  /// Force on one row [N/m].
  [[nodiscard]] Vec2 force_on(int row) const noexcept;

  /// C_i of element, branch: xx, yy, xy.
  void save(std::vector<double>& branches) const;
  void restore(std::span<const double> branches);

 private:
  template <class Visit>
  void for_history(Visit&& visit) const;
  [[nodiscard]] std::vector<std::size_t> saved_places() const;
  void relax(std::span<const Vec2> u);

  const Model& model_;
  RubberPlan plan_;
  const kernels::RubberTable& table_;
  LargeArray force_, history_;
  std::vector<kernels::RubberSums> sums_;  ///< (blocks)
  kernels::RubberRows rows_{};
};

}  // namespace rondo::dynamics
