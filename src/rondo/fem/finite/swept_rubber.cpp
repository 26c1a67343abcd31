// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/finite/swept_rubber.hpp"

#include <cmath>
#include <numbers>

namespace rondo::fem::finite {

bool ColumnWindow::is_whole() const noexcept {
  return half >= std::numbers::pi;
}

void ColumnWindow::find(double angle, std::span<double> weight) const noexcept {
  const double column = 2.0 * std::numbers::pi / static_cast<double>(weight.size());
  for (std::size_t j = 0; j < weight.size(); ++j) {
    const double middle = angle + (static_cast<double>(j) + 0.5) * column;
    const double beyond = std::abs(std::remainder(middle, 2.0 * std::numbers::pi)) - half;
    weight[j] = beyond <= 0.0    ? 1.0
                : beyond >= fade ? 0.0
                                 : 0.5 * (1.0 + std::cos(std::numbers::pi * beyond / fade));
  }
}

}  // namespace rondo::fem::finite
