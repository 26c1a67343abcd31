// SPDX-License-Identifier: BSD-3-Clause
/// @file  The passes over the nodes of a step of several bodies (docs/theory.md, section 9),
/// compiled once for each instruction set. Plain pointers and numbers only, as in
/// fused/kernels/kernels.hpp. Nodes are rows, eight in a pack; those of a group, one after the
/// other, move in one frame: the nodes of a free body, or all that are held.
#pragma once
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "rondo/integrators/fused/kernels/kernels.hpp"

namespace rondo::dynamics::kernels {

/// Sums of the way to u_{n+2}, d = u_{n+2} less the shift of the pose at t_{n+1}; arm = X - X_c.
enum MoveSum {
  move_kinetic,  ///< m |v|²
  move_x,        ///< m d
  move_y,
  move_along,    ///< m arm·d
  move_across,   ///< m arm × d
  move_fastest,  ///< the largest |v|², no sum
  n_move_sums
};

/// Sums of the product, p = K e, y = arm + e.
enum ForceSum {
  force_moment,         ///< y × p
  force_change_moment,  ///< y × (p - p_n), with β only
  force_energy,         ///< e·p
  n_force_sums
};

/// Sums of the velocities, before the factors of (5.3); v̂ = v⁻ + v⁺, G of (9.5).
enum VelocitySum {
  velocity_frame,         ///< m v̂·Δt[(ṡJ - s²)(X + u) + Rᵀ(c̈ - g)]
  velocity_mass,          ///< m |v̂|²
  velocity_stiffness,     ///< v̂ · of the damping (9.6)
  velocity_load,          ///< v̂ · of the loads
  velocity_power_before,  ///< v⁻·G
  velocity_power_after,   ///< v⁺·G
  velocity_strain,        ///< u_n·p, of held nodes
  n_velocity_sums
};

/// The frame in which a group's strains are seen; of held nodes the one that they move in.
struct GroupPose {
  double turn_x = 1.0, turn_y = 0.0;    ///< R
  double back_x = 0.0, back_y = 0.0;    ///< Rᵀ - 1
  double shift_x = 0.0, shift_y = 0.0;  ///< x_c - X_c                                     [m]
};

/// Factors of m J R arm in the forces that turning with the body takes away, over |Z| (9.5).
struct GroupTurning {
  double elastic = 0.0;  ///< factor from p                                              [1/s²]
  double damping = 0.0;  ///< factor from β (p - p_n)/Δt
};

/// Fields of all rows, whatever their group.
struct BodyFields {
  const std::int64_t* start;   ///< (packs + 1), with `blocks` and `column` as in SparseRows
  const double* blocks;        ///< [N/m²]
  const std::int32_t* column;  ///< (places, lanes) twice the row
  const double* constants;     ///< (packs, 4, lanes) arm [m] (held: X), m [kg/m], Δt/m
  double* motion;              ///< (packs, 4, lanes) u, v
  double* elastic;             ///< (rows, 2) e                                            [m]
  double* force;               ///< (packs, 2, lanes) p; with β (packs, 4, lanes) p, p - p_n
  const int* load_at;          ///< (packs) place in `loads`, -1: none; null: no loads
  const double* loads;         ///< (places, 2, lanes) frame of the nodes                 [N/m]
};

/// Packs of one group.
struct BodyBlock {
  const BodyFields* fields;
  std::ptrdiff_t first_pack, last_pack;
  const GroupPose* pose;
  const GroupTurning* turning;
  const StepFactors* step;  ///< factors of the step in the group's frame
  double* sums;             ///< sums of one of the enumerations above, by lanes: set
};

static_assert(std::is_trivial_v<BodyFields> && std::is_trivial_v<BodyBlock> &&
              std::is_trivially_copyable_v<GroupPose> &&
              std::is_trivially_copyable_v<GroupTurning>);
static_assert(move_fastest + 1 == n_move_sums);  // no sum: the others are added up before it

/// The passes of one instruction set, in their order in a step.
struct BodyTable {
  const char* name;
  void (*elastic)(const BodyBlock&) noexcept;         ///< e of u (9.3)
  void (*force[2])(const BodyBlock&) noexcept;        ///< [β] p = K e
  void (*velocity[2][2])(const BodyBlock&) noexcept;  ///< [held][β] v⁺ of v⁻ (3.4)
  void (*move)(const BodyBlock&) noexcept;            ///< u_{n+2} of v⁺
  /// [held][β] both in one, with the sums of both, VelocitySum first.
  void (*velocity_and_move[2][2])(const BodyBlock&) noexcept;
};

extern const BodyTable avx512_bodies, avx2_bodies, baseline_bodies;

}  // namespace rondo::dynamics::kernels
