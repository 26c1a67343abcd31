// SPDX-License-Identifier: BSD-3-Clause
/// @file  The inner loops of a step, compiled once for each instruction set (docs/performance.md).
/// Plain pointers and numbers only: a file compiled for AVX-512 must not hold an inline function
/// that the linker could hand to a machine without it.
#pragma once
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "rondo/integrators/implicit/ring_terms.hpp"

namespace rondo::dynamics::kernels {

/// Columns are worked on in packs of eight at every level, so that sums have the same order.
inline constexpr int lanes = 8;
/// Packs whose sums are added up together.
inline constexpr int group_packs = 4;
/// Rows that are worked on together.
inline constexpr int most_rows = 4;

/// Sums over the nodes of a step, before the factors of (5.1) and (5.3); v̂ = v⁻ + v⁺.
enum Sum {
  sum_kinetic,    ///< m |v⁻|²
  sum_strain,     ///< u_{n+1}·K u_n
  sum_frame,      ///< m v̂·Δt[(ṡJ - s²)(X + u) + Rᵀ(c̈ - g)]
  sum_mass,       ///< m |v̂|²
  sum_stiffness,  ///< v̂·(K u_{n+1} - K u_n)
  sum_load,       ///< v̂·f of the loads
  n_sums
};
/// With elements of rubber one more, and another sum_strain.
enum RubberSum {
  sum_mean_force = sum_strain,  ///< v̂·f, f what the elements and K do at u_{n+1}
  sum_force_before = n_sums,    ///< v⁻·f
  sum_linear,                   ///< u·K u of the linear elements
  n_rubber_sums
};
/// In three dimensions one more.
enum SolidRubberSum {
  sum_window = n_rubber_sums,  ///< twice what the motion of a window does to its rubber
  n_solid_rubber_sums
};

/// Sums over the nodes of a step on a loaded rim, co-rotating frame, before the factors of (10.5):
/// a of V in the axes of R_{n+1} before (a⁻) and after (a⁺), p = K u_{n+1}, d = u_{n+1} - u_n, e =
/// p - K u_n, y = X + u_{n+1}; a × b = a_x b_y - a_y b_x.
enum WheelSum {
  wheel_kinetic,        ///< m |a⁻|²
  wheel_strain,         ///< u_n·p; with elements of rubber d·p_n
  wheel_force_arm,      ///< y·p
  wheel_force_moment,   ///< y × p
  wheel_force_after,    ///< p·a⁺
  wheel_force_across,   ///< p × a⁺
  wheel_force_moved,    ///< p·d
  wheel_force_turned,   ///< p × d
  wheel_mass_mean,      ///< m d·(a⁻ + a⁺)
  wheel_mass_moment,    ///< m y × d
  wheel_change_mean,    ///< e·(a⁻ + a⁺)
  wheel_change_moment,  ///< y × e
  wheel_force_x,        ///< p
  wheel_force_y,
  wheel_change_x,  ///< e
  wheel_change_y,
  wheel_mass_x,  ///< m d
  wheel_mass_y,
  wheel_momentum_x,  ///< m (a⁻ + a⁺); with gravity only
  wheel_momentum_y,
  n_wheel_sums
};
/// The sums of WheelSum, and more with elements of rubber.
enum RubberWheelSum {
  wheel_linear = n_wheel_sums,  ///< u·K u of the linear elements
  n_rubber_wheel_sums
};
/// The sums of WheelSum, and more in three dimensions. There the sums of kinetic and strain energy
/// and those with a⁻ + a⁺ are over three components; moments and what the rim's turn does to p are
/// about the axle.
enum SolidWheelSum {
  wheel_force_z = n_rubber_wheel_sums,  ///< p along the axle, and so on
  wheel_change_z,
  wheel_mass_z,
  wheel_momentum_z,
  wheel_load,           ///< f·(a⁻ + a⁺), f of the pressures
  wheel_rest,           ///< u × f of the forces of the state at rest
  wheel_force_moved_z,  ///< p·d along the axle
  wheel_window,         ///< as sum_window
  n_solid_wheel_sums
};
inline constexpr int most_sums = n_solid_wheel_sums;
static_assert(int{n_sums} <= most_sums && int{n_solid_rubber_sums} <= most_sums &&
              int{n_wheel_sums} <= most_sums && int{n_rubber_wheel_sums} <= most_sums);

/// The factors that all nodes of a step on a loaded rim share, for forces and velocities.
struct WheelFactors {
  double back_x, back_y;  ///< e^{-iδ⁻} - 1
  double pull_x, pull_y;  ///< Δt Rᵀ g                                      [m/s]
  double pull_z;          ///< along the axle
  double alpha_over_dt;   ///< α/Δt                                         [1/s²]
  double beta_over_dt;    ///< β/Δt [-]
};
/// Factors of all nodes for the way to u_{n+2}, which is known once the rim is.
struct WheelWay {
  double turn_x, turn_y;  ///< e^{-iδ⁺} - 1
  double way_x, way_y;    ///< Δt e^{-iδ⁺}                                            [s]
  double hub_x, hub_y;    ///< Rᵀ ċ⁺                                                  [m/s]
  double hub_z;           ///< along the axle
  double dt;              ///< Δt                                                     [s]
};

/// The factors that all nodes of a step share. Complex numbers as (x, y).
struct StepFactors {
  double dt;                    ///< Δt [s]
  double rate_x, rate_y;        ///< Δt (ṡJ - s²)                                     [1/s]
  double pull_x, pull_y;        ///< Δt Rᵀ(c̈ - g)                                     [m/s]
  double inverse_x, inverse_y;  ///< 1/a
  double drag_x, drag_y;        ///< drag of the velocity update (3.5)
  double beta_over_dt;          ///< β/Δt [-]
};

/// Which terms a step has.
struct Terms {
  bool stiffness_damping = false;  ///< β > 0: K u_n is kept
  bool unsteady = false;           ///< the spin changes, or some pull is not zero
};

/// One 2×2 block of a row, column-major, and where its vectors are: number of doubles from the
/// field u of the chunk's first row, sector 0, to that of the column, the shift included.
struct CyclicEntry {
  std::ptrdiff_t at;
  double k[4];
};

/// Blocks of a row on one layer where sectors are mirrors of themselves: with the sum S and the
/// difference D of the vectors of the next and the last sector,
/// f_r = rr u_r + rr1 S_r + rt1 D_t,  f_t = tt u_t + tt1 S_t + tr1 D_r.
struct MirrorBlock {
  double rr, tt, rr1, tt1, rt1, tr1;
};
/// Row of such a disk: what the layers below, here and above do on it.
struct MirrorRow {
  MirrorBlock below, here, above;
};

/// A local node over the sectors of a chunk.
struct CyclicRow {
  const CyclicEntry* entries;  ///< unused where the strip has mirror rows
  int n_entries;
  std::ptrdiff_t at;    ///< from the chunk's first field to this row's, sector 0
  double mass;          ///< m                                                        [kg/m]
  double dt_over_mass;  ///< Δt/m
  double x, y;          ///< X in the sector's frame                                    [m]
  int first_load = 0;   ///< its loads among the strip's
  int n_loads = 0;
};

/// Fields and columns of the rows of a strip. Fields are `stride` apart in a row, a component
/// each: u of even and of odd steps, v, and with β K u_n.
struct StripFields {
  double* now;       ///< u_{n+1} of the chunk's first row, sector 0
  double* next;      ///< u_{n+2}; on a loaded rim u_n till the kernel of the way
  double* velocity;  ///< v⁻, becomes v⁺; on a loaded rim V in the axes of R_n, of R_{n+1}
  double* force;     ///< K u_n, becomes K u_{n+1}; unused where it is not kept
  std::ptrdiff_t stride;
  const double* turn_x;       ///< cos φ of the chunk's sectors (padded like a field)
  const double* turn_y;       ///< sin φ
  int first_pack;             ///< 0, or -1 where the halo is advanced too
  int last_pack;              ///< one past the last pack
  int columns;                ///< sectors of the chunk's own: the sums are over these
  bool keep_tail;             ///< lanes past `columns` in the last own pack stay as they are
  const WheelFactors* wheel;  ///< instead of the factors of a step, on a loaded rim
  const WheelWay* way;        ///< read by the kernel of the way alone
  double* sums;               ///< (groups, sums of a group, lanes): added to
};

/// Some rows, one above the other, over the sectors of a chunk: product, velocity update and sums
/// in one pass.
struct CyclicStrip : StripFields {
  const CyclicRow* rows;
  int n_rows;               ///< at most most_rows
  const MirrorRow* mirror;  ///< mirror form of each row; null: rows have entries
  std::ptrdiff_t row_size;  ///< between rows
  bool lowest, highest;     ///< no free row below the first, none above the last
  const StepFactors* step;
  // Loads on nodes, unused by kernels without: f = Σ pressure · force, in the sector's frame.
  const double* loads;      ///< force per pressure of the first, sector 0; components and loads are
                            ///< `stride` apart                                           [m]
  const int* load_of;       ///< (loads) whose pressure it is of
  const double* pressures;  ///< [Pa]
};

/// Sectors of a row that may touch: y of the node <= limit.
struct CyclicHeight {
  const double* u;  ///< u_r of sector 0 of the chunk; u_t is `stride` on
  std::ptrdiff_t stride;
  double x, y;           ///< X in the sector's frame                          [m]
  const double* turn_x;  ///< cos φ, sin φ of the sectors
  const double* turn_y;
  double rotation_x, rotation_y;  ///< R(θ_{n+1})
  double limit;                   ///< top of the ground - y of the center              [m]
  int first, last;                ///< columns looked at
};

struct RubberRows;

/// Packs of eight rows of K on any mesh, one a node, and the nodes' fields: product, velocity
/// update and sums in one pass. Rows of a pack have as many blocks as the longest: zero blocks on
/// their own node fill the others up. `column` is twice the node: where its pair is in u.
struct SparseRows {
  const std::int64_t* start;   ///< (packs + 1) first place of a pack in `blocks`, `column`
  const double* blocks;        ///< (places, lanes, 4) [k_xx, k_xy, k_yx, k_yy]           [N/m²]
  const std::int32_t* column;  ///< (places, lanes)
  const double* constants;     ///< (packs, 4, lanes) X_x, X_y [m], m [kg/m], Δt/m
  const double* now;           ///< (nodes, 2) u_{n+1}
  double* next;                ///< (nodes, 2) u_{n+2}
  double* motion;              ///< (packs, 2, lanes) v⁻, becomes v⁺; with β (packs, 4, lanes):
                               ///< v and K u_n, which becomes K u_{n+1}
  std::ptrdiff_t first_pack, last_pack;
  const StepFactors* step;
  const WheelFactors* wheel;  ///< instead of `step`; `next` and `motion` then as in CyclicStrip
  const WheelWay* way;
  double* sums;  ///< (n_sums or n_wheel_sums, lanes) of these packs: set
  // Loads on nodes, unused by kernels without: f = Σ pressure · force.
  const int* first_load;     ///< (packs + 1) of a pack
  const double* loads;       ///< (loads, 2, lanes) force per pressure                     [m]
  const int* load_of;        ///< (loads) whose pressure it is of
  const double* pressures;   ///< [Pa]
  const RubberRows* rubber;  ///< unused by kernels without
};

struct RubberTable;
struct SolidTable;

/// The loops of one instruction set on a loaded rim; K u_n is always kept there, and pressures are
/// those of the general step. In a file of their
/// own: beside the others each would be compiled worse, for what both call is no longer put in
/// place.
struct WheelTable {
  void (*strip[2])(const CyclicStrip&) noexcept;  ///< [heavy]
  void (*strip_way)(const CyclicStrip&) noexcept;
  void (*rows[2])(const SparseRows&) noexcept;  ///< [heavy]
  void (*rows_way)(const SparseRows&) noexcept;
};

/// The loops of one instruction set.
struct Table {
  const char* name;
  /// [loaded][stiffness_damping][unsteady]
  void (*cyclic_strip[2][2][2])(const CyclicStrip&) noexcept;
  /// Columns that are low enough, ascending; returns how many.
  int (*low_columns)(const CyclicHeight&, int* columns) noexcept;
  /// [loaded][stiffness_damping][unsteady]
  void (*sparse_rows[2][2][2])(const SparseRows&) noexcept;
  const WheelTable* wheel;
  RingProduct ring_product;
  const RubberTable* rubber;
  const SolidTable* solid;
};

/// No constructors that the linker could take from a file compiled for another machine.
static_assert(std::is_trivial_v<WheelFactors> && std::is_trivial_v<WheelWay> &&
              std::is_trivial_v<StepFactors> && std::is_trivially_copyable_v<Terms>);
static_assert(std::is_trivial_v<CyclicEntry> && std::is_trivial_v<MirrorRow> &&
              std::is_trivially_copyable_v<CyclicRow> && std::is_trivial_v<CyclicStrip> &&
              std::is_trivial_v<CyclicHeight> && std::is_trivial_v<SparseRows>);
static_assert(std::is_trivial_v<RingTerms> && std::is_trivial_v<Table>);
static_assert(sizeof(MirrorRow) == 18 * sizeof(double));  // as MirrorBlock: no gaps are read

/// In files of their own, as the loops of a loaded rim.
void avx512_ring_product(const RingTerms& terms) noexcept;
void avx2_ring_product(const RingTerms& terms) noexcept;
void baseline_ring_product(const RingTerms& terms) noexcept;

extern const WheelTable avx512_wheel, avx2_wheel, baseline_wheel;
extern const Table avx512_table, avx2_table, baseline_table;

}  // namespace rondo::dynamics::kernels
