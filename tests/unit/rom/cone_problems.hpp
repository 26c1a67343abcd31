// SPDX-License-Identifier: BSD-3-Clause
/// @file  Problems of the law of contact in space, and a slow solver that shares no code with it.
#pragma once
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <numbers>
#include <random>
#include <vector>

#include "rondo/contact/cone.hpp"
#include "rondo/core/index.hpp"
#include "rondo/rom/solid/cone_law.hpp"
#include "rondo/rom/solid/solid_residual.hpp"

namespace rondo::rom::cone_problems {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd, Eigen::Vector3d;

struct Problem {
  WindowCompliance window;
  MatrixXd compliance;  ///< in the axes of the compliance
  std::vector<ConeContact> contacts;
};

inline Vec3 plain(const Vector3d& a) {
  return {a[0], a[1], a[2]};
}

/// The compliance along the axes of the contacts, rim included.
inline MatrixXd dense(const Problem& p) {
  const auto n = static_cast<Index>(p.contacts.size());
  MatrixXd axes = MatrixXd::Zero(3 * n, p.compliance.rows());
  MatrixXd lift(3 * n, 3), reply(3 * n, 3);
  for (Index i = 0; i < n; ++i) {
    const ConeContact& c = p.contacts[at(i)];
    for (Index k = 0; k < 3; ++k) {
      axes.block<1, 3>(3 * i + k, Index{3} * c.place) = vector_of(c.axes[at(k)]).transpose();
      lift.block<3, 1>(3 * i, k) = vector_of(c.lift[at(k)]);
      reply.block<3, 1>(3 * i, k) = vector_of(c.reply[at(k)]);
    }
  }
  return axes * p.compliance * axes.transpose() + lift * reply.transpose();
}

inline VectorXd forces_of(const Problem& p) {
  VectorXd r(3 * static_cast<Index>(p.contacts.size()));
  for (std::size_t i = 0; i < p.contacts.size(); ++i)
    r.segment<3>(static_cast<Index>(3 * i)) = vector_of(p.contacts[i].force);
  return r;
}

/// Gaps and distances slid under forces.
inline VectorXd moved_by(const Problem& p, const VectorXd& forces) {
  VectorXd u = dense(p) * forces;
  for (std::size_t i = 0; i < p.contacts.size(); ++i)
    u.segment<3>(static_cast<Index>(3 * i)) += vector_of(p.contacts[i].free);
  return u;
}

/// |r - P(r - ŵ / mean)| of the worst contact over the largest force, with ŵ = w + μ|w_t| n.
inline double missed(const Problem& p) {
  const VectorXd r = forces_of(p), u = moved_by(p, r);
  const double mean = dense(p).diagonal().mean();
  double worst = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < p.contacts.size(); ++i) {
    const auto row = static_cast<Index>(3 * i);
    Vector3d w = u.segment<3>(row);
    w[0] += p.contacts[i].friction * w.tail<2>().norm();
    const Vector3d force = r.segment<3>(row);
    const Vec3 nearest = contact::project_on_cone(plain(force - w / mean), p.contacts[i].friction);
    worst = std::max(worst, (force - vector_of(nearest)).norm());
    largest = std::max({largest, force[0], -p.contacts[i].free.x / mean});
  }
  return worst / largest;
}

/// One contact after the other goes along its natural map, many times. (3n) forces.
inline VectorXd by_projection(const Problem& p, int sweeps, double share = 0.7) {
  const MatrixXd a = dense(p);
  const VectorXd free = moved_by(p, VectorXd::Zero(a.rows()));
  VectorXd r = VectorXd::Zero(a.rows());
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (std::size_t i = 0; i < p.contacts.size(); ++i) {
      const auto row = static_cast<Index>(3 * i);
      Vector3d w = free.segment<3>(row) + a.middleRows<3>(row) * r;
      const double mu = p.contacts[i].friction, rho = share / a.block<3, 3>(row, row).norm();
      w[0] += mu * w.tail<2>().norm();
      r.segment<3>(row) =
          vector_of(contact::project_on_cone(plain(r.segment<3>(row) - rho * w), mu));
    }
  return r;
}

struct Choice {
  int contacts = 20;
  double friction = 0.3;
  bool rim = false;
};

/// A compliance near 1e-7 m/N that is not symmetric, and contacts of which a third are open.
inline Problem random_problem(unsigned seed, const Choice& choice) {
  std::mt19937 numbers(seed);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const auto random = [&](Index rows, Index columns) {
    return MatrixXd(MatrixXd::NullaryExpr(rows, columns, [&] { return any(numbers); }));
  };
  const auto vec = [&](double size) {
    const double x = size * any(numbers), y = size * any(numbers);
    return Vec3{x, y, size * any(numbers)};
  };
  const Index nodes = choice.contacts + 3, n = 3 * nodes;
  Problem p;
  const MatrixXd root = random(n, n);
  p.compliance =
      1e-7 * (MatrixXd::Identity(n, n) + root * root.transpose() / static_cast<double>(2 * n) +
              0.1 * random(n, n) / std::sqrt(static_cast<double>(n)));
  p.window.resize(n, 1);
  p.window.set(0, p.compliance);
  for (int i = 0; i < choice.contacts; ++i) {
    ConeContact c;
    c.place = i + (i > 4 ? 1 : 0) + (i > 11 ? 2 : 0);  // not all nodes of the window
    const Eigen::Matrix3d turn =
        Eigen::Quaterniond(Eigen::Vector4d(random(4, 1)).normalized()).toRotationMatrix();
    for (Index k = 0; k < 3; ++k) c.axes[at(k)] = plain(turn.col(k));
    c.free = vec(2e-3);
    c.free.x = 1e-2 * (any(numbers) - 0.35);
    c.friction = choice.friction;
    if (choice.rim)
      for (std::size_t k = 0; k < 3; ++k) {
        c.lift[k] = vec(1e-6);
        c.reply[k] = 1e5 * c.lift[k] + vec(1e-2);  // a rim that a force lifts goes its way
      }
    p.contacts.push_back(c);
  }
  return p;
}

/// The wheel without modes, pressed 8 mm onto flat ground and dragged along it by 1 mm, at an
/// angle: what a step has to solve.
inline Problem window_problem(const SolidRing& ring, double friction) {
  const RingResidual g = solid_residual(ring, {}, 0.0);
  const Index size = g.size, sectors = 11;
  Problem p;
  p.window.resize(size, sectors);
  p.compliance.resize(size * sectors, size * sectors);
  for (Index lag = 1 - sectors; lag < sectors; ++lag) {
    p.window.set(lag, g.block(static_cast<int>(lag)));
    for (Index to = std::max<Index>(0, lag); to < std::min(sectors, sectors + lag); ++to)
      p.compliance.block(to * size, (to - lag) * size, size, size) = g.block(static_cast<int>(lag));
  }
  const double pitch = 2.0 * std::numbers::pi / ring.n_sectors();
  const auto nodes = static_cast<int>(ring.contact.size());
  for (int i = 0; i < nodes * static_cast<int>(sectors); ++i) {
    const double angle = pitch * (i / nodes - 5 + 0.3), c = std::cos(angle), s = std::sin(angle);
    const double gap = 0.292 - 0.3 * c;
    if (gap > 1e-3) continue;
    ConeContact contact;
    contact.place = i;
    contact.axes = {Vec3{-c, s, 0.0}, Vec3{s, c, 0.0}, Vec3{0.0, 0.0, 1.0}};
    contact.free = {gap, 1e-3, 3e-4};
    contact.friction = friction;
    p.contacts.push_back(contact);
  }
  return p;
}

}  // namespace rondo::rom::cone_problems
