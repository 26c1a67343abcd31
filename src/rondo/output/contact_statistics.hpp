// SPDX-License-Identifier: BSD-3-Clause
/// @file  Maxima and sums of the contact over a run.
#pragma once
#include "rondo/model/contact_node.hpp"

namespace rondo::study {

struct ContactStatistics {
  double residual = 0.0;       ///< largest law residual over the largest |w_free| so far
  double free_velocity = 0.0;  ///< largest |w_free| so far                            [m/s]
  double penetration = 0.0;    ///< [m]
  long long contact_steps = 0;
  int nodes_max = 0;
  long long pairs = 0;
  long long pairs_not_converged = 0;
  long long clusters = 0;
  long long clusters_not_converged = 0;
  int cluster_largest = 0;
  int cluster_iterations = 0;  ///< largest of one cluster
  long long extensions = 0;    ///< of a massless boundary: how often nodes were added
  int extensions_max = 0;      ///< largest in a step
  int between_bodies = 0;      ///< largest in a step
  // Friction that is not constant adds these at the rows of history.csv
  // (analysis/friction_watch.hpp):
  double friction_steepness = 0.0;    ///< largest κ of a contact                           [-]
  double friction_alternating = 0.0;  ///< Σ r_n |Δμ| of contacts above its limit  [N·s/m], [N·s]
  double friction_bearable = 0.0;     ///< Σ r_n μ of all contacts, with the larger of both μ

  bool operator==(const ContactStatistics&) const = default;
  /// Adds the contact of a step.
  void add(const dynamics::ContactReport& r) noexcept;
};

}  // namespace rondo::study
