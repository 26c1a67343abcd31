// SPDX-License-Identifier: BSD-3-Clause
/// @file  A rolling body in a few modes, as plain data: the basis and the equations of motion in it
/// (docs/reduced.md, 2 and 3).
#pragma once
#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "rondo/core/vec2.hpp"
#include "rondo/mesh/mesh.hpp"
#include "rondo/pod/rectify.hpp"
#include "rondo/rom/contact_rows.hpp"

namespace rondo::rom {

enum class ModelFrame {
  rectified,  ///< modes of T(θ)u: motion near the ground stays in the same modes
  turning,    ///< modes of u itself, as in other reduced models: D = 0
};

/// r modes. q are the coefficients of the displacement and p those of the material velocity in the
/// frame of the model, in kg^1/2 m and kg^1/2 m/s per square root of the thickness:
///     q̇ = p + s D q,
///     ṗ = -(α + 2sJ - sD + βK) p - (K - s²) q - ṡ (J q + j) + s² x - Eᵀ(c̈ - g) + Hᵀ λ   (R.2)
struct ReducedModel {
  Eigen::MatrixXd basis;  ///< (2n, r) Φ, node after node x, y: ΦᵀMΦ = I, 0 on clamped nodes
  Eigen::MatrixXd stiffness;  ///< (r, r) K = ΦᵀKΦ, symmetric                       [1/s²]
  Eigen::MatrixXd generator;  ///< (r, r) D = ΦᵀM𝒟Φ, bitwise skew
  Eigen::MatrixXd turn;       ///< (r, r) J = ΦᵀMJΦ, bitwise skew
  Eigen::VectorXd reference;  ///< (r) x = ΦᵀM X
  Eigen::VectorXd turned_reference;  ///< (r) j = ΦᵀMJ X
  Eigen::MatrixXd translation;       ///< (r, 2) Eᵀ: ΦᵀM times unit accelerations along x and y
  ModelFrame frame = ModelFrame::rectified;
  ContactForm form = ContactForm::places;
  Eigen::MatrixXd weights;  ///< (sectors, m) of the sectors in the points fixed in space
  ContactRows contact;      ///< of these points; empty if the points are nodes
  int n_sectors = 0;

  [[nodiscard]] Eigen::Index size() const noexcept { return basis.cols(); }
};

/// (n) √M of the two numbers of each node, in pairs: weighted fields are √M times the field.
Eigen::VectorXd mass_roots(std::span<const double> mass);

/// D u for each column: fields (2n, columns), not weighted. Clamped nodes must be 0 and remain so.
Eigen::MatrixXd differentiate(const mesh::Mesh& mesh, const Eigen::MatrixXd& fields);

/// Orthonormal columns that span those of `parts`, one after another. A column whose part outside
/// the earlier ones is below `dependent` of its norm is left out.
Eigen::MatrixXd join(std::span<const Eigen::MatrixXd> parts, double dependent = 1e-8);

/// The data of a mesh from which a reduced model is made.
struct FullModel {
  const mesh::Mesh& mesh;                                                 ///< of equal sectors
  std::span<const double> mass;                                           ///< (n) [kg/m]
  std::function<void(std::span<const Vec2>, std::span<Vec2>)> stiffness;  ///< out = K in
};

/// The model without contact points, which the caller chooses (form, weights, contact).
/// @param weighted (2n, r) orthonormal: √M Φ
ReducedModel make_reduced_model(const FullModel& full, const Eigen::MatrixXd& weighted,
                                ModelFrame frame = ModelFrame::rectified);

/// Sets contact at points fixed in space (contact_rows.hpp). @param weights (sectors, m)
void set_contact(const mesh::Mesh& mesh, ContactForm form, Eigen::MatrixXd weights,
                 ReducedModel& model);

/// Transforms coefficients to fields of the co-rotating frame, and back. Owns the work space of its
/// transforms: one object per thread.
class Lift {
 public:
  /// The model must outlive it. @pre pod::node_rings(mesh) has sectors
  Lift(const mesh::Mesh& mesh, const ReducedModel& model);
  /// For some points only: the rows of the basis are those of the points, and must outlive it.
  Lift(const Eigen::MatrixXd& basis, ModelFrame frame, pod::Rings rings);
  /// out = T(-θ) Φ q; Φ q in the co-rotating frame. @param out (n)
  void lift(double theta, const Eigen::VectorXd& q, std::span<Vec2> out);
  /// ΦᵀM T(θ) u, or ΦᵀM u: the inverse for fields in the span of the modes. @param mass (n)
  [[nodiscard]] Eigen::VectorXd restrict_to_modes(double theta, std::span<const Vec2> field,
                                                  std::span<const double> mass);

 private:
  const Eigen::MatrixXd& basis_;
  bool moves_;
  pod::Rings rings_;
  pod::Rectifier rectifier_;
  std::vector<Vec2> ordered_;  ///< (n) ring after ring
  Eigen::VectorXd field_;      ///< (2n)
};

/// Lift for the boundary alone, at a fraction of the cost.
class BoundaryLift {
 public:
  /// The mesh must outlive it.
  BoundaryLift(const mesh::Mesh& mesh, const ReducedModel& model);
  /// Fills u (n) at the nodes of the boundary and leaves the others unchanged.
  void lift(double theta, const Eigen::VectorXd& q, std::span<Vec2> u);

 private:
  const std::vector<int>& boundary_;
  const Eigen::MatrixXd basis_;  ///< (2nb, r)
  Lift lift_;
  std::vector<Vec2> values_;  ///< (nb)
};

}  // namespace rondo::rom
