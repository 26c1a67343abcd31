// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/rubber/rubber_plan.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/fem/hyperelastic/quadrilateral.hpp"

namespace rondo::dynamics {
namespace {

using kernels::lanes;
constexpr std::size_t corners_of_element = 4;
/// Packs of a block: threads share a small body evenly, and the sums of a large one are few.
constexpr std::size_t fewest_element_packs = 8, most_element_blocks = 512;

/// By material, then by their last row: elements read and write what is near.
std::vector<int> element_order(const RubberPart& rubber, std::span<const int> row) {
  std::vector<int> order(rubber.cells.size()), last(order.size());
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t e = 0; e < order.size(); ++e) {
    last[e] = -1;  // all held
    for (const int node : rubber.cells[e]) last[e] = std::max(last[e], row[at(node)]);
  }
  std::ranges::stable_sort(order, [&](int a, int b) {
    if (rubber.material[at(a)] != rubber.material[at(b)])
      return rubber.material[at(a)] < rubber.material[at(b)];
    return last[at(a)] < last[at(b)];
  });
  return order;
}

/// Elements of a material: packs, and blocks of them.
void add_material(std::span<const int> elements, std::size_t material, std::size_t n_branches,
                  std::size_t packs_of_block, RubberPlan& plan) {
  const std::size_t n = (elements.size() + lanes - 1) / lanes;
  for (std::size_t i = 0; i < n * lanes; ++i)
    plan.element.push_back(elements[std::min(i, elements.size() - 1)]);
  for (std::size_t first = 0; first < n; first += packs_of_block) {
    const std::size_t last = std::min(first + packs_of_block, n);
    RubberBlock block;
    block.first_pack = static_cast<std::ptrdiff_t>(plan.n_packs + first);
    block.last_pack = static_cast<std::ptrdiff_t>(plan.n_packs + last);
    block.lanes_of_last =
        last < n ? kernels::lanes : static_cast<int>(elements.size() - (n - 1) * lanes);
    block.material = material;
    block.first_history = plan.n_history + first * n_branches * 3 * lanes;
    plan.blocks.push_back(block);
  }
  plan.n_packs += n;
  plan.n_history += n * n_branches * 3 * lanes;
}

void add_packs(const RubberPart& rubber, std::span<const int> row, RubberPlan& plan) {
  const std::vector<int> order = element_order(rubber, row);
  const std::size_t packs_of_block =
      std::max(fewest_element_packs, order.size() / lanes / most_element_blocks + 1);
  std::size_t first = 0;
  for (std::size_t m = 0; m < rubber.materials.size(); ++m) {
    std::size_t last = first;
    while (last < order.size() && rubber.material[at(order[last])] == static_cast<int>(m)) ++last;
    if (last > first)
      add_material(std::span(order).subspan(first, last - first), m,
                   rubber.materials[m].branches.size(), packs_of_block, plan);
    first = last;
  }
}

void add_branches(const Model& model, RubberPlan& plan) {
  for (const fem::Rubber& rubber : model.rubber->materials) {
    plan.branches.emplace_back();
    RONDO_ASSERT(std::ranges::all_of(rubber.branches, [](const auto& b) { return b.time > 0.0; }),
                 rubber.branches.size());
    for (const fem::ViscousBranch& b : rubber.branches)
      plan.branches.back().push_back(
          {b.relative_modulus * rubber.shear_modulus(), std::expm1(0.5 * model.dt / b.time)});
  }
}

void add_geometry(const Model& model, std::span<const int> row, int zero, RubberPlan& plan) {
  namespace rubber = fem::hyperelastic;
  plan.geometry = LargeArray(plan.n_packs * 6 * lanes);
  plan.node = LargeArrayOf<std::int32_t>(plan.n_packs * corners_of_element * lanes);
  for (std::size_t i = 0; i < plan.element.size(); ++i) {
    const mesh::Cell& cell = model.rubber->cells[at(plan.element[i])];
    RONDO_ASSERT(mesh::n_corners(cell) == corners_of_element, plan.element[i]);
    rubber::Corners<double> x;
    for (std::size_t c = 0; c < corners_of_element; ++c) {
      const auto node = static_cast<std::size_t>(cell[c]);
      x[c] = {model.reference[node].x, model.reference[node].y};
      plan.node.data()[(i / lanes * corners_of_element + c) * lanes + i % lanes] =
          2 * (row[node] < 0 ? zero : row[node]);
    }
    const rubber::Bilinear<double> f = rubber::bilinear(x);
    double* to = plan.geometry.data() + i / lanes * 6 * lanes + i % lanes;
    for (const double value :
         {f.along.x, f.along.y, f.across.x, f.across.y, f.twist.x, f.twist.y}) {
      *to = value;
      to += lanes;
    }
  }
}

/// Corners of the elements on each row, in the order of the elements: where their pairs are.
std::vector<std::vector<std::int32_t>> corners_on_rows(const RubberPart& rubber,
                                                       std::span<const int> row,
                                                       const RubberPlan& plan, std::size_t n_rows) {
  std::vector<std::vector<std::int32_t>> on(n_rows);
  std::vector<char> seen(rubber.cells.size(), 0);
  for (std::size_t i = 0; i < plan.element.size(); ++i) {
    const auto e = static_cast<std::size_t>(plan.element[i]);
    if (std::exchange(seen[e], 1)) continue;
    for (std::size_t c = 0; c < corners_of_element; ++c) {
      const int r = row[at(rubber.cells[e][c])];
      if (r < 0) continue;
      on[at(r)].push_back(static_cast<std::int32_t>(
          ((i / lanes * corners_of_element + c) * lanes + i % lanes) * 2));
    }
  }
  return on;
}

/// Rows of a pack have as many places as the most of them; zeros are past the last element.
void add_corners(const RubberPart& rubber, std::span<const int> row, std::size_t n_row_packs,
                 RubberPlan& plan) {
  const auto on = corners_on_rows(rubber, row, plan, n_row_packs * lanes);
  plan.start.assign(1, 0);
  for (std::size_t pack = 0; pack < n_row_packs; ++pack) {
    std::size_t most = 0;
    for (std::size_t i = 0; i < lanes; ++i) most = std::max(most, on[pack * lanes + i].size());
    plan.start.push_back(plan.start.back() + static_cast<std::int64_t>(most));
  }
  const auto n = static_cast<std::size_t>(plan.start.back()) * lanes;
  plan.corner = LargeArrayOf<std::int32_t>(n);
  std::fill_n(plan.corner.data(), n,
              static_cast<std::int32_t>(plan.n_packs * corners_of_element * lanes * 2));
  for (std::size_t r = 0; r < on.size(); ++r) {
    std::size_t place = static_cast<std::size_t>(plan.start[r / lanes]) * lanes + r % lanes;
    for (const std::int32_t at : on[r]) {
      plan.corner.data()[place] = at;
      place += lanes;
    }
  }
}

}  // namespace

RubberPlan make_rubber_plan(const Model& model, std::span<const int> row, int zero,
                            std::size_t n_row_packs) {
  constexpr std::size_t most_elements = 1U << 27U;  // their corners are counted in 32 bits
  RONDO_DEMAND(model.rubber && model.rubber->cells.size() < most_elements);
  RONDO_DEMAND(row.size() == model.n_nodes() && zero >= 0 && model.dt > 0.0 &&
                   model.rubber->material.size() == model.rubber->cells.size(),
               row.size(), model.n_nodes(), zero, model.dt, model.rubber->material.size());
  RubberPlan plan;
  add_packs(*model.rubber, row, plan);
  RONDO_DEMAND(plan.element.size() == plan.n_packs * lanes &&
                   plan.element.size() >= model.rubber->cells.size(),
               plan.element.size(), plan.n_packs, model.rubber->cells.size());
  add_branches(model, plan);
  add_geometry(model, row, zero, plan);
  add_corners(*model.rubber, row, n_row_packs, plan);
  return plan;
}

}  // namespace rondo::dynamics
