// SPDX-License-Identifier: BSD-3-Clause
/// @file  Small bodies of the tests of modes, and dense solutions of them.
#pragma once
#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include "rondo/fem/assembly.hpp"
#include "rondo/fem/sector_stiffness.hpp"
#include "rondo/mesh/disk.hpp"
#include "rondo/modal/modes.hpp"

namespace rondo::test {

struct ModalBody {
  mesh::Mesh mesh;
  fem::SectorStiffness sector;  ///< of a disk
  fem::BlockCsr stiffness;
  std::vector<double> mass;

  [[nodiscard]] modal::CyclicBody<2> cyclic() const { return {sector, mass, mesh.coordinates}; }
  [[nodiscard]] modal::MeshBody any() const { return {mesh, stiffness, mass}; }
};

inline const fem::Material rubber{5.0e6, 0.45, 1100.0, fem::Plane::strain};

inline ModalBody body_of(mesh::Mesh mesh) {
  ModalBody b;
  b.mesh = std::move(mesh);
  if (b.mesh.n_sectors > 0) b.sector = fem::assemble_sector(b.mesh, {&rubber, 1});
  b.stiffness = fem::assemble_stiffness(b.mesh, {&rubber, 1});
  b.mass = fem::lumped_mass(b.mesh, {&rubber, 1});
  return b;
}

inline mesh::Mesh ring(int radial, int columns, bool clamped = true) {
  mesh::Disk disk{.outer_radius = 0.3,
                  .inner_radius = 0.2,
                  .radial = radial,
                  .circumferential = columns,
                  .grading = 1.0,
                  .tread = {}};
  mesh::Mesh mesh = mesh::make_disk(disk);
  if (!clamped) mesh.clamped.clear();
  return mesh;
}

/// `b` beside `a`, nodes and cells after one another; no sectors.
inline mesh::Mesh beside(mesh::Mesh a, const mesh::Mesh& b, Vec2 by) {
  const int n = static_cast<int>(a.n_nodes());
  for (const Vec2 x : b.coordinates) a.coordinates.push_back(x + by);
  for (mesh::Cell cell : b.cells) {
    for (int& node : cell) node += node >= 0 ? n : 0;
    a.cells.push_back(cell);
  }
  for (const int node : b.clamped) a.clamped.push_back(n + node);
  a.n_sectors = 0;
  a.sector.clear();
  a.sector_node.clear();
  return a;
}

/// A' = M^-½ K M^-½ - s² on the free nodes.
inline Eigen::MatrixXd dense(const ModalBody& b, double spin) {
  const std::vector<int> free = fem::free_nodes(b.mesh);
  Eigen::MatrixXd a = Eigen::MatrixXd(fem::free_matrix(b.stiffness, free));
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    for (Eigen::Index j = 0; j < a.cols(); ++j) {
      const auto mass = [&](Eigen::Index k) {
        return b.mass[static_cast<std::size_t>(free[static_cast<std::size_t>(k / 2)])];
      };
      a(i, j) /= std::sqrt(mass(i) * mass(j));
    }
  a.diagonal().array() -= spin * spin;
  return a;
}

/// All frequencies, ascending, by the eigenvalues iω of the companion matrix of
/// λ² + 2sJ λ + A', without use of any symmetry.
inline std::vector<double> dense_frequencies(const ModalBody& b, double spin) {
  const Eigen::MatrixXd a = dense(b, spin);
  const Eigen::Index n = a.rows();
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  companion.topRightCorner(n, n).setIdentity();
  companion.bottomLeftCorner(n, n) = -a;
  for (Eigen::Index k = 0; k < n; k += 2) {
    companion(n + k, n + k + 1) = 2.0 * spin;
    companion(n + k + 1, n + k) = -2.0 * spin;
  }
  const Eigen::VectorXcd lambda =
      Eigen::EigenSolver<Eigen::MatrixXd>(companion, false).eigenvalues();
  std::vector<double> omega;
  for (Eigen::Index k = 0; k < lambda.size(); ++k)
    if (lambda[k].imag() > 0.0) omega.push_back(lambda[k].imag());
  std::sort(omega.begin(), omega.end());
  return omega;
}

inline std::vector<double> frequencies(const modal::Modes& found) {
  std::vector<double> omega;
  for (const modal::Mode& mode : found.modes) omega.push_back(mode.omega);
  return omega;
}

}  // namespace rondo::test
