// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/modal/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rondo::modal {
namespace {

using StdComplex = std::complex<double>;

/// Sets (n) φ = M^-½ w e^{inφ_j} in each sector j, turned back into Cartesian components.
void spread(const CyclicBody& body, int n, const Eigen::VectorXcd& w, Mode& mode) {
  const fem::SectorStiffness& k = body.stiffness;
  mode.real.assign(body.mass.size(), Vec2{});
  mode.imaginary.assign(body.mass.size(), Vec2{});
  for (std::size_t j = 0; j < k.turn.size(); ++j) {
    const auto step = static_cast<long long>(j) * n % k.n_sectors;
    const StdComplex phase =
        std::polar(1.0, 2.0 * std::numbers::pi * static_cast<double>(step) / k.n_sectors);
    for (std::size_t a = 0; a < k.n_local(); ++a) {
      const std::size_t node = k.node(a, j);
      const auto at = static_cast<Eigen::Index>(2 * a);
      const double scale = 1.0 / std::sqrt(body.mass[node]);
      const StdComplex x = scale * phase * w[at], y = scale * phase * w[at + 1];
      mode.real[node] = k.turn[j] * Vec2{x.real(), y.real()};
      mode.imaginary[node] = k.turn[j] * Vec2{x.imag(), y.imag()};
    }
  }
}

void rotate_phase(Mode& mode, rondo::Complex by) {
  for (std::size_t i = 0; i < mode.real.size(); ++i) {
    const Vec2 r = mode.real[i], m = mode.imaginary[i];
    mode.real[i] = by.re * r - by.im * m;
    mode.imaginary[i] = by.re * m + by.im * r;
  }
}

}  // namespace

void normalise(Mode& mode, std::span<const double> mass) {
  double norm = 0.0, largest = 0.0;
  rondo::Complex phase{1.0, 0.0};
  for (std::size_t i = 0; i < mass.size(); ++i) {
    const Vec2 r = mode.real[i], m = mode.imaginary[i];
    norm += mass[i] * (dot(r, r) + dot(m, m));
    for (const rondo::Complex z : {rondo::Complex{r.x, m.x}, rondo::Complex{r.y, m.y}}) {
      // Takes the first of components that are equal except for round-off, as around a wave.
      if (norm_squared(z) <= largest * (1.0 + 1e-6)) continue;
      largest = norm_squared(z);
      phase = z;
    }
  }
  if (norm > 0.0) rotate_phase(mode, conj(phase) / (std::sqrt(largest) * std::sqrt(norm)));
}

std::vector<Mode> modes_of(const CyclicBody& body, double spin, int n, bool partner,
                           const HarmonicRoot& root) {
  Mode mode;
  mode.omega = std::abs(root.omega);
  mode.diameters = n;
  mode.wave = Wave::standing;
  spread(body, n, root.w, mode);
  std::vector<Mode> modes;
  if (spin != 0.0) {
    if (partner) mode.wave = root.omega * spin < 0.0 ? Wave::forward : Wave::backward;
    if (root.omega < 0.0)  // the same motion at a positive ω
      for (Vec2& m : mode.imaginary) m = -m;
    modes.push_back(std::move(mode));
  } else if (partner) {
    Mode other = mode;
    std::swap(other.real, other.imaginary);
    for (Mode* m : {&mode, &other}) std::fill(m->imaginary.begin(), m->imaginary.end(), Vec2{});
    modes = {std::move(mode), std::move(other)};
  } else {
    modes.push_back(std::move(mode));
  }
  for (Mode& m : modes) normalise(m, body.mass);
  return modes;
}

}  // namespace rondo::modal
