// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/rom/wheel/creep_field.hpp"

#include <algorithm>

#include "rondo/core/contract.hpp"

namespace rondo::rom {

CreepField::CreepField(std::span<const CreepTerm> terms, std::span<const RingResidual> at_once,
                       std::span<const RingResidual> later, std::size_t n, double stiffness_damping,
                       double dt)
    : tables_{at_once, later},
      memory_(terms, at_once.size(), 2, CreepMemory::Numbers(n, 1.0), stiffness_damping, dt) {
  RONDO_DEMAND(at_once.size() == later.size(), at_once.size(), later.size());
}

/// G times a force on a node, added to all nodes.
void CreepField::add_product(const RingResidual& table, const NodeForce& from,
                             CreepMemory::Numbers& out) noexcept {
  const std::size_t size = at(table.size), c = size / 2, sectors = at(table.n_sectors),
                    sector = at(from.node) / c, local = at(from.node) % c;
  for (std::size_t d = 0; d < sectors; ++d) {
    const double* by_x = table.blocks.data() + (d * size + 2 * local) * size;
    const double* by_y = by_x + size;
    double* to = out.data() + (sector + d < sectors ? sector + d : sector + d - sectors) * size;
    for (std::size_t i = 0; i < size; ++i) to[i] += by_x[i] * from.force.x + by_y[i] * from.force.y;
  }
}

/// Finds the products of the tables with new forces.
void CreepField::push(std::span<const NodeForce> forces) noexcept {
  std::ranges::fill(memory_.acting(), 0.0);
  for (const NodeForce& from : forces) {
    memory_.acting()[2 * at(from.node)] += from.force.x;
    memory_.acting()[2 * at(from.node) + 1] += from.force.y;
  }
  for (std::size_t kind = 0; kind < 2; ++kind)
    for (std::size_t a = 0; a < memory_.n_tables(); ++a) {
      std::ranges::fill(memory_.pushing(kind, a), 0.0);
      for (const NodeForce& from : forces)
        add_product(tables_[kind][a], from, memory_.pushing(kind, a));
    }
}

void CreepField::start(std::span<const NodeForce> forces) noexcept {
  push(forces);
  memory_.start();
}

void CreepField::step(std::span<const NodeForce> forces) noexcept {
  push(forces);
  memory_.step();
}

Vec2 CreepField::now(int node, const TableShares& shares) const noexcept {
  Vec2 u;
  for (std::size_t a = 0; a < memory_.n_tables(); ++a)
    u += shares[a] * Vec2{memory_.now(a)[2 * at(node)], memory_.now(a)[2 * at(node) + 1]};
  return u;
}

Vec2 CreepField::left(int node, const TableShares& shares) const noexcept {
  Vec2 u;
  for (std::size_t a = 0; a < memory_.n_tables(); ++a)
    u += shares[a] * Vec2{memory_.left(a)[2 * at(node)], memory_.left(a)[2 * at(node) + 1]};
  return u;
}

CreepField::Lagging CreepField::lagging(int node) const noexcept {
  const auto x = memory_.lagging(2 * at(node)), y = memory_.lagging(2 * at(node) + 1);
  return {{x.at_once, y.at_once}, {x.later, y.later}};
}

CreepField::Lagging CreepField::lagging_before(int node) const noexcept {
  const auto x = memory_.lagging_before(2 * at(node)), y = memory_.lagging_before(2 * at(node) + 1);
  return {{x.at_once, y.at_once}, {x.later, y.later}};
}

}  // namespace rondo::rom
