// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/coupled/spatial_squares.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/contact/coupled/cholesky.hpp"

namespace rondo::contact {
namespace {

constexpr double round_off = 1e-16;
constexpr int most_steps = 60;
constexpr double first_marquardt = 1e-4, least_marquardt = 1e-18, largest_marquardt = 1e6;

/// P and its derivative at z = (x, y): the identity, 0, or those of a point of the cone's side.
struct Projection {
  Vec3 value;
  SpatialBlock slope{};
};

Projection project(Vec3 z, double mu) noexcept {
  const Vec2 y{z.y, z.z};
  const double a = norm(y);
  if (z.x >= 0.0 && a <= mu * z.x)
    return {z, {Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}}};
  if (mu * a <= -z.x) return {};
  const Vec2 t = a > 0.0 ? y / a : Vec2{1.0, 0.0};
  const double scale = 1.0 / (1.0 + mu * mu), x = scale * (z.x + mu * a);
  const double across = a > 0.0 ? mu * x / a : 0.0;
  const Vec3 of_x = scale * Vec3{1.0, mu * t.x, mu * t.y};
  return {{x, mu * x * t.x, mu * x * t.y},
          {of_x, mu * t.x * of_x + across * Vec3{0.0, t.y * t.y, -t.x * t.y},
           mu * t.y * of_x + across * Vec3{0.0, -t.x * t.y, t.x * t.x}}};
}

/// F and its derivative.
class Equations {
 public:
  Equations(const SpatialCoupled& p, double share, SpatialWorkspace& work)
      : p_(p), share_(share), work_(work) {}

  /// F into work.value, with `slopes` its derivative into work.slope, by rows. @return |F|²
  double evaluate(std::span<const Vec3> r, bool slopes) {
    const std::size_t n = p_.size();
    work_.value.resize(n);
    if (slopes) work_.slope.assign(9 * n * n, 0.0);
    double squared = 0.0;
    for (std::size_t j = 0; j < n; ++j) {
      add(j, r, slopes);
      squared += dot(work_.value[j], work_.value[j]);
    }
    return squared;
  }

 private:
  void add(std::size_t j, std::span<const Vec3> r, bool slopes) {
    const double m = p_.mass(j), mu = share_ * p_.friction[j];
    Vec3 w = p_.free[j];
    for (std::size_t l = 0; l < p_.size(); ++l) w += apply(p_.block(j, l), r[l]);
    const double sliding = std::hypot(w.y, w.z);
    const Vec2 t = direction({w.y, w.z});
    const Projection to = project(r[j] - m * Vec3{w.x + p_.bounce[j] + mu * sliding, w.y, w.z}, mu);
    work_.value[j] = r[j] - to.value;
    if (!slopes) return;
    // dF = dr - slope (dr - m [dw + μ n t·dw_t])
    const SpatialBlock& s = to.slope;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 of_w = m * (s[i] + s[i].x * mu * Vec3{0.0, t.x, t.y});
      for (std::size_t l = 0; l < p_.size(); ++l) {
        Vec3 entries = transposed(p_.block(j, l), of_w);
        if (l == j) {
          const Vec3 unit{i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0};
          entries += unit - s[i];
        }
        double* const to_row = work_.slope.data() + (3 * j + i) * 3 * p_.size() + 3 * l;
        to_row[0] = entries.x, to_row[1] = entries.y, to_row[2] = entries.z;
      }
    }
  }

  const SpatialCoupled& p_;
  double share_;
  SpatialWorkspace& work_;
};

double component(Vec3 a, std::size_t i) noexcept {
  return i == 0 ? a.x : i == 1 ? a.y : a.z;
}

/// (JᵀJ + shift) step = -JᵀF. @return false: a pivot is not positive
bool find_step(std::size_t n, double shift, SpatialWorkspace& work) {
  const std::size_t order = 3 * n;
  work.matrix.assign(order * order, 0.0);
  work.step.assign(order, 0.0);
  for (std::size_t row = 0; row < order; ++row) {
    const double* const j = work.slope.data() + row * order;
    const double f = component(work.value[row / 3], row % 3);
    for (std::size_t a = 0; a < order; ++a) {
      if (j[a] == 0.0) continue;
      work.step[a] -= j[a] * f;
      double* const to = work.matrix.data() + a * order;
      for (std::size_t b = 0; b <= a; ++b) to[b] += j[a] * j[b];
    }
  }
  for (std::size_t a = 0; a < order; ++a) work.matrix[a * order + a] += shift;
  return solve_cholesky(work.matrix, work.step);
}

double scale_of(const SpatialCoupled& p) noexcept {
  double scale = 0.0;
  for (std::size_t j = 0; j < p.size(); ++j) scale = std::max(scale, p.mass(j) * norm(p.free[j]));
  return scale;
}

}  // namespace

int least_squares(const SpatialCoupled& p, double share, std::span<Vec3> impulse,
                  SpatialWorkspace& work) {
  const std::size_t n = p.size();
  Equations equations(p, share, work);
  work.trial.resize(n);
  const double enough = round_off * scale_of(p);
  double shift = first_marquardt, squared = equations.evaluate(impulse, true);
  int steps = 0;
  for (; steps < most_steps && squared > enough * enough && shift < largest_marquardt; ++steps) {
    if (!find_step(n, shift, work)) {
      shift *= 10.0;
      continue;
    }
    for (std::size_t j = 0; j < n; ++j)
      work.trial[j] =
          impulse[j] + Vec3{work.step[3 * j], work.step[3 * j + 1], work.step[3 * j + 2]};
    const double next = equations.evaluate(work.trial, false);
    if (next < squared) {
      std::ranges::copy(work.trial, impulse.begin());
      shift = std::max(shift * (next < 0.25 * squared ? 0.01 : 0.3), least_marquardt);
    } else {
      shift *= 10.0;
    }
    squared = equations.evaluate(impulse, true);
  }
  return steps;
}

}  // namespace rondo::contact
