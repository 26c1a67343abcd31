// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/paper/validation_measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "rondo/core/contract.hpp"

namespace rondo::study {

namespace {

constexpr double turn = 2.0 * std::numbers::pi;

}  // namespace

double share_of(double part, double whole) noexcept {
  return whole == 0.0 ? std::numeric_limits<double>::quiet_NaN() : part / whole;
}

double SquareSums::relative() const noexcept {
  return std::sqrt(share_of(difference, of));
}

std::optional<Between> between(std::span<const double> times, double time) noexcept {
  if (times.empty() || !(time >= times.front() && time <= times.back())) return std::nullopt;
  const auto after = std::ranges::upper_bound(times, time);
  const auto first = static_cast<std::size_t>(after - times.begin()) - 1;
  if (after == times.end()) return Between{first, 0.0};
  return Between{first, (time - times[first]) / (*after - times[first])};
}

ProfileSum::ProfileSum(const mesh::Mesh& mesh)
    : sum_(mesh.boundary.size()),
      length_(std::accumulate(mesh.tributary.begin(), mesh.tributary.end(), 0.0)) {
  for (const int node : mesh.boundary) {
    const Vec2 x = mesh.coordinates[static_cast<std::size_t>(node)];
    angle_.push_back(std::atan2(x.x, -x.y));
  }
}

void ProfileSum::add(double theta, std::span<const Vec2> force) {
  RONDO_DEMAND(force.size() == angle_.size(), force.size(), angle_.size());
  const std::size_t n = angle_.size();
  for (std::size_t i = 0; i < n; ++i) {
    double turns = (angle_[i] + theta) / turn;
    turns -= std::floor(turns);
    const double place = turns * static_cast<double>(n);
    const double whole = std::floor(place);
    const std::size_t j = static_cast<std::size_t>(whole) % n;
    sum_[j] += (1.0 - (place - whole)) * force[i];
    sum_[(j + 1) % n] += (place - whole) * force[i];
  }
  ++count_;
}

Profile ProfileSum::mean() const {
  RONDO_DEMAND(count_ > 0, count_);
  const std::size_t n = sum_.size();
  const double scale = static_cast<double>(n) / (length_ * static_cast<double>(count_));
  Profile profile;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t j = (k + (n + 1) / 2) % n;  // from the one after straight up, or from it
    const double angle = turn * static_cast<double>(j) / static_cast<double>(n);
    profile.angle.push_back(2 * j >= n ? angle - turn : angle);
    profile.pressure.push_back(scale * sum_[j].x);
    profile.shear.push_back(scale * sum_[j].y);
  }
  return profile;
}

double profile_error(std::span<const double> full, std::span<const double> reduced,
                     std::span<const double> by) {
  RONDO_DEMAND(full.size() == reduced.size() && full.size() == by.size(), full.size(),
               reduced.size(), by.size());
  SquareSums sums;
  for (std::size_t k = 0; k < full.size(); ++k) {
    const double difference = reduced[k] - full[k];
    sums.difference += difference * difference;
    sums.of += by[k] * by[k];
  }
  return sums.relative();
}

}  // namespace rondo::study
