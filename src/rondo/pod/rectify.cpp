// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/pod/rectify.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rondo/core/complex.hpp"
#include "rondo/core/contract.hpp"

namespace rondo::pod {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

Rings rings_of(const mesh::Mesh& mesh, const std::vector<int>& nodes) {
  RONDO_DEMAND(mesh.n_sectors > 0, mesh.n_sectors);
  const auto n_sectors = static_cast<std::size_t>(mesh.n_sectors);
  // The order of the rings is that of their nodes within a sector.
  std::vector<int> in_sector;
  for (const int node : nodes)
    if (mesh.sector[static_cast<std::size_t>(node)] == 0)
      in_sector.push_back(mesh.sector_node[static_cast<std::size_t>(node)]);
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

}  // namespace

Rings node_rings(const mesh::Mesh& mesh) {
  std::vector<int> nodes(mesh.n_nodes());
  for (std::size_t k = 0; k < nodes.size(); ++k) nodes[k] = static_cast<int>(k);
  return rings_of(mesh, nodes);
}

Rings boundary_rings(const mesh::Mesh& mesh) {
  return rings_of(mesh, mesh.boundary);
}

/// Two real rings at once: the complex transform of (first component) + i (second component), whose
/// harmonics k and -k get e^{-ikθ} and e^{ikθ}, does to each of them what its real transform would.
struct Rectifier::Impl {
  std::size_t n, n_rings;
  Components components;
  Shift shift;
  std::vector<Complex> to_polar;  ///< (n) e^{-iφ} of the sectors
  std::vector<Complex> phase;     ///< (n) of the harmonics, over n
  std::vector<Vec2> work;         ///< (n) one ring
  fftw_plan forward = nullptr, backward = nullptr;

  Impl(int n_sectors, std::size_t rings, Components c, Shift s)
      : n(static_cast<std::size_t>(n_sectors)),
        n_rings(rings),
        components(c),
        shift(s),
        to_polar(n),
        phase(n),
        work(n) {
    const double sectors = n_sectors;
    for (std::size_t k = 0; k < n; ++k)
      to_polar[k] = rotation(-turn * static_cast<double>(k) / sectors);
    auto* ring = reinterpret_cast<fftw_complex*>(work.data());
    // Plans chosen by rule, not by timing: the same bits in every run.
    const unsigned flags = FFTW_ESTIMATE | FFTW_UNALIGNED;
    forward = fftw_plan_dft_1d(n_sectors, ring, ring, FFTW_FORWARD, flags);
    backward = fftw_plan_dft_1d(n_sectors, ring, ring, FFTW_BACKWARD, flags);
    RONDO_DEMAND(forward != nullptr && backward != nullptr, n_sectors);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    fftw_destroy_plan(forward);
    fftw_destroy_plan(backward);
  }

  [[nodiscard]] double harmonic(std::size_t k) const noexcept {
    return 2 * k <= n ? static_cast<double>(k) : static_cast<double>(k) - static_cast<double>(n);
  }

  void set_phases(double theta) {
    const double share = 1.0 / static_cast<double>(n);
    for (std::size_t k = 0; k < n; ++k)
      phase[k] = 2 * k == n ? Complex{share, 0.0} : share * rotation(-harmonic(k) * theta);
  }

  void set_rates() {
    const double share = 1.0 / static_cast<double>(n);
    for (std::size_t k = 0; k < n; ++k)
      phase[k] = 2 * k == n ? Complex{} : Complex{0.0, -share * harmonic(k)};
  }

  void move_by_harmonics(std::span<Vec2> ring) {
    std::copy(ring.begin(), ring.end(), work.begin());
    fftw_execute(forward);
    for (std::size_t k = 0; k < n; ++k) work[k] = phase[k] * work[k];
    fftw_execute(backward);
    std::copy(work.begin(), work.end(), ring.begin());
  }

  /// @param sectors how far, in [0, n)
  void move_by_sectors(std::span<Vec2> ring, std::size_t sectors) {
    std::rotate(ring.begin(), ring.end() - static_cast<std::ptrdiff_t>(sectors), ring.end());
  }

  /// Each ring in its polar frames, where they turn with the field.
  template <class Move>
  void move(std::span<Vec2> values, Move&& move_ring) {
    RONDO_DEMAND(values.size() == n * n_rings, values.size(), n, n_rings);
    for (std::size_t r = 0; r < n_rings; ++r) {
      const std::span<Vec2> ring = values.subspan(r * n, n);
      if (components == Components::cartesian)
        for (std::size_t k = 0; k < n; ++k) ring[k] = to_polar[k] * ring[k];
      move_ring(ring);
      if (components == Components::cartesian)
        for (std::size_t k = 0; k < n; ++k) ring[k] = conj(to_polar[k]) * ring[k];
    }
  }

  void apply(double theta, std::span<Vec2> values) {
    // In (-π, π] by way of the direction: a remainder by the rounded 2π is wrong by 1e-16 each
    // turn.
    const Vec2 direction = direction_at(theta);
    const double angle = std::atan2(direction.y, direction.x);
    const long pitches = std::lround(angle / turn * static_cast<double>(n));
    const auto sectors =
        static_cast<std::size_t>(pitches + (pitches < 0 ? static_cast<long>(n) : 0));
    if (shift == Shift::fourier) set_phases(angle);
    move(values, [&](std::span<Vec2> ring) {
      if (shift == Shift::fourier)
        move_by_harmonics(ring);
      else
        move_by_sectors(ring, sectors);
    });
  }

  void differentiate(std::span<Vec2> values) {
    RONDO_DEMAND(shift == Shift::fourier, n);
    set_rates();
    move(values, [&](std::span<Vec2> ring) { move_by_harmonics(ring); });
  }
};

Rectifier::Rectifier(int n_sectors, std::size_t n_rings, Components components, Shift shift)
    : impl_(std::make_unique<Impl>(n_sectors, n_rings, components, shift)) {}
Rectifier::~Rectifier() = default;
Rectifier::Rectifier(Rectifier&&) noexcept = default;
Rectifier& Rectifier::operator=(Rectifier&&) noexcept = default;

void Rectifier::apply(double theta, std::span<Vec2> values) {
  impl_->apply(theta, values);
}

void Rectifier::differentiate(std::span<Vec2> values) {
  impl_->differentiate(values);
}

}  // namespace rondo::pod
