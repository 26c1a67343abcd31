// SPDX-License-Identifier: BSD-3-Clause
/// @file  Where a reduced model touches the ground, and what its modes move there: points that
/// stand still in space, or the nodes of the boundary as they come by (docs/reduced.md, 5).
#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "rondo/core/vec2.hpp"
#include "rondo/mesh/mesh.hpp"
#include "rondo/pod/rectify.hpp"

namespace rondo::rom {

struct ReducedModel;

enum class ContactForm {
  places,  ///< means of nodes, at angles fixed in space
  nodes,   ///< the candidates themselves
};

/// m points: those of a reduced model that stand still, or nodes at one phase of the disk.
struct ContactRows {
  Eigen::MatrixXd rows;       ///< (2m, r) H: the modes at the points, x and y of each
  std::vector<Vec2> points;   ///< (m) X of these, in the frame of the model                 [m]
  std::vector<double> share;  ///< (m) length of undeformed boundary each stands for        [m]
  std::vector<std::array<int, 2>> beside;  ///< (m) points next to it on the boundary; -1: none
};

/// Share that a node of the boundary has in a contact point `distance` nodes away: a hat over
/// `stride` nodes to either side, of sum 1. With stride 1 the point is the node.
double contact_weight(double distance, int stride) noexcept;

/// (sectors, sectors · phases) shares of the nodes in the impulses at them and at phases - 1 points
/// evenly spaced between two of them, which have them both. Columns of sum 1.
Eigen::MatrixXd between_weights(int n_sectors, int phases);

/// (sectors, points) weights of the hats, columns of sum 1. @pre stride divides the sectors
Eigen::MatrixXd hat_weights(int n_sectors, int stride);

/// Points that stand still: means of the places of the sectors with model.weights; where there are
/// more than sectors, places between these too, where the modes are turned to (a mean of two places
/// that touch touches with them: it would say nothing new).
/// @pre the rectified frame, one ring of candidates
ContactRows standing_rows(const mesh::Mesh& mesh, const ReducedModel& model);

/// The candidates, as the disk turns. Owns the work space of its moves: one object a thread.
class NodeRows {
 public:
  /// Both must outlive it. @pre the candidates are rings
  NodeRows(const mesh::Mesh& mesh, const ReducedModel& model);
  /// When the disk has turned by `phase` [rad], in the order of pod::boundary_rings(mesh). In the
  /// rectified frame the rows move with the phase, T(-phase) of the modes there; in the turning
  /// frame they are the modes at the nodes.
  [[nodiscard]] ContactRows at(double phase);

 private:
  const mesh::Mesh& mesh_;
  const ReducedModel& model_;
  pod::Rings rings_;
  std::vector<std::array<int, 2>> beside_;  ///< as ContactRows has it
  pod::Rectifier rectifier_;                ///< of all modes at once
  Eigen::MatrixXd modes_;                   ///< (2m, r) at the nodes, in the order of the rings
};

}  // namespace rondo::rom
