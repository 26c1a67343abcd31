// SPDX-License-Identifier: BSD-3-Clause
/// @file  Groups of contacts that share nodes, directly or through others (docs/theory.md, 4.7).
#pragma once
#include <span>
#include <vector>

namespace rondo::contact {

/// Contacts of cluster k: contacts[start[k]] ... contacts[start[k + 1] - 1], ascending. Clusters
/// are in the order of their first contact.
struct Clusters {
  std::vector<int> start;     ///< (clusters + 1)
  std::vector<int> contacts;  ///< (contacts)

  [[nodiscard]] std::size_t size() const noexcept { return start.empty() ? 0 : start.size() - 1; }
  [[nodiscard]] std::span<const int> operator[](std::size_t k) const noexcept {
    return {contacts.data() + start[k], contacts.data() + start[k + 1]};
  }
};

/// Finds clusters again and again in the same memory, which only grows.
class ClusterFinder {
 public:
  /// Nodes of contact j: nodes[node_start[j]] ... nodes[node_start[j + 1] - 1], each in
  /// [0, n_nodes). O(entries), not O(n_nodes), but for the first call with a larger n_nodes.
  const Clusters& find(std::span<const int> node_start, std::span<const int> nodes,
                       std::size_t n_nodes);

 private:
  int root(int contact) noexcept;

  std::vector<int> parent_;      ///< (contacts) union–find
  std::vector<int> first_at_;    ///< (n_nodes) a contact that has the node, -1: none
  std::vector<int> cluster_of_;  ///< (contacts)
  std::vector<int> filled_;      ///< (clusters) next free place
  Clusters clusters_;
};

}  // namespace rondo::contact
