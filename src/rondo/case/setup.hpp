// SPDX-License-Identifier: BSD-3-Clause
/// @file  What a case is built into: all that its steps need and its results are made of.
#pragma once
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rondo/case/case.hpp"
#include "rondo/model/model.hpp"
#include "rondo/model/stability/critical_step.hpp"

namespace rondo::fem {
class Hyperelasticity;
}

namespace rondo::study {

/// Where a probe is in the mesh.
struct ProbeSite {
  std::size_t cell = 0;
  std::array<double, 4> weight{};  ///< shape functions of its corners
};

/// A line of `rondo check`: what is told, and its value.
using Told = std::pair<std::string, std::string>;

struct Setup {
  mesh::Mesh mesh;                                     ///< free bodies where they are at t = 0
  std::vector<fem::Material> materials;                ///< one for each region of the mesh
  std::shared_ptr<const fem::Hyperelasticity> rubber;  ///< all cells at finite strain; null: linear
  fem::NodalDilatation dilatation;                     ///< of triangles by B-bar, for their stress
  std::vector<ProbeSite> probes;                       ///< of output.probes
  dynamics::Model model;
  std::vector<char> implicit_cells;   ///< (e) 1: implicit; empty: none
  dynamics::CriticalStep critical;    ///< of the explicit elements; an infinite step: none
  double critical_plain = 0.0;        ///< critical step if all were explicit, with its mass [s]
  long long n_steps = 0;              ///< ceil(end / step); the step is never fitted to the end
  std::vector<Vec2> prestress;        ///< (n) displacement whose stress stiffens the body [m]
  Field displacement;                 ///< (n) u_0                          [m]
  Field velocity;                     ///< (n) v_0                          [m/s]
  Field half_velocity;                ///< (n) v_{1/2}; empty: as (3.7) has it [m/s]
  double frequencies_above = 0.0;     ///< every ω² of the body is known to be above it [1/s²]
  std::vector<Told> figures;          ///< of a physical kind, for `rondo check`
  std::vector<std::string> warnings;  ///< for the user: the caller prints them
};

/// Speed of a node at the start [m/s].
inline double initial_speed(const Setup& s, std::size_t node) {
  return s.model.solid ? norm(s.velocity.space()[node]) : norm(s.velocity.plane()[node]);
}

}  // namespace rondo::study
