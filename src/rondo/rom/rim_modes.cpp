// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/rim_modes.hpp"

#include <Eigen/Cholesky>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/rom/reduced_model.hpp"

namespace rondo::rom {

using Eigen::Index;
using Eigen::MatrixXd;

RimModes make_rim_modes(const mesh::Mesh& mesh, std::span<const double> mass,
                        const ReducedModel& model) {
  RONDO_DEMAND(model.frame == ModelFrame::rectified && mass.size() == mesh.n_nodes(), mass.size(),
               mesh.n_nodes());
  RimModes m;
  std::vector<bool> bonded(mesh.n_nodes(), false);
  for (const int node : mesh.clamped) bonded[at(node)] = true;
  for (std::size_t k = 0; k < mass.size(); ++k) {
    if (bonded[k]) continue;
    m.mass += mass[k];
    m.inertia += mass[k] * dot(mesh.coordinates[k], mesh.coordinates[k]);
  }
  const MatrixXd product_with_stiffness = model.generator * model.stiffness;
  m.carry = 0.5 * (model.generator + model.stiffness.llt().solve(product_with_stiffness));
  m.turned_carry = model.turn * m.carry;
  const Eigen::VectorXd roots = mass_roots(mass);
  const MatrixXd carried = roots.asDiagonal() * differentiate(mesh, model.basis);
  MatrixXd turned(carried.rows(), carried.cols());
  for (Index i = 0; i < carried.rows() / 2; ++i) {
    turned.row(2 * i) = -roots[2 * i] * model.basis.row(2 * i + 1);
    turned.row(2 * i + 1) = roots[2 * i] * model.basis.row(2 * i);
  }
  // 𝒟 is skew in the M product: Φᵀ M 𝒟 (J Φ) = -(M 𝒟 Φ)ᵀ (J Φ).
  const MatrixXd product = carried.transpose() * turned;
  m.carried_turn = -0.5 * (product + product.transpose());
  return m;
}

}  // namespace rondo::rom
