// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/reduce/contact_patterns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rondo/core/contract.hpp"
#include "rondo/pod/nonnegative.hpp"
#include "rondo/study/pod/pod_input.hpp"

namespace rondo::study {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Normal forces of one snapshot at the places. @param force (nb) in the order of the boundary
VectorXd at_places(const pod::Rings& ring, double theta, std::span<const Vec2> force) {
  const int n = ring.n_sectors;
  const double sectors = theta / (2.0 * std::numbers::pi) * n;
  const double whole = std::floor(sectors), part = sectors - whole;
  const auto on = static_cast<Index>(whole - n * std::floor(whole / n));
  VectorXd places = VectorXd::Zero(n);
  for (Index s = 0; s < n; ++s) {
    const auto point = static_cast<std::size_t>(ring.point[static_cast<std::size_t>(s)]);
    places[(s + on) % n] += (1.0 - part) * force[point].x;
    places[(s + on + 1) % n] += part * force[point].x;
  }
  return places;
}

}  // namespace

MatrixXd standing_forces(std::span<const io::RunReader> runs, std::span<const Column> columns) {
  RONDO_DEMAND(!runs.empty(), runs.size());
  const pod::Rings ring = pod::boundary_rings(runs.front().mesh());
  RONDO_DEMAND(ring.n_rings() == 1, ring.n_rings());
  MatrixXd forces(ring.n_sectors, static_cast<Index>(columns.size()));
  std::vector<Vec2> force(ring.point.size());
  Index kept = 0;
  for (const Column& column : columns) {
    const io::RunReader& run = runs[column.run];
    if (!run.has(io::Quantity::contact)) continue;
    run.read(io::Quantity::contact, column.snapshot, 0, force);
    const bool sound = std::ranges::all_of(force, [](Vec2 f) { return f.x >= 0.0 && f.x < 1e100; });
    if (!sound)
      throw request_error("RUN", run.directory().string(),
                          fmt::format("the snapshot at t = {:.9g} s holds normal forces that are "
                                      "negative or not finite",
                                      column.time),
                          "a run that is sound, or a window without this time (--from, --to)");
    forces.col(kept) = at_places(ring, column.angle, force);
    if (forces.col(kept).maxCoeff() > 0.0) ++kept;
  }
  forces.conservativeResize(Eigen::NoChange, kept);
  return forces;
}

ContactPatterns learn_patterns(std::span<const io::RunReader> runs, std::span<const Column> columns,
                               long long patterns,
                               const std::function<void(const std::string&)>& warn) {
  const MatrixXd forces = standing_forces(runs, columns);
  if (forces.cols() == 0)
    throw request_error("--contact", "patterns",
                        "nothing is pressed in any snapshot: there is no contact to learn from",
                        "runs that touch the ground, or --contact places");
  const pod::NonnegativeFactors found =
      pod::factor_nonnegative(forces, static_cast<Index>(patterns));
  if (found.w.cols() < patterns && warn)
    warn(
        fmt::format("--contact-patterns: {} patterns hold all that {} snapshots with contact have, "
                    "{} were asked for",
                    found.w.cols(), forces.cols(), patterns));
  return {found.w, {forces.cols(), found.residual(), found.sweeps()}};
}

}  // namespace rondo::study
