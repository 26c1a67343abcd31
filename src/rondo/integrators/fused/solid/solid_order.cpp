// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/solid/solid_order.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::dynamics {
namespace {

using fem::SolidSector;

/// In smaller wheels no steps follow each other in a pass.
constexpr std::size_t nodes_in_cache = 12'000;

/// The distance of each row from the side of least z, in nodes.
std::vector<int> levels_from_side(const SolidSector& k, const std::vector<double>& z) {
  const auto [least, most] = std::minmax_element(z.begin(), z.end());
  const double side = *least + 1e-9 * (*most - *least);
  std::vector<int> level(k.n_local(), -1);
  std::vector<std::size_t> found;
  for (std::size_t a = 0; a < level.size(); ++a)
    if (z[a] <= side) {
      level[a] = 0;
      found.push_back(a);
    }
  for (std::size_t i = 0; i < found.size(); ++i)
    for (const SolidSector::Entry& e : k.row(found[i])) {
      const auto b = static_cast<std::size_t>(e.column);
      if (level[b] >= 0) continue;
      level[b] = level[found[i]] + 1;
      found.push_back(b);
    }
  return level;
}

/// Level by level, meridian by meridian: rows that follow each other couple with the same nodes.
std::vector<int> order_from_side(const Model& model) {
  const SolidSector& k = model.solid->linear();
  std::vector<double> z;
  std::vector<long> meridian;  // by its angle, in steps that round-off does not see
  for (std::size_t a = 0; a < k.n_local(); ++a) {
    const Vec2 x = conj(k.turn[0]) * model.reference[k.node(a, 0)];
    const Vec2 first = conj(k.turn[0]) * model.reference[k.node(0, 0)];
    meridian.push_back(std::lround(1e6 * std::atan2(cross(first, x), dot(first, x))));
    z.push_back(model.solid->axial[k.node(a, 0)]);
  }
  const std::vector<int> level = levels_from_side(k, z);
  std::vector<int> order(k.n_local());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    return std::tie(level[i], meridian[i], a) < std::tie(level[j], meridian[j], b);
  });
  return order;
}

std::vector<int> inverse(const std::vector<int>& order) {
  std::vector<int> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) place[at(order[i])] = static_cast<int>(i);
  return place;
}

/// The farthest rows that couple.
int width_of(const SolidSector& k, const std::vector<int>& order) {
  const std::vector<int> place = inverse(order);
  int width = 0;
  for (std::size_t a = 0; a < k.n_local(); ++a)
    for (const SolidSector::Entry& e : k.row(a))
      width = std::max(width, place[at(e.column)] - place[a]);
  return width;
}

SolidSector in_order(const SolidSector& k, const std::vector<int>& order) {
  const std::vector<int> place = inverse(order);
  SolidSector out;
  out.n_sectors = k.n_sectors;
  out.nodes_per_sector = k.nodes_per_sector;
  out.turn = k.turn;
  out.row_start.push_back(0);
  for (const int row : order) {
    const auto a = static_cast<std::size_t>(row);
    out.nodes.push_back(k.nodes[a]);
    for (SolidSector::Entry e : k.row(a)) {
      e.column = place[at(e.column)];
      out.entries.push_back(e);
    }
    out.row_start.push_back(out.entries.size());
  }
  return out;
}

}  // namespace

OrderedSector order_sector(const Model& model) {
  RONDO_DEMAND(model.solid && model.solid->axial.size() == model.n_nodes() &&
                   model.solid->sector.n_local() > 0,
               model.solid.has_value(), model.n_nodes());
  const SolidSector& k = model.solid->linear();
  std::vector<int> order(k.n_local());
  std::iota(order.begin(), order.end(), 0);
  std::vector<int> from_side = order_from_side(model);
  const bool large = k.n_local() * static_cast<std::size_t>(k.n_sectors) > nodes_in_cache;
  if (large && width_of(k, from_side) < width_of(k, order)) order = std::move(from_side);
  return {in_order(k, order), std::move(order)};
}

}  // namespace rondo::dynamics
