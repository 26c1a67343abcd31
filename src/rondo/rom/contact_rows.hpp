// SPDX-License-Identifier: BSD-3-Clause
/// @file  The contact points of a reduced model and their motion by its modes: points fixed in
/// space, or the nodes of the boundary as the disk turns (docs/reduced.md, 5).
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

/// m points: those of a reduced model that are fixed in space, or nodes at one phase of the disk.
struct ContactRows {
  Eigen::MatrixXd rows;       ///< (2m, r) H: the modes at the points, x and y of each
  std::vector<Vec2> points;   ///< (m) X of the points, in the frame of the model              [m]
  std::vector<double> share;  ///< (m) length of undeformed boundary of each point          [m]
  std::vector<std::array<int, 2>> beside;  ///< (m) adjacent points on the boundary; -1: none
};

/// Weight of a boundary node in a contact point `distance` nodes away: a hat function over `stride`
/// nodes to either side, with sum 1. For stride 1 the point is the node.
double contact_weight(double distance, int stride) noexcept;

/// (sectors, sectors · phases) shares of the nodes in the impulses at the nodes and at phases - 1
/// points evenly spaced between two of them, which share them. Columns have sum 1.
Eigen::MatrixXd between_weights(int n_sectors, int phases);

/// (sectors, points) weights of the hats; columns have sum 1. @pre stride divides the sectors
Eigen::MatrixXd hat_weights(int n_sectors, int stride);

/// Points fixed in space: means over the sectors with model.weights. If there are more points than
/// sectors, also points between the sectors, to which the modes are rotated. (A mean of two points
/// in contact would be in contact with them and add no information.)
/// @pre the rectified frame, one ring of candidates
ContactRows standing_rows(const mesh::Mesh& mesh, const ReducedModel& model);

/// The candidates as the disk turns. Owns the work space of its transforms: one object per thread.
class NodeRows {
 public:
  /// Both must outlive it. @pre the candidates are rings
  NodeRows(const mesh::Mesh& mesh, const ReducedModel& model);
  /// Points after the disk has turned by `phase` [rad], in the order of pod::boundary_rings(mesh).
  /// In the rectified frame the rows depend on the phase, T(-phase) of the modes there; in the
  /// rotating frame they are the modes at the nodes.
  [[nodiscard]] ContactRows at(double phase);

 private:
  const mesh::Mesh& mesh_;
  const ReducedModel& model_;
  pod::Rings rings_;
  std::vector<std::array<int, 2>> beside_;  ///< like that of ContactRows
  pod::Rectifier rectifier_;                ///< for all modes at once
  Eigen::MatrixXd modes_;                   ///< (2m, r) at the nodes, in the order of the rings
};

}  // namespace rondo::rom
