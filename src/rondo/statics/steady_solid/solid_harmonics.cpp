// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady_solid/solid_harmonics.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/process_wide.hpp"
#include "rondo/statics/imaginary.hpp"
#include "rondo/statics/steady/fourier.hpp"

namespace rondo::statics {
namespace {

using Complexes = std::complex<double>;
using Eigen::Index;

/// Above it, transfers of the harmonics are made anew wherever fields are asked for [B].
constexpr double most_kept = 2.5e8;

std::size_t at(Index index) noexcept {
  return static_cast<std::size_t>(index);
}

fftw_complex* raw(Complexes* values) noexcept {
  return reinterpret_cast<fftw_complex*>(values);
}

}  // namespace

SolidHarmonics::SolidHarmonics(SolidRollingBody body)
    : body_(std::move(body)), turn_(body_.stiffness.n_sectors * body_.samples) {
  RONDO_DEMAND(body_.spin != 0.0 && body_.samples >= 1, body_.spin, body_.samples);
  RONDO_DEMAND(!body_.candidates.empty());
  const OneBlasThread one_thread;
  layers_ = solid_layers(body_.stiffness, body_.candidates, body_.mass);
  for (int m = 0; m < turn_; ++m)
    waves_.push_back(std::polar(1.0, 2.0 * std::numbers::pi * m / turn_));
  if (body_.massless) move_masses();
  find_compliance();
  find_bases();
}

bool SolidHarmonics::finite() const noexcept {
  return std::ranges::all_of(history_, [](double x) { return std::isfinite(x); }) &&
         constant_.allFinite() && leaning_.allFinite() && turning_.allFinite();
}

Vec3 SolidHarmonics::reference(std::size_t a) const noexcept {
  const std::size_t node = body_.stiffness.node(at(body_.candidates[a]), 0);
  return {body_.reference[node], body_.axial[node]};
}

/// A candidate's mass to the row of the layer below that is nearest to it.
void SolidHarmonics::move_masses() {
  RONDO_DEMAND(layers_.size() >= 2);
  SolidLayer &below = layers_[layers_.size() - 2], &last = layers_.back();
  const auto place = [&](int row) {
    const std::size_t node = body_.stiffness.node(at(row), 0);
    return Vec3{body_.reference[node], body_.axial[node]};
  };
  for (std::size_t a = 0; a < last.rows.size(); ++a) {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t b = 0; b < below.rows.size(); ++b) {
      const double distance = norm(place(below.rows[b]) - place(last.rows[a]));
      if (distance < least) least = distance, best = b;
    }
    below.mass[best] += std::exchange(last.mass[a], 0.0);
  }
}

/// The highest of an even turn has no derivative.
RollingOrder SolidHarmonics::order(int k) const noexcept {
  const Complexes turn = waves_[static_cast<std::size_t>(k) * at(body_.samples) % waves_.size()];
  return {{std::conj(turn), 1.0, turn},
          2 * k == turn_ ? 0.0 : k * body_.spin,
          body_.spin,
          body_.mass_damping,
          body_.stiffness_damping};
}

bool SolidHarmonics::keeps_transfers() const noexcept {
  double size = 0.0;
  for (std::size_t l = 1; l < layers_.size(); ++l)
    size += static_cast<double>(layers_[l - 1].size() * layers_[l].size());
  const int harmonics = turn_ / 2 + 1;
  return size * harmonics * sizeof(Complexes) <= most_kept;
}

/// One inverse real transform of the candidates' Z_k⁻¹ over the harmonics.
void SolidHarmonics::find_compliance() {
  const std::size_t n = 3 * n_candidates(), length = at(turn_), half = length / 2 + 1;
  surface_.resize(half);
  const bool keep = keeps_transfers();
  if (keep) transfers_.resize(half);
  std::vector<Complexes> spectra(n * n * half);
#pragma omp parallel for num_threads(body_.threads) schedule(static)
  for (std::size_t k = 0; k < half; ++k) {
    SolidElimination e(layers_, order(static_cast<int>(k)));
    surface_[k] = e.surface();
    if (keep) transfers_[k] = std::move(e.transfers());
    Eigen::Map<Block>(spectra.data() + k * n * n, surface_[k].rows(), surface_[k].cols()) =
        surface_[k] / static_cast<double>(length);
  }
  history_.resize(n * n * length);
  const int size = turn_, many = static_cast<int>(n * n);
  transform_once([&] {
    return fftw_plan_many_dft_c2r(1, &size, many, raw(spectra.data()), nullptr, many, 1,
                                  history_.data(), nullptr, many, 1, FFTW_ESTIMATE);
  });
}

Eigen::Matrix3d SolidHarmonics::compliance(std::size_t a, std::size_t b, int ahead) const noexcept {
  const auto n = static_cast<Index>(3 * n_candidates());
  const Index from = static_cast<Index>(wrapped(ahead)) * n * n;
  return Eigen::Map<const Eigen::MatrixXd>(history_.data() + from, n, n)
      .block<3, 3>(static_cast<Index>(3 * a), static_cast<Index>(3 * b));
}

/// Of spin, and loads that are the same in all sectors.
Eigen::VectorXcd SolidHarmonics::constant_load() const {
  const double spin = body_.spin;
  Eigen::VectorXcd f = Eigen::VectorXcd::Zero(n_rows());
  for (const SolidLayer& layer : layers_)
    for (std::size_t b = 0; b < layer.rows.size(); ++b) {
      const std::size_t a = at(layer.rows[b]);
      const Vec3 load = body_.load.empty() ? Vec3{} : body_.load[a];
      const Vec2 pull = spin * spin * layer.mass[b] * body_.reference[body_.stiffness.node(a, 0)];
      f.segment<3>(static_cast<Index>(3 * a)) << pull.x + load.x, pull.y + load.y, load.z;
    }
  return f;
}

/// Of an acceleration of 1: along -z it is in harmonic 0; along -y it turns past the sectors, in
/// harmonic 1: R(-ψ)(0, -m) = -m (sin ψ, cos ψ).
Eigen::VectorXcd SolidHarmonics::weight_load(bool axial) const {
  Eigen::VectorXcd f = Eigen::VectorXcd::Zero(n_rows());
  for (const SolidLayer& layer : layers_)
    for (std::size_t b = 0; b < layer.rows.size(); ++b) {
      const Index row = 3 * layer.rows[b];
      const double m = layer.mass[b];
      if (axial) {
        f[row + 2] = -m;
      } else {
        f[row] = 0.5 * i * m;
        f[row + 1] = -0.5 * m;
      }
    }
  return f;
}

/// The torque of the weight is minus its power over s, -2N Re(i R_1ᴴ U_1).
void SolidHarmonics::find_bases() {
  const SolidElimination zero(layers_, order(0));
  SolidElimination one(layers_, order(1));
  const Eigen::VectorXcd load = weight_load(false);
  constant_ = zero.solve(constant_load());
  leaning_ = zero.solve(weight_load(true));
  turning_ = one.solve(load);
  const Complexes factor = -2.0 * i * static_cast<double>(body_.stiffness.n_sectors);
  weight_torque_ = (factor * load.dot(turning_)).real();
  for (Index c = 0; c < surface_[1].cols(); ++c) {
    Eigen::VectorXcd u = Eigen::VectorXcd::Zero(n_rows());
    for (std::size_t a = 0; a < n_candidates(); ++a)
      u.segment<3>(3 * body_.candidates[a]) =
          surface_[1].col(c).segment<3>(static_cast<Index>(3 * a)) / static_cast<double>(turn_);
    follow(layers_, one.transfers(), u);
    weight_by_force_.push_back(factor * load.dot(u));
  }
}

Vec3 SolidHarmonics::weight_torque(std::size_t a, int sample) const noexcept {
  const Complexes back = std::conj(waves_[wrapped(sample)]);
  const auto along = [&](std::size_t c) { return (weight_by_force_[3 * a + c] * back).real(); };
  return {along(0), along(1), along(2)};
}

Vec3 SolidHarmonics::displacement(std::size_t a, int sample, SolidGravity g) const noexcept {
  const Complexes wave = 2.0 * waves_[wrapped(sample)];
  const auto along = [&](int component) {
    const Index n = 3 * body_.candidates[a] + component;
    return constant_[n].real() + g.axial * leaning_[n].real() +
           g.down * (turning_[n] * wave).real();
  };
  return {along(0), along(1), along(2)};
}

SolidHarmonics::Block SolidHarmonics::spectrum(const Eigen::MatrixXd& force, SolidGravity g) const {
  const std::size_t length = at(turn_), half = length / 2 + 1, n = 3 * n_candidates();
  RONDO_DEMAND(at(force.rows()) == n && at(force.cols()) == length, force.rows(), force.cols());
  const OneBlasThread one_thread;
  Eigen::MatrixXd in = force.transpose();  // a column a component
  Block forces(static_cast<Index>(half), static_cast<Index>(n));
  const int size = turn_;
  transform_once([&] {
    return fftw_plan_many_dft_r2c(1, &size, static_cast<int>(n), in.data(), nullptr, 1, size,
                                  raw(forces.data()), nullptr, 1, static_cast<int>(half),
                                  FFTW_ESTIMATE);
  });
  Block u = Block::Zero(n_rows(), static_cast<Index>(half));
#pragma omp parallel for num_threads(body_.threads) schedule(static)
  for (Index k = 0; k < u.cols(); ++k) {
    const Eigen::VectorXcd surface =
        surface_[at(k)] * forces.row(k).transpose() / static_cast<double>(turn_);
    for (std::size_t a = 0; a < n_candidates(); ++a)
      u.col(k).segment<3>(3 * body_.candidates[a]) = surface.segment<3>(static_cast<Index>(3 * a));
    if (transfers_.empty()) {
      SolidElimination e(layers_, order(static_cast<int>(k)));
      follow(layers_, e.transfers(), u.col(k));
    } else {
      follow(layers_, transfers_[at(k)], u.col(k));
    }
  }
  u.col(0) += constant_ + g.axial * leaning_;
  u.col(1) += g.down * turning_;
  return u;
}

Eigen::MatrixXd SolidHarmonics::fields(Eigen::Ref<const Block> spectrum, bool rate) const {
  Block turned = spectrum.transpose();  // a column a row's component
  for (Index k = 0; rate && k < turned.rows(); ++k)
    turned.row(k) *= 2 * k == turn_ ? Complexes{} : i * static_cast<double>(k);
  Eigen::MatrixXd out(turn_, turned.cols());
  const int size = turn_;
  transform_once([&] {
    return fftw_plan_many_dft_c2r(1, &size, static_cast<int>(turned.cols()), raw(turned.data()),
                                  nullptr, 1, static_cast<int>(turned.rows()), out.data(), nullptr,
                                  1, size, FFTW_ESTIMATE);
  });
  return out.transpose();
}

SolidHarmonics::Damped SolidHarmonics::damped(const Block& spectrum) const {
  std::vector<RollingNorms> norms(at(spectrum.cols()));
#pragma omp parallel for num_threads(body_.threads) schedule(static)
  for (Index k = 1; k < spectrum.cols(); ++k)
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
double SolidHarmonics::weight(const Block& spectrum, SolidGravity g) const {
  const Complexes power = weight_load(false).dot(spectrum.col(1)) * (i * body_.spin);
  return 2.0 * body_.stiffness.n_sectors * g.down * power.real();
}

}  // namespace rondo::statics
