// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/finite/swept_forces.hpp"

#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/fem/finite/enclosed_volume.hpp"

namespace rondo::fem::finite {

SweptForces::SweptForces(SweptFaces faces, std::vector<Vec3> x, int n_sectors)
    : faces_(std::move(faces)), x_(std::move(x)), n_sectors_(at(n_sectors)), of_state_(x_.size()) {
  RONDO_DEMAND(n_sectors >= 3 && x_.size() % n_sectors_ == 0, n_sectors, x_.size());
  for (const SweptCords& c : faces_.cords)
    RONDO_DEMAND(c.points.size() == c.lines.size(), c.points.size(), c.lines.size());
  const std::vector<Vec3> rest(x_.size());
  energy_of_state_ = find(rest, of_state_);
}

std::array<std::size_t, 4> SweptForces::nodes(const std::array<int, 2>& line,
                                              std::size_t column) const noexcept {
  const std::size_t n = x_.size() / n_sectors_, here = column * n,
                    next = (column + 1) % n_sectors_ * n;
  return {here + at(line[0]), here + at(line[1]), next + at(line[1]), next + at(line[0])};
}

void SweptForces::tangent(std::span<const Vec3> u, const TakeBlock& take) const {
  for (std::size_t j = 0; j < n_sectors_; ++j) {
    const auto add = [&](const std::array<int, 2>& line, double share, auto&& energy_of) {
      const std::array<std::size_t, 4> node = nodes(line, j);
      FaceCorners x;
      for (std::size_t a = 0; a < 4; ++a) x[a] = x_[node[a]] + u[node[a]];
      const Energy<4> of = energy_of(x);
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < 4; ++b)
          take(node[a], node[b],
               share * of.stiffness.block<3, 3>(static_cast<Eigen::Index>(3 * a),
                                                static_cast<Eigen::Index>(3 * b)));
    };
    for (const SweptCords& c : faces_.cords)
      for (std::size_t e = 0; e < c.lines.size(); ++e)
        add(c.lines[e], 1.0,
            [&](const FaceCorners& x) { return cord_face(c.points[e], x, c.law); });
    for (const auto& line : faces_.liner) add(line, -faces_.pressure, cone_volume);
  }
}

double SweptForces::find(std::span<const Vec3> u, std::span<Vec3> force) const noexcept {
  double energy = 0.0;
  for (std::size_t j = 0; j < n_sectors_; ++j) {
    const auto add = [&](const std::array<int, 2>& line, double share, auto&& force_of) {
      const std::array<std::size_t, 4> node = nodes(line, j);
      FaceCorners x;
      for (std::size_t a = 0; a < 4; ++a) x[a] = x_[node[a]] + u[node[a]];
      const FaceForce f = force_of(x);
      energy += share * f.energy;
      for (std::size_t a = 0; a < 4; ++a) force[node[a]] += share * f.force[a];
    };
    for (const SweptCords& c : faces_.cords)
      for (std::size_t e = 0; e < c.lines.size(); ++e)
        add(c.lines[e], 1.0,
            [&](const FaceCorners& x) { return cord_force(c.points[e], x, c.law); });
    for (const auto& line : faces_.liner) add(line, -faces_.pressure, cone_force);
  }
  return energy;
}

double SweptForces::add_to(std::span<const Vec3> u, std::span<Vec3> force) const noexcept {
  RONDO_ASSERT(u.size() == x_.size() && force.size() == u.size(), u.size(), x_.size());
  double energy = -energy_of_state_;
  for (std::size_t k = 0; k < u.size(); ++k) {
    energy -= dot(of_state_[k], u[k]);
    force[k] -= of_state_[k];
  }
  return energy + find(u, force);
}

}  // namespace rondo::fem::finite
