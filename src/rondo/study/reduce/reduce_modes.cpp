// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/reduce/reduce_modes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "rondo/core/index.hpp"
#include "rondo/io/run_reader.hpp"
#include "rondo/rom/chosen_modes.hpp"
#include "rondo/study/pod/pod_input.hpp"

namespace rondo::study {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Number computed if a tolerance is given, and at least if the norm chooses among them.
constexpr Index most_modes = 400;

/// Smallest number kept to choose modes without one run; at least three times the requested number.
constexpr Index least_kept = 150;

/// The first modes that leave out no more than the tolerance, or all.
Index modes_for(const VectorXd& left, double tolerance) {
  Index count = 1;
  while (count + 1 < left.size() && left[count] > tolerance * left[0]) ++count;
  return count;
}

/// The nearest of n positions around the disk, the first of which is straight down.
std::size_t place_of(Vec2 x, std::size_t n) {
  const double turns = std::atan2(x.x, -x.y) / (2.0 * std::numbers::pi);
  const auto count = static_cast<long>(n);
  const long place = std::lround(turns * static_cast<double>(n));
  return static_cast<std::size_t>(((place % count) + count) % count);
}

/// Positions around the disk, one per candidate, where a force occurs in some snapshot.
std::vector<char> touched_places(const Setup& setup, const std::vector<io::RunReader>& runs,
                                 const ReduceRequest& r) {
  const std::size_t n = setup.mesh.boundary.size();
  std::vector<char> touched(n, 0);
  std::vector<Vec2> force(n);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const io::RunReader& run = runs[k];
    if (!run.has(io::Quantity::contact)) continue;
    for (std::size_t j = 0; j < run.n_snapshots(); ++j) {
      if (!is_in_window(runs, k, run.times().time[j], r.from, r.to)) continue;
      run.read(io::Quantity::contact, j, 0, force);
      const Complex turned = rotation(run.times().angle[j]);
      for (std::size_t i = 0; i < n; ++i) {
        if (force[i] == Vec2{}) continue;
        const auto node = static_cast<std::size_t>(setup.mesh.boundary[i]);
        const Vec2 x = turned * setup.mesh.coordinates[node];
        touched[place_of(x, n)] = 1;
      }
    }
  }
  return touched;
}

/// Adds a third of the touched positions on either side, where contact may also occur.
std::vector<char> widened(const std::vector<char>& touched) {
  const auto n = static_cast<std::ptrdiff_t>(touched.size());
  const std::ptrdiff_t reach = (std::ranges::count(touched, 1) + 2) / 3;
  std::vector<char> wide(touched.size(), 0);
  for (std::ptrdiff_t k = 0; k < n; ++k)
    for (std::ptrdiff_t d = -reach; touched[at(k)] && d <= reach; ++d)
      wide[at(((k + d) % n + n) % n)] = 1;
  return wide;
}

/// √weight times the values of the modes at the touched nodes.
MatrixXd at_touched(const TouchedNodes& touched, const MatrixXd& modes, const VectorXd& roots) {
  MatrixXd rows(static_cast<Index>(2 * touched.node.size()), modes.cols());
  for (std::size_t k = 0; k < touched.node.size(); ++k) {
    const auto at = static_cast<Index>(2 * touched.node[k]);
    rows.middleRows(static_cast<Index>(2 * k), 2) =
        std::sqrt(touched.weight[k]) / roots[at] * modes.middleRows(at, 2);
  }
  return rows;
}

}  // namespace

TouchedNodes touched_nodes(const Setup& setup, const std::vector<io::RunReader>& runs,
                           const ReduceRequest& r) {
  const double share = r.contact_weight;
  const bool turning = is_co_rotating(r.frame, {});
  TouchedNodes nodes;
  if (share == 0.0) return nodes;
  std::vector<char> places = touched_places(setup, runs, r);
  const bool any = std::ranges::count(places, 1) > 0;
  if (!any) return nodes;
  places = turning ? std::vector<char>(places.size(), 1) : widened(places);
  for (std::size_t i = 0; i < setup.mesh.boundary.size(); ++i) {
    const auto node = static_cast<std::size_t>(setup.mesh.boundary[i]);
    const Vec2 x = setup.mesh.coordinates[node];
    if (!places[place_of(x, places.size())]) continue;
    nodes.node.push_back(node);
    nodes.weight.push_back(setup.mesh.tributary[i]);
  }
  const std::vector<double>& mass = setup.model.mass;
  const double body = std::accumulate(mass.begin(), mass.end(), 0.0);
  const double length = std::accumulate(nodes.weight.begin(), nodes.weight.end(), 0.0);
  for (double& weight : nodes.weight) weight *= share * body / length;
  return nodes;
}

FieldModes modes_of_field(const ReduceRequest& r, RunSnapshots snapshots, const VectorXd& roots,
                          const TouchedNodes& touched, const WantedModes& wanted) {
  std::optional<Index> asked;
  if (wanted.modes) asked = static_cast<Index>(*wanted.modes);
  if (!wanted.modes && !wanted.tolerance) asked = static_cast<Index>(wanted.otherwise);
  pod::DecomposeOptions options;
  PodRequest memory;
  memory.memory = r.memory;
  options.memory = memory_of(memory);
  options.progress = r.progress;
  options.modes = std::max(most_modes, asked.value_or(0));
  options.modes = std::min({options.modes, snapshots.rows(), snapshots.columns()});
  pod::Decomposition found = decompose(snapshots, options);
  if (found.rank == 0)
    throw request_error("RUN", r.runs.front().string(),
                        fmt::format("every {} is zero: nothing moves", wanted.field),
                        "runs in which the disk is loaded or spins");
  for (Index j = 0; j < found.modes.cols(); ++j) {
    snapshots.unweight(found.modes.col(j));
    found.modes.col(j).array() *= roots.array();
  }
  const MatrixXd extra = at_touched(touched, found.modes, roots);
  const rom::ChosenModes chosen = rom::choose_modes(found, extra, options.modes);
  const Index keep =
      std::min(asked ? *asked : modes_for(chosen.left, *wanted.tolerance), chosen.modes.cols());
  const double missed = chosen.left[keep] / chosen.left[0];
  FieldModes out;
  out.report = {wanted.field, snapshots.columns(), keep, missed};
  if (wanted.tolerance && missed > *wanted.tolerance && r.warn)
    r.warn(
        fmt::format("{} modes, as many as are looked for, leave out {:.3g} of the energy of the "
                    "{}s, more than the tolerance of {:.3g}",
                    keep, missed, wanted.field, *wanted.tolerance));
  out.modes = chosen.modes.leftCols(keep);
  if (!r.error_estimate) return out;
  const Index kept =
      std::min({std::max(least_kept, 3 * keep), found.modes.cols(), found.temporal.cols()});
  out.found.sigma = found.sigma.head(kept);
  out.found.modes = found.modes.leftCols(kept);
  out.found.temporal = found.temporal.leftCols(kept);
  out.at_touched = extra.leftCols(extra.rows() > 0 ? kept : 0);
  return out;
}

MatrixXd modes_without(const FieldModes& field, std::span<const SnapshotColumn> columns,
                       std::size_t run) {
  std::vector<Index> rows;
  for (std::size_t j = 0; j < columns.size(); ++j)
    if (columns[j].run != run) rows.push_back(static_cast<Index>(j));
  pod::Decomposition others;
  others.sigma = field.found.sigma;
  others.modes = field.found.modes;
  others.temporal = field.found.temporal(rows, Eigen::all);
  return rom::choose_modes(others, field.at_touched, field.modes.cols()).modes;
}

double energy_left(RunSnapshots snapshots, const MatrixXd& modes, const VectorXd& roots) {
  double left = 0.0, all = 0.0;
  MatrixXd column(snapshots.rows(), 1);
  for (Index j = 0; j < snapshots.columns(); ++j) {
    snapshots.read_columns(j, column);
    all += column.squaredNorm();
    snapshots.unweight(column.col(0));
    column.array() *= roots.array();
    const VectorXd inside = modes.transpose() * column.col(0);
    left += std::max(0.0, column.squaredNorm() - inside.squaredNorm());
  }
  return left / all;
}

}  // namespace rondo::study
