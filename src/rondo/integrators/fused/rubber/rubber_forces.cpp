// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/rubber/rubber_forces.hpp"

#include <algorithm>

#include "rondo/core/contract.hpp"
#include "rondo/core/sum.hpp"
#include "rondo/fem/hyperelastic/quadrilateral.hpp"

namespace rondo::dynamics {

namespace {
using kernels::lanes;
constexpr std::size_t corners = 4;
}  // namespace

RubberForces::RubberForces(const Model& model, std::span<const int> row, int zero,
                           std::size_t n_row_packs, std::span<const Vec2> u,
                           const kernels::RubberTable& table)
    : model_(model),
      plan_(make_rubber_plan(model, row, zero, n_row_packs)),
      table_(table),
      force_(plan_.n_packs * corners * lanes * 2 + 2),
      history_(plan_.n_history),
      sums_(plan_.blocks.size()) {
  RONDO_DEMAND(u.size() == model.n_nodes() && row.size() == model.n_nodes(), u.size(), row.size(),
               model.n_nodes());
  rows_ = {plan_.start.data(), plan_.corner.data(), force_.data()};
  relax(u);
}

/// visit(element, branch, where xx is) of each element once.
template <class Visit>
void RubberForces::for_history(Visit&& visit) const {
  for (const RubberBlock& block : plan_.blocks) {
    const std::size_t n = plan_.branches[block.material].size();
    const auto packs = static_cast<std::size_t>(block.last_pack - block.first_pack);
    for (std::size_t p = 0; p < packs; ++p)
      for (std::size_t k = 0; k < n; ++k)
        for (std::size_t i = 0; i < lanes; ++i)
          visit(plan_.element[(static_cast<std::size_t>(block.first_pack) + p) * lanes + i], k,
                block.first_history + (p * n + k) * 3 * lanes + i);
  }
}

/// C_i = C̄ of the center.
void RubberForces::relax(std::span<const Vec2> u) {
  namespace rubber = fem::hyperelastic;
  for_history([&](int element, std::size_t, std::size_t at) {
    rubber::Corners<double> x, v;
    const mesh::Cell& cell = model_.rubber->cells[static_cast<std::size_t>(element)];
    for (std::size_t c = 0; c < corners; ++c) {
      const auto node = static_cast<std::size_t>(cell[c]);
      x[c] = {model_.reference[node].x, model_.reference[node].y};
      v[c] = {u[node].x, u[node].y};
    }
    const auto g = rubber::local_gradient(rubber::bilinear(x), 0.0, 0.0);
    const auto state = rubber::point_state(g, rubber::local_gradient(rubber::bilinear(v), 0.0, 0.0),
                                           1.0 / cross(g.x, g.y));
    const double y = rubber::inverse_cube_root(1.0 + state.j_less_1);
    const auto c = rubber::right_cauchy_green(state.f);
    history_.data()[at] = y * y * c.xx;
    history_.data()[at + lanes] = y * y * c.yy;
    history_.data()[at + 2 * lanes] = y * y * c.xy;
  });
}

void RubberForces::evaluate(const double* now, std::size_t block) noexcept {
  RONDO_ASSERT(block < plan_.blocks.size() && now, block, plan_.blocks.size());
  const RubberBlock& b = plan_.blocks[block];
  const fem::Rubber& rubber = model_.rubber->materials[b.material];
  const auto first = static_cast<std::size_t>(b.first_pack);
  kernels::RubberElements e{};
  e.geometry = plan_.geometry.data() + first * 6 * lanes;
  e.node = plan_.node.data() + first * corners * lanes;
  e.now = now;
  e.force = force_.data() + first * corners * lanes * 2;
  e.history = history_.data() + b.first_history;
  e.n_packs = b.last_pack - b.first_pack;
  e.lanes_of_last = b.lanes_of_last;
  e.rubber = &rubber;
  e.shear = rubber.shear_modulus();
  e.branches = plan_.branches[b.material].data();
  e.n_branches = static_cast<int>(plan_.branches[b.material].size());
  e.sums = &sums_[block];
  table_.elements[rubber.one_point ? 1 : 0][static_cast<std::size_t>(rubber.law)](e);
}

RubberEnergy RubberForces::energy() const noexcept {
  CompensatedSum stored, before, after;
  RubberEnergy energy;
  energy.least = sums_.empty() ? 1.0 : sums_.front().least;
  for (const kernels::RubberSums& s : sums_) {
    stored.add(s.energy);
    before.add(s.dissipation_before);
    after.add(s.dissipation_after);
    energy.least = std::min(energy.least, s.least);
  }
  energy.stored = stored.value();
  energy.dissipation_before = before.value();
  energy.dissipation_after = after.value();
  return energy;
}

Vec2 RubberForces::force_on(int row) const noexcept {
  const auto r = static_cast<std::size_t>(row);
  RONDO_ASSERT(r / lanes + 1 < plan_.start.size(), row, plan_.start.size());
  Vec2 force;
  for (std::int64_t place = rows_.start[r / lanes]; place < rows_.start[r / lanes + 1]; ++place) {
    const double* pair =
        rows_.force + rows_.corner[static_cast<std::size_t>(place) * lanes + r % lanes];
    force += Vec2{pair[0], pair[1]};
  }
  return force;
}

/// (elements + 1) where the branches of each are in what is saved: in the order of elements and
/// branches, whatever that of the packs is.
std::vector<std::size_t> RubberForces::saved_places() const {
  std::vector<std::size_t> first(1, 0);
  for (const int material : model_.rubber->material)
    first.push_back(first.back() + 3 * plan_.branches[static_cast<std::size_t>(material)].size());
  return first;
}

void RubberForces::save(std::vector<double>& branches) const {
  const std::vector<std::size_t> first = saved_places();
  branches.resize(first.back());
  for_history([&](int element, std::size_t k, std::size_t at) {
    for (std::size_t i = 0; i < 3; ++i)
      branches[first[static_cast<std::size_t>(element)] + 3 * k + i] =
          history_.data()[at + i * lanes];
  });
}

void RubberForces::restore(std::span<const double> branches) {
  const std::vector<std::size_t> first = saved_places();
  RONDO_DEMAND(branches.size() == first.back(), branches.size(), first.back());
  for_history([&](int element, std::size_t k, std::size_t at) {
    for (std::size_t i = 0; i < 3; ++i)
      history_.data()[at + i * lanes] =
          branches[first[static_cast<std::size_t>(element)] + 3 * k + i];
  });
}

}  // namespace rondo::dynamics
