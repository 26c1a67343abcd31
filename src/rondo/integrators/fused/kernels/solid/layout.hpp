// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the loops over a wheel in three dimensions read and write (docs/performance.md).
/// Plain pointers and numbers, as in kernels.hpp. Vectors are (radial, tangential, axial), each in
/// the frame of its own node: the first axis points from the axle to X.
#pragma once
#include <cstddef>
#include <type_traits>

#include "rondo/integrators/fused/kernels/kernels.hpp"

namespace rondo::dynamics::kernels {

/// Rows that are worked on together: their sums stay in registers.
inline constexpr int solid_rows = 2;
/// Packs whose sums are added up together: twice three, as many of two rows as the registers of
/// AVX-512 hold.
inline constexpr int solid_packs = 6;

/// How the blocks of a strip are written down.
enum class SolidKind {
  general,   ///< 9 numbers for each node that a row couples with, column-major
  mirrored,  ///< 14 numbers for each three nodes beside each other (SolidMirror)
};

/// The nodes that the rows of a strip couple with: one over all sectors, or three of one radius and
/// z, the middle one on the meridian of the row's node. A place is a number of doubles from the
/// field u of the chunk's first row, sector 0.
struct SolidEntry {
  std::ptrdiff_t here;
  std::ptrdiff_t last, next;  ///< places in mirrored strips
  int rows;                   ///< bits: 1 the first row couples with it, 2 the second
};

/// The 14 numbers of a row and three nodes, u the vector of the middle one, S and D sum and
/// difference of those of the next and the last: f_r = rr u_r + zr u_z + rr1 S_r + rt1 D_t + rz1
/// S_z, and so on. In the order in which they are read: by r, t and z of the vectors.
enum SolidMirror {
  mirror_rr,
  mirror_zr,
  mirror_rr1,
  mirror_zr1,
  mirror_tr1,
  mirror_tt,
  mirror_tt1,
  mirror_rt1,
  mirror_zt1,
  mirror_rz,
  mirror_zz,
  mirror_rz1,
  mirror_zz1,
  mirror_tz1,
  n_mirror
};

static_assert(n_mirror == 14 && mirror_rr == 0);
static_assert(solid_rows == 2);       // SolidEntry::rows has a bit for each
static_assert(solid_packs % 2 == 0);  // half of them at a time

/// A node of a sector, over the sectors of a chunk.
struct SolidRow {
  std::ptrdiff_t at;      ///< from the chunk's first field to this row's, sector 0
  double mass;            ///< m                                                          [kg]
  double dt_over_mass;    ///< Δt/m
  double x, y, z;         ///< X in its frame                                              [m]
  double turn_x, turn_y;  ///< its frame in that of its sector
  double rest_x, rest_y;  ///< force of the state at rest, on a loaded rim                 [N]
  std::ptrdiff_t swept;   ///< place of its forces in SolidFaces::force; -1: it has none
  std::ptrdiff_t rubber;  ///< place in SolidRubber::force
  double of_state[3];     ///< force of cords and air in the state                         [N]
};

/// The factors that all nodes of a step share.
struct SolidFactors {
  StepFactors plane;
  double axial_pull;     ///< Δt (c̈ - g) along the axle                                 [m/s]
  double axial_inverse;  ///< 1/A
  double axial_drag;     ///< Δt α
};

/// Some rows over the sectors of a chunk: product, velocity update and sums in one pass.
struct SolidStrip : StripFields {
  const SolidRow* rows;
  int n_rows;  ///< at most solid_rows
  SolidKind kind;
  const SolidEntry* entries;
  int n_entries;
  const double* blocks;  ///< blocks of the entries, one by one, each with those of its rows
  const SolidFactors* step;
  const double* swept;         ///< forces of cords and air (SolidFaces::force); null: K u is all
  const double* rubber;        ///< forces of rubber (SolidRubber::force); null: it is linear
  const char* has_rubber;      ///< of the packs: these are to be added there
  int n_sums;                  ///< of a group of solid_packs
  double load[solid_rows][3];  ///< force on each node of a row, unused by kernels without [N]
};

/// A corner of a face that is swept from a sector to the next. Places are numbers of doubles from
/// the first u of the chunk, and from the first force, at the column of the face.
struct SolidFaceCorner {
  std::ptrdiff_t u;       ///< -1: it is held
  std::ptrdiff_t force;   ///< corners of the next sector have forces of their own
  double turn_x, turn_y;  ///< frame of its node in that of the face
};
/// A line of cords over the sectors of a chunk: y = rest + Σ slope u at its four points.
struct SolidCordFace {
  SolidFaceCorner corner[4];
  double rest[4][3], slope[4][4];
  double length[4];  ///< of the cords that a point stands for                             [m]
  double stiffness, prestrain, compression;
};
/// A face of the liner: its middle and the tangents there, in the state                   [m]
struct SolidAirFace {
  SolidFaceCorner corner[4];
  double middle[3], along[3], across[3];
};
/// All faces of a chunk.
struct SolidFaces {
  const SolidCordFace* cords;
  const SolidAirFace* air;
  int n_cords, n_air;
  double pressure;         ///< [Pa]
  double energy_of_state;  ///< of a sector [J]
  const double* now;       ///< u_{n+1}
  double* force;  ///< (rows with faces, of faces of this and of the last sector, 3, stride): set
  int n_rows;     ///< with faces
  std::ptrdiff_t stride;
  int columns;  ///< the chunk's own; forces are found for the one before as well
  int n_sums, sum;
  double* sums;  ///< (groups, n_sums, lanes): twice the energy is added to number `sum`
};

/// Modes of an element that are not those of its middle: along ξ, η, ζ, of their products.
inline constexpr int n_solid_modes = 7;
/// Share of each of eight corners in a mode that the points of an element see with factors of ±1.
struct SolidModeShares {
  double one, two, three;  ///< by the number of coordinates in the product
};
/// An element of rubber that is swept from a sector to the next. Modes are those of the corners,
/// with three components in the frame of the element; points by x + 2 y + 4 z.
struct SolidRubberElement {
  SolidFaceCorner corner[8];
  double rest[3 * n_solid_modes];           ///< modes of x in the state                [m]
  double metric[8][6], cometric[8][6];      ///< xx, yy, zz, xy, yz, zx of I₁, and of I₂
  double volume[8], whole_volume;           ///< undeformed [m³]
  double bulk, c10, c20, c30, c01;          ///< [Pa]
  double energy, force[3 * n_solid_modes];  ///< in the state, its forces on the modes  [J], [N]
  double stiffness[9 * n_solid_modes * n_solid_modes];  ///< there, of modes              [N/m]
};
/// All elements of a chunk, and the columns in which they have a weight.
struct SolidRubber {
  const SolidRubberElement* elements;
  int n_elements;
  SolidModeShares shares;
  const int* packs;  ///< that have columns with a weight, -1 among them
  int n_packs;
  const int* cleared;  ///< packs of `force` that are set to 0 before
  int n_cleared;
  const double* weight;  ///< of the columns, from 0 on; padded to whole packs from -1 on
  const double* mask;    ///< 1 where there is a weight, else 0
  const double* now;     ///< u_{n+1}
  double* force;         ///< as that of SolidFaces, of all rows
  int n_rows;            ///< of `force`
  std::ptrdiff_t stride;
  double* energy;  ///< of the columns, without the weight: added to [J]
};

/// Sectors of a row that may touch: place of the node along n <= limit.
struct SolidHeight {
  const double* u;  ///< u_r of sector 0 of the chunk; u_t and u_z are `stride` and 2 `stride` on
  std::ptrdiff_t stride;
  double x, y, z;        ///< X in the node's frame                                        [m]
  const double* turn_x;  ///< cos φ, sin φ of the sectors
  const double* turn_y;
  double rotation_x, rotation_y;  ///< R(θ_{n+1}) of the node's frame in its sector's
  double normal_y, normal_z;      ///< n
  double limit;                   ///< top of the ground - height of the center             [m]
  int first, last;                ///< columns looked at
};

static_assert(std::is_trivial_v<SolidCordFace> && std::is_trivial_v<SolidAirFace> &&
              std::is_trivial_v<SolidFaces> && std::is_trivial_v<SolidRubberElement> &&
              std::is_trivial_v<SolidRubber>);
static_assert(std::is_trivial_v<SolidEntry> && std::is_trivial_v<SolidRow> &&
              std::is_trivial_v<SolidFactors> && std::is_trivial_v<SolidStrip> &&
              std::is_trivial_v<SolidHeight>);

/// The loops of one instruction set on a loaded rim, where K u_n is always kept. In a file of their
/// own, as WheelTable.
struct SolidWheelTable {
  void (*strip)(const SolidStrip&) noexcept;
  void (*way)(const SolidStrip&) noexcept;
};

/// The loops of one instruction set for a wheel in three dimensions.
struct SolidTable {
  /// [loaded][stiffness_damping][unsteady]
  void (*strip[2][2][2])(const SolidStrip&) noexcept;
  /// Columns that are low enough, ascending; returns how many.
  int (*low_columns)(const SolidHeight&, int* columns) noexcept;
  const SolidWheelTable* wheel;
  void (*faces)(const SolidFaces&) noexcept;
  void (*rubber)(const SolidRubber&) noexcept;
  void (*rubber_state)(SolidRubberElement&) noexcept;
};

/// In files of their own.
void avx512_solid_faces(const SolidFaces& faces) noexcept;
void avx2_solid_faces(const SolidFaces& faces) noexcept;
void baseline_solid_faces(const SolidFaces& faces) noexcept;
void avx512_solid_rubber(const SolidRubber& rubber) noexcept;
void avx2_solid_rubber(const SolidRubber& rubber) noexcept;
void baseline_solid_rubber(const SolidRubber& rubber) noexcept;
void avx512_solid_rubber_state(SolidRubberElement& element) noexcept;
void avx2_solid_rubber_state(SolidRubberElement& element) noexcept;
void baseline_solid_rubber_state(SolidRubberElement& element) noexcept;

extern const SolidWheelTable avx512_solid_wheel, avx2_solid_wheel, baseline_solid_wheel;
extern const SolidTable avx512_solid, avx2_solid, baseline_solid;

}  // namespace rondo::dynamics::kernels
