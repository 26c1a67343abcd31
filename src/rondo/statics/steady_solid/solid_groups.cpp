// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady_solid/solid_groups.hpp"

#include <map>
#include <utility>

namespace rondo::statics {
namespace {

using Eigen::Index;

constexpr int group_size = 4;

int group_of(int sample) noexcept {
  return sample / group_size - (sample % group_size < 0 ? 1 : 0);
}

}  // namespace

SolidGroups grouped(const SolidRollingProblem& all) {
  SolidGroups g;
  std::map<std::pair<std::size_t, int>, std::size_t> numbers;
  for (const RollingPair& p : all.pairs) {
    const std::pair<std::size_t, int> key{p.candidate, group_of(p.sample)};
    const auto [found, is_new] = numbers.try_emplace(key, numbers.size());
    if (is_new) g.problem.pairs.push_back({key.first, key.second});
    g.of.push_back(found->second);
  }
  const auto n = static_cast<Index>(numbers.size());
  g.share = Eigen::VectorXd::Zero(n);
  for (const std::size_t group : g.of) g.share[static_cast<Index>(group)] += 1.0;
  g.share = g.share.cwiseInverse().eval();
  SolidRollingProblem& few = g.problem;
  few.ground = all.ground;
  few.time = all.time;
  few.pass = all.pass;
  few.base_weight = all.base_weight;
  few.base = Eigen::VectorXd::Zero(3 * n);
  few.weight = few.base;
  few.matrix = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  few.base_place = Eigen::VectorXd::Zero(2 * n);
  few.matrix_place = Eigen::MatrixXd::Zero(2 * n, 3 * n);
  for (std::size_t q = 0; q < g.of.size(); ++q) {
    const auto from = static_cast<Index>(q), to = static_cast<Index>(g.of[q]);
    few.base.segment<3>(3 * to) += g.share[to] * all.base.segment<3>(3 * from);
    few.weight.segment<3>(3 * to) += g.share[to] * all.weight.segment<3>(3 * from);
    few.base_place.segment<2>(2 * to) += g.share[to] * all.base_place.segment<2>(2 * from);
    for (std::size_t p = 0; p < g.of.size(); ++p) {
      const auto row = static_cast<Index>(p), at = static_cast<Index>(g.of[p]);
      const double both = g.share[to] * g.share[at];
      few.matrix.block<3, 3>(3 * at, 3 * to) += both * all.matrix.block<3, 3>(3 * row, 3 * from);
      few.matrix_place.block<2, 3>(2 * at, 3 * to) +=
          both * all.matrix_place.block<2, 3>(2 * row, 3 * from);
    }
  }
  return g;
}

Eigen::VectorXd spread(const SolidGroups& g, const Eigen::VectorXd& force) {
  Eigen::VectorXd fine(static_cast<Index>(3 * g.of.size()));
  for (std::size_t p = 0; p < g.of.size(); ++p) {
    const auto group = static_cast<Index>(g.of[p]);
    fine.segment<3>(static_cast<Index>(3 * p)) = g.share[group] * force.segment<3>(3 * group);
  }
  return fine;
}

Eigen::VectorXd gathered(const SolidGroups& g, const Eigen::VectorXd& force) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(3 * g.share.size());
  for (std::size_t p = 0; p < g.of.size(); ++p)
    sums.segment<3>(static_cast<Index>(3 * g.of[p])) += force.segment<3>(static_cast<Index>(3 * p));
  return sums;
}

}  // namespace rondo::statics
