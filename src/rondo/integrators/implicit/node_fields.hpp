// SPDX-License-Identifier: BSD-3-Clause
/// @file  Fields of some nodes of a body, taken out of an integrator between two steps, changed and
/// put back: in its own components (Cartesian, polar in the cyclic step) and its own order.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "rondo/core/complex.hpp"
#include "rondo/core/vec2.hpp"

namespace rondo::dynamics {

/// Components apart, so that loops over the nodes are loops over numbers.
struct PlaneField {
  PlaneField() = default;
  explicit PlaneField(std::size_t n) : x(n), y(n) {}
  [[nodiscard]] std::size_t size() const noexcept { return x.size(); }
  [[nodiscard]] Vec2 at(std::size_t i) const noexcept { return {x[i], y[i]}; }
  void put(std::size_t i, Vec2 value) noexcept {
    x[i] = value.x;
    y[i] = value.y;
  }

  std::vector<double> x, y;
};

/// The nodes, in the integrator's order. Places that fill up rows are of no node: mass 0.
struct NodeSet {
  std::vector<int> node;      ///< (n) of the mesh, -1: none
  std::vector<double> mass;   ///< (n)                                                 [kg/m]
  PlaneField reference;       ///< (n) X in the components                                [m]
  std::vector<Complex> turn;  ///< (n) turns the components to those of the co-rotating frame
  int sectors = 0;            ///< > 0: rows round a ring of equal sectors, sector by sector
  std::size_t row_size = 0;   ///< places from a row to the next, with sectors

  [[nodiscard]] std::size_t size() const noexcept { return node.size(); }
};

/// The fields of such nodes that an integrator shows and lets be changed, between two steps.
class NodeFields {
 public:
  virtual void read_displacement(PlaneField& u) const noexcept = 0;
  virtual void read_velocity(PlaneField& v) const noexcept = 0;
  /// K u of the last step made, where there is stiffness damping                       [N/m]
  virtual void read_force(PlaneField& force) const noexcept = 0;
  virtual void write(const PlaneField& u, const PlaneField& v) noexcept = 0;

 protected:
  ~NodeFields() = default;
};

}  // namespace rondo::dynamics
