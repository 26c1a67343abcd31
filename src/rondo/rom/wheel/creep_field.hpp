// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the contact nodes of a viscous wheel remember of their forces (docs/reduced.md,
/// section 2): a lagging force of each term of the creep at each node, and the displacement that
/// it makes beyond the modes. Both obey one recursion, so that a step costs one product of the
/// tables with the forces of the nodes in contact, however long the wheel remembers.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "rondo/core/vec2.hpp"
#include "rondo/rom/wheel/ring_harmonics.hpp"

namespace rondo::rom {

/// Shares of the tables of a residual at a spin; those beyond their number are 0.
using TableShares = std::array<double, 3>;

/// A force on a contact node, in the frame of its sector [N/m].
struct NodeForce {
  int node = 0;
  Vec2 force;
};

/// Energies and works of the creep in a step [J/m].
struct CreepEnergy {
  double at_start = 0.0, at_end = 0.0;  ///< stored; both by the tables of the spin at its end
  double work = 0.0;                    ///< done on it
  double lost = 0.0;                    ///< >= 0, as far as the tables are
  double by_stiffness = 0.0;            ///< of that, by stiffness damping
};

class CreepField {
 public:
  /// @param at_once, later tables of CreepResidual, one for each spin; they must outlive it
  /// @param n number of contact nodes of the wheel, those of a sector one after the other
  /// @param stiffness_damping β that the terms contain [s] @param dt [s]
  CreepField(std::span<const CreepTerm> terms, std::span<const RingResidual> at_once,
             std::span<const RingResidual> later, std::size_t n, double stiffness_damping,
             double dt);

  /// Forgets all forces.
  void clear() noexcept;
  /// Starts from forces that have always been there.
  void start(std::span<const NodeForce> forces) noexcept;
  /// Moves on by a step, at whose end these are the forces. Allocates nothing.
  void step(std::span<const NodeForce> forces) noexcept;

  /// Displacement of a node, and what will be left of it after a step without new forces [m].
  [[nodiscard]] Vec2 now(int node, const TableShares& shares) const noexcept {
    return sum(now_, node, shares);
  }
  [[nodiscard]] Vec2 left(int node, const TableShares& shares) const noexcept {
    return sum(left_, node, shares);
  }
  /// What a new force does to the displacement at the end of its step: shares of both tables.
  [[nodiscard]] double new_at_once() const noexcept { return new_at_once_; }
  [[nodiscard]] double new_later() const noexcept { return new_later_; }
  /// The same of a force that has always been there.
  [[nodiscard]] double held_at_once() const noexcept { return terms_.front().share; }
  [[nodiscard]] double held_later() const noexcept { return 1.0 - terms_.front().share; }

  /// Of the last step.
  [[nodiscard]] CreepEnergy energy(const TableShares& shares) const noexcept;
  /// Stored at its end [J/m].
  [[nodiscard]] double stored(const TableShares& shares) const noexcept;

  /// Lagging forces on a node by their shares, of the first term and of all others [N/m].
  struct Lagging {
    Vec2 at_once, later;
  };
  [[nodiscard]] Lagging lagging(int node) const noexcept { return lagging_of(force_, node); }
  /// At the start of the last step.
  [[nodiscard]] Lagging lagging_before(int node) const noexcept {
    return lagging_of(force_before_, node);
  }

  /// The numbers from which another one of the same wheel goes on bit for bit.
  void save(std::vector<double>& out) const;
  /// @param numbers n_numbers() of save()
  void restore(std::span<const double> numbers) noexcept;
  [[nodiscard]] static std::size_t n_numbers(std::size_t terms, std::size_t tables,
                                             std::size_t n) noexcept {
    return 2 * n * (1 + terms + tables * (2 + terms));
  }

 private:
  using Field = std::vector<Vec2>;  ///< (n)
  struct Step {
    double share, time;
    CreepStep step;
  };
  /// Displacements by one table for each spin.
  using Fields = std::array<Field, 3>;

  void push(std::span<const NodeForce> forces) noexcept;
  void add_product(const RingResidual& table, const NodeForce& from, Field& out) const noexcept;
  void find_sums() noexcept;
  [[nodiscard]] std::size_t kind(std::size_t term) const noexcept { return term == 0 ? 0 : 1; }
  [[nodiscard]] Vec2 sum(const Fields& of, int node, const TableShares& shares) const noexcept {
    Vec2 u;
    for (std::size_t a = 0; a < n_tables_; ++a)
      u += shares[a] * of[a][static_cast<std::size_t>(node)];
    return u;
  }
  [[nodiscard]] Lagging lagging_of(const std::vector<Field>& force, int node) const noexcept;

  std::array<std::span<const RingResidual>, 2> tables_;  ///< at once, later
  std::size_t n_, n_tables_;
  double stiffness_damping_, dt_;
  std::vector<Step> terms_;
  double new_at_once_ = 0.0, new_later_ = 0.0;
  Field last_;                                ///< λ at the end of the last step
  std::vector<Field> force_, force_before_;   ///< of each term: λ_b
  std::vector<Fields> moved_, moved_before_;  ///< of each term: G λ_b by its kind of table
  std::array<Fields, 2> pushed_;              ///< G λ of the last forces, by both kinds
  std::array<Fields, 2> pushing_;             ///< of the forces of a step, while it is made
  Field acting_;                              ///< these forces
  Fields now_, left_;                         ///< sums by shares
};

}  // namespace rondo::rom
