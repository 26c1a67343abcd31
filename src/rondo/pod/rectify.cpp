// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/pod/rectify.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/core/process_wide.hpp"

namespace rondo::pod {
namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

Rings rings_of(const mesh::Mesh& mesh, const std::vector<int>& nodes) {
  RONDO_DEMAND(mesh.n_sectors > 0, mesh.n_sectors);
  const auto n_sectors = static_cast<std::size_t>(mesh.n_sectors);
  // The rings are in the order of their nodes within a sector.
  std::vector<int> in_sector;
  for (const int node : nodes)
    if (mesh.sector[at(node)] == 0) in_sector.push_back(mesh.sector_node[at(node)]);
  std::sort(in_sector.begin(), in_sector.end());
  if (in_sector.size() * n_sectors != nodes.size()) return {};
  Rings rings{mesh.n_sectors, std::vector<int>(nodes.size(), -1)};
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const auto node = static_cast<std::size_t>(nodes[k]);
    const auto ring = std::lower_bound(in_sector.begin(), in_sector.end(), mesh.sector_node[node]);
    if (ring == in_sector.end() || *ring != mesh.sector_node[node]) return {};
    rings.point[static_cast<std::size_t>(ring - in_sector.begin()) * n_sectors +
                static_cast<std::size_t>(mesh.sector[node])] = static_cast<int>(k);
  }
  if (std::count(rings.point.begin(), rings.point.end(), -1) > 0) return {};
  return rings;
}

/// In (-π, π], by the direction: a remainder by the rounded 2π is wrong by 1e-16 for each turn.
double within_a_turn(double theta) {
  const Vec2 direction = direction_at(theta);
  return std::atan2(direction.y, direction.x);
}

}  // namespace

Rings node_rings(const mesh::Mesh& mesh) {
  std::vector<int> nodes(mesh.n_nodes());
  for (std::size_t k = 0; k < nodes.size(); ++k) nodes[k] = static_cast<int>(k);
  return rings_of(mesh, nodes);
}

Rings boundary_rings(const mesh::Mesh& mesh) {
  return rings_of(mesh, mesh.boundary);
}

/// Two real rings at once: the complex transform of (first component) + i (second component), with
/// harmonics k and -k times e^{-ikθ} and e^{ikθ}, acts on each as its real transform would.
Rectifier::Rectifier(int n_sectors, std::size_t n_rings, Components components, Shift shift)
    : n_(static_cast<std::size_t>(n_sectors)),
      n_rings_(n_rings),
      components_(components),
      shift_(shift),
      to_polar_(n_),
      phase_(n_),
      work_(n_) {
  const double sectors = n_sectors;
  for (std::size_t k = 0; k < n_; ++k)
    to_polar_[k] = rotation(-full_turn * static_cast<double>(k) / sectors);
  auto* ring = reinterpret_cast<fftw_complex*>(work_.data());
  // Plans are chosen by rule, not by timing, which gives the same bits in every run.
  const unsigned flags = FFTW_ESTIMATE | FFTW_UNALIGNED;
  const std::lock_guard lock(fftw_planner());
  forward_ = fftw_plan_dft_1d(n_sectors, ring, ring, FFTW_FORWARD, flags);
  backward_ = fftw_plan_dft_1d(n_sectors, ring, ring, FFTW_BACKWARD, flags);
  RONDO_DEMAND(forward_ != nullptr && backward_ != nullptr, n_sectors);
}

Rectifier::~Rectifier() {
  const std::lock_guard lock(fftw_planner());
  fftw_destroy_plan(forward_);
  fftw_destroy_plan(backward_);
}

double Rectifier::harmonic(std::size_t k) const noexcept {
  return 2 * k <= n_ ? static_cast<double>(k) : static_cast<double>(k) - static_cast<double>(n_);
}

void Rectifier::set_phases(double theta) {
  const double share = 1.0 / static_cast<double>(n_);
  for (std::size_t k = 0; k < n_; ++k)
    phase_[k] = 2 * k == n_ ? Complex{share, 0.0} : share * rotation(-harmonic(k) * theta);
}

void Rectifier::move_by_harmonics(std::span<Vec2> ring) {
  std::copy(ring.begin(), ring.end(), work_.begin());
  fftw_execute(forward_);
  for (std::size_t k = 0; k < n_; ++k) work_[k] = phase_[k] * work_[k];
  fftw_execute(backward_);
  std::copy(work_.begin(), work_.end(), ring.begin());
}

void Rectifier::move_by_harmonics(std::span<double> ring) {
  for (std::size_t k = 0; k < n_; ++k) work_[k] = {ring[k], 0.0};
  fftw_execute(forward_);
  for (std::size_t k = 0; k < n_; ++k) work_[k] = phase_[k] * work_[k];
  fftw_execute(backward_);
  for (std::size_t k = 0; k < n_; ++k) ring[k] = work_[k].x;
}

/// Applies the move to each ring, in polar frames if they turn with the field.
template <class Move>
void Rectifier::move(std::span<Vec2> values, Move&& move_ring) {
  RONDO_DEMAND(values.size() == n_ * n_rings_, values.size(), n_, n_rings_);
  for (std::size_t r = 0; r < n_rings_; ++r) {
    const std::span<Vec2> ring = values.subspan(r * n_, n_);
    if (components_ == Components::cartesian)
      for (std::size_t k = 0; k < n_; ++k) ring[k] = to_polar_[k] * ring[k];
    move_ring(ring);
    if (components_ == Components::cartesian)
      for (std::size_t k = 0; k < n_; ++k) ring[k] = conj(to_polar_[k]) * ring[k];
  }
}

/// Number of sectors, 0 to n, by which the field moves for the angle in (-π, π].
std::ptrdiff_t Rectifier::whole_sectors(double angle) const noexcept {
  const long pitches = std::lround(angle / full_turn * static_cast<double>(n_));
  return pitches + (pitches < 0 ? static_cast<long>(n_) : 0);
}

void Rectifier::apply(double theta, std::span<Vec2> values) {
  const double angle = within_a_turn(theta);
  if (shift_ == Shift::fourier) {
    set_phases(angle);
    return move(values, [&](std::span<Vec2> ring) { move_by_harmonics(ring); });
  }
  const std::ptrdiff_t sectors = whole_sectors(angle);
  move(values,
       [&](std::span<Vec2> ring) { std::rotate(ring.begin(), ring.end() - sectors, ring.end()); });
}

void Rectifier::apply(double theta, std::span<double> values) {
  RONDO_DEMAND(values.size() == n_ * n_rings_, values.size(), n_, n_rings_);
  const double angle = within_a_turn(theta);
  if (shift_ == Shift::fourier) set_phases(angle);
  const std::ptrdiff_t sectors = whole_sectors(angle);
  for (std::size_t r = 0; r < n_rings_; ++r) {
    const std::span<double> ring = values.subspan(r * n_, n_);
    if (shift_ == Shift::fourier)
      move_by_harmonics(ring);
    else
      std::rotate(ring.begin(), ring.end() - sectors, ring.end());
  }
}

}  // namespace rondo::pod
