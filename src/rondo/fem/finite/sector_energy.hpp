// SPDX-License-Identifier: BSD-3-Clause
/// @file  Energy of a wheel at finite strain whose sectors all deform alike, with its derivatives:
/// rubber and cords, the work of a pressure that follows the wall, and that of the spin.
#pragma once
#include <Eigen/SparseCore>
#include <array>
#include <span>
#include <vector>

#include "rondo/core/complex.hpp"
#include "rondo/core/vec3.hpp"
#include "rondo/fem/finite/swept_forces.hpp"
#include "rondo/fem/finite/swept_rubber.hpp"
#include "rondo/fem/finite/swept_section.hpp"
#include "rondo/fem/solid/hexahedron.hpp"

namespace rondo::fem::finite {

struct SectorLoads {
  double pressure = 0.0;      ///< inside [Pa]
  double spin_squared = 0.0;  ///< s² about the axle [1/s²]
};

/// State of one sector. Its first side has the nodes of the section; its second side has those of
/// the next sector, turned by R. Component c of node a is number 3a + c; components in the frame of
/// the sector: outwards, around, along the axle.
struct SectorState {
  double energy = 0.0;      ///< of rubber and cords                                        [J]
  double volume = 0.0;      ///< of the cones from the origin, and caps: what is enclosed where
                            ///< the liner and its caps close [m³]
  double least = 0.0;       ///< smallest det F; <= 0: no force is set
  std::size_t of_quad = 0;  ///< where
  double load = 0.0;        ///< largest component of the loads at a node [N]
  Eigen::VectorXd force;    ///< (3n) of all that is stored less the loads: 0 at free nodes in
                            ///< equilibrium                                           [N]
  /// (3n, 3n) K u in sector j is here u_j + next u_{j+1} + nextᵀ u_{j-1} [N/m]; with the pressure's
  /// stiffness, without the spin's.
  Eigen::SparseMatrix<double> here, next;
};

class SectorEnergy {
 public:
  /// @pre nodes and rubbers exist; r, spacings and stiffnesses are > 0; a line of cords goes from
  /// node to node in one direction; where the liner ends, its node is held or has a cap
  explicit SectorEnergy(SweptSection section);
  SectorEnergy(const SectorEnergy&) = delete;
  SectorEnergy& operator=(const SectorEnergy&) = delete;

  [[nodiscard]] const SweptSection& section() const noexcept { return section_; }
  [[nodiscard]] std::size_t n_nodes() const noexcept { return section_.place.size(); }
  /// (n) lumped in the undeformed state, of one sector [kg]
  [[nodiscard]] std::span<const double> mass() const noexcept { return mass_; }
  /// @param u (n) displacements [m]
  [[nodiscard]] SectorState state(std::span<const Vec3> u, const SectorLoads& loads) const;

  /// Cords, and the liner under a pressure.
  [[nodiscard]] SweptFaces faces(double pressure) const;
  /// The rubber in a state. @param u (n) displacements [m]
  [[nodiscard]] SweptRubber rubber(std::span<const Vec3> u) const;

  /// The cords at a point of a layer, deformed.
  struct CordPlace {
    Vec3 place;          ///< [m]
    double angle = 0.0;  ///< from the direction around [rad]
    CordState state;
  };
  [[nodiscard]] std::vector<CordPlace> cords(std::size_t layer, std::span<const Vec3> u) const;

  /// The largest principal stretch of the rubber at the points of its elements.
  [[nodiscard]] double largest_stretch(std::span<const Vec3> u) const;
  /// The volume between the liner and the ring that joins its two ends, of the whole wheel [m³].
  /// Absent: the liner is not one line with two ends
  [[nodiscard]] std::optional<double> cavity(std::span<const Vec3> u) const;

 private:
  [[nodiscard]] std::array<int, 2> outwards(std::array<int, 2> edge) const;
  void check() const;
  void make_mass();
  [[nodiscard]] std::vector<std::array<CordPoint, 4>> points_of(const Cords& cords) const;
  [[nodiscard]] std::vector<Vec3> places(std::span<const Vec3> u) const;

  SweptSection section_;
  Complex turn_;                 ///< R, by the angle of a sector
  std::vector<Vec3> reference_;  ///< (n) X [m]
  std::vector<HexahedronPoints> points_;
  std::vector<std::vector<std::array<CordPoint, 4>>> layers_;  ///< (lines, 4) of each
  std::vector<double> mass_;
};

}  // namespace rondo::fem::finite
