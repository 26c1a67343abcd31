// SPDX-License-Identifier: BSD-3-Clause
/// @file  What is built from a case: all data that its steps need and its results are made of.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rondo/case/case.hpp"
#include "rondo/case/inflation_figures.hpp"
#include "rondo/model/model.hpp"
#include "rondo/model/stability/critical_step.hpp"

namespace rondo::fem {
class Hyperelasticity;
}

namespace rondo::study {

/// Location of a probe in the mesh.
struct ProbeSite {
  std::size_t cell = 0;
  std::array<double, 4> weight{};  ///< shape functions of its corners
};

/// A line of `rondo check`: a label and its value.
using Told = std::pair<std::string, std::string>;

struct Setup {
  mesh::Mesh mesh;                                     ///< free bodies in their positions at t = 0
  std::vector<fem::Material> materials;                ///< one for each region of the mesh
  std::shared_ptr<const fem::Hyperelasticity> rubber;  ///< cells at finite strain; null: linear
  fem::NodalDilatation dilatation;                     ///< of B-bar triangles, for their stress
  std::vector<ProbeSite> probes;                       ///< of output.probes
  dynamics::Model model;
  std::optional<InflationFigures> inflation;  ///< of a wheel about its inflated state
  std::vector<char> implicit_cells;           ///< (e) 1: implicit; empty: none
  dynamics::CriticalStep critical;    ///< of the explicit elements; infinite: there are none
  double critical_plain = 0.0;        ///< critical step with all elements explicit, own mass [s]
  long long n_steps = 0;              ///< ceil(end / step); the step is never fitted to the end
  std::string reduced;                ///< reduced wheel: its modes, in words; empty: the mesh
  std::size_t saved_numbers = 0;      ///< reduced wheel: size of SavedState::ring
  std::vector<Vec2> prestress;        ///< (n) displacement whose stress stiffens the body [m]
  Field displacement;                 ///< (n) u_0                          [m]
  Field velocity;                     ///< (n) v_0                          [m/s]
  Field half_velocity;                ///< (n) v_{1/2}; empty: by (3.7) [m/s]
  double frequencies_above = 0.0;     ///< a known lower bound of every ω² of the body [1/s²]
  std::vector<Told> figures;          ///< physical quantities for `rondo check`
  std::vector<std::string> warnings;  ///< for the user; the caller prints them
};

/// Speed of a node at the start [m/s].
inline double initial_speed(const Setup& s, std::size_t node) {
  return s.model.solid ? norm(s.velocity.space()[node]) : norm(s.velocity.plane()[node]);
}

/// The work of the internal forces is a column of its own: they are not K u alone.
inline bool has_internal_work(const Setup& s) noexcept {
  const dynamics::Model& m = s.model;
  return fem::has_rubber(s.materials) || !m.viscous.empty() ||
         (m.solid && (m.solid->swept || !m.solid->viscous.empty()));
}

}  // namespace rondo::study
