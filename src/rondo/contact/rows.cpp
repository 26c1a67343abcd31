// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/rows.hpp"

#include <algorithm>

#include "rondo/core/contract.hpp"

namespace rondo::contact {
namespace {

/// H_j G H_lᵀ with the complex number G.
Block through(const Block& hj, Vec2 g, const Block& hl) noexcept {
  const Vec2 n = g * Vec2{hl[0], hl[1]}, t = g * Vec2{hl[2], hl[3]};  // columns of G H_lᵀ
  const Vec2 row_n{hj[0], hj[1]}, row_t{hj[2], hj[3]};
  return {dot(row_n, n), dot(row_n, t), dot(row_t, n), dot(row_t, t)};
}

Block coupling(const ContactRows& j, const ContactRows& l,
               std::span<const Vec2> response) noexcept {
  Block sum{};
  for (std::size_t a = 0; a < static_cast<std::size_t>(j.count); ++a)
    for (std::size_t b = 0; b < static_cast<std::size_t>(l.count); ++b) {
      if (j.node[a] != l.node[b]) continue;
      const Block part =
          through(j.block[a], response[static_cast<std::size_t>(j.node[a])], l.block[b]);
      for (std::size_t k = 0; k < 4; ++k) sum[k] += part[k];
    }
  return sum;
}

}  // namespace

ContactRows ground_rows(int node, Vec2 normal) noexcept {
  const Vec2 t = turn90(normal);
  return {1, {node, -1, -1}, {Block{normal.x, normal.y, t.x, t.y}, Block{}, Block{}}};
}

void DelassusBuilder::build(std::span<const ContactRows> contacts, std::span<const Vec2> response,
                            CoupledProblem& problem) {
  const int nc = static_cast<int>(contacts.size());
  if (head_.size() < response.size()) head_.resize(response.size(), -1);
  // Entry 3 j + a is node a of contact j; the contacts of a node are a linked list of entries.
  next_.resize(3 * contacts.size());
  for (int j = nc - 1; j >= 0; --j) {
    const ContactRows& c = contacts[static_cast<std::size_t>(j)];
    for (int a = 0; a < c.count; ++a) {
      int& head = head_[static_cast<std::size_t>(c.node[static_cast<std::size_t>(a)])];
      next_[static_cast<std::size_t>(3 * j + a)] = head;
      head = 3 * j + a;
    }
  }
  problem.row_start.assign(1, 0);
  problem.column.clear();
  problem.blocks.clear();
  problem.mass.clear();
  for (int j = 0; j < nc; ++j) {
    const ContactRows& c = contacts[static_cast<std::size_t>(j)];
    sharing_.clear();
    for (int a = 0; a < c.count; ++a) {
      const int node = c.node[static_cast<std::size_t>(a)];
      for (int e = head_[static_cast<std::size_t>(node)]; e >= 0;
           e = next_[static_cast<std::size_t>(e)])
        sharing_.push_back(e / 3);
    }
    std::sort(sharing_.begin(), sharing_.end());
    sharing_.erase(std::unique(sharing_.begin(), sharing_.end()), sharing_.end());
    for (const int l : sharing_) {
      problem.column.push_back(l);
      problem.blocks.push_back(coupling(c, contacts[static_cast<std::size_t>(l)], response));
      if (l != j) continue;
      const Block& w = problem.blocks.back();
      RONDO_DEMAND(w[0] + w[3] > 0.0, j, w[0], w[3]);
      problem.mass.push_back(2.0 / (w[0] + w[3]));
    }
    problem.row_start.push_back(static_cast<int>(problem.column.size()));
  }
  for (const ContactRows& c : contacts)
    for (int a = 0; a < c.count; ++a)
      head_[static_cast<std::size_t>(c.node[static_cast<std::size_t>(a)])] = -1;
}

}  // namespace rondo::contact
