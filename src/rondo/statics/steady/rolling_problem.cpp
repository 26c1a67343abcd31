// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady/rolling_problem.hpp"

#include <cmath>
#include <utility>

namespace rondo::statics {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The product by the columns where there is a force: many pairs touch nothing.
VectorXd times(const MatrixXd& matrix, const VectorXd& force) {
  VectorXd sum = VectorXd::Zero(matrix.rows());
  for (Index c = 0; c < force.size(); ++c)
    if (force[c] != 0.0) sum += force[c] * matrix.col(c);
  return sum;
}

/// Number `component` of each pair. @param each numbers a pair has
VectorXd along(const VectorXd& all, Index component, Index each) {
  return all(Eigen::seqN(component, all.size() / each, each));
}

double sum_of(const VectorXd& all, Index component, Index each) {
  return all(Eigen::seqN(component, all.size() / each, each)).sum();
}

/// Moments about the center's projection on the ground, of forces at places: about t2, and in space
/// about n and t1 as well. They are bilinear.
template <int D>
struct Moments {
  double rolling, aligning = 0.0, overturning = 0.0;

  Moments(const VectorXd& place, const VectorXd& force) {
    const VectorXd normal = along(force, 0, D), ahead = along(place, 0, D - 1);
    rolling = ahead.dot(normal);
    if constexpr (D == 3) {
      const VectorXd aside = along(place, 1, D - 1);
      aligning = aside.dot(along(force, 1, D)) - ahead.dot(along(force, 2, D));
      overturning = -aside.dot(normal);
    }
  }
};

}  // namespace

template <>
NodeMatrix<2> ground_axes<2>(Complex /*lean*/) noexcept {
  NodeMatrix<2> axes;
  axes << 0.0, 1.0, 1.0, 0.0;
  return axes;
}

template <>
NodeMatrix<3> ground_axes<3>(Complex lean) noexcept {
  NodeMatrix<3> axes;
  axes << 0.0, 1.0, 0.0, lean.re, 0.0, -lean.im, lean.im, 0.0, lean.re;
  return axes;
}

template <int D>
MatrixXd yawed(const MatrixXd& places) {
  const Index n = places.rows() / (D - 1);
  MatrixXd moved = MatrixXd::Zero(D * n, places.cols());
  if constexpr (D == 3) {
    moved(Eigen::seqN(1, n, D), Eigen::all) = places(Eigen::seqN(1, n, D - 1), Eigen::all);
    moved(Eigen::seqN(2, n, D), Eigen::all) = -places(Eigen::seqN(0, n, D - 1), Eigen::all);
  }
  return moved;
}

template <int D>
MatrixXd yawing_matrix(const RollingProblem<D>& problem, double turn) {
  if (turn == 0.0) return problem.matrix;
  return problem.matrix + turn * yawed<D>(problem.matrix_place);
}

template <int D>
VectorXd gaps_and_ways(const RollingProblem<D>& problem, const RollingPoint& p,
                       const RollingPath& path) {
  VectorXd all = problem.base + times(problem.matrix, p.force);
  const Index m = problem.n_pairs();
  const double way = p.speed * problem.time;
  all(Eigen::seqN(0, m, D)).array() += p.height;
  all(Eigen::seqN(1, m, D)).array() += way * std::cos(path.slip_angle);
  if constexpr (D == 3) all(Eigen::seqN(2, m, D)).array() += way * std::sin(path.slip_angle);
  if (path.turn_slip != 0.0)
    all += way * path.turn_slip * yawed<D>(places(problem, p.force)).reshaped();
  return all;
}

template <int D>
VectorXd places(const RollingProblem<D>& problem, const VectorXd& force) {
  return problem.base_place + times(problem.matrix_place, force);
}

/// The axle is along cos γ t2 + sin γ n, a height above the ground that the forces are on.
template <int D>
RollingForces forces_of(const RollingProblem<D>& problem, const RollingPoint& p) {
  const Moments<D> m(places(problem, p.force), p.force);
  RollingForces f;
  f.normal = along(p.force, 0, D).sum() / problem.pass;
  f.heading = sum_of(p.force, 1, D) / problem.pass;
  if constexpr (D == 3) f.lateral = sum_of(p.force, 2, D) / problem.pass;
  f.aligning = m.aligning / problem.pass;
  f.overturning = m.overturning / problem.pass;
  f.torque = problem.lean.re * (m.rolling / problem.pass + p.height * f.heading) +
             problem.lean.im * f.aligning + problem.base_weight + problem.weight.dot(p.force);
  return f;
}

template <int D>
void add_force(const NodeVector<D>& r, const NodeVector<D - 1>& place, double height, Complex lean,
               double share, RollingForces& sum) noexcept {
  RollingForces f;
  if constexpr (D == 3) {
    f.lateral = r[2];
    f.aligning = place[1] * r[1] - place[0] * r[2];
    f.overturning = -place[1] * r[0];
  }
  sum.normal += share * r[0];
  sum.heading += share * r[1];
  sum.lateral += share * f.lateral;
  sum.torque += share * (lean.re * (place[0] * r[0] + height * r[1]) + lean.im * f.aligning);
  sum.aligning += share * f.aligning;
  sum.overturning += share * f.overturning;
}

template <int D>
TorqueChange torque_change(const RollingProblem<D>& problem, const RollingPoint& p) {
  const double cosine = problem.lean.re, sine = problem.lean.im;
  const Index n = problem.n_pairs();
  const auto normal = Eigen::seqN(0, n, D), heading = Eigen::seqN(1, n, D);
  const VectorXd place = problem.base_place + problem.matrix_place * p.force;
  const VectorXd ahead = along(place, 0, D - 1);
  VectorXd by_place = cosine * along(p.force, 0, D);  // (D - 1 pairs)
  if constexpr (D == 3) {
    const VectorXd by_ahead = by_place - sine * along(p.force, 2, D);
    by_place.resize(place.size());
    by_place(Eigen::seqN(0, n, 2)) = by_ahead;
    by_place(Eigen::seqN(1, n, 2)) = sine * along(p.force, 1, D);
  }
  VectorXd row = problem.matrix_place.transpose() * by_place;
  row(normal) += cosine * ahead;
  row(heading).array() += cosine * p.height;
  if constexpr (D == 3) {
    row(heading) += sine * along(place, 1, D - 1);
    row(Eigen::seqN(2, n, D)) -= sine * ahead;
  }
  row += problem.pass * problem.weight;
  return {std::move(row), cosine * p.force(heading).sum()};
}

template <int D>
RollingForces forces_change(const RollingProblem<D>& problem, const RollingPoint& p,
                            const TorqueChange& torque, const RollingPoint& change) {
  RollingForces f;
  f.normal = sum_of(change.force, 0, D) / problem.pass;
  f.heading = sum_of(change.force, 1, D) / problem.pass;
  f.torque = (torque.row.dot(change.force) + torque.by_height * change.height) / problem.pass;
  if constexpr (D == 3) {
    f.lateral = sum_of(change.force, 2, D) / problem.pass;
    const Moments<D> here(places(problem, p.force), change.force),
        moved(times(problem.matrix_place, change.force), p.force);
    f.aligning = (here.aligning + moved.aligning) / problem.pass;
    f.overturning = (here.overturning + moved.overturning) / problem.pass;
  }
  return f;
}

template MatrixXd yawed<2>(const MatrixXd&);
template MatrixXd yawing_matrix(const RollingProblem<2>&, double);
template VectorXd gaps_and_ways(const RollingProblem<2>&, const RollingPoint&, const RollingPath&);
template VectorXd places(const RollingProblem<2>&, const VectorXd&);
template RollingForces forces_of(const RollingProblem<2>&, const RollingPoint&);
template void add_force<2>(const NodeVector<2>&, const NodeVector<1>&, double, Complex, double,
                           RollingForces&) noexcept;
template TorqueChange torque_change(const RollingProblem<2>&, const RollingPoint&);
template RollingForces forces_change(const RollingProblem<2>&, const RollingPoint&,
                                     const TorqueChange&, const RollingPoint&);
template MatrixXd yawed<3>(const MatrixXd&);
template MatrixXd yawing_matrix(const RollingProblem<3>&, double);
template VectorXd gaps_and_ways(const RollingProblem<3>&, const RollingPoint&, const RollingPath&);
template VectorXd places(const RollingProblem<3>&, const VectorXd&);
template RollingForces forces_of(const RollingProblem<3>&, const RollingPoint&);
template void add_force<3>(const NodeVector<3>&, const NodeVector<2>&, double, Complex, double,
                           RollingForces&) noexcept;
template TorqueChange torque_change(const RollingProblem<3>&, const RollingPoint&);
template RollingForces forces_change(const RollingProblem<3>&, const RollingPoint&,
                                     const TorqueChange&, const RollingPoint&);

}  // namespace rondo::statics
