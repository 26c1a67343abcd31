// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/wheel/ring_harmonics.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/dense.hpp"
#include "rondo/core/index.hpp"
#include "rondo/rom/wheel/base/ring_rows.hpp"
#include "rondo/rom/wheel/creep/creep_pair.hpp"
#include "rondo/rom/wheel/ring_waves.hpp"

namespace rondo::rom {
namespace {

using Complexes = std::complex<double>;
using Eigen::Index, Eigen::MatrixXcd, Eigen::VectorXcd, Eigen::VectorXd;

constexpr Complexes i{0.0, 1.0};

Complexes wave(int n, int k) {
  return std::polar(1.0, 2.0 * std::numbers::pi * k / n);
}

/// Rows of the nodes with mass, and of the contact nodes: both components of each node.
struct Parts {
  std::vector<Index> inner, contact;

  explicit Parts(const Ring& ring) : inner(inner_rows(ring)), contact(contact_rows(ring)) {}
};

/// The eigenproblem of the nodes with mass, contact nodes condensed; M^½ φ_i are its vectors.
struct Condensed {
  MatrixXcd matrix;  ///< M^-½ (K_ii - K_ic K_cc⁻¹ K_ci) M^-½
  MatrixXcd follow;  ///< φ_c = follow φ_i
  VectorXd root;     ///< (inner) √M

  Condensed(const Ring& ring, const Parts& parts, int k) {
    const MatrixXcd all = stiffness_of(ring, k);
    const MatrixXcd k_ci = all(parts.contact, parts.inner);
    follow = -solve_definite(all(parts.contact, parts.contact), k_ci);
    root = masses(ring)(parts.inner).cwiseSqrt();
    const MatrixXcd condensed = all(parts.inner, parts.inner) + k_ci.adjoint() * follow;
    const VectorXd scale = root.cwiseInverse();
    matrix = scale.asDiagonal() * condensed * scale.asDiagonal();
    matrix = (0.5 * (matrix + matrix.adjoint())).eval();
  }
  /// (rows, r) φ. @param shapes (inner, r) M^½ φ_i
  [[nodiscard]] MatrixXcd all_rows(const Ring& ring, const Parts& parts,
                                   const MatrixXcd& shapes) const {
    const MatrixXcd inner = root.cwiseInverse().asDiagonal() * shapes;
    MatrixXcd all(ring.n_rows(), shapes.cols());
    all(parts.inner, Eigen::all) = inner;
    all(parts.contact, Eigen::all) = follow * inner;
    return all;
  }
};

RingHarmonic harmonic_of(const Ring& ring, const Parts& parts, int k, Index n_modes) {
  const Condensed c(ring, parts, k);
  const Axes<MatrixXcd> axes = axes_of(c.matrix);
  return make_harmonic(ring, k, axes.values.head(n_modes),
                       c.all_rows(ring, parts, axes.vectors.leftCols(n_modes)));
}

/// How many eigenvalues of a Hermitian matrix are negative.
Index n_negative(const MatrixXcd& z) {
  if (z.size() == 0) return 0;
  return (eigenvalues_of(z).array() < 0.0).count();
}

/// Z_k of the ring and of the modes, at the rate ks and the spin s.
struct Dynamic {
  MatrixXcd ring, modes;

  /// @param inertia share of it that is counted
  Dynamic(const Ring& of, const RingHarmonic* h, int k, double spin, double rate,
          double inertia = 1.0) {
    const double straight = inertia * (spin * spin + rate * rate),
                 across = inertia * 2.0 * rate * spin;
    const VectorXd m = masses(of);
    ring = stiffness_of(of, k);
    for (Index a = 0; a < ring.rows(); ++a) ring(a, a) -= straight * m[a];
    for (Index a = 0; a < ring.rows(); a += 2) {
      ring(a, a + 1) -= i * across * m[a];
      ring(a + 1, a) += i * across * m[a];
    }
    if (!h) return;
    modes = i * across * h->coriolis;
    modes.diagonal() += (h->squares.array() - straight).matrix();
  }
  /// The convected form says what a pattern does that came from rest only if no mode that is left
  /// out has passed its critical spin.
  [[nodiscard]] bool has_meaning() const { return n_negative(ring) == n_negative(modes); }
  /// (rows, 2C) What unit forces on the contact nodes do beyond the modes.
  [[nodiscard]] MatrixXcd beyond(const RingHarmonic* h, const MatrixXcd& forces) const {
    MatrixXcd g = solve(ring, forces);
    if (h) g -= h->shapes * solve(modes, MatrixXcd(h->contact.adjoint()));
    return g;
  }
};

/// What is summed up of a residual, harmonic by harmonic.
class Lags {
 public:
  Lags(const Ring& ring, const Parts& parts, RingResidual& out) : parts_(parts), out_(out) {
    out_.n_sectors = ring.n_sectors();
    out_.size = ring.n_contact();
    rows_ = ring.n_rows();
    out_.fields.resize(at(out_.n_sectors) * at(out_.size * rows_));
  }
  /// @param g (rows, 2C)
  void add(int k, MatrixXcd g) {
    const MatrixXcd surface = g(parts_.contact, Eigen::all);
    g(parts_.contact, Eigen::all) = 0.5 * (surface + surface.adjoint());
    const int n = out_.n_sectors;
    const double weight = harmonic_weight(k, n) / n;
    for (int d = 0; d < n; ++d) lag(d) += weight * (wave(n, k * d % n) * g).real();
  }
  /// After all harmonics: the rows of the contact nodes as a table of their own.
  void finish() {
    for (int d = 0; d < out_.n_sectors; ++d) {
      const Eigen::MatrixXd block = lag(d)(parts_.contact, Eigen::all);
      out_.blocks.insert(out_.blocks.end(), block.data(), block.data() + block.size());
    }
  }

 private:
  Eigen::Map<Eigen::MatrixXd> lag(int d) {
    return {out_.fields.data() + d * out_.size * rows_, rows_, out_.size};
  }

  const Parts& parts_;
  RingResidual& out_;
  Index rows_ = 0;
};

/// (rows) What the spin does beyond the modes. @param still of harmonic 0
VectorXd by_spin(const Ring& ring, const RingHarmonic* h, const Dynamic& still, double square) {
  const VectorXcd pull = square * (masses(ring).asDiagonal() * reference_of(ring));
  VectorXcd u = solve(still.ring, pull);
  if (h) u -= h->shapes * solve(still.modes, VectorXcd(square * h->reference));
  return u.real();
}

/// (rows, 2C) Both matrices of the answer of Z_k with K g. None: one of them would not be positive.
/// @pre the lags differ
std::optional<CreepPair> exact_creep(const Ring& ring, const RingHarmonic* h, int k, double spin,
                                     const CreepLags& lags, const MatrixXcd& forces,
                                     const Parts& parts) {
  const double rate = k * spin;
  const auto answer = [&](const Complexes& modulus) {
    Dynamic z(ring, h, k, spin, rate);
    z.ring += (modulus - 1.0) * stiffness_of(ring, k);
    if (h) z.modes.diagonal() += (modulus - 1.0) * h->squares;
    return z.beyond(h, forces);
  };
  const Complexes modulus = 1.0 / lags.all();
  const MatrixXcd ahead = answer(modulus), back = answer(std::conj(modulus));
  CreepPair pair = creep_pair(lags, ahead, back);
  if (!is_semidefinite(pair.at_once(parts.contact, Eigen::all)) ||
      !is_semidefinite(pair.later(parts.contact, Eigen::all)))
    return {};
  return pair;
}

}  // namespace

const RingHarmonic* find_harmonic(std::span<const RingHarmonic> harmonics, int k) {
  const auto found = std::ranges::find(harmonics, k, &RingHarmonic::k);
  return found == harmonics.end() ? nullptr : &*found;
}

MatrixXcd stiffness_of(const Ring& ring, int k) {
  const fem::SectorStiffness& stiffness = ring.stiffness;
  MatrixXcd out = MatrixXcd::Zero(ring.n_rows(), ring.n_rows());
  for (std::size_t a = 0; a < stiffness.n_local(); ++a)
    for (const fem::SectorStiffness::Entry& e : stiffness.row(a))
      out.block<2, 2>(static_cast<Index>(2 * a), 2 * e.column) +=
          wave(ring.n_sectors(), k * e.shift) * Eigen::Map<const Eigen::Matrix2d>(e.block.data());
  return 0.5 * (out + out.adjoint());
}

RingHarmonic make_harmonic(const Ring& ring, int k, VectorXd squares, MatrixXcd shapes) {
  RingHarmonic h;
  h.k = k;
  h.squares = std::move(squares);
  h.shapes = std::move(shapes);
  h.contact = h.shapes(contact_rows(ring), Eigen::all);
  const MatrixXcd weighted = masses(ring).asDiagonal() * h.shapes;
  const MatrixXcd turning = weighted.adjoint() * quarter_turned<2>(h.shapes);
  h.coriolis = 0.5 * (turning - turning.adjoint());
  for (VectorXcd* v : {&h.reference, &h.turned, &h.translation}) v->setZero(h.squares.size());
  const VectorXcd x = reference_of(ring);
  if (k == 0) {
    h.reference = weighted.adjoint() * x;
    h.turned = weighted.adjoint() * quarter_turned<2>(x);
  }
  if (k == 1 || ring.n_sectors() == 1) {
    VectorXcd ones(x.size());
    for (Index a = 0; a < ones.size(); a += 2) ones[a] = 1.0, ones[a + 1] = -i;
    h.translation = weighted.transpose() * ones;
  }
  return h;
}

std::vector<Index> inner_rows(const Ring& ring) {
  std::vector<Index> rows;
  for (Index a = 0; a < ring.n_rows() / 2; ++a)
    if (ring.mass[at(a)] != 0.0) rows.insert(rows.end(), {2 * a, 2 * a + 1});
  return rows;
}

RingHarmonic ritz_harmonic(const Ring& ring, int k, const MatrixXcd& shapes) {
  const Parts parts(ring);
  const Condensed c(ring, parts, k);
  const MatrixXcd reduced = shapes.adjoint() * c.matrix * shapes;
  const Axes<MatrixXcd> axes = axes_of(MatrixXcd(0.5 * (reduced + reduced.adjoint())));
  return make_harmonic(ring, k, axes.values, c.all_rows(ring, parts, shapes * axes.vectors));
}

VectorXd frequencies_of(const Ring& ring, int k) {
  const Condensed c(ring, Parts(ring), k);
  return eigenvalues_of(c.matrix).cwiseMax(0.0).cwiseSqrt();
}

std::vector<Index> take_lowest(std::span<const VectorXd> frequencies, const ModeChoice& choice) {
  struct Mode {
    double frequency;
    std::size_t k;
  };
  std::vector<Mode> modes;
  for (std::size_t k = 0; k < frequencies.size(); ++k)
    for (const double frequency : frequencies[k]) modes.push_back({frequency, k});
  std::ranges::stable_sort(modes, {}, &Mode::frequency);
  std::vector<Index> taken(frequencies.size());
  int count = 0;
  for (const Mode& mode : modes) {
    if (count >= choice.wanted || (mode.frequency > choice.highest && count >= choice.fewest))
      break;
    ++taken[mode.k];
    count += mode.k == 0 ? 1 : 2;
  }
  return taken;
}

std::vector<RingHarmonic> ring_modes(const Ring& ring, const ModeChoice& choice) {
  std::vector<VectorXd> frequencies;
  for (int k = 0; 2 * k < ring.n_sectors(); ++k) frequencies.push_back(frequencies_of(ring, k));
  const std::vector<Index> taken = take_lowest(frequencies, choice);
  std::vector<RingHarmonic> harmonics;
  const Parts parts(ring);
  for (std::size_t k = 0; k < taken.size(); ++k)
    if (taken[k] > 0) harmonics.push_back(harmonic_of(ring, parts, static_cast<int>(k), taken[k]));
  return harmonics;
}

int count_modes(std::span<const RingHarmonic> harmonics) noexcept {
  Index n = 0;
  for (const RingHarmonic& h : harmonics) n += (h.k == 0 ? 1 : 2) * h.squares.size();
  return static_cast<int>(n);
}

RingResidual ring_residual(const Ring& ring, std::span<const RingHarmonic> harmonics,
                           double spin_squared, ResidualForm form) {
  const double spin = std::sqrt(spin_squared);
  const Parts parts(ring);
  RingResidual out;
  Lags lags(ring, parts, out);
  const MatrixXcd forces = unit_forces(ring);
  for (int k = 0; 2 * k <= ring.n_sectors(); ++k) {
    const RingHarmonic* h = find_harmonic(harmonics, k);
    const bool rolls = form == ResidualForm::convected && k > 0 && 2 * k < ring.n_sectors();
    Dynamic z(ring, h, k, spin, rolls ? k * spin : 0.0);
    if (rolls && !z.has_meaning()) {
      out.made_static.push_back(k);
      z = Dynamic(ring, h, k, spin, 0.0);
    }
    lags.add(k, z.beyond(h, forces));
    if (k == 0) out.centrifugal = by_spin(ring, h, z, spin_squared);
  }
  lags.finish();
  return out;
}

CreepResidual creep_residual(const Ring& ring, std::span<const RingHarmonic> harmonics,
                             double spin_squared, std::span<const CreepTerm> creep) {
  RONDO_DEMAND(creep.size() >= 2, creep.size());
  const double spin = std::sqrt(spin_squared);
  const Parts parts(ring);
  CreepResidual out;
  Lags at_once(ring, parts, out.at_once), later(ring, parts, out.later);
  const MatrixXcd forces = unit_forces(ring);
  for (int k = 0; 2 * k <= ring.n_sectors(); ++k) {
    const RingHarmonic* h = find_harmonic(harmonics, k);
    const bool rolls = spin > 0.0 && k > 0 && 2 * k < ring.n_sectors();
    const double rate = rolls ? spin * k : 0.0;
    // Forces over g(iks) have the inertia over g too; of it this takes the part in phase.
    Dynamic z(ring, h, k, spin, rate, rolls ? creep_at(creep, rate).real() : 1.0);
    const bool is_static = rolls && !z.has_meaning();
    if (is_static) {
      out.at_once.made_static.push_back(k);
      z = Dynamic(ring, h, k, spin, 0.0);
    }
    std::optional<CreepPair> pair;
    const CreepLags lagging(creep, rate);
    const bool two = rolls && !is_static && lagging.differ();
    if (two) pair = exact_creep(ring, h, k, spin, lagging, forces, parts);
    if (!pair) {
      if (two) out.one_matrix.push_back(k);
      const MatrixXcd g = z.beyond(h, forces);
      pair = CreepPair{g, g};
    }
    at_once.add(k, std::move(pair->at_once));
    later.add(k, std::move(pair->later));
    if (k == 0) out.at_once.centrifugal = by_spin(ring, h, z, spin_squared);
  }
  at_once.finish();
  later.finish();
  return out;
}

}  // namespace rondo::rom
