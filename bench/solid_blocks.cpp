// SPDX-License-Identifier: BSD-3-Clause
#include "solid_blocks.hpp"

#include <cstring>
#include <utility>

namespace rondo::bench {
namespace {

typedef double Four __attribute__((vector_size(32)));

inline Four load_four(const double* p) noexcept {
  Four x;
  std::memcpy(&x, p, sizeof x);
  return x;
}
inline Four all(double x) noexcept {
  return Four{} + x;
}

struct Rows {
  const std::int64_t* start;
  const double* blocks;
  const std::int32_t* column;
  const double *u, *constants;
  double *next, *v, *force;
  std::int64_t n;
  double dt, beta_over_dt, alpha, spin;
};

/// One step; sums: kinetic, strain, frame, mass, stiffness.
void step(const Rows& r, double* sums) noexcept {
  const double alpha = r.dt * r.alpha, re = 1.0 + 0.5 * alpha, im = r.dt * r.spin;
  const double norm = 1.0 / (re * re + im * im), ix = norm * re, iy = -norm * im;
  const double rate = -r.dt * r.spin * r.spin;
  double kinetic = 0.0, strain = 0.0, frame = 0.0, mass = 0.0, stiffness = 0.0;
  for (std::int64_t i = 0; i < r.n; ++i) {
    Four sum = all(0.0);
    for (std::int64_t k = r.start[i]; k < r.start[i + 1]; ++k) {
      const double* b = r.blocks + 9 * k;
      const double* u = r.u + r.column[k];
      sum += load_four(b) * all(u[0]) + load_four(b + 3) * all(u[1]) + load_four(b + 6) * all(u[2]);
    }
    const double* c = r.constants + 3 * i;
    const double* u = r.u + 3 * i;
    double* v = r.v + 3 * i;
    double* before = r.force + 3 * i;
    const double g[3] = {rate * (c[0] + u[0]), rate * (c[1] + u[1]), 0.0};
    double t[3], after[3];
    for (int d = 0; d < 3; ++d) {
      const double change = sum[d] - before[d];
      t[d] = r.dt / c[2] * (sum[d] + r.beta_over_dt * change) + g[d] + alpha * v[d];
    }
    t[0] -= 2.0 * im * v[1];
    t[1] += 2.0 * im * v[0];
    after[0] = v[0] - (ix * t[0] - iy * t[1]);
    after[1] = v[1] - (ix * t[1] + iy * t[0]);
    after[2] = v[2] - t[2] / re;
    for (int d = 0; d < 3; ++d) {
      const double mean = v[d] + after[d];
      kinetic += c[2] * v[d] * v[d];
      strain += u[d] * before[d];
      frame += c[2] * mean * g[d];
      mass += c[2] * mean * mean;
      stiffness += mean * (sum[d] - before[d]);
      before[d] = sum[d];
      v[d] = after[d];
      r.next[3 * i + d] = u[d] + r.dt * after[d];
    }
  }
  sums[0] = kinetic;
  sums[1] = strain, sums[2] = frame, sums[3] = mass, sums[4] = stiffness;
}

}  // namespace

SolidBlocks::SolidBlocks(const dynamics::Model& m)
    : dt_(m.dt),
      beta_(m.stiffness_damping),
      alpha_(m.mass_damping),
      spin_(-m.motion.angular_velocity.at(0.0)) {
  const fem::SolidSector& k = m.solid->sector;
  const auto local = static_cast<std::int64_t>(k.n_local());
  const std::int64_t n = k.n_sectors;
  start_.push_back(0);
  for (std::int64_t j = 0; j < n; ++j)
    for (std::int64_t a = 0; a < local; ++a) {
      for (const auto& e : k.row(static_cast<std::size_t>(a))) {
        const std::int64_t sector = (j + e.shift + n) % n;
        blocks_.insert(blocks_.end(), e.block.begin(), e.block.end());
        column_.push_back(static_cast<std::int32_t>(3 * (sector * local + e.column)));
      }
      start_.push_back(static_cast<std::int64_t>(column_.size()));
      const std::size_t node = k.node(static_cast<std::size_t>(a), static_cast<std::size_t>(j));
      const Vec2 x = conj(k.turn[static_cast<std::size_t>(j)]) * m.reference[node];
      constants_.insert(constants_.end(), {x.x, x.y, m.mass[node]});
    }
  blocks_.insert(blocks_.end(), 3, 0.0);
  const auto fields = static_cast<std::size_t>(3 * n * local + 1);
  for (std::vector<double>* f : {&u_, &next_, &v_, &force_}) f->assign(fields, 0.0);
  // Half a step to v_{1/2}, then u_1.
  const double half = 0.5 * dt_, re = 1.0 + 0.5 * half * alpha_, im = half * spin_;
  const Complex a{re, im};
  for (std::int64_t i = 0; i < n * local; ++i) {
    const auto at = static_cast<std::size_t>(3 * i);
    const Vec2 pull = half * spin_ * spin_ * Vec2{constants_[at], constants_[at + 1]};
    const Vec2 v = pull / a;
    v_[at] = v.x, v_[at + 1] = v.y;
    u_[at] = dt_ * v.x, u_[at + 1] = dt_ * v.y;
  }
}

void SolidBlocks::advance(int steps) {
  for (int i = 0; i < steps; ++i) {
    double sums[5];
    step({start_.data(), blocks_.data(), column_.data(), u_.data(), constants_.data(), next_.data(),
          v_.data(), force_.data(), static_cast<std::int64_t>(start_.size()) - 1, dt_, beta_ / dt_,
          alpha_, spin_},
         sums);
    kinetic_ = 0.5 * sums[0];
    for (int s = 0; s < 4; ++s) sums_[s] += sums[s + 1];
    std::swap(u_, next_);
  }
}

}  // namespace rondo::bench
