// SPDX-License-Identifier: BSD-3-Clause
/// @file  Nodes of a wheel that may touch the ground, numbered as they come: a candidate of a
/// sector at each.
#pragma once
#include <cstddef>
#include <vector>

namespace rondo::study {

class TouchingNodes {
 public:
  TouchingNodes(std::size_t n_candidates, std::size_t n_sectors)
      : n_sectors_(n_sectors), number_(n_candidates * n_sectors, -1) {}

  /// Numbers a node that has no number yet. @param node of the wheel
  void include(std::size_t candidate, std::size_t sector, std::size_t node) {
    int& number = number_[candidate * n_sectors_ + sector];
    if (number >= 0) return;
    number = static_cast<int>(nodes_.size());
    nodes_.push_back(node);
  }
  /// -1: it was not included.
  [[nodiscard]] int number(std::size_t candidate, std::size_t sector) const noexcept {
    return number_[candidate * n_sectors_ + sector];
  }
  /// By their numbers.
  [[nodiscard]] const std::vector<std::size_t>& nodes() const noexcept { return nodes_; }

 private:
  std::size_t n_sectors_;
  std::vector<int> number_;
  std::vector<std::size_t> nodes_;
};

}  // namespace rondo::study
