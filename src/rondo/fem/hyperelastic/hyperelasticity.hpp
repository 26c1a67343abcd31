// SPDX-License-Identifier: BSD-3-Clause
/// @file  All cells of a mesh that contains rubber: cells of rubber at finite strain, others with
/// their small-strain stiffness (docs/rubber.md, 1.3). Energies and forces depend on displacements
/// in the frame in which the undeformed body rests. If all is rubber, a rotation is no strain.
#pragma once
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "rondo/fem/assembly.hpp"
#include "rondo/fem/hyperelastic/element.hpp"

namespace rondo::fem {

/// The smallest det F of an evaluation, and its cell.
struct LeastVolume {
  double ratio = std::numeric_limits<double>::infinity();  ///< <= 0: the cell is inverted
  std::size_t cell = 0;
};

/// Results that are found along with the forces of a body.
struct Look {
  LeastVolume least;
  double energy = 0.0;  ///< stored; infinite if a cell is inverted                  [J/m]
};

class Hyperelasticity {
 public:
  using History = hyperelastic::Symmetric<double>;  ///< C_i of a branch in a cell
  using Histories = std::span<const History>;       ///< (n_histories); empty: no branches

  /// Work space of a pass over the cells. Each concurrent pass needs its own.
  struct Pass {
    std::vector<hyperelastic::CornerForces> forces;  ///< (cells of rubber)
    std::vector<double> of_cell;                     ///< smallest det F, or loss in a half step
    std::vector<double> energy;                      ///< (cells of rubber) stored energy [J/m]
  };

  /// @param materials one for each region of the mesh (material_of). @pre no cell is inverted
  Hyperelasticity(const mesh::Mesh& mesh, std::span<const Material> materials);
  Hyperelasticity(const Hyperelasticity&) = delete;  // the parts point to the laws
  Hyperelasticity& operator=(const Hyperelasticity&) = delete;

  [[nodiscard]] std::size_t n_nodes() const noexcept { return reference_.size(); }
  /// (n) 1: the node has cells, and all of them are rubber.
  [[nodiscard]] std::vector<char> nodes_of_rubber_alone() const;

  /// Number of histories: all branches of all cells, by cell, in the order of Rubber::branches.
  [[nodiscard]] std::size_t n_histories() const noexcept { return first_history_.back(); }
  /// Histories that are relaxed in the state u: the branches have no stress.
  [[nodiscard]] std::vector<History> relaxed(std::span<const Vec2> u) const;
  /// Relaxes all branches over half a step with u constant; returns their loss of energy [J/m].
  /// @param half_step [s]
  double relax(std::span<const Vec2> u, double half_step, std::span<History> histories, Pass& pass,
               int threads = 1) const;

  /// Derivative of the energy with respect to u, (n) [N/m]; at clamped nodes that of rubber alone.
  /// An inverted cell has none: see what is returned. Same bits for any number of threads.
  Look gradient(std::span<const Vec2> u, Histories histories, std::span<Vec2> out, Pass& pass,
                int threads = 1) const;
  /// Derivative of the gradient at constant histories, free nodes [N/m²]; symmetric to round-off.
  [[nodiscard]] BlockCsr tangent(std::span<const Vec2> u, Histories histories = {}) const;

 private:
  struct Part {
    std::size_t cell = 0;  ///< index in the mesh
    const Rubber* rubber = nullptr;
    int n_corners = 4;
    NodalDilatation::Corners patches{};  ///< of a triangle
  };
  struct Corner {
    std::int32_t part, corner;
  };
  struct Pressures {
    std::vector<double> value, slope;  ///< (patches) U' [Pa], U'' / area [Pa/m²]
    double energy = 0.0;               ///< sum over patches                            [J/m]
  };

  void find_corners();
  void look_at(std::size_t part, std::span<const Vec2> u, Histories histories,
               const Pressures& pressures, Pass& pass) const;
  [[nodiscard]] hyperelastic::DeformedCell deformed(const Part& part,
                                                    std::span<const Vec2> u) const noexcept;
  [[nodiscard]] Histories histories_of(std::size_t part, Histories all) const noexcept;
  [[nodiscard]] std::vector<double> patch_changes(std::span<const Vec2> u) const;
  [[nodiscard]] Pressures patch_pressures(std::span<const Vec2> u) const;
  [[nodiscard]] static double mean_pressure(const Part& part, const Pressures& pressures) noexcept;
  void add_patches(std::span<const Vec2> u, const Pressures& pressures, BlockCsr& k) const;

  std::vector<Vec2> reference_;             ///< (n) X [m]
  std::vector<mesh::Cell> cells_;           ///< (e)
  std::vector<Rubber> rubbers_;             ///< (regions) those that are rubber
  std::vector<Part> parts_;                 ///< the cells of rubber
  std::vector<std::size_t> first_history_;  ///< (parts + 1)
  NodalDilatation dilatation_;
  std::vector<double> patch_bulk_;  ///< (patches) κ; 0: not rubber [Pa]
  BlockCsr stiffness_;  ///< of the other cells, in the pattern of all; no rows: there are no others
  BlockCsr pattern_;    ///< of all cells, values 0
  std::vector<std::size_t> first_corner_;  ///< (n + 1)
  std::vector<Corner> corners_;            ///< corners of a node in parts_, ascending
};

}  // namespace rondo::fem
