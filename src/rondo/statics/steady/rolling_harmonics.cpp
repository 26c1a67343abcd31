// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady/rolling_harmonics.hpp"

#include <fftw3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "rondo/core/contract.hpp"

namespace rondo::statics {
namespace {

using Complexes = std::complex<double>;
constexpr Complexes i{0.0, 1.0};

std::size_t at(Eigen::Index index) noexcept {
  return static_cast<std::size_t>(index);
}

/// e^{ik 2π/N shift} of the shifts -1, 0 and 1.
std::array<Complexes, 3> turns_of(int k, int sectors) {
  const Complexes turn = std::polar(1.0, 2.0 * std::numbers::pi * k / sectors);
  return {std::conj(turn), 1.0, turn};
}

}  // namespace

RollingHarmonics::RollingHarmonics(RollingBody body)
    : body_(std::move(body)), turn_(body_.stiffness.n_sectors * body_.samples) {
  RONDO_DEMAND(body_.spin != 0.0 && body_.samples >= 1, body_.spin, body_.samples);
  find_layers();
  move_masses();
  find_compliance();
  const auto size = static_cast<Eigen::Index>(2 * mass_.size());
  base_ = Block::Zero(size, 2);
  for (int k = 0; k < 2; ++k) base_.col(k) = solve(k, load_of(k));
}

/// Rows of the same distance from the center, one above the other.
void RollingHarmonics::find_layers() {
  const fem::SectorStiffness& k = body_.stiffness;
  const auto radius = [&](std::size_t a) { return norm(body_.reference[k.node(a, 0)]); };
  for (std::size_t a = 0; a < k.n_local(); ++a) {
    const bool next = a == 0 || std::abs(radius(a) - radius(a - 1)) > 1e-9 * radius(a);
    if (next) layers_.push_back({static_cast<Eigen::Index>(2 * a), 0});
    layers_.back().size += 2;
  }
  for (const int row : body_.candidates) {
    RONDO_DEMAND(2 * row >= layers_.back().first, row);
    local_.push_back(2 * row - layers_.back().first);
  }
}

/// A candidate's mass to the row of the layer below that is nearest in angle.
void RollingHarmonics::move_masses() {
  const fem::SectorStiffness& k = body_.stiffness;
  for (std::size_t a = 0; a < k.n_local(); ++a) mass_.push_back(body_.mass[k.node(a, 0)]);
  if (!body_.massless) return;
  RONDO_DEMAND(layers_.size() >= 2);
  const Layer& below = layers_[layers_.size() - 2];
  for (const int row : body_.candidates) {
    const Vec2 x = body_.reference[k.node(static_cast<std::size_t>(row), 0)];
    std::size_t best = 0;
    double most = -2.0;
    for (Eigen::Index b = below.first / 2; b < (below.first + below.size) / 2; ++b) {
      const Vec2 y = body_.reference[k.node(at(b), 0)];
      const double cosine = dot(x, y) / (norm(x) * norm(y));
      if (cosine > most) most = cosine, best = at(b);
    }
    mass_[best] += mass_[static_cast<std::size_t>(row)];
    mass_[static_cast<std::size_t>(row)] = 0.0;
  }
}

/// Z_k = K(k)(1 + iksβ) + M(-(ks)² + iks(α + 2sJ) - s²); of the highest of an even turn, which has
/// no derivative, K(k) - s²M.
RollingHarmonics::Block RollingHarmonics::block(int k, const Layer& rows,
                                                const Layer& columns) const {
  const fem::SectorStiffness& stiffness = body_.stiffness;
  const double s = body_.spin;
  const double rate = 2 * k == turn_ ? 0.0 : k * s;
  const Complexes elastic = 1.0 + i * (rate * body_.stiffness_damping);
  const auto turns = turns_of(k, stiffness.n_sectors);
  Block z = Block::Zero(rows.size, columns.size);
  for (Eigen::Index a = rows.first / 2; a < (rows.first + rows.size) / 2; ++a) {
    for (const fem::SectorStiffness::Entry& e : stiffness.row(at(a))) {
      const Eigen::Index row = 2 * a - rows.first, column = 2 * e.column - columns.first;
      if (column < 0 || column >= columns.size) continue;
      const Complexes turned =
          elastic * turns[static_cast<std::size_t>(std::ptrdiff_t{e.shift} + 1)];
      z(row, column) += turned * e.block[0];
      z(row + 1, column) += turned * e.block[1];
      z(row, column + 1) += turned * e.block[2];
      z(row + 1, column + 1) += turned * e.block[3];
    }
    if (rows.first != columns.first) continue;
    const Eigen::Index row = 2 * a - rows.first;
    const double m = mass_[at(a)];
    const Complexes straight = m * (-rate * rate - s * s + i * (rate * body_.mass_damping));
    const Complexes across = m * 2.0 * i * (rate * s);
    z(row, row) += straight;
    z(row + 1, row + 1) += straight;
    z(row, row + 1) -= across;
    z(row + 1, row) += across;
  }
  return z;
}

/// Of the last layer what is left once all below are eliminated.
RollingHarmonics::Block RollingHarmonics::last_layer(int k) const {
  Block s = block(k, layers_[0], layers_[0]);
  for (std::size_t l = 1; l < layers_.size(); ++l) {
    const Block up = block(k, layers_[l], layers_[l - 1]);
    const Block down = block(k, layers_[l - 1], layers_[l]);
    s = block(k, layers_[l], layers_[l]) - up * s.partialPivLu().solve(down);
  }
  return s;
}

/// One inverse real transform of the candidates' rows of Z_k⁻¹ over the harmonics.
void RollingHarmonics::find_compliance() {
  const std::size_t n = 2 * n_candidates(), length = at(turn_), half = length / 2 + 1;
  std::vector<Complexes> spectra(n * n * half);
  for (std::size_t k = 0; k < half; ++k) {
    const Block g = last_layer(static_cast<int>(k)).inverse();
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t c = 0; c < n; ++c) {
        const auto number = [&](std::size_t x) {
          return local_[x / 2] + static_cast<Eigen::Index>(x % 2);
        };
        spectra[(r * n + c) * half + k] = g(number(r), number(c)) / static_cast<double>(length);
      }
  }
  history_.resize(n * n * length);
  const int size = turn_;
  fftw_plan plan = fftw_plan_many_dft_c2r(
      1, &size, static_cast<int>(n * n), reinterpret_cast<fftw_complex*>(spectra.data()), nullptr,
      1, static_cast<int>(half), history_.data(), nullptr, 1, size, FFTW_ESTIMATE);
  fftw_execute(plan);
  fftw_destroy_plan(plan);
}

Eigen::Matrix2d RollingHarmonics::compliance(std::size_t a, std::size_t b,
                                             int ahead) const noexcept {
  const std::size_t n = 2 * n_candidates(), length = at(turn_);
  const auto m = static_cast<std::size_t>((ahead % turn_ + turn_) % turn_);
  const auto entry = [&](std::size_t r, std::size_t c) {
    return history_[((2 * a + r) * n + 2 * b + c) * length + m];
  };
  Eigen::Matrix2d g;
  g << entry(0, 0), entry(0, 1), entry(1, 0), entry(1, 1);
  return g;
}

RollingHarmonics::Eliminated RollingHarmonics::eliminated(int k) const {
  Eliminated e;
  for (std::size_t l = 0; l < layers_.size(); ++l) {
    Block here = block(k, layers_[l], layers_[l]);
    if (l > 0) {
      e.up.push_back(block(k, layers_[l], layers_[l - 1]));
      e.down.push_back(block(k, layers_[l - 1], layers_[l]));
      here -= e.up.back() * e.left.back().solve(e.down.back());
    }
    e.left.emplace_back(here);
  }
  return e;
}

/// U_k under loads on all rows.
Eigen::VectorXcd RollingHarmonics::solve(int k, const Eigen::VectorXcd& load) const {
  const Eliminated e = eliminated(k);
  std::vector<Eigen::VectorXcd> right;
  for (std::size_t l = 0; l < layers_.size(); ++l) {
    right.push_back(load.segment(layers_[l].first, layers_[l].size));
    if (l > 0) right[l] -= e.up[l - 1] * e.left[l - 1].solve(right[l - 1]);
  }
  Eigen::VectorXcd u(load.size());
  for (std::size_t l = layers_.size(); l-- > 0;) {
    if (l + 1 < layers_.size())
      right[l] -= e.down[l] * u.segment(layers_[l + 1].first, layers_[l + 1].size);
    u.segment(layers_[l].first, layers_[l].size) = e.left[l].solve(right[l]);
  }
  return u;
}

/// Spin and constant loads in harmonic 0; gravity, which turns past the sectors, in harmonic 1:
/// R(-ψ)(0, -mg) = -mg (sin ψ, cos ψ).
Eigen::VectorXcd RollingHarmonics::load_of(int k) const {
  const fem::SectorStiffness& stiffness = body_.stiffness;
  const double s = body_.spin;
  Eigen::VectorXcd f = Eigen::VectorXcd::Zero(static_cast<Eigen::Index>(2 * mass_.size()));
  for (std::size_t a = 0; a < mass_.size(); ++a) {
    const auto row = static_cast<Eigen::Index>(2 * a);
    if (k == 1) {
      f[row] = 0.5 * i * (mass_[a] * body_.gravity);
      f[row + 1] = -0.5 * (mass_[a] * body_.gravity);
      continue;
    }
    const Vec2 load = body_.load.empty() ? Vec2{} : body_.load[a];
    const Vec2 x = body_.reference[stiffness.node(a, 0)];
    f[row] = s * s * mass_[a] * x.x + load.x;
    f[row + 1] = s * s * mass_[a] * x.y + load.y;
  }
  return f;
}

Vec2 RollingHarmonics::place(std::size_t a, int sample) const noexcept {
  const int row = body_.candidates[a];
  const Vec2 x = body_.reference[body_.stiffness.node(static_cast<std::size_t>(row), 0)];
  const Complexes wave = 2.0 * std::polar(1.0, 2.0 * std::numbers::pi * sample / turn_);
  const auto along = [&](int component) {
    const Eigen::Index n = 2 * row + component;
    return base_(n, 0).real() + (base_(n, 1) * wave).real();
  };
  return x + Vec2{along(0), along(1)};
}

RollingHarmonics::Block RollingHarmonics::spectrum(const Eigen::MatrixXd& force) const {
  const std::size_t length = at(turn_), half = length / 2 + 1, n = 2 * n_candidates();
  RONDO_DEMAND(at(force.rows()) == n && at(force.cols()) == length, force.rows(), force.cols());
  Eigen::MatrixXd in = force.transpose();  // a column a component
  Block forces(static_cast<Eigen::Index>(half), static_cast<Eigen::Index>(n));
  const int size = turn_;
  fftw_plan plan = fftw_plan_many_dft_r2c(1, &size, static_cast<int>(n), in.data(), nullptr, 1,
                                          size, reinterpret_cast<fftw_complex*>(forces.data()),
                                          nullptr, 1, static_cast<int>(half), FFTW_ESTIMATE);
  fftw_execute(plan);
  fftw_destroy_plan(plan);
  Block u(base_.rows(), static_cast<Eigen::Index>(half));
  for (Eigen::Index k = 0; k < u.cols(); ++k) {
    Eigen::VectorXcd load = Eigen::VectorXcd::Zero(u.rows());
    for (std::size_t c = 0; c < n; ++c)
      load[2 * body_.candidates[c / 2] + static_cast<Eigen::Index>(c % 2)] =
          forces(k, static_cast<Eigen::Index>(c)) / static_cast<double>(turn_);
    u.col(k) = solve(static_cast<int>(k), load);
    if (k < 2) u.col(k) += base_.col(k);
  }
  return u;
}

Eigen::MatrixXd RollingHarmonics::fields(const Block& spectrum, double chi, bool rate) const {
  Block turned = spectrum.transpose();  // a column a row's component
  for (Eigen::Index k = 0; k < turned.rows(); ++k) {
    const bool last = 2 * k == turn_;  // has no derivative, and no phase
    const auto order = static_cast<double>(k);
    const Complexes phase = last ? Complexes{1.0, 0.0} : std::polar(1.0, order * chi);
    turned.row(k) *= rate ? (last ? Complexes{} : i * order * phase) : phase;
  }
  Eigen::MatrixXd out(turn_, turned.cols());
  const int size = turn_;
  fftw_plan plan = fftw_plan_many_dft_c2r(
      1, &size, static_cast<int>(turned.cols()), reinterpret_cast<fftw_complex*>(turned.data()),
      nullptr, 1, static_cast<int>(turned.rows()), out.data(), nullptr, 1, size, FFTW_ESTIMATE);
  fftw_execute(plan);
  fftw_destroy_plan(plan);
  return out.transpose();
}

Eigen::VectorXcd RollingHarmonics::stiffness_product(int k, const Eigen::VectorXcd& u) const {
  const fem::SectorStiffness& stiffness = body_.stiffness;
  const auto turns = turns_of(k, stiffness.n_sectors);
  Eigen::VectorXcd f = Eigen::VectorXcd::Zero(u.size());
  for (std::size_t a = 0; a < mass_.size(); ++a) {
    const auto row = static_cast<Eigen::Index>(2 * a);
    for (const fem::SectorStiffness::Entry& e : stiffness.row(a)) {
      const Complexes turned = turns[static_cast<std::size_t>(std::ptrdiff_t{e.shift} + 1)];
      const Complexes x = turned * u[2 * e.column], y = turned * u[2 * e.column + 1];
      f[row] += e.block[0] * x + e.block[2] * y;
      f[row + 1] += e.block[1] * x + e.block[3] * y;
    }
  }
  return f;
}

RollingHarmonics::Damped RollingHarmonics::damped(const Block& spectrum) const {
  Damped d;
  for (Eigen::Index k = 1; k < spectrum.cols(); ++k) {
    if (2 * k == turn_) continue;
    const Eigen::VectorXcd u = spectrum.col(k);
    const double rate = static_cast<double>(k) * body_.spin;
    double mass = 0.0;
    for (std::size_t a = 0; a < mass_.size(); ++a)
      mass += mass_[a] * u.segment<2>(static_cast<Eigen::Index>(2 * a)).squaredNorm();
    const double both = 2.0 * body_.stiffness.n_sectors * rate * rate;  // k and -k
    d.by_mass += both * body_.mass_damping * mass;
    if (body_.stiffness_damping > 0.0)
      d.by_stiffness +=
          both * body_.stiffness_damping * u.dot(stiffness_product(static_cast<int>(k), u)).real();
  }
  return d;
}

/// N Σ R_kᴴ (iks U_k) over k = 1 and -1.
double RollingHarmonics::weight(const Block& spectrum) const {
  const Complexes power = load_of(1).dot(spectrum.col(1)) * (i * body_.spin);
  return 2.0 * body_.stiffness.n_sectors * power.real();
}

}  // namespace rondo::statics
