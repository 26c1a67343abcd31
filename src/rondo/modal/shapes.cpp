// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/modal/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>

namespace rondo::modal {
namespace {

using StdComplex = std::complex<double>;

/// Sets (n) φ = M^-½ w e^{inφ_j} in each sector j, turned back into Cartesian components.
template <int D>
void spread(const CyclicBody<D>& body, int n, const Eigen::VectorXcd& w, Mode& mode) {
  using Vec = std::conditional_t<D == 2, Vec2, Vec3>;
  const fem::SectorBlocks<D>& k = body.stiffness;
  std::vector<Vec> real(body.mass.size()), imaginary(body.mass.size());
  for (std::size_t j = 0; j < k.turn.size(); ++j) {
    const auto step = static_cast<long long>(j) * n % k.n_sectors;
    const StdComplex phase =
        std::polar(1.0, 2.0 * std::numbers::pi * static_cast<double>(step) / k.n_sectors);
    for (std::size_t a = 0; a < k.n_local(); ++a) {
      const std::size_t node = k.node(a, j);
      const auto at = static_cast<Eigen::Index>(D * a);
      const double scale = 1.0 / std::sqrt(body.mass[node]);
      std::array<StdComplex, D> x;
      for (std::size_t c = 0; c < D; ++c)
        x[c] = scale * phase * w[at + static_cast<Eigen::Index>(c)];
      if constexpr (D == 2) {
        real[node] = k.turn[j] * Vec2{x[0].real(), x[1].real()};
        imaginary[node] = k.turn[j] * Vec2{x[0].imag(), x[1].imag()};
      } else {
        real[node] = k.turn[j] * Vec3{x[0].real(), x[1].real(), x[2].real()};
        imaginary[node] = k.turn[j] * Vec3{x[0].imag(), x[1].imag(), x[2].imag()};
      }
    }
  }
  mode.real = Field(std::move(real));
  mode.imaginary = Field(std::move(imaginary));
}

/// The numbers of both parts.
struct Parts {
  std::span<double> real, imaginary;

  explicit Parts(Mode& mode)
      : real(MutableFieldView(mode.real).values),
        imaginary(MutableFieldView(mode.imaginary).values) {}
};

}  // namespace

void normalise(Mode& mode, std::span<const double> mass) {
  const Parts p(mode);
  const std::size_t components = mode.real.components();
  double norm = 0.0, largest = 0.0;
  rondo::Complex phase{1.0, 0.0};
  for (std::size_t k = 0; k < p.real.size(); ++k) {
    const rondo::Complex z{p.real[k], p.imaginary[k]};
    norm += mass[k / components] * norm_squared(z);
    // Takes the first of components that are equal except for round-off, as around a wave.
    if (norm_squared(z) <= largest * (1.0 + 1e-6)) continue;
    largest = norm_squared(z);
    phase = z;
  }
  if (!(norm > 0.0)) return;
  const rondo::Complex by = conj(phase) / (std::sqrt(largest) * std::sqrt(norm));
  for (std::size_t k = 0; k < p.real.size(); ++k) {
    const double r = p.real[k], m = p.imaginary[k];
    p.real[k] = by.re * r - by.im * m;
    p.imaginary[k] = by.re * m + by.im * r;
  }
}

template <int D>
std::vector<Mode> modes_of(const CyclicBody<D>& body, double spin, int n, bool partner,
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
      for (double& m : Parts(mode).imaginary) m = -m;
    modes.push_back(std::move(mode));
  } else if (partner) {
    Mode other = mode;
    std::swap(other.real, other.imaginary);
    for (Mode* m : {&mode, &other}) std::ranges::fill(Parts(*m).imaginary, 0.0);
    modes = {std::move(mode), std::move(other)};
  } else {
    modes.push_back(std::move(mode));
  }
  for (Mode& m : modes) normalise(m, body.mass);
  return modes;
}

template std::vector<Mode> modes_of(const CyclicBody<2>&, double, int, bool, const HarmonicRoot&);
template std::vector<Mode> modes_of(const CyclicBody<3>&, double, int, bool, const HarmonicRoot&);

}  // namespace rondo::modal
