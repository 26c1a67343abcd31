// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady/rolling_problem.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace rondo::statics {
namespace {

using Eigen::Index;

constexpr int group_size = 4;

int group_of(int sample) noexcept {
  return sample / group_size - (sample % group_size < 0 ? 1 : 0);
}

/// Columns of the matrix where there is a force: many pairs touch nothing.
Eigen::VectorXd times(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& force) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(matrix.rows());
  for (Index c = 0; c < force.size(); ++c)
    if (force[c] != 0.0) sum += force[c] * matrix.col(c);
  return sum;
}

}  // namespace

Eigen::VectorXd gaps_and_ways(const RollingProblem& problem, const RollingPoint& p) {
  Eigen::VectorXd all = problem.base + times(problem.matrix, p.force);
  const Index m = all.size() / 2;
  all(Eigen::seqN(0, m, 2)).array() += p.height;
  all(Eigen::seqN(1, m, 2)).array() += p.speed * problem.time;
  return all;
}

RollingForces forces_of(const RollingProblem& problem, const RollingPoint& p) {
  const Index m = p.force.size() / 2;
  const Eigen::VectorXd normal = p.force(Eigen::seqN(0, m, 2)),
                        x = problem.base_x + times(problem.matrix_x, p.force);
  RollingForces f;
  f.y = normal.sum() / problem.pass;
  f.x = p.force(Eigen::seqN(1, m, 2)).sum() / problem.pass;
  f.torque = x.dot(normal) / problem.pass + p.height * f.x + problem.base_weight +
             problem.weight.dot(p.force);
  return f;
}

std::vector<std::size_t> groups_of(const RollingProblem& problem) {
  std::map<std::pair<std::size_t, int>, std::size_t> numbers;
  std::vector<std::size_t> groups;
  for (const RollingPair& p : problem.pairs)
    groups.push_back(
        numbers.try_emplace({p.candidate, group_of(p.sample)}, numbers.size()).first->second);
  return groups;
}

RollingProblem grouped(const RollingProblem& all, const std::vector<std::size_t>& groups) {
  const std::size_t n = *std::ranges::max_element(groups) + 1;
  RollingProblem g;
  g.time = all.time;
  g.pass = all.pass;
  g.pairs.resize(n);
  Eigen::VectorXd share = Eigen::VectorXd::Zero(static_cast<Index>(n));
  for (const std::size_t of : groups) share[static_cast<Index>(of)] += 1.0;
  share = share.cwiseInverse().eval();
  const auto rows = static_cast<Index>(2 * n);
  g.base = Eigen::VectorXd::Zero(rows);
  g.matrix = Eigen::MatrixXd::Zero(rows, rows);
  g.base_x = Eigen::VectorXd::Zero(rows / 2);
  g.matrix_x = Eigen::MatrixXd::Zero(rows / 2, rows);
  g.base_weight = all.base_weight;
  g.weight = Eigen::VectorXd::Zero(rows);
  const auto place = [&](std::size_t pair) { return static_cast<Index>(groups[pair]); };
  for (std::size_t q = 0; q < groups.size(); ++q) {
    const auto from = static_cast<Index>(2 * q);
    const Index to = place(q);
    g.pairs[groups[q]] = {all.pairs[q].candidate, group_of(all.pairs[q].sample)};
    g.base.segment<2>(2 * to) += share[to] * all.base.segment<2>(from);
    g.base_x[to] += share[to] * all.base_x[from / 2];
    g.weight.segment<2>(2 * to) += share[to] * all.weight.segment<2>(from);
    for (std::size_t p = 0; p < groups.size(); ++p) {
      const auto row = static_cast<Index>(2 * p);
      const double both = share[to] * share[place(p)];
      g.matrix.block<2, 2>(2 * place(p), 2 * to) += both * all.matrix.block<2, 2>(row, from);
      g.matrix_x.block<1, 2>(place(p), 2 * to) += both * all.matrix_x.block<1, 2>(row / 2, from);
    }
  }
  return g;
}

}  // namespace rondo::statics
