// SPDX-License-Identifier: BSD-3-Clause
/// @file  The contacts at sharp corners of the ground in one step of a wheel in three dimensions,
/// solved (docs/wheel3d.md): a corner pushes the two nodes of an edge, so that it shares them with
/// the corners on the edges beside it and with the facets under these nodes.
#pragma once
#include <vector>

#include "rondo/contact/coupled/clusters.hpp"
#include "rondo/contact/coupled/coupled_contacts.hpp"
#include "rondo/integrators/solid/corner_finder.hpp"
#include "rondo/model/solid/solid_contact.hpp"

namespace rondo::dynamics {

class CornerSolver {
 public:
  /// @pre has_sharp_corners(model), in three dimensions. The model must outlive it.
  explicit CornerSolver(const Model& model);

  [[nodiscard]] CornerFinder& finder() noexcept { return finder_; }
  [[nodiscard]] const CornerFinder& finder() const noexcept { return finder_; }

  /// Finds the contacts, from the places of the finder. @param near see CornerFinder::find
  /// @return them; each node of theirs has all of its own
  std::span<const CornerRow> find(std::span<const CornerFinder::Near> near);
  /// Solves those found: v_next of the state, without their impulses, becomes that with them; what
  /// each candidate feels is added to `active`, and the rest to the report.
  /// @param before impulses of the step before by the keys of their contacts
  void solve(const SolidContactStep& step, const contact::KeptImpulses& before, State& state,
             ContactReport& report);
  /// Adds the impulses of the last step by the keys of their contacts: along n and J n, and by a
  /// marked key along the edges; 0 of those that others hold                        [N·s]
  void add_impulses_to(contact::KeptImpulses& kept) const;

 private:
  using Rows = std::span<const int>;  ///< of one cluster
  void set_row(const SolidContactStep& step, const contact::KeptImpulses& before,
               const State& state, CornerRow& row) const;
  [[nodiscard]] double friction_of(const SolidContactStep& step,
                                   const contact::KeptImpulses& before, const State& state,
                                   const CornerRow& row) const;
  [[nodiscard]] double turning_of(const SolidContactStep& step, const CornerRow& row,
                                  const State& state) const;
  [[nodiscard]] Vec3 arm_of(const State& state, std::size_t node) const noexcept;
  void look_for_late(const SolidContactStep& step, const contact::KeptImpulses& before, double time,
                     ContactReport& report) const;
  [[nodiscard]] bool came_round(const CornerRow& row) const noexcept;
  contact::CoupledResult solve_problem(const SolidContactStep& step,
                                       const contact::KeptImpulses& before, Rows rows,
                                       const State& state, ContactReport& report);
  contact::CoupledResult try_to_solve(const SolidContactStep& step,
                                      const contact::KeptImpulses& before);
  [[nodiscard]] bool solve_pair();
  void solve_together(const SolidContactStep& step, const contact::KeptImpulses& before, Rows rows,
                      State& state, ContactReport& report);
  void make_problem(const SolidContactStep& step, Rows rows);
  void push_nodes(const SolidContactStep& step, Rows rows, bool converged, State& state) const;
  void finish(const SolidContactStep& step, CornerRow& row, State& state, ContactReport& report);
  void add_active(const SolidContactStep& step, const CornerRow& row, State& state) const;

  const Model& model_;
  CornerFinder finder_;
  const contact::CoupledLimits limits_;
  std::vector<CornerRow> rows_;
  std::vector<int> node_start_, nodes_;
  contact::ClusterFinder cluster_finder_;
  std::vector<int> asked_;           ///< contacts of the problem
  contact::SpatialCoupled problem_;  ///< of one cluster, or of what is asked of it
  std::vector<Vec3> impulse_;
  std::vector<contact::Status> status_;
  contact::SpatialWorkspace work_;
};

}  // namespace rondo::dynamics
