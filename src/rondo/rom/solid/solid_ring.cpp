// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/solid/solid_ring.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/modal/krylov.hpp"

namespace rondo::rom {
namespace {

using Complexes = std::complex<double>;
using Eigen::Index, Eigen::MatrixXcd, Eigen::VectorXcd, Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<Complexes>;
using Factor = Eigen::SimplicialLDLT<Sparse, Eigen::Lower, Eigen::AMDOrdering<int>>;

constexpr Complexes i{0.0, 1.0};

Complexes wave(int n, int k) {
  return std::polar(1.0, 2.0 * std::numbers::pi * k / n);
}

/// (rows) mass of each row.
VectorXd masses(const SolidRing& ring) {
  VectorXd m(ring.n_rows());
  for (Index a = 0; a < m.size(); ++a) m[a] = ring.mass[at(a / 3)];
  return m;
}

/// (3C) rows of the contact nodes.
std::vector<Index> contact_rows(const SolidRing& ring) {
  std::vector<Index> rows;
  for (const int a : ring.contact)
    rows.insert(rows.end(), {Index{3} * a, Index{3} * a + 1, Index{3} * a + 2});
  return rows;
}

/// K(k) of a ring at all k, from the three matrices that couple a sector with its neighbours.
class Stiffness {
 public:
  explicit Stiffness(const SolidRing& ring) : n_(ring.n_sectors()) {
    const fem::SolidSector& of = ring.stiffness;
    std::array<std::vector<Eigen::Triplet<Complexes>>, 3> entries;
    for (std::size_t a = 0; a < of.n_local(); ++a)
      for (const fem::SolidSector::Entry& e : of.row(a))
        for (int c = 0; c < 3; ++c)
          for (int r = 0; r < 3; ++r)
            entries[at(e.shift + 1)].emplace_back(static_cast<int>(3 * a) + r, 3 * e.column + c,
                                                  e.block[at(3 * c + r)]);
    for (std::size_t s = 0; s < 3; ++s) {
      parts_[s].resize(ring.n_rows(), ring.n_rows());
      parts_[s].setFromTriplets(entries[s].begin(), entries[s].end());
    }
  }
  [[nodiscard]] Sparse at_harmonic(int k) const {
    const Complexes turn = wave(n_, k);
    const Sparse beside = std::conj(turn) * parts_[0] + turn * parts_[2];
    return parts_[1] + beside;
  }

 private:
  int n_;
  std::array<Sparse, 3> parts_;  ///< by the shift, from -1
};

/// J u of each node: a quarter turn about the axle.
MatrixXcd quarter_turned(const MatrixXcd& u) {
  MatrixXcd out = MatrixXcd::Zero(u.rows(), u.cols());
  for (Index a = 0; a < u.rows(); a += 3) {
    out.row(a) = -u.row(a + 1);
    out.row(a + 1) = u.row(a);
  }
  return out;
}

MatrixXcd in_plane(MatrixXcd u) {
  for (Index a = 2; a < u.rows(); a += 3) u.row(a).setZero();
  return u;
}

/// (rows) X in the plane.
VectorXcd reference(const SolidRing& ring) {
  VectorXcd x = VectorXcd::Zero(ring.n_rows());
  for (std::size_t a = 0; a < ring.place.size(); ++a) {
    x[static_cast<Index>(3 * a)] = ring.place[a].x;
    x[static_cast<Index>(3 * a + 1)] = ring.place[a].y;
  }
  return x;
}

VectorXcd load_of(const SolidRing& ring) {
  VectorXcd f = VectorXcd::Zero(ring.n_rows());
  for (std::size_t a = 0; a < ring.load.size(); ++a) {
    const Index row = static_cast<Index>(3 * a);
    f[row] = ring.load[a].x;
    f[row + 1] = ring.load[a].y;
    f[row + 2] = ring.load[a].z;
  }
  return f;
}

RingHarmonic make_harmonic(const SolidRing& ring, int k, VectorXd squares, MatrixXcd shapes) {
  RingHarmonic h;
  const VectorXd mass = masses(ring);
  h.k = k;
  h.squares = std::move(squares);
  h.shapes = std::move(shapes);
  h.contact = h.shapes(contact_rows(ring), Eigen::all);
  const MatrixXcd weighted = (mass.asDiagonal() * h.shapes).adjoint();
  const MatrixXcd turning = weighted * quarter_turned(h.shapes);
  const MatrixXcd planar = weighted * in_plane(h.shapes);
  h.coriolis = 0.5 * (turning - turning.adjoint());
  h.planar = 0.5 * (planar + planar.adjoint());
  const VectorXcd x = reference(ring);
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
    h.turned = weighted * quarter_turned(x);
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
RingHarmonic harmonic_of(const SolidRing& ring, const Sparse& k_of, int k, Index n_modes) {
  const Factor factor(k_of);
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

/// Z_k of the ring and of the modes, at the rate ks and the spin s.
class Dynamic {
 public:
  Dynamic(const SolidRing& ring, const Sparse& stiffness, const RingHarmonic* h, double spin,
          double rate)
      : h_(h) {
    const double square = spin * spin, still = rate * rate, across = 2.0 * rate * spin;
    const VectorXd m = masses(ring);
    Sparse z = stiffness;
    for (Index a = 0; a < m.size(); a += 3) {
      if (m[a] == 0.0) continue;
      z.coeffRef(a, a) -= (square + still) * m[a];
      z.coeffRef(a + 1, a + 1) -= (square + still) * m[a];
      z.coeffRef(a + 2, a + 2) -= still * m[a];
      z.coeffRef(a, a + 1) -= i * across * m[a];
      z.coeffRef(a + 1, a) += i * across * m[a];
    }
    factor_->compute(z);
    if (!h) return;
    modes_ = i * across * h->coriolis - square * h->planar;
    modes_.diagonal() += (h->squares.array() - still).matrix();
    const MatrixXcd turned = modes_.adjoint();
    modes_ = 0.5 * (modes_ + turned);
  }
  /// The convected form says what a pattern does that came from rest only if no mode that is left
  /// out has passed its critical spin.
  [[nodiscard]] bool has_meaning() const {
    if (factor_->info() != Eigen::Success) return false;
    Index below = (factor_->vectorD().real().array() < 0.0).count();
    if (h_ && h_->squares.size() > 0) {
      const Eigen::SelfAdjointEigenSolver<MatrixXcd> solver(modes_, Eigen::EigenvaluesOnly);
      below -= (solver.eigenvalues().array() < 0.0).count();
    }
    return below == 0;
  }
  /// What forces do beyond the modes.
  [[nodiscard]] MatrixXcd beyond(const MatrixXcd& forces) const {
    MatrixXcd u = factor_->solve(forces);
    if (h_) u -= h_->shapes * modes_.partialPivLu().solve(h_->shapes.adjoint() * forces);
    return u;
  }

 private:
  const RingHarmonic* h_;
  std::unique_ptr<Factor> factor_ = std::make_unique<Factor>();  // it cannot be moved
  MatrixXcd modes_;
};

Dynamic dynamic_of(const SolidRing& ring, const Sparse& stiffness, const RingHarmonic* h, int k,
                   double spin, bool& made_static) {
  const bool rolls = k > 0 && 2 * k < ring.n_sectors();
  made_static = false;
  if (rolls) {
    Dynamic z(ring, stiffness, h, spin, k * spin);
    if (z.has_meaning()) return z;
    made_static = true;
  }
  return {ring, stiffness, h, spin, 0.0};
}

/// (rows, 3C) Unit forces on the contact nodes.
MatrixXcd unit_forces(const SolidRing& ring) {
  const std::vector<Index> rows = contact_rows(ring);
  MatrixXcd forces = MatrixXcd::Zero(ring.n_rows(), ring.n_contact());
  for (std::size_t c = 0; c < rows.size(); ++c) forces(rows[c], static_cast<Index>(c)) = 1.0;
  return forces;
}

}  // namespace

SolidRing make_solid_ring(const fem::SolidSector& stiffness, std::span<const double> mass,
                          std::span<const Vec2> reference, std::span<const double> axial,
                          std::span<const int> contact) {
  SolidRing ring{stiffness, {}, {}, {}, {}};
  std::vector<char> touches(at(stiffness.nodes_per_sector));
  for (const int node : contact) touches[at(node % stiffness.nodes_per_sector)] = 1;
  for (std::size_t a = 0; a < stiffness.n_local(); ++a) {
    const std::size_t node = stiffness.node(a, 0);
    ring.place.push_back(Vec3(reference[node], axial[node]));
    ring.mass.push_back(mass[node]);
    const bool contacts = touches[at(stiffness.nodes[a])] != 0;
    RONDO_DEMAND(contacts == (mass[node] == 0.0), a, mass[node]);
    if (contacts) ring.contact.push_back(static_cast<int>(a));
  }
  RONDO_DEMAND(ring.contact.size() * at(stiffness.n_sectors) == contact.size(), ring.contact.size(),
               stiffness.n_sectors, contact.size());
  return ring;
}

std::vector<RingHarmonic> solid_modes(const SolidRing& ring, const ModeChoice& choice) {
  const Stiffness stiffness(ring);
  const int n_harmonics = (ring.n_sectors() + 1) / 2;
  const int at_least = std::max(choice.wanted, choice.fewest);
  std::vector<RingHarmonic> found(at(n_harmonics));
  if (at_least == 0) return {};
  Index each = std::min<Index>(ring.n_rows(), 3 + 3 * at_least / ring.n_sectors());
  for (;;) {
#pragma omp parallel for num_threads(ring.threads) schedule(dynamic)
    for (int k = 0; k < n_harmonics; ++k)
      found[at(k)] = harmonic_of(ring, stiffness.at_harmonic(k), k, each);
    struct Mode {
      double frequency;
      int k;
    };
    std::vector<Mode> modes;
    for (const RingHarmonic& h : found)
      for (const double square : h.squares) modes.push_back({std::sqrt(square), h.k});
    std::ranges::stable_sort(modes, {}, &Mode::frequency);
    std::vector<Index> taken(at(n_harmonics));
    int count = 0;
    bool all_seen = true;
    for (const Mode& mode : modes) {
      if (count >= choice.wanted || (mode.frequency > choice.highest && count >= choice.fewest))
        break;
      ++taken[at(mode.k)];
      count += mode.k == 0 ? 1 : 2;
      // A harmonic whose last mode is taken may have more that are as low.
      const Index known = found[at(mode.k)].squares.size();
      all_seen = all_seen && (taken[at(mode.k)] < known || known < each);
    }
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

RingResidual solid_residual(const SolidRing& ring, std::span<const RingHarmonic> harmonics,
                            double spin_squared) {
  const double spin = std::sqrt(spin_squared);
  const Stiffness stiffness(ring);
  const std::vector<Index> rows = contact_rows(ring);
  const MatrixXcd forces = unit_forces(ring);
  RingResidual out;
  const int n = out.n_sectors = ring.n_sectors();
  const Index size = out.size = ring.n_contact();
  std::vector<MatrixXcd> by_harmonic(at(n / 2 + 1));
  std::vector<char> made_static(by_harmonic.size());
#pragma omp parallel for num_threads(ring.threads) schedule(dynamic)
  for (int k = 0; k <= n / 2; ++k) {
    const RingHarmonic* h = find_harmonic(harmonics, k);
    bool is_static = false;
    const Dynamic z = dynamic_of(ring, stiffness.at_harmonic(k), h, k, spin, is_static);
    made_static[at(k)] = is_static ? 1 : 0;
    const MatrixXcd surface = z.beyond(forces)(rows, Eigen::all);
    by_harmonic[at(k)] = 0.5 * (surface + surface.adjoint());
    if (k > 0) continue;
    const VectorXcd pull =
        spin_squared * (masses(ring).asDiagonal() * reference(ring)) + load_of(ring);
    out.centrifugal = z.beyond(pull).real();
  }
  for (int k = 0; k <= n / 2; ++k)
    if (made_static[at(k)] != 0) out.made_static.push_back(k);
  out.blocks.resize(at(n) * at(size * size));
#pragma omp parallel for num_threads(ring.threads) schedule(static)
  for (int d = 0; d < n; ++d) {
    Eigen::Map<Eigen::MatrixXd> lag(out.blocks.data() + d * size * size, size, size);
    lag.setZero();
    for (int k = 0; k <= n / 2; ++k) {
      const double weight = (k == 0 || 2 * k == n ? 1.0 : 2.0) / n;
      const Complexes turn = weight * wave(n, static_cast<int>(static_cast<long long>(k) * d % n));
      lag += turn.real() * by_harmonic[at(k)].real() - turn.imag() * by_harmonic[at(k)].imag();
    }
  }
  return out;
}

SolidFields::SolidFields(const SolidRing& ring, std::span<const RingHarmonic> harmonics,
                         double spin)
    : ring_(ring), spin_(spin) {
  const Stiffness stiffness(ring);
  for (int k = 0; k <= ring.n_sectors() / 2; ++k) {
    bool is_static = false;
    const auto z = std::make_shared<Dynamic>(dynamic_of(
        ring, stiffness.at_harmonic(k), find_harmonic(harmonics, k), k, spin, is_static));
    beyond_.emplace_back([z](const VectorXcd& forces) -> VectorXcd { return z->beyond(forces); });
  }
}

MatrixXcd SolidFields::operator()(const MatrixXcd& forces) const {
  const std::vector<Index> rows = contact_rows(ring_);
  MatrixXcd out(ring_.n_rows(), forces.cols());
  VectorXcd all = VectorXcd::Zero(ring_.n_rows());
  for (Index k = 0; k < forces.cols(); ++k) {
    for (std::size_t c = 0; c < rows.size(); ++c) all[rows[c]] = forces(static_cast<Index>(c), k);
    out.col(k) = beyond_[at(k)](all);
  }
  return out;
}

}  // namespace rondo::rom
