// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/matrices/operators.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "rondo/analysis/build/memory.hpp"
#include "rondo/case/features/case_features.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::study {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;
using Index = Eigen::Index;

struct NotConstant {
  dynamics::Features of;
  std::string_view why;
};

constexpr std::array not_constant{
    NotConstant{dynamics::has::rubber,
                "is rubber at finite strain: its stiffness changes with the displacement"},
    NotConstant{dynamics::has::viscosity, "relaxes: its stiffness changes with the frequency"},
    NotConstant{dynamics::has::own_material, "is no linear one: it has no constant stiffness"},
    NotConstant{dynamics::has::free_bodies,
                "leaves bodies free: the frame of their stiffness turns with each of them"},
};

void refuse_not_constant(const Case& c, const dynamics::Model& model) {
  const dynamics::Features all = dynamics::features_of(model);
  for (const auto& [of, why] : not_constant)
    if ((all & of) != 0) {
      const CaseFeature& row = row_of(c, of);
      throw case_error(c, std::string(row.key),
                       fmt::format("{}, and there are no matrices of the motion", why),
                       std::string(row.without));
    }
}

/// Entries of K, with their triplets and the sum of K and its transpose [B].
std::size_t memory_of(const Case& c, const Setup& s) {
  const dynamics::Model& m = s.model;
  if (!m.solid) return 3 * stiffness_memory(m.n_nodes(), has_wide_rows(c, s.mesh));
  constexpr std::size_t bytes_of_entry = 16 + 4 * 12;
  const fem::SolidSector& k = m.solid->sector;
  return 9 * bytes_of_entry * k.entries.size() * static_cast<std::size_t>(k.n_sectors);
}

/// The frame of a sector: its columns are the radial, tangential and axial directions.
template <int C>
Eigen::Matrix<double, C, C> frame_of(Complex turn) {
  Eigen::Matrix<double, C, C> frame = Eigen::Matrix<double, C, C>::Identity();
  frame(0, 0) = frame(1, 1) = turn.re;
  frame(1, 0) = turn.im;
  frame(0, 1) = -turn.im;
  return frame;
}

/// K of all sectors from the blocks of one (docs/theory.md, 2.7). @param place (n) index of a node
/// among the free ones
template <int C>
Csr assemble_sectors(const fem::SectorBlocks<C>& k, const std::vector<int>& place, Index size) {
  using Block = Eigen::Matrix<double, C, C>;
  const auto n = static_cast<std::size_t>(k.n_sectors);
  Triplets entries;
  entries.reserve(static_cast<std::size_t>(C) * C * n * k.entries.size());
  for (std::size_t j = 0; j < n; ++j) {
    const std::array<std::size_t, 3> sector{(j + n - 1) % n, j, (j + 1) % n};
    for (std::size_t a = 0; a < k.n_local(); ++a)
      for (const auto& e : k.row(a)) {
        const std::size_t there = sector[at(e.shift + 1)];
        const Block block = frame_of<C>(k.turn[j]) * Eigen::Map<const Block>(e.block.data()) *
                            frame_of<C>(k.turn[there]).transpose();
        const int row = C * place[k.node(a, j)];
        const int column = C * place[k.node(at(e.column), there)];
        for (int p = 0; p < C; ++p)
          for (int q = 0; q < C; ++q) entries.emplace_back(row + p, column + q, block(p, q));
      }
  }
  Csr matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Csr transposed = matrix.transpose();
  return 0.5 * (matrix + transposed);  // the blocks were turned with round-off
}

Csr stiffness_of(const dynamics::Model& m, const std::vector<int>& place, Index size) {
  if (m.solid) return assemble_sectors(m.solid->sector, place, size);
  if (!m.stiffness.row_start.empty()) return fem::free_matrix(m.stiffness, m.free);
  RONDO_DEMAND(m.sector.has_value(), m.n_nodes());
  return assemble_sectors(*m.sector, place, size);
}

void add_masses(const dynamics::Model& m, Operators& o) {
  const auto size = static_cast<Index>(o.n_unknowns());
  const int components = static_cast<int>(o.components);
  Triplets mass, plane, turned;
  for (std::size_t k = 0; k < o.nodes.size(); ++k) {
    const double of_node = m.mass[at(o.nodes[k])];
    const int x = components * static_cast<int>(k), y = x + 1;
    for (int i = 0; i < components; ++i) mass.emplace_back(x + i, x + i, of_node);
    for (const int i : {x, y}) plane.emplace_back(i, i, of_node);
    turned.emplace_back(x, y, -2.0 * of_node);
    turned.emplace_back(y, x, 2.0 * of_node);
  }
  for (auto& [matrix, entries] : {std::pair(&o.mass, &mass), std::pair(&o.centrifugal, &plane),
                                  std::pair(&o.gyroscopic, &turned)}) {
    matrix->resize(size, size);
    matrix->setFromTriplets(entries->begin(), entries->end());
  }
}

}  // namespace

Operators make_operators(const Case& c, const Setup& s) {
  const dynamics::Model& m = s.model;
  refuse_not_constant(c, m);
  demand_memory(c, m.n_nodes(), memory_of(c, s));
  Operators o;
  o.components = m.components();
  o.nodes = m.free;
  std::vector<int> place(m.n_nodes(), -1);
  for (std::size_t k = 0; k < o.nodes.size(); ++k) {
    const std::size_t node = at(o.nodes[k]);
    place[node] = static_cast<int>(k);
    o.reference.insert(o.reference.end(), {m.reference[node].x, m.reference[node].y});
    if (m.solid) o.reference.push_back(m.solid->axial[node]);
  }
  add_masses(m, o);
  o.stiffness = stiffness_of(m, place, static_cast<Index>(o.n_unknowns()));
  o.damping = m.mass_damping * o.mass;
  if (m.stiffness_damping != 0.0) o.damping += m.stiffness_damping * o.stiffness;
  return o;
}

}  // namespace rondo::study
