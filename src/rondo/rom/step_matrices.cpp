// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/step_matrices.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <utility>

#include "rondo/model/stability/critical_step.hpp"
#include "rondo/pod/dense.hpp"
#include "rondo/pod/svd.hpp"

namespace rondo::rom {

using pod::inverse;
using pod::multiply;

namespace {

MatrixXd product(const MatrixXd& a, const MatrixXd& b) {
  MatrixXd c(a.rows(), b.cols());
  multiply(a, b, c);
  return c;
}

/// L = K - s² + ṡJ.
MatrixXd restoring(const rom::ReducedModel& m, const StepMatrixKey& k) {
  MatrixXd l = m.stiffness + k.spin_rate * m.turn;
  l.diagonal().array() -= k.spin * k.spin;
  return l;
}

/// N = (I - Δt/2 s D)⁻¹; D = 0 is common, because nothing is carried in the co-rotating frame.
MatrixXd carrying(const rom::ReducedModel& m, const StepMatrixKey& k) {
  const MatrixXd unit = MatrixXd::Identity(m.size(), m.size());
  if (m.frame == rom::ModelFrame::turning || k.carry == 0.0) return unit;
  return inverse(unit - 0.5 * k.dt * k.carry * m.generator);
}

}  // namespace

double critical_step(const rom::ReducedModel& model, double stiffness_damping) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(model.stiffness, Eigen::EigenvaluesOnly);
  return dynamics::critical_step_of(std::sqrt(solver.eigenvalues().maxCoeff()),
                                    {stiffness_damping, 0.0});
}

StepMatrices::StepMatrices(const rom::ReducedModel& model, const StepMatrixKey& key)
    : key_(key), carry_(carrying(model, key)), work_(model.size()), other_(model.size()) {
  if (key.scheme == StepScheme::midpoint)
    make_midpoint(model);
  else
    make_central(model);
}

void StepMatrices::make_midpoint(const rom::ReducedModel& m) {
  const double h = 0.5 * key_.dt;
  from_q_ = h * product(restoring(m, key_), carry_);
  MatrixXd g = h * (2.0 * key_.spin * m.turn - key_.spin * m.generator +
                    key_.stiffness_damping * m.stiffness + from_q_);
  g.diagonal().array() += 1.0 + h * key_.mass_damping;
  push_ = inverse(std::move(g));
}

void StepMatrices::make_central(const rom::ReducedModel& m) {
  const double h = 0.5 * key_.dt;
  const MatrixXd unit = MatrixXd::Identity(m.size(), m.size());
  const MatrixXd turning = h * (2.0 * key_.spin * m.turn + key_.mass_damping * unit);
  push_ = inverse(unit + turning);
  from_q_ = -key_.dt * product(push_, restoring(m, key_));
  from_p_ = product(push_, unit - turning - key_.dt * key_.stiffness_damping * m.stiffness);
  carry_ = 2.0 * carry_ - unit;
}

void StepMatrices::advance(const VectorXd& q, const VectorXd& p, const VectorXd& push,
                           VectorXd& q_end, VectorXd& p_end, VectorXd& carried) {
  if (key_.scheme == StepScheme::central) {
    work_ = q + key_.dt * p;
    multiply(carry_, work_, q_end);
    multiply(carry_, p, carried);
    kick(q_end, carried, push, p_end);
    return;
  }
  const double h = 0.5 * key_.dt;
  carried = p;
  multiply(from_q_, q, other_);
  work_ = p + 0.5 * push - other_;
  multiply(push_, work_, p_end);  // p̄
  work_ = q + h * p_end;
  multiply(carry_, work_, q_end);  // q̄
  q_end = 2.0 * q_end - q;
  p_end = 2.0 * p_end - p;
}

void StepMatrices::kick(const VectorXd& q, const VectorXd& p, const VectorXd& push,
                        VectorXd& p_end) {
  multiply(from_p_, p, p_end);
  multiply(from_q_, q, work_);
  multiply(push_, push, other_);
  p_end += work_ + other_;
}

void StepMatrices::respond(const MatrixXd& pushes, MatrixXd& dq, MatrixXd& dp) const {
  dp = product(push_, pushes);
  if (key_.scheme == StepScheme::midpoint)
    dq = 0.5 * key_.dt * product(carry_, dp);
  else
    dq.setZero(pushes.rows(), pushes.cols());
}

void StepMatrices::add_response(const VectorXd& push, VectorXd& q, VectorXd& p) {
  multiply(push_, push, work_);
  p += work_;
  if (key_.scheme == StepScheme::central) return;
  multiply(carry_, work_, other_);
  q += 0.5 * key_.dt * other_;
}

}  // namespace rondo::rom
