// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/finite/rubber_remainder.hpp"

#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/fem/finite/rubber_hexahedron.hpp"

namespace rondo::fem::finite {
namespace {

using Eigen::Index;

Eigen::Vector<double, 24> flat(const HexahedronCorners& u) noexcept {
  Eigen::Vector<double, 24> v;
  for (std::size_t a = 0; a < 8; ++a)
    v.segment<3>(static_cast<Index>(3 * a)) << u[a].x, u[a].y, u[a].z;
  return v;
}

}  // namespace

RubberRemainder::RubberRemainder(SweptRubber rubber, std::vector<Complex> turn)
    : rubber_(std::move(rubber)), axes_(std::move(turn)) {
  RONDO_DEMAND(axes_.size() >= 3 && rubber_.corner.size() == rubber_.points.size() &&
                   rubber_.corner.size() == rubber_.rubber.size(),
               axes_.size(), rubber_.corner.size(), rubber_.points.size(), rubber_.rubber.size());
  const Complex next = conj(axes_[0]) * axes_[1];
  for (std::size_t e = 0; e < rubber_.corner.size(); ++e) {
    State s;
    for (std::size_t a = 0; a < 8; ++a) {
      const Vec3 u = rubber_.u[at(rubber_.corner[e][a % 4])];
      s.u[a] = a < 4 ? u : next * u;
    }
    const RubberEnergy of =
        rubber_hexahedron(rubber_.points[e], s.u, rubber_.rubbers[at(rubber_.rubber[e])]);
    RONDO_DEMAND(of.least > 0.0, e, of.least);
    // By the loops of the steps: nothing is left in the state, to the last bit.
    const RubberForce force =
        rubber_force(rubber_.points[e], s.u, rubber_.rubbers[at(rubber_.rubber[e])]);
    s.energy = force.energy;
    s.force = flat(force.force);
    s.stiffness = of.stiffness;
    state_.push_back(s);
  }
  // Sector 0 is the lowest: outwards is -y there, around is x.
  for (Complex& axes : axes_) axes = axes * Complex{0.0, -1.0};
}

RubberRemainder::Placed RubberRemainder::placed(std::size_t e, std::size_t column,
                                                std::span<const Vec3> u) const noexcept {
  const std::size_t n = rubber_.u.size(), after = (column + 1) % axes_.size();
  const Complex back = conj(axes_[column]);
  Placed p;
  for (std::size_t a = 0; a < 8; ++a) {
    p.node[a] = (a < 4 ? column : after) * n + at(rubber_.corner[e][a % 4]);
    p.more[a] = back * u[p.node[a]];
    p.all[a] = state_[e].u[a] + p.more[a];
  }
  return p;
}

void RubberRemainder::tangent(std::span<const Vec3> u, std::span<const double> weight,
                              const TakeBlock& take) const {
  for (std::size_t j = 0; j < weight.size(); ++j) {
    if (weight[j] == 0.0) continue;
    const Eigen::Matrix3d turn = about_axle(axes_[j]);
    for (std::size_t e = 0; e < state_.size(); ++e) {
      const Placed p = placed(e, j, u);
      const RubberEnergy now =
          rubber_hexahedron(rubber_.points[e], p.all, rubber_.rubbers[at(rubber_.rubber[e])]);
      if (!(now.least > 0.0)) continue;
      const Eigen::Matrix<double, 24, 24> more = weight[j] * (now.stiffness - state_[e].stiffness);
      for (std::size_t a = 0; a < 8; ++a)
        for (std::size_t b = 0; b < 8; ++b)
          take(p.node[a], p.node[b],
               turn * more.block<3, 3>(static_cast<Index>(3 * a), static_cast<Index>(3 * b)) *
                   turn.transpose());
    }
  }
}

/// @return the energy of the remainder
double RubberRemainder::add_element(std::size_t e, std::size_t column, std::span<const Vec3> u,
                                    double weight, std::span<Vec3> force) const noexcept {
  const State& s = state_[e];
  const auto [node, more, all] = placed(e, column, u);
  const RubberForce now =
      rubber_force(rubber_.points[e], all, rubber_.rubbers[at(rubber_.rubber[e])]);
  const Eigen::Vector<double, 24> way = flat(more), linear = s.stiffness * way;
  const Eigen::Vector<double, 24> left = flat(now.force) - s.force - linear;
  for (std::size_t a = 0; a < 8; ++a) {
    const auto f = left.segment<3>(static_cast<Index>(3 * a));
    force[node[a]] += weight * (axes_[column] * Vec3{f[0], f[1], f[2]});
  }
  return now.energy - s.energy - s.force.dot(way) - 0.5 * way.dot(linear);
}

void RubberRemainder::add_to(std::span<const Vec3> u, std::span<const double> weight,
                             std::span<Vec3> force, std::span<double> energy) const noexcept {
  RONDO_ASSERT(u.size() == rubber_.u.size() * axes_.size() && force.size() == u.size() &&
                   weight.size() == axes_.size() && energy.size() == axes_.size(),
               u.size(), force.size(), weight.size(), energy.size());
  for (std::size_t j = 0; j < weight.size(); ++j) {
    energy[j] = 0.0;
    if (weight[j] == 0.0) continue;
    for (std::size_t e = 0; e < state_.size(); ++e)
      energy[j] += add_element(e, j, u, weight[j], force);
  }
}

}  // namespace rondo::fem::finite
