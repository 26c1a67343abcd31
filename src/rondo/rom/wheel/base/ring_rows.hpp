// SPDX-License-Identifier: BSD-3-Clause
/// @file  Vectors and matrices of all rows of a ring, D rows for each node of a sector.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "rondo/core/index.hpp"
#include "rondo/rom/wheel/base/ring.hpp"

namespace rondo::rom {

/// (rows) mass of each row.
template <int D>
[[nodiscard]] Eigen::VectorXd masses(const SectorRing<D>& ring) {
  Eigen::VectorXd m(ring.n_rows());
  for (Eigen::Index a = 0; a < m.size(); ++a) m[a] = ring.mass[at(a / D)];
  return m;
}

/// (rows) X in the plane.
template <int D>
[[nodiscard]] Eigen::VectorXcd reference_of(const SectorRing<D>& ring) {
  Eigen::VectorXcd x = Eigen::VectorXcd::Zero(ring.n_rows());
  for (std::size_t a = 0; a < ring.place.size(); ++a)
    x.segment<2>(static_cast<Eigen::Index>(D * a)) << ring.place[a].x, ring.place[a].y;
  return x;
}

/// J u of each node, or of each column of a matrix: a quarter turn about the axle.
template <int D>
[[nodiscard]] Eigen::MatrixXcd quarter_turned(const Eigen::MatrixXcd& u) {
  Eigen::MatrixXcd out = Eigen::MatrixXcd::Zero(u.rows(), u.cols());
  for (Eigen::Index a = 0; a < u.rows(); a += D) {
    out.row(a) = -u.row(a + 1);
    out.row(a + 1) = u.row(a);
  }
  return out;
}

/// (D C) rows of the contact nodes.
template <int D>
[[nodiscard]] std::vector<Eigen::Index> contact_rows(const SectorRing<D>& ring) {
  std::vector<Eigen::Index> rows;
  for (const int a : ring.contact)
    for (Eigen::Index c = 0; c < D; ++c) rows.push_back(Eigen::Index{D} * a + c);
  return rows;
}

/// (rows, D C) Unit forces on the contact nodes.
template <int D>
[[nodiscard]] Eigen::MatrixXcd unit_forces(const SectorRing<D>& ring) {
  const std::vector<Eigen::Index> rows = contact_rows(ring);
  Eigen::MatrixXcd forces = Eigen::MatrixXcd::Zero(ring.n_rows(), ring.n_contact());
  for (std::size_t c = 0; c < rows.size(); ++c) forces(rows[c], static_cast<Eigen::Index>(c)) = 1.0;
  return forces;
}

}  // namespace rondo::rom
