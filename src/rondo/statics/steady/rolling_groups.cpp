// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/statics/steady/rolling_groups.hpp"

#include <map>
#include <utility>

namespace rondo::statics {
namespace {

using Eigen::Index;

constexpr int group_size = 4;

int group_of(int sample) noexcept {
  return sample / group_size - (sample % group_size < 0 ? 1 : 0);
}

/// Which pair is in which group; of the problem all but its numbers.
template <int D>
RollingGroups<D> numbered(const RollingProblem<D>& all) {
  RollingGroups<D> g;
  RollingProblem<D>& few = g.problem;
  few.time = all.time;
  few.pass = all.pass;
  few.back = all.back;
  few.lean = all.lean;
  few.base_weight = all.base_weight;
  std::map<std::pair<std::size_t, int>, std::size_t> numbers;
  for (const RollingPair& p : all.pairs) {
    const std::pair<std::size_t, int> key{p.candidate, group_of(p.sample)};
    const auto [found, is_new] = numbers.try_emplace(key, numbers.size());
    if (is_new) few.pairs.push_back({key.first, key.second});
    g.of.push_back(found->second);
  }
  g.share = Eigen::VectorXd::Zero(std::ssize(few.pairs));
  for (const std::size_t group : g.of) g.share[static_cast<Index>(group)] += 1.0;
  g.share = g.share.cwiseInverse().eval();
  return g;
}

}  // namespace

template <int D>
RollingGroups<D> grouped(const RollingProblem<D>& all) {
  RollingGroups<D> g = numbered(all);
  RollingProblem<D>& few = g.problem;
  const Index n = g.share.size();
  constexpr Index along = D - 1;
  few.base = Eigen::VectorXd::Zero(D * n);
  few.weight = few.base;
  few.matrix = Eigen::MatrixXd::Zero(D * n, D * n);
  few.base_place = Eigen::VectorXd::Zero(along * n);
  few.matrix_place = Eigen::MatrixXd::Zero(along * n, D * n);
  for (std::size_t q = 0; q < g.of.size(); ++q) {
    const auto from = static_cast<Index>(q), to = static_cast<Index>(g.of[q]);
    const double share = g.share[to];
    few.base.template segment<D>(D * to) += share * all.base.template segment<D>(D * from);
    few.weight.template segment<D>(D * to) += share * all.weight.template segment<D>(D * from);
    few.base_place.template segment<along>(along * to) +=
        share * all.base_place.template segment<along>(along * from);
    for (std::size_t p = 0; p < g.of.size(); ++p) {
      const auto row = static_cast<Index>(p), at = static_cast<Index>(g.of[p]);
      const double both = share * g.share[at];
      few.matrix.template block<D, D>(D * at, D * to) +=
          both * all.matrix.template block<D, D>(D * row, D * from);
      few.matrix_place.template block<along, D>(along * at, D * to) +=
          both * all.matrix_place.template block<along, D>(along * row, D * from);
    }
  }
  return g;
}

template <int D>
Eigen::VectorXd spread(const RollingGroups<D>& g, const Eigen::VectorXd& force) {
  Eigen::VectorXd fine(static_cast<Index>(D * g.of.size()));
  for (std::size_t p = 0; p < g.of.size(); ++p) {
    const auto group = static_cast<Index>(g.of[p]);
    fine.segment<D>(static_cast<Index>(D * p)) = g.share[group] * force.segment<D>(D * group);
  }
  return fine;
}

template <int D>
Eigen::VectorXd gathered(const RollingGroups<D>& g, const Eigen::VectorXd& force) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(D * g.share.size());
  for (std::size_t p = 0; p < g.of.size(); ++p)
    sums.segment<D>(static_cast<Index>(D * g.of[p])) += force.segment<D>(static_cast<Index>(D * p));
  return sums;
}

template <int D>
std::vector<PairFriction> gathered(const RollingGroups<D>& g,
                                   const std::vector<PairFriction>& pairs) {
  if (pairs.empty()) return {};
  std::vector<PairFriction> means(g.problem.pairs.size(), PairFriction{.factor = 0.0});
  for (std::size_t p = 0; p < g.of.size(); ++p)
    means[g.of[p]].factor +=
        g.share[static_cast<Index>(g.of[p])] * (p < pairs.size() ? pairs[p].factor : 1.0);
  return means;
}

template RollingGroups<2> grouped(const RollingProblem<2>&);
template RollingGroups<3> grouped(const RollingProblem<3>&);
template Eigen::VectorXd spread(const RollingGroups<2>&, const Eigen::VectorXd&);
template Eigen::VectorXd spread(const RollingGroups<3>&, const Eigen::VectorXd&);
template Eigen::VectorXd gathered(const RollingGroups<3>&, const Eigen::VectorXd&);
template std::vector<PairFriction> gathered(const RollingGroups<2>&,
                                            const std::vector<PairFriction>&);
template std::vector<PairFriction> gathered(const RollingGroups<3>&,
                                            const std::vector<PairFriction>&);

}  // namespace rondo::statics
