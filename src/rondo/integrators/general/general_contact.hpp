// SPDX-License-Identifier: BSD-3-Clause
/// @file  All contacts of a step of a general model, solved (docs/theory.md, 4.7). Contacts that
/// share nodes are solved together; a node that only the ground holds as in contact_node.hpp, to
/// the same bits.
#pragma once
#include <utility>
#include <vector>

#include "rondo/contact/coupled/clusters.hpp"
#include "rondo/contact/coupled/coupled_contacts.hpp"
#include "rondo/contact/coupled/rows.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/integrators/general/body_frames.hpp"
#include "rondo/integrators/general/contact_finder.hpp"

namespace rondo::dynamics {

class GeneralContact {
 public:
  explicit GeneralContact(const Model& model);

  /// Corrects v_next of `state` by the impulses at its places; `active` gets what each candidate
  /// feels. @param center about which the ground's angular impulse is taken              [m]
  ContactReport solve(const BodyFrames& frames, Vec2 center, State& state);

  /// Candidates whose contacts are solved elsewhere. @param held (nb)
  void leave_out(std::vector<char> held) {
    RONDO_DEMAND(model_.contact && held.size() == model_.contact->nodes.size(), held.size());
    held_ = std::move(held);
  }

  // solve() in two parts: find() at u, then solve_found() with velocities without impulses.
  /// See ContactFinder::find.
  std::span<const ContactRow> find(const State& state);
  /// See ContactFinder::find_at_corners. @return the contacts; each node of theirs has all of its
  /// own
  std::span<const ContactRow> find_at_corners(const State& state, std::span<const NearCorner> near,
                                              std::span<const int> nodes);
  ContactReport solve_found(const BodyFrames& frames, Vec2 center, State& state);
  [[nodiscard]] const ContactFinder& finder() const noexcept { return finder_; }
  [[nodiscard]] ContactFinder& finder() noexcept { return finder_; }

  /// The impulses from which the next step starts, and the difficult problems.
  [[nodiscard]] const contact::CoupledContacts& coupled() const noexcept { return coupled_; }
  [[nodiscard]] contact::CoupledContacts& coupled() noexcept { return coupled_; }

 private:
  using Rows = std::span<const int>;  ///< rows of one cluster

  [[nodiscard]] double turning_of(const BodyFrames& frames, const ContactRow& row,
                                  const State& state) const;
  void set_velocities(const BodyFrames& frames, const State& state);
  void look_for_late(const BodyFrames& frames, ContactReport& report) const noexcept;
  [[nodiscard]] bool came_round(const ContactRow& row) const noexcept;
  void find_clusters();
  [[nodiscard]] bool one_node_on_ground(Rows rows) const;
  void solve_on_ground(const BodyFrames& frames, Rows rows, State& state, ContactReport& report);
  void solve_together(const BodyFrames& frames, Rows rows, State& state, ContactReport& report);
  void make_problem(Rows rows);
  void add_impulses(const BodyFrames& frames, Rows rows, bool converged, State& state);
  void finish_row(const BodyFrames& frames, ContactRow& row, double mass, State& state,
                  ContactReport& report);
  void report_on_ground(const ContactRow& row, ContactReport& report) const;
  void add_active(const ContactRow& row, State& state) const;
  [[nodiscard]] double pressure_before(const ContactRow& row) const;
  void keep_impulses();

  const Model& model_;
  ContactFinder finder_;
  std::vector<ContactRow> rows_;
  std::vector<char> held_;         ///< (nb) candidates that are left out; empty: none
  std::vector<int> candidate_;     ///< (n) place among the candidates, -1: none
  std::vector<Complex> response_;  ///< (n) complex Delassus operator of the nodes in contact [m/kg]
  std::vector<int> node_start_, nodes_;
  contact::ClusterFinder cluster_finder_;
  std::vector<contact::ContactRows> cluster_rows_;
  contact::DelassusBuilder delassus_;
  contact::CoupledContacts coupled_;  ///< problem of one cluster; `kept` of all contacts
  Vec2 center_;
};

}  // namespace rondo::dynamics
