// SPDX-License-Identifier: BSD-3-Clause
/// @file  A linear elastic body seen from some of its boundary nodes: the stiffness factorised
/// once, its inverse condensed on those nodes (docs/theory.md, 6.4).
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "rondo/fem/assembly.hpp"

namespace rondo::statics {

/// The body under forces on its candidates.
struct CondensedField {
  std::vector<Vec2> u;  ///< (n) 0 on clamped nodes                                  [m]
  double strain = 0.0;  ///< ½ uᵀ K u                                                [J/m]
  double residual = 0.0;  ///< ‖K u - Hᵀ r‖ / ‖Hᵀ r‖; 0 without force                    [-]
};

/// Contact frames of flat ground: normal (0, 1), tangent J n = (-1, 0); H takes u to (u_y, -u_x) of
/// each candidate of the set.
class Condensation {
 public:
  /// Factorises K (CHOLMOD). @param nodes (nb) candidates, free nodes, none in the set at first.
  Condensation(const fem::BlockCsr& k, std::span<const int> free, std::span<const int> nodes);
  ~Condensation();
  Condensation(const Condensation&) = delete;
  Condensation& operator=(const Condensation&) = delete;

  /// False where K is not positive definite in numbers; then nothing below may be called.
  [[nodiscard]] bool factorised() const noexcept;
  /// Adds candidates to the set, with two solves each. @pre not in the set.
  void append(std::span<const std::size_t> candidates);
  /// Empties the set; the factor stays.
  void clear();
  /// The number of nodes of the mesh.
  [[nodiscard]] std::size_t n_nodes() const noexcept;
  /// (m) Places in `nodes`, in the order of the compliance's rows.
  [[nodiscard]] const std::vector<std::size_t>& set() const noexcept;
  /// Places in `nodes` that are not in the set, ascending.
  [[nodiscard]] std::vector<std::size_t> outside() const;
  /// (2m, 2m) G = H K⁻¹ Hᵀ                                                            [m²/N]
  [[nodiscard]] const Eigen::MatrixXd& compliance() const noexcept;
  /// u = K⁻¹ Hᵀ r with one step of refinement. @param r (2m) [N/m]
  [[nodiscard]] CondensedField field(const Eigen::VectorXd& r) const;
  /// K⁻¹ f likewise (n). @param force (n) [N/m]
  [[nodiscard]] std::vector<Vec2> displacement(std::span<const Vec2> force) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rondo::statics
