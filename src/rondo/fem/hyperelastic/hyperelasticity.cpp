// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fem/hyperelastic/hyperelasticity.hpp"

#include <algorithm>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/core/threads.hpp"
#include "rondo/fem/hyperelastic/laws.hpp"
#include "rondo/fem/stiffness_product.hpp"

namespace rondo::fem {

using hyperelastic::Center;
using hyperelastic::CornerForces;
using hyperelastic::DeformedCell;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

Hyperelasticity::Hyperelasticity(const mesh::Mesh& mesh, std::span<const Material> materials)
    : reference_(mesh.coordinates), cells_(mesh.cells), dilatation_(mesh, materials) {
  for (const Material& m : materials) rubbers_.push_back(m.rubber.value_or(Rubber{}));
  std::vector<char> others(cells_.size(), 0);
  first_history_.push_back(0);
  patch_bulk_.assign(dilatation_.size(), 0.0);
  for (std::size_t e = 0; e < cells_.size(); ++e) {
    const Material& material = material_of(mesh, materials, e);
    others[e] = material.rubber ? 0 : 1;
    if (!material.rubber) continue;
    const Rubber& rubber = rubbers_[mesh.region.empty() ? 0 : at(mesh.region[e])];
    Part part{e, &rubber, mesh::n_corners(cells_[e])};
    first_history_.push_back(first_history_.back() + rubber.branches.size());
    if (part.n_corners == 3) {
      RONDO_DEMAND(dilatation_.holds(e), e);
      part.patches = dilatation_.patches_of(e);
      for (const int patch : part.patches) patch_bulk_[at(patch)] = rubber.bulk_modulus;
    }
    parts_.push_back(part);
  }
  pattern_ = stiffness_pattern(mesh, dilatation_);
  if (parts_.size() < cells_.size())
    stiffness_ = assemble_stiffness(mesh::mesh_of_cells(mesh, others), materials);
  find_corners();
}

/// Finds, by counting, the corners of each node in the order of the cells.
void Hyperelasticity::find_corners() {
  first_corner_.assign(n_nodes() + 1, 0);
  const auto for_corners = [&](auto&& work) {
    for (std::size_t i = 0; i < parts_.size(); ++i)
      for (int a = 0; a < parts_[i].n_corners; ++a)
        work(at(cells_[parts_[i].cell][at(a)]), Corner{static_cast<std::int32_t>(i), a});
  };
  for_corners([&](std::size_t node, Corner) { ++first_corner_[node + 1]; });
  for (std::size_t k = 0; k < n_nodes(); ++k) first_corner_[k + 1] += first_corner_[k];
  corners_.resize(first_corner_.back());
  std::vector<std::size_t> next(first_corner_.begin(), first_corner_.end() - 1);
  for_corners([&](std::size_t node, Corner corner) { corners_[next[node]++] = corner; });
}

std::vector<char> Hyperelasticity::nodes_of_rubber_alone() const {
  std::vector<char> alone(n_nodes(), 0);
  for (const Part& part : parts_)
    for (int a = 0; a < part.n_corners; ++a) alone[at(cells_[part.cell][at(a)])] = 1;
  std::vector<char> is_rubber(cells_.size(), 0);
  for (const Part& part : parts_) is_rubber[part.cell] = 1;
  for (std::size_t e = 0; e < cells_.size(); ++e)
    for (int a = 0; !is_rubber[e] && a < mesh::n_corners(cells_[e]); ++a)
      alone[at(cells_[e][at(a)])] = 0;
  return alone;
}

/// @param u empty: no displacement
DeformedCell Hyperelasticity::deformed(const Part& part, std::span<const Vec2> u) const noexcept {
  DeformedCell cell;
  cell.n_corners = part.n_corners;
  for (std::size_t a = 0; a < at(part.n_corners); ++a) {
    const std::size_t node = at(cells_[part.cell][a]);
    cell.x[a] = reference_[node];
    if (!u.empty()) cell.u[a] = u[node];
  }
  return cell;
}

Hyperelasticity::Histories Hyperelasticity::histories_of(std::size_t part,
                                                         Histories all) const noexcept {
  if (all.empty()) return {};
  return all.subspan(first_history_[part], first_history_[part + 1] - first_history_[part]);
}

std::vector<Hyperelasticity::History> Hyperelasticity::relaxed(std::span<const Vec2> u) const {
  std::vector<History> histories(n_histories());
  for (std::size_t i = 0; i < parts_.size(); ++i)
    std::fill(histories.begin() + static_cast<std::ptrdiff_t>(first_history_[i]),
              histories.begin() + static_cast<std::ptrdiff_t>(first_history_[i + 1]),
              relaxed_history(center_of(deformed(parts_[i], u))));
  return histories;
}

double Hyperelasticity::relax(std::span<const Vec2> u, double half_step,
                              std::span<History> histories, Pass& pass, int threads) const {
  if (histories.empty()) return 0.0;
  RONDO_DEMAND(histories.size() == n_histories(), histories.size());
  pass.of_cell.resize(parts_.size());
  for_blocks(parts_.size(), threads, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) {
      const Center center = center_of(deformed(parts_[i], u));
      const auto own =
          histories.subspan(first_history_[i], first_history_[i + 1] - first_history_[i]);
      const bool inverted = center.j_less_1 <= -1.0;
      pass.of_cell[i] =
          inverted ? 0.0 : hyperelastic::relax(*parts_[i].rubber, center, half_step, own);
    }
  });
  double sum = 0.0;
  for (const double lost : pass.of_cell) sum += lost;
  return sum;
}

/// J - 1 of the patches: the mean of their triangles, weighted by area.
std::vector<double> Hyperelasticity::patch_changes(std::span<const Vec2> u) const {
  std::vector<double> change(dilatation_.size(), 0.0);
  for (const Part& part : parts_) {
    if (part.n_corners == 4) continue;
    const Center center = center_of(deformed(part, u));
    for (const int patch : part.patches)
      change[at(patch)] += center.area / 3.0 * center.j_less_1 / dilatation_.area(at(patch));
  }
  return change;
}

/// U'' = κ/2 (1 + J⁻²)
Hyperelasticity::Pressures Hyperelasticity::patch_pressures(std::span<const Vec2> u) const {
  const std::vector<double> change = patch_changes(u);
  Pressures p{std::vector<double>(change.size()), std::vector<double>(change.size())};
  for (std::size_t i = 0; i < change.size(); ++i) {
    if (patch_bulk_[i] == 0.0 || change[i] <= -1.0) continue;  // its cells report it
    const double j = 1.0 + change[i], area = dilatation_.area(i);
    const auto volumetric = hyperelastic::volumetric(patch_bulk_[i], change[i]);
    p.value[i] = volumetric.pressure;
    p.energy += area * volumetric.energy;
    p.slope[i] = 0.5 * patch_bulk_[i] * (1.0 + 1.0 / (j * j)) / area;
  }
  return p;
}

double Hyperelasticity::mean_pressure(const Part& part, const Pressures& pressures) noexcept {
  if (part.n_corners == 4) return 0.0;
  double sum = 0.0;
  for (const int patch : part.patches) sum += pressures.value[at(patch)];
  return sum / 3.0;
}

/// Computes forces, energy and smallest det F of a cell.
void Hyperelasticity::look_at(std::size_t i, std::span<const Vec2> u, Histories histories,
                              const Pressures& pressures, Pass& pass) const {
  const Part& part = parts_[i];
  const DeformedCell cell = deformed(part, u);
  pass.forces[i] = {};
  pass.energy[i] = infinity;
  pass.of_cell[i] = least_volume_ratio(*part.rubber, cell);
  if (!(pass.of_cell[i] > 0.0)) return;
  const Histories own = histories_of(i, histories);
  const auto found = result_of(*part.rubber, cell, mean_pressure(part, pressures));
  pass.forces[i] = found.forces;
  add_branch_forces(*part.rubber, cell, own, pass.forces[i]);
  pass.energy[i] = found.energy;
  if (!own.empty()) pass.energy[i] += branch_energy(*part.rubber, center_of(cell), own);
}

Look Hyperelasticity::gradient(std::span<const Vec2> u, Histories histories, std::span<Vec2> out,
                               Pass& pass, int threads) const {
  RONDO_DEMAND(u.size() == n_nodes() && out.size() == n_nodes() &&
                   (histories.empty() || histories.size() == n_histories()),
               u.size(), out.size(), histories.size());
  pass.forces.resize(parts_.size());
  pass.of_cell.resize(parts_.size());
  pass.energy.resize(parts_.size());
  const Pressures pressures = patch_pressures(u);
  for_blocks(parts_.size(), threads, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t i = begin; i < end; ++i) look_at(i, u, histories, pressures, pass);
  });
  Look look{{}, pressures.energy};
  if (stiffness_.row_start.empty())
    std::fill(out.begin(), out.end(), Vec2{});
  else
    apply(stiffness_, u, out, threads);
  for (std::size_t k = 0; k < n_nodes(); ++k) look.energy += 0.5 * dot(u[k], out[k]);
  for_blocks(n_nodes(), threads, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t k = begin; k < end; ++k)
      for (std::size_t c = first_corner_[k]; c < first_corner_[k + 1]; ++c)
        out[k] += pass.forces[at(corners_[c].part)][at(corners_[c].corner)];
  });
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    look.energy += pass.energy[i];
    if (!(pass.of_cell[i] >= look.least.ratio)) look.least = {pass.of_cell[i], parts_[i].cell};
  }
  return look;
}

/// Adds U''/V ∂v ∂vᵀ of each patch; the remaining term, U' ∂²v, belongs to its triangles.
void Hyperelasticity::add_patches(std::span<const Vec2> u, const Pressures& pressures,
                                  BlockCsr& k) const {
  if (dilatation_.empty()) return;
  std::vector<std::vector<NodalDilatation::Term>> volume(dilatation_.size());
  for (std::size_t p = 0; p < volume.size(); ++p)
    for (const auto& term : dilatation_.terms(p)) volume[p].push_back({term.node, {}});
  for (const Part& part : parts_) {
    if (part.n_corners == 4) continue;
    const CornerForces area = area_gradient(deformed(part, u));
    for (const int patch : part.patches)
      for (auto& [node, gradient] : volume[at(patch)])
        for (std::size_t a = 0; a < 3; ++a)
          if (cells_[part.cell][a] == node) gradient += area[a] / 3.0;
  }
  for (std::size_t p = 0; p < volume.size(); ++p)
    if (patch_bulk_[p] > 0.0) add_product(k, pressures.slope[p], volume[p]);
}

BlockCsr Hyperelasticity::tangent(std::span<const Vec2> u, Histories histories) const {
  BlockCsr k = pattern_;
  for (std::size_t row = 0; row + 1 < stiffness_.row_start.size(); ++row)
    for (auto b = stiffness_.row_start[row]; b < stiffness_.row_start[row + 1]; ++b) {
      const auto from = static_cast<std::size_t>(b);
      BlockCsr::Block& to =
          *find_block(k, static_cast<int>(row), static_cast<int>(stiffness_.column[from]));
      for (std::size_t c = 0; c < 4; ++c) to[c] += stiffness_.values[from][c];
    }
  const Pressures pressures = patch_pressures(u);
  for (std::size_t i = 0; i < parts_.size(); ++i)
    add_cell(k, cells_[parts_[i].cell],
             tangent_of(*parts_[i].rubber, deformed(parts_[i], u),
                        mean_pressure(parts_[i], pressures), histories_of(i, histories)));
  add_patches(u, pressures, k);
  return k;
}

}  // namespace rondo::fem
