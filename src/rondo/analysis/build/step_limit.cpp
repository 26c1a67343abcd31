// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/step_limit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/elements/massless_boundary.hpp"
#include "rondo/analysis/elements/parts.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"
#include "rondo/mesh/locate.hpp"

namespace rondo::study {

StepLimit find_step_limit(const Case& c, const Setup& s) {
  const bool lagged = c.time.scheme == Scheme::as_printed;
  const auto step_of = [&](double eigenvalue) {
    return eigenvalue > 0.0
               ? dynamics::critical_step_of(std::sqrt(eigenvalue),
                                            {c.damping.stiffness, lagged ? c.damping.mass : 0.0})
               : 0.0;
  };
  std::vector<double> values = fem::element_eigenvalues(s.mesh, fem::instantaneous(s.materials),
                                                        s.prestress, s.mesh.n_sectors > 0);
  const Parts parts = parts_of(c, s);
  RONDO_DEMAND(!values.empty() && parts.of_cell.size() == values.size() &&
                   (s.implicit_cells.empty() || s.implicit_cells.size() == values.size()),
               values.size(), parts.of_cell.size(), s.implicit_cells.size());
  for (std::size_t e = 0; e < s.implicit_cells.size(); ++e)
    if (s.implicit_cells[e]) values[e] = 0.0;
  const auto worst = std::max_element(values.begin(), values.end());
  StepLimit limit;
  limit.cell = static_cast<std::size_t>(worst - values.begin());
  limit.step = step_of(*worst);
  limit.place = mesh::middle_of(s.mesh.coordinates, s.mesh.cells[limit.cell]);
  const int part = parts.of_cell[limit.cell];
  limit.part = parts.names[at(part)];
  limit.part_kind = parts.kind;
  double elsewhere = 0.0;
  std::vector<double> sorted;
  for (std::size_t e = 0; e < values.size(); ++e) {
    if (parts.of_cell[e] != part) elsewhere = std::max(elsewhere, values[e]);
    if (values[e] > 0.0) sorted.push_back(values[e]);
  }
  limit.without_part = step_of(elsewhere);
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  const std::size_t left_out = std::max<std::size_t>(1, sorted.size() / 100);
  limit.without_worst = left_out < sorted.size() ? step_of(sorted[left_out]) : 0.0;
  return limit;
}

std::vector<Told> lines_of(const StepLimit& limit) {
  RONDO_DEMAND(limit.step > 0.0, limit.step, limit.cell);
  const auto times = [&](double step) {
    return fmt::format("{:.3g} times the step, by the element bound", step / limit.step);
  };
  std::vector<Told> lines{
      {"set by", fmt::format("cell {} of /mesh/cells at ({:.6g}, {:.6g}) m, {}", limit.cell,
                             limit.place.x, limit.place.y, limit.part)}};
  constexpr double same = 1.005;  // as printed
  if (limit.without_worst >= same * limit.step)
    lines.emplace_back("without the worst",
                       times(limit.without_worst) + ": a hundredth of the elements left out");
  if (limit.without_part > 0.0)
    lines.emplace_back("without that " + limit.part_kind, times(limit.without_part));
  return lines;
}

namespace {

Told implicit_line(const Setup& setup) {
  const auto chosen = std::ranges::count(setup.implicit_cells, 1);
  const dynamics::Model& m = setup.model;
  RONDO_DEMAND(m.implicit || m.subdomains, setup.implicit_cells.size());
  const auto& nodes = m.implicit ? m.implicit->nodes : m.subdomains->coarse.free;
  return {"implicit elements",
          fmt::format("{} of {} ({} dofs): explicit, they would make the critical step {:.6g} s",
                      chosen, setup.implicit_cells.size(), 2 * nodes.size(), setup.critical_plain)};
}

}  // namespace

std::vector<Told> step_lines(const Case& c, const Setup& s) {
  const auto length = [](double seconds) { return fmt::format("{:.6g} s", seconds); };
  const double step = explicit_step(s.model);
  RONDO_DEMAND(step > 0.0 && s.critical.step > 0.0, step, s.critical.step);
  const bool bounded = std::isfinite(s.critical.step);
  std::vector<Told> lines{
      {"largest frequency", fmt::format("{:.6g} rad/s (element bound {:.6g})", s.critical.omega,
                                        s.critical.element_bound)},
      {"critical step", bounded ? told_critical_step(s) : "none: all elements are implicit"}};
  if (!bounded) lines.erase(lines.begin());
  if (!s.implicit_cells.empty()) lines.push_back(implicit_line(s));
  // By plane elements that have their mass.
  if (bounded && !has_massless_contact(s.model) && !s.model.solid)
    for (Told& told : lines_of(find_step_limit(c, s))) lines.push_back(std::move(told));
  lines.emplace_back(
      "step", bounded ? fmt::format("{} ({:.3g} of critical)", length(step), step / s.critical.step)
                      : length(step));
  if (s.model.subdomains)
    lines.emplace_back("coarse step", fmt::format("{}, {} of these", length(s.model.dt),
                                                  s.model.subdomains->ratio));
  lines.emplace_back("steps", fmt::format("{} to t = {:.6g} s", s.n_steps,
                                          static_cast<double>(s.n_steps) * s.model.dt));
  return lines;
}

}  // namespace rondo::study
