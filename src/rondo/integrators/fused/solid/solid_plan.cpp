// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/solid/solid_plan.hpp"

#include <algorithm>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::dynamics {
namespace {

using fem::SolidSector;
using Couplings = std::vector<SolidCoupling>;

/// Nodes that two rows couple with in the same way.
std::size_t shared(const Couplings& a, const Couplings& b) {
  std::size_t n = 0;
  for (const SolidCoupling& x : a)
    n += static_cast<std::size_t>(
        std::count_if(b.begin(), b.end(), [&](const auto& y) { return x.same_nodes(y); }));
  return n;
}

/// One coupling of a strip: of its first row, its second, or both.
struct Joined {
  const SolidCoupling* of[2];

  [[nodiscard]] const SolidCoupling& any() const noexcept { return of[0] ? *of[0] : *of[1]; }
  [[nodiscard]] bool before(const Joined& b) const noexcept {
    const auto key = [](const SolidCoupling& c) { return std::pair{c.here.row, c.here.shift}; };
    return key(any()) < key(b.any());
  }
};

std::vector<Joined> join(const Couplings& a, const Couplings* b) {
  std::vector<Joined> all;
  for (const SolidCoupling& x : a) all.push_back({{&x, nullptr}});
  if (b)
    for (const SolidCoupling& y : *b) {
      const auto found = std::find_if(all.begin(), all.end(), [&](const Joined& j) {
        return j.of[0] && j.of[0]->same_nodes(y);
      });
      if (found != all.end())
        found->of[1] = &y;
      else
        all.push_back({{nullptr, &y}});
    }
  std::stable_sort(all.begin(), all.end(),
                   [](const Joined& x, const Joined& y) { return x.before(y); });
  return all;
}

/// Two rows that follow each other are one strip where most of what they couple with is the same.
bool go_together(const SolidStiffness& k, std::size_t a) {
  if (a + 1 >= k.kind.size() || k.kind[a] != k.kind[a + 1]) return false;
  const std::size_t most = std::max(k.couplings[a].size(), k.couplings[a + 1].size());
  return 2 * shared(k.couplings[a], k.couplings[a + 1]) >= most;
}

void find_strips(SolidPlan& plan) {
  const std::size_t n = plan.stiffness.kind.size();
  for (std::size_t a = 0; a < n;) {
    SolidPlanStrip strip;
    strip.first = static_cast<int>(a);
    strip.n_rows = go_together(plan.stiffness, a) ? 2 : 1;
    strip.kind = plan.stiffness.kind[a];
    plan.strips.push_back(strip);
    a += static_cast<std::size_t>(strip.n_rows);
  }
  RONDO_DEMAND(
      !plan.strips.empty() && plan.strips.back().first + plan.strips.back().n_rows == plan.n_local,
      plan.strips.size(), plan.n_local);  // every row in exactly one strip
}

void write_strips(SolidPlan& plan) {
  const auto at = [&](SolidCoupling::Place p) { return p.row * plan.row_size() + p.shift; };
  for (SolidPlanStrip& strip : plan.strips) {
    strip.first_entry = plan.entries.size();
    strip.first_block = plan.numbers.size();
    const auto first = static_cast<std::size_t>(strip.first);
    const auto& couplings = plan.stiffness.couplings;
    for (const Joined& j :
         join(couplings[first], strip.n_rows == 2 ? &couplings[first + 1] : nullptr)) {
      const SolidCoupling& c = j.any();
      plan.entries.push_back(
          {at(c.here), at(c.last), at(c.next), (j.of[0] ? 1 : 0) + (j.of[1] ? 2 : 0)});
      for (const SolidCoupling* of : j.of)
        if (of) plan.numbers.insert(plan.numbers.end(), of->k.begin(), of->k.end());
    }
    strip.n_entries = plan.entries.size() - strip.first_entry;
  }
}

/// A strip reads u of the rows that couple with its own, and overwrites what these read in the step
/// before: that step must have done them.
void add_order(SolidPlan& plan) {
  std::vector<int> strip_of(static_cast<std::size_t>(plan.n_local));
  for (std::size_t i = 0; i < plan.strips.size(); ++i)
    for (int row = plan.strips[i].first; row < plan.strips[i].first + plan.strips[i].n_rows; ++row)
      strip_of[at(row)] = static_cast<int>(i);
  plan.needs.assign(plan.strips.size(), 0);
  for (std::size_t row = 0; row < strip_of.size(); ++row) {
    int& needed = plan.needs[at(strip_of[row])];
    for (const SolidBlock& b : plan.stiffness.blocks[row])
      needed = std::max(needed, strip_of[at(b.row)]);
  }
}

/// Rows that the steps of a pass are apart.
int rows_between_steps(const SolidPlan& plan) {
  int most = 0;
  for (std::size_t i = 0; i < plan.strips.size(); ++i) {
    const SolidPlanStrip& needed = plan.strips[at(plan.needs[i])];
    most = std::max(most, needed.first + needed.n_rows - plan.strips[i].first);
  }
  return most;
}

void cut(const Model& model, const SolidTuning& tuning, SolidPlan& plan) {
  const std::size_t row_bytes = static_cast<std::size_t>(plan.n_fields()) * sizeof(double);
  const std::size_t in_hand =
      solid_steps_in_a_pass * static_cast<std::size_t>(rows_between_steps(plan) + 1) * row_bytes;
  const int columns =
      std::max(tuning.fewest_columns, static_cast<int>(tuning.pass_bytes / in_hand));
  const int depth = model.solid->swept ? 1 : solid_steps_in_a_pass;  // faces need all rows of u
  cut_ring(model.threads, depth, {tuning.cache_bytes, columns, tuning.wide_halo_columns}, plan);
}

void add_rows(const Model& model, SolidPlan& plan) {
  const SolidSector& k = plan.ordered.sector;
  for (std::size_t a = 0; a < k.n_local(); ++a) {
    const double mass = model.mass[k.node(a, 0)];
    RONDO_ASSERT(mass > 0.0, a, mass);
    const Vec3 arm = plan.stiffness.arm[a];
    const Complex frame = plan.stiffness.frame[a];
    plan.rows.push_back({.at = static_cast<std::ptrdiff_t>(a) * plan.row_size(),
                         .mass = mass,
                         .dt_over_mass = model.dt / mass,
                         .x = arm.x,
                         .y = arm.y,
                         .z = arm.z,
                         .turn_x = frame.re,
                         .turn_y = frame.im,
                         .rest_x = 0.0,
                         .rest_y = 0.0,
                         .swept = -1,
                         .rubber = SolidRubberPlan::place(static_cast<int>(a), plan),
                         .of_state = {}});
  }
}

void add_loads(const Model& model, SolidPlan& plan) {
  for (const SolidPressure& pressure : model.solid->pressures) {
    RONDO_DEMAND(pressure.force.size() == plan.rows.size(), pressure.force.size());
    std::vector<Vec3>& load = plan.loads.emplace_back();
    for (std::size_t a = 0; a < plan.rows.size(); ++a)
      load.push_back(conj(plan.stiffness.frame[a]) * pressure.force[at(plan.ordered.was[a])]);
    if (!pressure.of_rest) continue;
    for (std::size_t a = 0; a < plan.rows.size(); ++a) {
      plan.rows[a].rest_x += load[a].x;
      plan.rows[a].rest_y += load[a].y;
    }
  }
}

void add_faces(const Model& model, SolidPlan& plan) {
  plan.faces = make_faces_plan(model, plan);
  for (std::size_t a = 0; a < plan.rows.size(); ++a) {
    const int place = plan.faces->place[a];
    plan.rows[a].swept = place < 0 ? -1 : 6 * place * plan.stride;
  }
}

}  // namespace

void set_state_of_faces(const kernels::SolidTable& table, SolidPlan& plan) {
  if (!plan.faces) return;
  const StateOfFaces state = state_of_faces(*plan.faces, plan, table);
  plan.energy_of_state = state.energy;
  for (std::size_t a = 0; a < plan.rows.size(); ++a) {
    const Vec3 f = state.force[a];
    double* const to = plan.rows[a].of_state;
    to[0] = f.x, to[1] = f.y, to[2] = f.z;
  }
}

std::size_t n_solid_groups(int n_sectors) noexcept {
  return n_groups_of(n_sectors, solid_group_columns);
}

SolidPlan make_solid_plan(const Model& model, const SolidTuning& tuning) {
  RONDO_DEMAND(model.solid.has_value());
  SolidPlan plan;
  plan.n_local = static_cast<int>(model.solid->sector.n_local());
  plan.n_sectors = model.solid->sector.n_sectors;
  plan.components = 3;
  const bool swept = model.solid->swept.has_value();
  plan.wheel = plan.stepwise = model.rim.has_value();
  plan.keeps_force = plan.wheel || swept || model.stiffness_damping > 0.0;
  plan.keeps_impulse = has_friction_law(model);
  plan.n_sums = plan.wheel ? int{kernels::n_solid_wheel_sums}
                : swept    ? int{kernels::n_solid_rubber_sums}
                           : int{kernels::n_sums};
  plan.group_columns = solid_group_columns;
  plan.ordered = order_sector(model);
  plan.nodes_per_sector = plan.ordered.sector.nodes_per_sector;
  plan.nodes = plan.ordered.sector.nodes;
  plan.stiffness = solid_stiffness(model, plan.ordered.sector);
  plan.frame = plan.stiffness.frame;
  const auto n_free =
      static_cast<std::size_t>(plan.n_local) * static_cast<std::size_t>(plan.n_sectors);
  RONDO_DEMAND(n_free == model.free.size(), plan.n_local, plan.n_sectors, model.free.size());
  find_strips(plan);
  add_order(plan);
  cut(model, tuning, plan);
  set_stride(plan);
  add_rows(model, plan);
  write_strips(plan);
  if (swept) add_faces(model, plan);
  find_candidates(model, plan);
  add_loads(model, plan);
  return plan;
}

}  // namespace rondo::dynamics
