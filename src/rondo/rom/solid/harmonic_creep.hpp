// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the contact nodes of a viscous wheel in three dimensions remember of their forces
/// (../wheel/creep/creep_memory.hpp), harmonic by harmonic: a step costs one product of a small
/// matrix with the forces of each harmonic.
#pragma once
#include <Eigen/Core>
#include <array>
#include <complex>
#include <span>
#include <vector>

#include "rondo/core/complex.hpp"
#include "rondo/core/vec3.hpp"
#include "rondo/rom/wheel/creep/creep_memory.hpp"
#include "rondo/rom/wheel/ring_harmonics.hpp"

namespace rondo::rom {

/// Amplitudes U_k of a field of contact nodes that turn with the ring, (3C, N/2 + 1):
/// u_j = Re Σ_k w_k e^{ikφ_j} U_k, with w_k = 1 for k = 0 and k = N/2, else 2.
using RingAmplitudes = Eigen::MatrixXcd;

class HarmonicCreep {
 public:
  /// @param at_once, later tables of CreepResidual, one for each spin
  /// @param turn (N) e^{iφ_j}; it must outlive it
  /// @param stiffness_damping β that the terms contain [s] @param dt [s]
  HarmonicCreep(std::span<const CreepTerm> terms, std::span<const RingResidual> at_once,
                std::span<const RingResidual> later, std::span<const Complex> turn,
                double stiffness_damping, double dt);

  /// Its shares of new forces and of those that have always been there, its energies, its numbers.
  [[nodiscard]] const CreepMemory& memory() const noexcept { return memory_; }
  /// Forgets all forces.
  void clear() noexcept;
  /// Empties the list of forces for start() and step(), and adds to it. @param component the first
  /// of the three rows of a node
  void clear_forces() noexcept;
  void add_force(int sector, Eigen::Index component, Vec3 force) noexcept;
  /// Starts from these forces, as if they had always been there.
  void start() noexcept;
  /// Moves on by a step, at whose end these are the forces. Allocates nothing.
  void step() noexcept;

  /// Finds the displacement of the nodes, and what will be left of it after a step without forces,
  /// by the tables of a spin.
  void use(const TableShares& shares) noexcept;
  [[nodiscard]] const RingAmplitudes& now() const noexcept { return now_; }
  [[nodiscard]] const RingAmplitudes& left() const noexcept { return left_; }
  /// Writes (3C) the field in a sector.
  void write(const RingAmplitudes& of, int sector, std::span<double> out) const noexcept;

  /// Lagging forces by their shares, of the first term and of all others [N].
  struct Lagging {
    RingAmplitudes at_once, later;
  };
  [[nodiscard]] Lagging lagging() const;
  /// At the start of the last step.
  [[nodiscard]] Lagging lagging_before() const;

  void restore(std::span<const double> numbers) noexcept { memory_.restore(numbers); }
  /// @param rows 3C
  [[nodiscard]] static std::size_t n_saved(std::size_t terms, std::size_t tables, std::size_t rows,
                                           std::size_t sectors) noexcept {
    return CreepMemory::n_saved(terms, tables, 2 * rows * (sectors / 2 + 1));
  }

 private:
  [[nodiscard]] RingAmplitudes harmonics_of(const RingResidual& table) const;
  void push() noexcept;
  /// @param one lagging() of the memory, or lagging_before()
  [[nodiscard]] Lagging lagging_by(CreepMemory::Lagging (CreepMemory::*one)(std::size_t)
                                       const noexcept) const;

  std::span<const Complex> turn_;
  CreepMemory memory_;  ///< a group is a harmonic: the real and imaginary parts of its 3C rows
  /// At once, later: for each spin the (3C, 3C) of all harmonics, one beside the other.
  std::array<std::vector<RingAmplitudes>, 2> tables_;
  RingAmplitudes now_, left_;  ///< by the shares of the tables
};

}  // namespace rondo::rom
