// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/contact/coupled/rows.hpp"

#include <algorithm>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::contact {
namespace {

/// H_j G H_lᵀ with the complex number G.
Block through(const Block& hj, Complex g, const Block& hl) noexcept {
  const Vec2 n = g * Vec2{hl[0], hl[1]}, t = g * Vec2{hl[2], hl[3]};  // columns of G H_lᵀ
  const Vec2 row_n{hj[0], hj[1]}, row_t{hj[2], hj[3]};
  return {dot(row_n, n), dot(row_n, t), dot(row_t, n), dot(row_t, t)};
}

Block coupling(const ContactRows& j, const ContactRows& l,
               std::span<const Complex> response) noexcept {
  Block sum{};
  for (std::size_t a = 0; a < static_cast<std::size_t>(j.count); ++a)
    for (std::size_t b = 0; b < static_cast<std::size_t>(l.count); ++b) {
      if (j.node[a] != l.node[b]) continue;
      const Block part = through(j.block[a], response[at(j.node[a])], l.block[b]);
      for (std::size_t k = 0; k < 4; ++k) sum[k] += part[k];
    }
  return sum;
}

}  // namespace

ContactRows ground_rows(int node, Vec2 normal) noexcept {
  const Vec2 t = turn90(normal);
  return {1, {node, -1, -1}, {Block{normal.x, normal.y, t.x, t.y}, Block{}, Block{}}};
}

void DelassusBuilder::list_contacts(std::span<const ContactRows> contacts) {
  next_.resize(3 * contacts.size());
  for (std::size_t j = contacts.size(); j-- > 0;)
    for (std::size_t a = 0; a < static_cast<std::size_t>(contacts[j].count); ++a) {
      int& head = head_[at(contacts[j].node[a])];
      next_[3 * j + a] = head;
      head = static_cast<int>(3 * j + a);
    }
}

void DelassusBuilder::find_sharing(const ContactRows& contact) {
  sharing_.clear();
  for (std::size_t a = 0; a < static_cast<std::size_t>(contact.count); ++a) {
    int entry = head_[at(contact.node[a])];
    for (; entry >= 0; entry = next_[at(entry)]) sharing_.push_back(entry / 3);
  }
  std::sort(sharing_.begin(), sharing_.end());
  sharing_.erase(std::unique(sharing_.begin(), sharing_.end()), sharing_.end());
}

void DelassusBuilder::build(std::span<const ContactRows> contacts,
                            std::span<const Complex> response, CoupledProblem& problem) {
  if (head_.size() < response.size()) head_.resize(response.size(), -1);
  list_contacts(contacts);
  problem.row_start.assign(1, 0);
  problem.column.clear();
  problem.blocks.clear();
  problem.mass.clear();
  for (std::size_t j = 0; j < contacts.size(); ++j) {
    find_sharing(contacts[j]);
    for (const int l : sharing_) {
      problem.column.push_back(l);
      problem.blocks.push_back(coupling(contacts[j], contacts[at(l)], response));
      if (static_cast<std::size_t>(l) != j) continue;
      const Block& w = problem.blocks.back();
      RONDO_DEMAND(w[0] + w[3] > 0.0, j, w[0], w[3]);
      problem.mass.push_back(2.0 / (w[0] + w[3]));
    }
    problem.row_start.push_back(static_cast<int>(problem.column.size()));
  }
  for (const ContactRows& c : contacts)
    for (std::size_t a = 0; a < static_cast<std::size_t>(c.count); ++a) head_[at(c.node[a])] = -1;
}

}  // namespace rondo::contact
