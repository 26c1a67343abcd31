// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady/rolling_harmonics.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/statics/imaginary.hpp"
#include "rondo/statics/steady/fourier.hpp"

namespace rondo::statics {
namespace {

using Complexes = std::complex<double>;

std::size_t at(Eigen::Index index) noexcept {
  return static_cast<std::size_t>(index);
}

}  // namespace

RollingHarmonics::RollingHarmonics(RollingBody body)
    : body_(std::move(body)), turn_(body_.stiffness.n_sectors * body_.samples) {
  RONDO_DEMAND(body_.spin != 0.0 && body_.samples >= 1, body_.spin, body_.samples);
  layers_ = rolling_layers(body_.stiffness, body_.reference, body_.mass);
  for (int m = 0; m < turn_; ++m)
    waves_.push_back(std::polar(1.0, 2.0 * std::numbers::pi * m / turn_));
  find_candidates();
  move_masses();
  find_compliance();
  base_ = Block::Zero(n_rows(), 2);
  for (int k = 0; k < 2; ++k) base_.col(k) = solve(layers_, order(k), load_of(k));
  find_weight_torque();
}

bool RollingHarmonics::finite() const noexcept {
  return std::ranges::all_of(history_, [](double x) { return std::isfinite(x); }) &&
         base_.allFinite();
}

/// Minus the power of the weight over s, -2N Re(i R_1ᴴ U_1), and what each force adds to U_1.
void RollingHarmonics::find_weight_torque() {
  const Eigen::VectorXcd load = load_of(1);
  const Complexes factor = -2.0 * i * static_cast<double>(body_.stiffness.n_sectors);
  weight_torque_ = (factor * load.dot(base_.col(1))).real();
  const RollingLayer& last = layers_.back();
  const std::size_t n_transfers = transfer_size(layers_);
  for (Eigen::Index c = 0; c < surface_[1].cols(); ++c) {
    Eigen::VectorXcd u = Eigen::VectorXcd::Zero(n_rows());
    u.segment(last.first, last.size) = surface_[1].col(c) / static_cast<double>(turn_);
    follow(layers_, std::span(transfers_).subspan(n_transfers, n_transfers),
           {u.data(), at(u.size())});
    weight_by_force_.push_back(factor * load.dot(u));
  }
}

Vec2 RollingHarmonics::weight_torque(std::size_t a, int sample) const noexcept {
  const Complexes back = std::conj(waves_[at((sample % turn_ + turn_) % turn_)]);
  return {(weight_by_force_[2 * a] * back).real(), (weight_by_force_[2 * a + 1] * back).real()};
}

void RollingHarmonics::find_candidates() {
  for (const int row : body_.candidates) {
    RONDO_DEMAND(2 * row >= layers_.back().first, row);
    local_.push_back(2 * row - layers_.back().first);
  }
}

/// A candidate's mass to the row of the layer below that is nearest in angle.
void RollingHarmonics::move_masses() {
  if (!body_.massless) return;
  RONDO_DEMAND(layers_.size() >= 2);
  RollingLayer &below = layers_[layers_.size() - 2], &last = layers_.back();
  const auto place = [&](const RollingLayer& layer, std::size_t a) {
    return body_.reference[body_.stiffness.node(at(layer.first / 2) + a, 0)];
  };
  for (const Eigen::Index number : local_) {
    const Vec2 x = place(last, at(number / 2));
    std::size_t best = 0;
    double most = -2.0;
    for (std::size_t b = 0; b < below.mass.size(); ++b) {
      const Vec2 y = place(below, b);
      const double cosine = dot(x, y) / (norm(x) * norm(y));
      if (cosine > most) most = cosine, best = b;
    }
    below.mass[best] += std::exchange(last.mass[at(number / 2)], 0.0);
  }
}

/// The highest of an even turn has no derivative.
RollingOrder RollingHarmonics::order(int k) const noexcept {
  const Complexes turn = waves_[static_cast<std::size_t>(k) * at(body_.samples) % waves_.size()];
  return {{std::conj(turn), 1.0, turn},
          2 * k == turn_ ? 0.0 : k * body_.spin,
          body_.spin,
          body_.mass_damping,
          body_.stiffness_damping};
}

/// One inverse real transform of the candidates' rows of Z_k⁻¹ over the harmonics.
void RollingHarmonics::find_compliance() {
  const std::size_t n = 2 * n_candidates(), length = at(turn_), half = length / 2 + 1;
  const std::size_t n_transfers = transfer_size(layers_);
  transfers_.resize(half * n_transfers);
  surface_.resize(half);
  std::vector<Complexes> spectra(n * n * half);
#pragma omp parallel for num_threads(body_.threads) schedule(static)
  for (std::size_t k = 0; k < half; ++k) {
    const Block g = eliminate(layers_, order(static_cast<int>(k)),
                              std::span(transfers_).subspan(k * n_transfers, n_transfers));
    Block& surface = surface_[k];
    surface.resize(g.rows(), static_cast<Eigen::Index>(n));
    for (std::size_t c = 0; c < n; ++c) {
      const auto column = static_cast<Eigen::Index>(c);
      surface.col(column) = g.col(local_[c / 2] + column % 2);
      for (std::size_t r = 0; r < n; ++r)
        spectra[(r * n + c) * half + k] =
            surface(local_[r / 2] + static_cast<Eigen::Index>(r % 2), column) /
            static_cast<double>(length);
    }
  }
  history_.resize(n * n * length);
  const int size = turn_;
  transform_once([&] {
    return fftw_plan_many_dft_c2r(
        1, &size, static_cast<int>(n * n), reinterpret_cast<fftw_complex*>(spectra.data()), nullptr,
        1, static_cast<int>(half), history_.data(), nullptr, 1, size, FFTW_ESTIMATE);
  });
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

/// Spin and constant loads in harmonic 0; gravity, which turns past the sectors, in harmonic 1:
/// R(-ψ)(0, -mg) = -mg (sin ψ, cos ψ).
Eigen::VectorXcd RollingHarmonics::load_of(int k) const {
  const fem::SectorStiffness& stiffness = body_.stiffness;
  const double s = body_.spin;
  Eigen::VectorXcd f = Eigen::VectorXcd::Zero(n_rows());
  for (const RollingLayer& layer : layers_)
    for (std::size_t b = 0; b < layer.mass.size(); ++b) {
      const std::size_t a = at(layer.first / 2) + b;
      const auto row = static_cast<Eigen::Index>(2 * a);
      const double m = layer.mass[b];
      if (k == 1) {
        f[row] = 0.5 * i * (m * body_.gravity);
        f[row + 1] = -0.5 * (m * body_.gravity);
        continue;
      }
      const Vec2 load = body_.load.empty() ? Vec2{} : body_.load[a];
      const Vec2 x = body_.reference[stiffness.node(a, 0)];
      f[row] = s * s * m * x.x + load.x;
      f[row + 1] = s * s * m * x.y + load.y;
    }
  return f;
}

Vec2 RollingHarmonics::place(std::size_t a, int sample) const noexcept {
  const int row = body_.candidates[a];
  const Vec2 x = body_.reference[body_.stiffness.node(static_cast<std::size_t>(row), 0)];
  const Complexes wave = 2.0 * waves_[at((sample % turn_ + turn_) % turn_)];
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
  transform_once([&] {
    return fftw_plan_many_dft_r2c(1, &size, static_cast<int>(n), in.data(), nullptr, 1, size,
                                  reinterpret_cast<fftw_complex*>(forces.data()), nullptr, 1,
                                  static_cast<int>(half), FFTW_ESTIMATE);
  });
  Block u = Block::Zero(n_rows(), static_cast<Eigen::Index>(half));
  const RollingLayer& last = layers_.back();
  const std::size_t n_transfers = transfer_size(layers_);
#pragma omp parallel for num_threads(body_.threads) schedule(static)
  for (Eigen::Index k = 0; k < u.cols(); ++k) {
    u.col(k).segment(last.first, last.size) =
        surface_[at(k)] * forces.row(k).transpose() / static_cast<double>(turn_);
    follow(layers_, std::span(transfers_).subspan(at(k) * n_transfers, n_transfers),
           {u.col(k).data(), at(u.rows())});
    if (k < 2) u.col(k) += base_.col(k);
  }
  return u;
}

Eigen::MatrixXd RollingHarmonics::fields(Eigen::Ref<const Block> spectrum, double chi,
                                         bool rate) const {
  Block turned = spectrum.transpose();  // a column a row's component
  for (Eigen::Index k = 0; k < turned.rows(); ++k) {
    const bool last = 2 * k == turn_;  // has no derivative, and no phase
    const auto order = static_cast<double>(k);
    const Complexes phase = last ? Complexes{1.0, 0.0} : std::polar(1.0, order * chi);
    turned.row(k) *= rate ? (last ? Complexes{} : i * order * phase) : phase;
  }
  Eigen::MatrixXd out(turn_, turned.cols());
  const int size = turn_;
  transform_once([&] {
    return fftw_plan_many_dft_c2r(
        1, &size, static_cast<int>(turned.cols()), reinterpret_cast<fftw_complex*>(turned.data()),
        nullptr, 1, static_cast<int>(turned.rows()), out.data(), nullptr, 1, size, FFTW_ESTIMATE);
  });
  return out.transpose();
}

RollingHarmonics::Damped RollingHarmonics::damped(const Block& spectrum) const {
  std::vector<RollingNorms> norms(at(spectrum.cols()));
#pragma omp parallel for num_threads(body_.threads) schedule(static)
  for (Eigen::Index k = 1; k < spectrum.cols(); ++k)
    norms[at(k)] = norms_of(layers_, order(static_cast<int>(k)), spectrum.col(k));
  Damped d;
  for (int k = 1; 2 * k < turn_; ++k) {
    const RollingNorms& of = norms[static_cast<std::size_t>(k)];
    const double both = 2.0 * body_.stiffness.n_sectors * std::pow(k * body_.spin, 2);  // k and -k
    d.by_mass += both * body_.mass_damping * of.mass;
    d.by_stiffness += both * body_.stiffness_damping * of.stiffness;
  }
  return d;
}

/// N Σ R_kᴴ (iks U_k) over k = 1 and -1.
double RollingHarmonics::weight(const Block& spectrum) const {
  const Complexes power = load_of(1).dot(spectrum.col(1)) * (i * body_.spin);
  return 2.0 * body_.stiffness.n_sectors * power.real();
}

}  // namespace rondo::statics
