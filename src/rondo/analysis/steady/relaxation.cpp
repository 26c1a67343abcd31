// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/steady/relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "rondo/core/contract.hpp"

namespace rondo::study {
namespace {

constexpr double reached = 1.0 - 1.0 / std::numbers::e;

/// Linear between the rows.
std::optional<double> length_of(std::span<const double> distance,
                                const std::vector<double>& share) {
  for (std::size_t k = 1; k < share.size(); ++k) {
    if (share[k] < reached) continue;
    const double part = (reached - share[k - 1]) / (share[k] - share[k - 1]);
    return distance[k - 1] + part * (distance[k] - distance[k - 1]);
  }
  return std::nullopt;
}

/// Root mean square of share - (1 - e^(-s/σ)).
double error_of(std::span<const double> distance, const std::vector<double>& share, double length) {
  double sum = 0.0;
  for (std::size_t k = 0; k < share.size(); ++k)
    sum += std::pow(share[k] + std::expm1(-distance[k] / length), 2);
  return std::sqrt(sum / static_cast<double>(share.size()));
}

/// By golden sections of the logarithm, from a tenth of the first row to ten times the last. What
/// ends at a limit has its minimum beyond it.
std::optional<double> fitted_to(std::span<const double> distance,
                                const std::vector<double>& share) {
  constexpr double part = 1.0 / std::numbers::phi;
  constexpr int sections = 60;
  constexpr double at_limit = 1e-6;
  const double least = std::log(0.1 * distance[1]), most = std::log(10.0 * distance.back());
  double low = least, high = most;
  const auto error = [&](double at) { return error_of(distance, share, std::exp(at)); };
  double left = high - part * (high - low), right = low + part * (high - low);
  double of_left = error(left), of_right = error(right);
  for (int n = 0; n < sections; ++n) {
    if (of_left < of_right) {
      high = right, right = left, of_right = of_left;
      left = high - part * (high - low), of_left = error(left);
    } else {
      low = left, left = right, of_left = of_right;
      right = low + part * (high - low), of_right = error(right);
    }
  }
  const double found = 0.5 * (low + high);
  if (std::min(found - least, most - found) < at_limit) return std::nullopt;
  return std::exp(found);
}

}  // namespace

Relaxation relaxation_of(std::span<const double> distance, std::span<const double> force,
                         double after, double smallest) {
  RONDO_DEMAND(distance.size() == force.size() && force.size() > 1 && distance[0] == 0.0,
               force.size());
  Relaxation r{.before = force[0], .after = after};
  const double change = after - force[0];
  r.changes = std::abs(change) > smallest;
  if (!r.changes) return r;
  std::vector<double> share;
  share.reserve(force.size());
  for (const double f : force) share.push_back((f - force[0]) / change);
  r.share = share.back();
  r.length = length_of(distance, share);
  r.fitted = fitted_to(distance, share);
  if (r.fitted) r.fit_error = error_of(distance, share, *r.fitted);
  return r;
}

}  // namespace rondo::study
