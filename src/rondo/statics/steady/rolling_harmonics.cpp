// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady/rolling_harmonics.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/core/process_wide.hpp"
#include "rondo/statics/imaginary.hpp"
#include "rondo/statics/steady/fourier.hpp"

namespace rondo::statics {
namespace {

using Complexes = std::complex<double>;
using Eigen::Index;

/// Above it, transfers of the harmonics are made anew wherever fields are asked for [B].
constexpr double most_kept = 2.5e8;

fftw_complex* raw(Complexes* values) noexcept {
  return reinterpret_cast<fftw_complex*>(values);
}

}  // namespace

template <int D>
RollingHarmonics<D>::RollingHarmonics(RollingBody<D> body)
    : body_(std::move(body)), turn_(body_.stiffness.n_sectors * body_.samples) {
  RONDO_DEMAND(body_.samples >= 1, body_.samples);
  RONDO_DEMAND(body_.spin != 0.0 || body_.inertia == RollingInertia::none, body_.spin);
  RONDO_DEMAND(!body_.candidates.empty());
  const OneBlasThread one_thread;
  layers_ = rolling_layers<D>(body_.stiffness, body_.candidates, body_.mass, body_.viscous);
  for (int m = 0; m < turn_; ++m)
    waves_.push_back(std::polar(1.0, 2.0 * std::numbers::pi * m / turn_));
  if (body_.massless) move_masses();
  find_compliance();
  find_bases();
}

template <int D>
bool RollingHarmonics<D>::finite() const noexcept {
  return std::ranges::all_of(history_, [](double x) { return std::isfinite(x); }) &&
         constant_.allFinite() && leaning_.allFinite() && turning_.allFinite();
}

/// A candidate's mass goes to the row of the layer below that is nearest to it.
template <int D>
void RollingHarmonics<D>::move_masses() {
  RONDO_DEMAND(layers_.size() >= 2);
  RollingLayer<D>&below = layers_[layers_.size() - 2], &last = layers_.back();
  for (std::size_t a = 0; a < last.rows.size(); ++a) {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t b = 0; b < below.rows.size(); ++b) {
      const double distance = (body_.place(below.rows[b]) - body_.place(last.rows[a])).norm();
      if (distance < least) least = distance, best = b;
    }
    below.mass[best] += std::exchange(last.mass[a], 0.0);
  }
}

template <int D>
bool RollingHarmonics<D>::has_inertia(int k) const noexcept {
  if (body_.inertia == RollingInertia::waves) return 2 * k <= body_.stiffness.n_sectors;
  return body_.inertia == RollingInertia::all;
}

/// The highest of an even turn has no derivative.
template <int D>
RollingOrder RollingHarmonics<D>::order(int k) const noexcept {
  const Complexes turn = waves_[static_cast<std::size_t>(k) * at(body_.samples) % waves_.size()];
  RollingOrder order{{std::conj(turn), 1.0, turn},
                     2 * k == turn_ ? 0.0 : k * body_.spin,
                     body_.spin,
                     body_.mass_damping,
                     body_.stiffness_damping,
                     has_inertia(k)};
  for (const fem::ViscousPart<fem::SectorBlocks<D>>& part : body_.viscous)
    order.viscous.push_back(fem::branch_modulus(part.branches, order.rate));
  return order;
}

/// One inverse real transform of the candidates' Z_k⁻¹ over the harmonics.
template <int D>
void RollingHarmonics<D>::find_compliance() {
  const std::size_t n = D * n_candidates(), length = at(turn_), half = length / 2 + 1;
  const std::size_t size = transfer_size(layers_);
  const bool keep = static_cast<double>(size * half * sizeof(Complexes)) <= most_kept;
  if (keep) transfers_.resize(half * size);
  surface_.resize(half);
  std::vector<Complexes> spectra(n * n * half);
  const Strides in = strides(n * n, half), out = strides(n * n, length);
#pragma omp parallel for num_threads(body_.threads) schedule(static)
  for (std::size_t k = 0; k < half; ++k) {
    std::vector<Complexes> own(keep ? 0 : size);
    surface_[k] = eliminate(layers_, order(static_cast<int>(k)),
                            keep ? std::span(transfers_).subspan(k * size, size) : std::span(own));
    for (std::size_t e = 0; e < n * n; ++e)
      spectra[e * in.entry + k * in.place] = surface_[k].data()[e] / static_cast<double>(length);
  }
  history_.resize(n * n * length);
  transform_once([&] {
    return fftw_plan_many_dft_c2r(1, &turn_, static_cast<int>(n * n), raw(spectra.data()), nullptr,
                                  static_cast<int>(in.place), static_cast<int>(in.entry),
                                  history_.data(), nullptr, static_cast<int>(out.place),
                                  static_cast<int>(out.entry), FFTW_ESTIMATE);
  });
}

template <int D>
NodeMatrix<D> RollingHarmonics<D>::compliance(std::size_t a, std::size_t b,
                                              int ahead) const noexcept {
  const std::size_t n = D * n_candidates();
  const Strides of = strides(n * n, at(turn_));
  const double* from = history_.data() + wrapped(ahead) * of.place;
  NodeMatrix<D> g;
  for (std::size_t c = 0; c < D; ++c)
    for (std::size_t r = 0; r < D; ++r)
      g.data()[D * c + r] = from[((D * b + c) * n + D * a + r) * of.entry];
  return g;
}

/// Forces of the spin, and loads that are the same in all sectors.
template <int D>
Eigen::VectorXcd RollingHarmonics<D>::constant_load() const {
  Eigen::VectorXcd f = Eigen::VectorXcd::Zero(n_rows());
  const double squares = body_.spin * body_.spin - body_.rest_spin * body_.rest_spin;
  for (const RollingLayer<D>& layer : layers_)
    for (std::size_t b = 0; b < layer.rows.size(); ++b) {
      const std::size_t a = at(layer.rows[b]);
      NodeVector<D> pull = squares * layer.mass[b] * body_.place(layer.rows[b]);
      if constexpr (D == 3) pull[2] = 0.0;
      if (!body_.load.empty()) pull += node_vector(body_.load[a]);
      f.segment<D>(static_cast<Index>(D * a)) = pull;
    }
  return f;
}

/// Force of an acceleration of 1: along -z in harmonic 0; along -y it turns past the sectors, in
/// harmonic 1: R(-ψ)(0, -m) = -m (sin ψ, cos ψ).
template <int D>
Eigen::VectorXcd RollingHarmonics<D>::weight_load(bool axial) const {
  Eigen::VectorXcd f = Eigen::VectorXcd::Zero(n_rows());
  for (const RollingLayer<D>& layer : layers_)
    for (std::size_t b = 0; b < layer.rows.size(); ++b) {
      const Index row = D * layer.rows[b];
      const double m = layer.mass[b];
      if (axial) {
        f[row + D - 1] = -m;
      } else {
        f[row] = 0.5 * i * m;
        f[row + 1] = -0.5 * m;
      }
    }
  return f;
}

/// Displacement of all rows in harmonic k, once those of the candidates are there.
template <int D>
void RollingHarmonics<D>::follow_candidates(int k, const Eigen::VectorXcd& surface,
                                            Eigen::Ref<Eigen::VectorXcd> u) const {
  for (std::size_t a = 0; a < n_candidates(); ++a)
    u.segment<D>(D * body_.candidates[a]) = surface.segment<D>(static_cast<Index>(D * a));
  const std::size_t size = transfer_size(layers_);
  if (transfers_.empty()) {
    std::vector<Complexes> own(size);
    static_cast<void>(eliminate(layers_, order(k), std::span(own)));
    follow(layers_, std::span<const Complexes>(own), u);
  } else {
    follow(layers_, std::span(transfers_).subspan(at(k) * size, size), u);
  }
}

/// The torque of the weight is minus its power over s, -2N Re(i R_1ᴴ U_1).
template <int D>
void RollingHarmonics<D>::find_bases() {
  const Eigen::VectorXcd load = weight_load(false);
  const RollingFactors<D> alike(layers_, order(0));
  constant_ = alike.solve(layers_, constant_load());
  if constexpr (D == 3) leaning_ = alike.solve(layers_, weight_load(true));
  turning_ = RollingFactors<D>(layers_, order(1)).solve(layers_, load);
  const Complexes factor = -2.0 * i * static_cast<double>(body_.stiffness.n_sectors);
  weight_torque_ = (factor * load.dot(turning_)).real();
  for (Index c = 0; c < surface_[1].cols(); ++c) {
    Eigen::VectorXcd u = Eigen::VectorXcd::Zero(n_rows());
    follow_candidates(1, surface_[1].col(c) / static_cast<double>(turn_), u);
    weight_by_force_.push_back(factor * load.dot(u));
  }
}

template <int D>
NodeVector<D> RollingHarmonics<D>::weight_torque(std::size_t a, int sample) const noexcept {
  const Complexes back = std::conj(waves_[wrapped(sample)]);
  NodeVector<D> torque;
  for (Index c = 0; c < D; ++c) torque[c] = (weight_by_force_[D * a + at(c)] * back).real();
  return torque;
}

template <int D>
NodeVector<D> RollingHarmonics<D>::displacement(std::size_t a, int sample,
                                                RollingGravity g) const noexcept {
  const Complexes wave = 2.0 * waves_[wrapped(sample)];
  NodeVector<D> u;
  for (Index c = 0; c < D; ++c) {
    const Index n = D * body_.candidates[a] + c;
    u[c] = constant_[n].real() + g.down * (turning_[n] * wave).real();
    if constexpr (D == 3) u[c] += g.axial * leaning_[n].real();
  }
  return u;
}

/// (L/2 + 1, rows) of the rows of a field.
template <int D>
typename RollingHarmonics<D>::Block RollingHarmonics<D>::transformed(
    const Eigen::MatrixXd& field) const {
  const auto n = static_cast<int>(field.rows()), half = turn_ / 2 + 1;
  RONDO_DEMAND(field.cols() == turn_, field.cols(), turn_);
  Eigen::MatrixXd in = field.transpose();  // a column a component
  Block out(half, n);
  transform_once([&] {
    return fftw_plan_many_dft_r2c(1, &turn_, n, in.data(), nullptr, 1, turn_, raw(out.data()),
                                  nullptr, 1, half, FFTW_ESTIMATE);
  });
  return out / static_cast<double>(turn_);
}

template <int D>
typename RollingHarmonics<D>::Block RollingHarmonics<D>::spectrum(const Eigen::MatrixXd& force,
                                                                  RollingGravity g) const {
  RONDO_DEMAND(at(force.rows()) == D * n_candidates(), force.rows(), n_candidates());
  const OneBlasThread one_thread;
  const Block forces = transformed(force);
  Block u = Block::Zero(n_rows(), forces.rows());
#pragma omp parallel for num_threads(body_.threads) schedule(static)
  for (Index k = 0; k < u.cols(); ++k)
    follow_candidates(static_cast<int>(k), surface_[at(k)] * forces.row(k).transpose(), u.col(k));
  u.col(0) += constant_;
  if constexpr (D == 3) u.col(0) += g.axial * leaning_;
  u.col(1) += g.down * turning_;
  return u;
}

template <int D>
std::vector<Index> RollingHarmonics<D>::candidate_rows() const {
  std::vector<Index> rows;
  for (const int a : body_.candidates)
    for (Index i = 0; i < D; ++i) rows.push_back(D * a + i);
  return rows;
}

template <int D>
typename RollingHarmonics<D>::Block RollingHarmonics<D>::on_candidates(
    const Block& spectrum) const {
  return spectrum(candidate_rows(), Eigen::all);
}

template <int D>
Eigen::MatrixXd RollingHarmonics<D>::on_candidates(const Eigen::MatrixXd& field) const {
  return field(candidate_rows(), Eigen::all);
}

template <int D>
void RollingHarmonics<D>::keep_factors() {
  if (!factors_.empty()) return;
  const OneBlasThread one_thread;
  std::vector<std::optional<RollingFactors<D>>> made(at(turn_) / 2 + 1);
#pragma omp parallel for num_threads(body_.threads) schedule(static)
  for (std::size_t k = 0; k < made.size(); ++k)
    made[k].emplace(layers_, order(static_cast<int>(k)));
  for (auto& factors : made) factors_.push_back(std::move(*factors));
}

template <int D>
std::size_t RollingHarmonics<D>::factors_memory() const noexcept {
  return (at(turn_) / 2 + 1) * factors_size(layers_) * sizeof(Complexes);
}

template <int D>
typename RollingHarmonics<D>::Block RollingHarmonics<D>::response(
    const Eigen::MatrixXd& force) const {
  RONDO_DEMAND(!factors_.empty() && force.rows() == n_rows(), force.rows(), n_rows());
  const OneBlasThread one_thread;
  const Block forces = transformed(force);
  Block u(n_rows(), forces.rows());
#pragma omp parallel for num_threads(body_.threads) schedule(static)
  for (Index k = 0; k < u.cols(); ++k)
    u.col(k) = factors_[at(k)].solve(layers_, forces.row(k).transpose());
  return u;
}

template <int D>
Eigen::MatrixXd RollingHarmonics<D>::fields(Eigen::Ref<const Block> spectrum, double chi,
                                            bool rate) const {
  Block turned = spectrum.transpose();  // a column a row's component
  for (Index k = 0; (rate || chi != 0.0) && k < turned.rows(); ++k) {
    const bool last = 2 * k == turn_;  // has no derivative, and no phase
    const auto order = static_cast<double>(k);
    const Complexes phase = last ? Complexes{1.0, 0.0} : std::polar(1.0, order * chi);
    turned.row(k) *= rate ? (last ? Complexes{} : i * order * phase) : phase;
  }
  Eigen::MatrixXd out(turn_, turned.cols());
  transform_once([&] {
    return fftw_plan_many_dft_c2r(1, &turn_, static_cast<int>(turned.cols()), raw(turned.data()),
                                  nullptr, 1, static_cast<int>(turned.rows()), out.data(), nullptr,
                                  1, turn_, FFTW_ESTIMATE);
  });
  return out.transpose();
}

template <int D>
typename RollingHarmonics<D>::Damped RollingHarmonics<D>::damped(const Block& spectrum) const {
  std::vector<RollingNorms> norms(at(spectrum.cols()));
#pragma omp parallel for num_threads(body_.threads) schedule(static)
  for (Index k = 1; k < spectrum.cols(); ++k)
    norms[at(k)] = norms_of<D>(layers_, order(static_cast<int>(k)), spectrum.col(k));
  Damped d;
  d.by_viscosity.resize(body_.viscous.size());
  for (int k = 1; 2 * k < turn_; ++k) {
    const RollingNorms& of = norms[at(k)];
    const double rate = k * body_.spin, pair = 2.0 * body_.stiffness.n_sectors;  // k and -k
    const double both = pair * std::pow(rate, 2);
    if (has_inertia(k)) d.by_mass += both * body_.mass_damping * of.mass;
    d.by_stiffness += both * body_.stiffness_damping * of.stiffness;
    for (std::size_t p = 0; p < d.by_viscosity.size(); ++p)
      d.by_viscosity[p] +=
          pair * rate * fem::branch_modulus(body_.viscous[p].branches, rate).imag() * of.viscous[p];
  }
  return d;
}

/// N Σ R_kᴴ (iks U_k) over k = 1 and -1.
template <int D>
double RollingHarmonics<D>::weight(const Block& spectrum, RollingGravity g) const {
  const Complexes power = weight_load(false).dot(spectrum.col(1)) * (i * body_.spin);
  return 2.0 * body_.stiffness.n_sectors * g.down * power.real();
}

template class RollingHarmonics<2>;
template class RollingHarmonics<3>;

}  // namespace rondo::statics
