// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/solid/solid_ring.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/modal/krylov.hpp"
#include "rondo/rom/solid/solid_dynamic.hpp"

namespace rondo::rom {
namespace {

using Complexes = std::complex<double>;
using Eigen::Index, Eigen::MatrixXcd, Eigen::VectorXcd, Eigen::VectorXd;

constexpr Complexes i{0.0, 1.0};

MatrixXcd in_plane(MatrixXcd u) {
  for (Index a = 2; a < u.rows(); a += 3) u.row(a).setZero();
  return u;
}

/// It is make_harmonic() of a ring in the plane, which sums over the rows in another order.
RingHarmonic make_harmonic(const SolidRing& ring, int k, VectorXd squares, MatrixXcd shapes) {
  RingHarmonic h;
  const VectorXd mass = masses(ring);
  h.k = k;
  h.squares = std::move(squares);
  h.shapes = std::move(shapes);
  h.contact = h.shapes(contact_rows(ring), Eigen::all);
  const MatrixXcd weighted = (mass.asDiagonal() * h.shapes).adjoint();
  const MatrixXcd turning = weighted * quarter_turned<3>(h.shapes);
  const MatrixXcd planar = weighted * in_plane(h.shapes);
  h.coriolis = 0.5 * (turning - turning.adjoint());
  h.planar = 0.5 * (planar + planar.adjoint());
  const VectorXcd x = reference_of(ring);
  VectorXcd ones = VectorXcd::Zero(ring.n_rows()), aside = ones, tilt = ones;
  for (Index a = 0; a < ones.size(); a += 3) {
    ones[a] = 1.0, ones[a + 1] = -i;
    aside[a + 2] = 1.0;
    tilt[a + 2] = x[a] + i * x[a + 1];
  }
  const Index r = h.shapes.cols();
  for (VectorXcd* v : {&h.reference, &h.turned, &h.axial, &h.load, &h.translation, &h.tilt})
    v->setZero(r);
  if (k == 0) {
    h.reference = weighted * x;
    h.turned = weighted * quarter_turned<3>(x);
    h.axial = weighted * aside;
    h.load = h.shapes.adjoint() * load_of(ring);
  }
  if (k == 1) {
    h.translation = weighted.conjugate() * ones;
    h.tilt = weighted * tilt;
  }
  return h;
}

/// Lowest modes of a harmonic: M^½ φ_i are the vectors of M^½ K⁻¹ M^½ on the nodes with mass.
RingHarmonic harmonic_of(const SolidRing& ring, const HarmonicStiffness& stiffness, int k,
                         Index n_modes) {
  const SparseFactor factor(stiffness.at_harmonic(k));
  RONDO_DEMAND(factor.info() == Eigen::Success, k);
  const VectorXd root = masses(ring).cwiseSqrt();
  Index size = 0;
  for (Index a = 0; a < root.size(); ++a) size += root[a] > 0.0 ? 1 : 0;
  modal::Operator<Complexes> op;
  op.size = ring.n_rows();
  op.rank = size;
  op.apply = [&](const VectorXcd& x) -> VectorXcd {
    return root.asDiagonal() * factor.solve(VectorXcd(root.asDiagonal() * x));
  };
  op.metric = [](const VectorXcd& x) -> VectorXcd { return x; };
  modal::Krylov<Complexes> space(op);
  const modal::Ritz ritz = modal::eigenvalues_beyond(space, 0.0, std::min(n_modes, size), Index{0});
  const Index n = std::min({n_modes, size, ritz.value.size()});
  VectorXd squares(n);
  MatrixXcd shapes(ring.n_rows(), n);
  for (Index j = 0; j < n; ++j) {
    squares[j] = 1.0 / ritz.value[j];
    const VectorXcd x = space.vector(ritz, j);
    // φ = ω² K⁻¹ M φ on all rows, so that contact nodes follow.
    shapes.col(j) = squares[j] * factor.solve(VectorXcd(root.asDiagonal() * x));
    const VectorXcd weighted = root.asDiagonal() * shapes.col(j);
    shapes.col(j) /= weighted.norm();
  }
  return make_harmonic(ring, k, std::move(squares), std::move(shapes));
}

/// The first modes of a harmonic alone.
RingHarmonic lowest(const SolidRing& ring, const RingHarmonic& of, Index n) {
  return make_harmonic(ring, of.k, of.squares.head(n), of.shapes.leftCols(n));
}

}  // namespace

std::vector<RingHarmonic> solid_modes(const SolidRing& ring, const ModeChoice& choice) {
  const HarmonicStiffness stiffness(ring.stiffness);
  const int n_harmonics = (ring.n_sectors() + 1) / 2;
  const int at_least = std::max(choice.wanted, choice.fewest);
  std::vector<RingHarmonic> found(at(n_harmonics));
  if (at_least == 0) return {};
  Index each = std::min<Index>(ring.n_rows(), 3 + 3 * at_least / ring.n_sectors());
  for (;;) {
#pragma omp parallel for num_threads(ring.threads) schedule(dynamic)
    for (int k = 0; k < n_harmonics; ++k) found[at(k)] = harmonic_of(ring, stiffness, k, each);
    std::vector<VectorXd> frequencies;
    for (const RingHarmonic& h : found) frequencies.emplace_back(h.squares.cwiseSqrt());
    const std::vector<Index> taken = take_lowest(frequencies, choice);
    // A harmonic whose last mode is taken may have more that are as low.
    const auto may_have_more = [&](std::size_t k) {
      const Index known = found[k].squares.size();
      return taken[k] == known && known == each;
    };
    bool all_seen = true;
    for (std::size_t k = 0; k < taken.size(); ++k) all_seen = all_seen && !may_have_more(k);
    if (!all_seen) {
      each *= 2;
      continue;
    }
    std::vector<RingHarmonic> harmonics;
    for (int k = 0; k < n_harmonics; ++k)
      if (taken[at(k)] > 0) harmonics.push_back(lowest(ring, found[at(k)], taken[at(k)]));
    return harmonics;
  }
}

}  // namespace rondo::rom
