// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/solid/harmonic_creep.hpp"

#include <algorithm>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/rom/wheel/ring_waves.hpp"

namespace rondo::rom {
namespace {

using Complexes = std::complex<double>;
using Eigen::Index;
using Numbers = CreepMemory::Numbers;

/// Weights of the harmonics: the sum of products of amplitudes, each times its weight, is the sum
/// of products over all nodes.
Numbers weights_of(int sectors) {
  Numbers weights;
  for (int k = 0; k <= sectors / 2; ++k) weights.push_back(sectors * harmonic_weight(k, sectors));
  return weights;
}

/// Numbers as amplitudes, two of them one after the other being a complex one.
Eigen::Map<RingAmplitudes> amplitudes(Numbers& of, Index rows) noexcept {
  return {reinterpret_cast<Complexes*>(of.data()), rows,
          static_cast<Index>(of.size()) / (2 * rows)};
}
Eigen::Map<const RingAmplitudes> amplitudes(const Numbers& of, Index rows) noexcept {
  return {reinterpret_cast<const Complexes*>(of.data()), rows,
          static_cast<Index>(of.size()) / (2 * rows)};
}

}  // namespace

HarmonicCreep::HarmonicCreep(std::span<const CreepTerm> terms,
                             std::span<const RingResidual> at_once,
                             std::span<const RingResidual> later, std::span<const Complex> turn,
                             double stiffness_damping, double dt)
    : turn_(turn),
      memory_(terms, at_once.size(), at(2 * at_once.front().size),
              weights_of(static_cast<int>(turn.size())), stiffness_damping, dt) {
  RONDO_DEMAND(at_once.size() == later.size(), at_once.size(), later.size());
  for (const RingResidual& table : at_once) tables_[0].push_back(harmonics_of(table));
  for (const RingResidual& table : later) tables_[1].push_back(harmonics_of(table));
  now_ = left_ = RingAmplitudes::Zero(at_once.front().size, at_once.front().n_sectors / 2 + 1);
}

RingAmplitudes HarmonicCreep::harmonics_of(const RingResidual& table) const {
  const int n = table.n_sectors;
  const Index size = table.size;
  RingAmplitudes all = RingAmplitudes::Zero(size, size * (n / 2 + 1));
  for (int k = 0; k <= n / 2; ++k)
    for (int d = 0; d < n; ++d) {
      const Complex e = turn_[at(static_cast<long long>(k) * d % n)];
      all.middleCols(k * size, size) += Complexes(e.re, -e.im) * table.block(d);
    }
  return all;
}

void HarmonicCreep::clear() noexcept {
  clear_forces();
  start();
}

void HarmonicCreep::clear_forces() noexcept {
  std::ranges::fill(memory_.acting(), 0.0);
}

void HarmonicCreep::add_force(int sector, Index component, Vec3 force) noexcept {
  const auto n = static_cast<long long>(turn_.size());
  const Vec3 part = force / static_cast<double>(n);
  auto acting = amplitudes(memory_.acting(), now_.rows());
  for (Index k = 0; k < acting.cols(); ++k) {
    const Complex e = turn_[at(k * sector % n)];
    const Complexes back(e.re, -e.im);
    acting(component, k) += part.x * back;
    acting(component + 1, k) += part.y * back;
    acting(component + 2, k) += part.z * back;
  }
}

/// Finds the products of the tables with new forces.
void HarmonicCreep::push() noexcept {
  const Index size = now_.rows();
  const auto acting = amplitudes(memory_.acting(), size);
  for (std::size_t kind = 0; kind < 2; ++kind)
    for (std::size_t a = 0; a < memory_.n_tables(); ++a) {
      auto pushing = amplitudes(memory_.pushing(kind, a), size);
      for (Index k = 0; k < acting.cols(); ++k)
        pushing.col(k).noalias() = tables_[kind][a].middleCols(k * size, size) * acting.col(k);
    }
}

void HarmonicCreep::start() noexcept {
  push();
  memory_.start();
}

void HarmonicCreep::step() noexcept {
  push();
  memory_.step();
}

void HarmonicCreep::use(const TableShares& shares) noexcept {
  now_.setZero();
  left_.setZero();
  for (std::size_t a = 0; a < memory_.n_tables(); ++a) {
    now_ += shares[a] * amplitudes(memory_.now(a), now_.rows());
    left_ += shares[a] * amplitudes(memory_.left(a), now_.rows());
  }
}

void HarmonicCreep::write(const RingAmplitudes& of, int sector,
                          std::span<double> out) const noexcept {
  const auto n = static_cast<long long>(turn_.size());
  std::ranges::fill(out, 0.0);
  for (Index k = 0; k < of.cols(); ++k) {
    const double weight = harmonic_weight(static_cast<int>(k), static_cast<int>(n));
    const Complex e = turn_[at(k * sector % n)];
    const double re = weight * e.re, im = weight * e.im;
    const Complexes* from = of.data() + k * of.rows();
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] += re * from[i].real() - im * from[i].imag();
  }
}

HarmonicCreep::Lagging HarmonicCreep::lagging() const {
  return lagging_by(&CreepMemory::lagging);
}

HarmonicCreep::Lagging HarmonicCreep::lagging_before() const {
  return lagging_by(&CreepMemory::lagging_before);
}

HarmonicCreep::Lagging HarmonicCreep::lagging_by(
    CreepMemory::Lagging (CreepMemory::*one)(std::size_t) const noexcept) const {
  Lagging all{now_, now_};
  for (Index k = 0, i = 0; k < now_.cols(); ++k)
    for (Index row = 0; row < now_.rows(); ++row, i += 2) {
      const auto re = (memory_.*one)(at(i)), im = (memory_.*one)(at(i + 1));
      all.at_once(row, k) = {re.at_once, im.at_once};
      all.later(row, k) = {re.later, im.later};
    }
  return all;
}

}  // namespace rondo::rom
