// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/crush_observers.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/output/observers.hpp"

namespace rondo::study {
namespace {

constexpr Vec2 normal{0.0, 1.0};  ///< a contact frame's vector times it is along the fixed axes

std::vector<std::string> columns() {
  std::vector<std::string> names = history_columns();
  for (const char* name :
       {"depth_m", "pressure_max_pa", "shear_max_pa", "contact_residual", "sweeps"})
    names.emplace_back(name);
  return names;
}

/// Of the contact after an increment.
struct Sums {
  Vec2 contact;         ///< of the ground: normal, tangential [N/m]
  Vec2 force;           ///< the same along the fixed axes [N/m]
  double torque = 0.0;  ///< about the centre [N]
  double nodes = 0.0, sticking = 0.0;
  double length = 0.0;                 ///< [m]
  double pressure = 0.0, shear = 0.0;  ///< largest [Pa]
};

Sums sum_up(const CrushSetup& setup, const statics::CrushState& state) {
  Sums s;
  for (std::size_t k = 0; k < state.force.size(); ++k) {
    const Vec2 r = state.force[k];
    if (!(r.x > 0.0)) continue;
    const auto node = static_cast<std::size_t>(setup.model.nodes[k]);
    const double tributary = setup.mesh.tributary[k];
    s.contact += r;
    s.force += from_frame(normal, r);
    s.torque += cross(setup.mesh.coordinates[node] + state.u[node], from_frame(normal, r));
    s.nodes += 1.0;
    s.sticking += state.status[k] == contact::Status::stick ? 1.0 : 0.0;
    s.length += tributary;
    s.pressure = std::max(s.pressure, r.x / tributary);
    s.shear = std::max(s.shear, std::abs(r.y) / tributary);
  }
  return s;
}

io::ResultsLayout layout(const Case& c, const CrushSetup& setup) {
  const int rows = c.analysis.increments + c.analysis.slide_increments;
  const auto increments = static_cast<std::size_t>(rows);
  constexpr bool contact = true, quasi_static = true;
  return {&setup.mesh, setup.mass, increments, contact, c.output.stress, quasi_static};
}

}  // namespace

CrushRecord::CrushRecord(const std::filesystem::path& directory, const Case& c,
                         const CrushSetup& setup)
    : setup_(setup),
      ground_(c.ground->shape),
      increments_(c.analysis.increments),
      history_(directory / "history.csv", columns()),
      contact_csv_(directory / "contact.csv", contact_columns()),
      results_(directory, layout(c, setup)),
      rate_(setup.mesh.n_nodes()),
      force_fixed_(setup.mesh.boundary.size()) {
  if (c.output.stress) stress_.emplace(setup.mesh, setup.materials);
  write_history(0.0, statics::start_crush(setup.model, setup.mesh.n_nodes()), {});
}

void CrushRecord::observe(int k, const statics::CrushState& state, const std::vector<Vec2>& before,
                          const statics::CrushReport& report) {
  const double parameter = static_cast<double>(k) / increments_;
  write_history(parameter, state, report);
  write_contact_rows(parameter, state);
  write_snapshot(k, state, before);
}

Vec2 CrushRecord::position(const statics::CrushState& state, std::size_t candidate) const {
  const auto node = static_cast<std::size_t>(setup_.model.nodes[candidate]);
  return setup_.center(state) + setup_.mesh.coordinates[node] + state.u[node];
}

void CrushRecord::write_history(double parameter, const statics::CrushState& state,
                                const statics::CrushReport& report) {
  const Sums s = sum_up(setup_, state);
  const Vec2 center = setup_.center(state);
  const statics::CrushWorks& w = state.works;
  constexpr double angle = 0.0, slip_ratio = 0.0, none = 0.0;  // of what a crush has not
  history_.row(std::vector<double>{parameter,
                                   angle,
                                   center.x,
                                   center.y,
                                   s.force.x,
                                   s.force.y,
                                   s.torque,
                                   s.nodes,
                                   s.sticking,
                                   s.length,
                                   report.penetration,
                                   slip_ratio,
                                   none,
                                   w.strain,
                                   none,
                                   w.contact,
                                   w.friction,
                                   w.impact,
                                   w.rim,
                                   none,
                                   none,
                                   none,
                                   w.residual,
                                   none,
                                   state.depth,
                                   s.pressure,
                                   s.shear,
                                   report.residual,
                                   static_cast<double>(report.sweeps)});
}

void CrushRecord::write_contact_rows(double parameter, const statics::CrushState& state) {
  std::vector<double> rows;
  for (std::size_t k = 0; k < state.force.size(); ++k) {
    if (!(state.force[k].x > 0.0)) continue;
    const Vec2 x = position(state, k);
    const Vec2 traction = state.force[k] / setup_.mesh.tributary[k];
    for (const double value : {parameter, static_cast<double>(setup_.model.nodes[k]),
                               ground_.abscissa(x), x.x, x.y, traction.x, traction.y})
      rows.push_back(value);
  }
  contact_csv_.rows(rows);
}

void CrushRecord::write_snapshot(int k, const statics::CrushState& state,
                                 const std::vector<Vec2>& before) {
  for (std::size_t i = 0; i < rate_.size(); ++i)
    rate_[i] = static_cast<double>(increments_) * (state.u[i] - before[i]);
  for (std::size_t i = 0; i < force_fixed_.size(); ++i)
    force_fixed_[i] = from_frame(normal, state.force[i]);
  io::Snapshot s;
  s.time = static_cast<double>(k) / increments_;
  s.time_velocity = (static_cast<double>(k) - 0.5) / increments_;
  s.center = setup_.center(state);
  s.displacement = state.u;
  s.velocity = rate_;
  s.contact_force = state.force;
  s.contact_force_fixed = force_fixed_;
  if (stress_) s.stress = (*stress_)(state.u);
  const Sums sums = sum_up(setup_, state);
  s.crush = {state.depth, sums.contact, sums.length, sums.pressure};
  results_.write(s);
}

void CrushRecord::close() {
  history_.close();
  contact_csv_.close();
  results_.close();
}

}  // namespace rondo::study
