// SPDX-License-Identifier: BSD-3-Clause
/// @file  The rectified frame: a field of the co-rotating frame is moved around the disk to the
/// fixed frame, on a mesh of equal sectors, by an exact isometry (docs/theory.md, 7.3).
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "rondo/core/complex.hpp"
#include "rondo/mesh/mesh.hpp"

struct fftw_plan_s;  // defined by the library

namespace rondo::pod {

/// Points of a cyclic mesh that follow one another around the disk, ring by ring.
struct Rings {
  int n_sectors = 0;
  std::vector<int>
      point;  ///< (n_rings * n_sectors) index in the field, [ring * n_sectors + sector]

  [[nodiscard]] std::size_t n_rings() const noexcept {
    return n_sectors > 0 ? point.size() / static_cast<std::size_t>(n_sectors) : 0;
  }
};

/// Rings of all nodes; indices are nodes. Empty (n_sectors 0) if the sectors do not all contain the
/// same nodes. @pre mesh.n_sectors > 0
Rings node_rings(const mesh::Mesh& mesh);
/// Rings of the contact candidates; indices are those in mesh.boundary. @pre mesh.n_sectors > 0
Rings boundary_rings(const mesh::Mesh& mesh);

enum class Components {
  cartesian,  ///< x, y in the co-rotating frame: turned and moved
  scalars,    ///< (normal, tangential): only moved
};

enum class Shift {
  fourier,  ///< by the exact angle: harmonic k over the sectors times e^{-ikθ}, Nyquist's times 1
  pitch,    ///< by the nearest whole number of sectors
};

/// T(θ): an isometry of the M norm, a group in θ (Shift::fourier), T(θ)⁻¹ = T(-θ) = its adjoint; it
/// commutes with K. Owns the plans and work space of its transforms: one object per thread.
class Rectifier {
 public:
  Rectifier(int n_sectors, std::size_t n_rings, Components components, Shift shift);
  ~Rectifier();
  Rectifier(const Rectifier&) = delete;
  Rectifier& operator=(const Rectifier&) = delete;

  /// Works in place. @param theta counter-clockwise angle of the co-rotating frame [rad]
  /// @param values (n_rings * n_sectors) ring after ring, as Rings::point
  void apply(double theta, std::span<Vec2> values);
  /// Moves one number per point, such as axial components in three dimensions, which a rotation
  /// about the axle does not change. Each ring is independent, so that blocks of rings give the
  /// same bits as all rings.
  /// @param values (n_rings * n_sectors) ring after ring
  void apply(double theta, std::span<double> values);

 private:
  [[nodiscard]] double harmonic(std::size_t k) const noexcept;
  void set_phases(double theta);
  void move_by_harmonics(std::span<Vec2> ring);
  void move_by_harmonics(std::span<double> ring);
  [[nodiscard]] std::ptrdiff_t whole_sectors(double angle) const noexcept;
  template <class Move>
  void move(std::span<Vec2> values, Move&& move_ring);

  std::size_t n_, n_rings_;
  Components components_;
  Shift shift_;
  std::vector<Complex> to_polar_;  ///< (n) e^{-iφ} of the sectors
  std::vector<Complex> phase_;     ///< (n) of the harmonics, over n
  std::vector<Vec2> work_;         ///< (n) space for one ring
  fftw_plan_s* forward_ = nullptr;
  fftw_plan_s* backward_ = nullptr;
};

}  // namespace rondo::pod
