// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/coupled/clusters.hpp"

#include <algorithm>
#include <numeric>

namespace rondo::contact {

int ClusterFinder::root(int contact) noexcept {
  auto at = static_cast<std::size_t>(contact);
  while (parent_[at] != static_cast<int>(at)) {
    parent_[at] = parent_[static_cast<std::size_t>(parent_[at])];
    at = static_cast<std::size_t>(parent_[at]);
  }
  return static_cast<int>(at);
}

const Clusters& ClusterFinder::find(std::span<const int> node_start, std::span<const int> nodes,
                                    std::size_t n_nodes) {
  const std::size_t nc = node_start.empty() ? 0 : node_start.size() - 1;
  if (first_at_.size() < n_nodes) first_at_.resize(n_nodes, -1);
  parent_.resize(nc);
  std::iota(parent_.begin(), parent_.end(), 0);
  for (std::size_t j = 0; j < nc; ++j)
    for (int k = node_start[j]; k < node_start[j + 1]; ++k) {
      int& first = first_at_[static_cast<std::size_t>(nodes[static_cast<std::size_t>(k)])];
      if (first < 0) first = static_cast<int>(j);
      // The smaller root stays: a cluster's root is its first contact.
      const int one = root(first), other = root(static_cast<int>(j));
      parent_[static_cast<std::size_t>(std::max(one, other))] = std::min(one, other);
    }
  for (const int node : nodes) first_at_[static_cast<std::size_t>(node)] = -1;
  cluster_of_.resize(nc);
  clusters_.start.assign(1, 0);
  for (std::size_t j = 0; j < nc; ++j) {
    const auto r = static_cast<std::size_t>(root(static_cast<int>(j)));
    if (r == j) {
      cluster_of_[j] = static_cast<int>(clusters_.size());
      clusters_.start.push_back(0);
    }
    cluster_of_[j] = cluster_of_[r];
    ++clusters_.start[static_cast<std::size_t>(cluster_of_[j]) + 1];
  }
  std::partial_sum(clusters_.start.begin(), clusters_.start.end(), clusters_.start.begin());
  clusters_.contacts.resize(nc);
  filled_.assign(clusters_.start.begin(), clusters_.start.end());
  for (std::size_t j = 0; j < nc; ++j) {
    int& place = filled_[static_cast<std::size_t>(cluster_of_[j])];
    clusters_.contacts[static_cast<std::size_t>(place++)] = static_cast<int>(j);
  }
  return clusters_;
}

}  // namespace rondo::contact
