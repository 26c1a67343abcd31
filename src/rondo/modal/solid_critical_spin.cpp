// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/modal/solid_critical_spin.hpp"

#include <cmath>
#include <complex>
#include <vector>

#include "rondo/fem/harmonics.hpp"
#include "rondo/modal/inertia.hpp"

namespace rondo::modal {
namespace {

using Matrix = fem::Harmonics::Matrix;

/// Whether A(n) - s²[(n² + 1)P + n²(1 - P) - n G], where P selects the components in the plane of
/// the wheel, is not positive definite: a wave of n then stands still at s or below.
bool stands_still(fem::Harmonics& elastic, int n, double spin) {
  const double squared = spin * spin, waves = n;
  const double axial = -squared * waves * waves;
  Matrix m = elastic.lower(n, 1.0, axial - squared, axial);
  for (Eigen::Index k = 0; k < m.cols(); k += 3)
    m.coeffRef(k + 1, k) += std::complex<double>(0.0, 2.0 * waves * squared);
  return negative_eigenvalues(m) != 0;
}

}  // namespace

std::optional<CriticalSpeed> lowest_critical_spin(const fem::SolidSector& sector,
                                                  std::span<const double> mass, double spin) {
  fem::Harmonics elastic(sector, mass);
  const auto among = [&](const std::vector<int>& waves, double at) {
    std::vector<int> still;
    for (const int n : waves)
      if (stands_still(elastic, n, at)) still.push_back(n);
    return still;
  };
  std::vector<int> all;
  for (int n = 0; n < elastic.count(); ++n) all.push_back(n);
  double low = 0.0, high = std::abs(spin);
  std::vector<int> waves = among(all, high);
  if (waves.empty()) return std::nullopt;
  while (high - low > solid_critical_tolerance * high) {
    const double middle = 0.5 * (low + high);
    std::vector<int> still = among(waves, middle);
    if (still.empty()) {
      low = middle;
    } else {
      high = middle;
      waves = std::move(still);
    }
  }
  return CriticalSpeed{waves.front(), high, 0.0};
}

}  // namespace rondo::modal
