// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/solid/solid_dynamic.hpp"

#include <cmath>
#include <numbers>

#include "rondo/core/contract.hpp"
#include "rondo/core/dense.hpp"
#include "rondo/core/index.hpp"

namespace rondo::rom {
namespace {

using Complexes = std::complex<double>;
using Eigen::Index, Eigen::MatrixXcd, Eigen::VectorXcd, Eigen::VectorXd;

/// Inertia of a pattern with this rate on a ring with this spin; `share` of it counts.
struct Inertia {
  double square, still, across;

  Inertia(double spin, double rate, double share)
      : square(share * spin * spin),
        still(share * rate * rate),
        across(share * 2.0 * rate * spin) {}
  void take_from(const SolidRing& ring, SparseComplex& z) const {
    const VectorXd m = masses(ring);
    for (Index a = 0; a < m.size(); a += 3) {
      if (m[a] == 0.0) continue;
      z.coeffRef(a, a) -= (square + still) * m[a];
      z.coeffRef(a + 1, a + 1) -= (square + still) * m[a];
      z.coeffRef(a + 2, a + 2) -= still * m[a];
      z.coeffRef(a, a + 1) -= Complexes(0.0, across * m[a]);
      z.coeffRef(a + 1, a) += Complexes(0.0, across * m[a]);
    }
  }
  /// Less the inertia of modes.
  [[nodiscard]] MatrixXcd of_modes(const RingHarmonic& h) const {
    return Complexes(0.0, across) * h.coriolis - square * h.planar;
  }
};

/// What forces do less what the modes do by them.
MatrixXcd without_modes(MatrixXcd u, const RingHarmonic* h, const MatrixXcd& modes,
                        const MatrixXcd& forces) {
  if (h) u -= h->shapes * solve(modes, MatrixXcd(h->shapes.adjoint() * forces));
  return u;
}

}  // namespace

HarmonicStiffness::HarmonicStiffness(const fem::SolidSector& of) : n_(of.n_sectors) {
  std::array<std::vector<Eigen::Triplet<Complexes>>, 3> entries;
  for (std::size_t a = 0; a < of.n_local(); ++a)
    for (const fem::SolidSector::Entry& e : of.row(a))
      for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
          entries[at(e.shift + 1)].emplace_back(static_cast<int>(3 * a) + r, 3 * e.column + c,
                                                e.block[at(3 * c + r)]);
  const auto rows = static_cast<Index>(3 * of.n_local());
  for (std::size_t s = 0; s < 3; ++s) {
    parts_[s].resize(rows, rows);
    parts_[s].setFromTriplets(entries[s].begin(), entries[s].end());
  }
}

SparseComplex HarmonicStiffness::at_harmonic(int k) const {
  const Complexes turn = std::polar(1.0, 2.0 * std::numbers::pi * k / n_);
  const SparseComplex beside = std::conj(turn) * parts_[0] + turn * parts_[2];
  return parts_[1] + beside;
}

StandingAnswer::StandingAnswer(const SolidRing& ring, const SparseComplex& stiffness,
                               const RingHarmonic* h, double spin, double rate, double inertia)
    : h_(h) {
  const Inertia of(spin, rate, inertia);
  SparseComplex z = stiffness;
  of.take_from(ring, z);
  factor_->compute(z);
  if (!h) return;
  modes_ = of.of_modes(*h);
  modes_.diagonal() += (h->squares.array() - of.still).matrix();
  const MatrixXcd turned = modes_.adjoint();
  modes_ = 0.5 * (modes_ + turned);
}

bool StandingAnswer::has_meaning() const {
  if (factor_->info() != Eigen::Success) return false;
  Index below = (factor_->vectorD().real().array() < 0.0).count();
  if (h_ && h_->squares.size() > 0) {
    below -= (eigenvalues_of(modes_).array() < 0.0).count();
  }
  return below == 0;
}

MatrixXcd StandingAnswer::beyond(const MatrixXcd& forces) const {
  return without_modes(factor_->solve(forces), h_, modes_, forces);
}

StandingAnswer standing_answer(const SolidRing& ring, const SparseComplex& stiffness,
                               const RingHarmonic* h, int k, double spin, bool& made_static,
                               double inertia) {
  const bool rolls = k > 0 && 2 * k < ring.n_sectors();
  made_static = false;
  if (rolls) {
    StandingAnswer z(ring, stiffness, h, spin, k * spin, inertia);
    if (z.has_meaning()) return z;
    made_static = true;
  }
  return {ring, stiffness, h, spin, 0.0};
}

ViscousAnswer::ViscousAnswer(const SolidRing& ring, const SparseComplex& stiffness,
                             const RingHarmonic* h, int k, double spin, const Complexes& modulus)
    : h_(h) {
  const Inertia inertia(spin, k * spin, 1.0);
  SparseComplex z = modulus * stiffness;
  inertia.take_from(ring, z);
  factor_->compute(z);
  RONDO_DEMAND(factor_->info() == Eigen::Success, k, spin);
  if (!h) return;
  modes_ = inertia.of_modes(*h);
  modes_.diagonal() += modulus * h->squares;
  modes_.diagonal().array() -= inertia.still;
}

MatrixXcd ViscousAnswer::ahead(const MatrixXcd& forces) const {
  return without_modes(factor_->solve(forces), h_, modes_, forces);
}

MatrixXcd ViscousAnswer::back(const MatrixXcd& forces) const {
  return without_modes(factor_->adjoint().solve(forces), h_, modes_.adjoint(), forces);
}

}  // namespace rondo::rom
