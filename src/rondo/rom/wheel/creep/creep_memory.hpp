// SPDX-License-Identifier: BSD-3-Clause
/// @file  What a viscous wheel remembers of the forces on its contact nodes (docs/reduced.md,
/// section 2): a lagging force of each term of the creep, and the displacement that it makes
/// beyond the modes. Both obey one recursion, so that a step needs the products of the tables with
/// its new forces alone, however long the wheel remembers. Forces and displacements are lists of
/// numbers here: components of nodes (wheel/creep_field.hpp) or of harmonics
/// (solid/harmonic_creep.hpp).
#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "rondo/rom/wheel/creep/creep.hpp"

namespace rondo::rom {

/// Shares of the tables of a residual at a spin; those beyond their number are 0.
using TableShares = std::array<double, 3>;

/// Energies and works of the creep in a step [J/m], in space [J].
struct CreepEnergy {
  double at_start = 0.0, at_end = 0.0;  ///< stored; both by the tables of the spin at its end
  double work = 0.0;                    ///< done on it
  double lost = 0.0;                    ///< >= 0, as far as the tables are
  double by_stiffness = 0.0;            ///< of that, by stiffness damping
};

class CreepMemory {
 public:
  using Numbers = std::vector<double>;

  /// @param n_tables number of spins that have tables, up to 3
  /// @param group how many numbers are in a group
  /// @param weights of each group: energies are weight · force · displacement
  /// @param stiffness_damping β that the terms contain [s] @param dt [s]
  CreepMemory(std::span<const CreepTerm> terms, std::size_t n_tables, std::size_t group,
              Numbers weights, double stiffness_damping, double dt);

  [[nodiscard]] std::size_t n_tables() const noexcept { return n_tables_; }
  /// The forces at the end of a step, and the displacements that they make by the tables of the
  /// first term (kind 0) and of all others (kind 1). Set them before start() and step().
  [[nodiscard]] Numbers& acting() noexcept { return acting_; }
  [[nodiscard]] const Numbers& acting() const noexcept { return acting_; }
  [[nodiscard]] Numbers& pushing(std::size_t kind, std::size_t table) noexcept {
    return pushing_[kind][table];
  }
  /// Starts from these forces, as if they had always been there.
  void start() noexcept;
  /// Moves on by a step. Allocates nothing.
  void step() noexcept;

  /// Finds the displacement by a table, and what will be left of it after a step without new
  /// forces.
  [[nodiscard]] const Numbers& now(std::size_t table) const noexcept { return now_[table]; }
  [[nodiscard]] const Numbers& left(std::size_t table) const noexcept { return left_[table]; }
  /// A new force acts on the displacement at the end of its step by these shares of both tables.
  [[nodiscard]] double new_at_once() const noexcept { return new_at_once_; }
  [[nodiscard]] double new_later() const noexcept { return new_later_; }
  /// A force that has always been there acts on the displacement by these shares of both tables.
  [[nodiscard]] double held_at_once() const noexcept { return terms_.front().share; }
  [[nodiscard]] double held_later() const noexcept { return 1.0 - terms_.front().share; }

  /// Finds the energies of the last step.
  [[nodiscard]] CreepEnergy energy(const TableShares& shares) const noexcept;
  /// Finds what is stored at its end.
  [[nodiscard]] double stored(const TableShares& shares) const noexcept;

  /// One number of the lagging forces by their shares: of the first term, and of all others.
  struct Lagging {
    double at_once = 0.0, later = 0.0;
  };
  [[nodiscard]] Lagging lagging(std::size_t i) const noexcept { return lagging_of(force_, i); }
  /// At the start of the last step.
  [[nodiscard]] Lagging lagging_before(std::size_t i) const noexcept {
    return lagging_of(force_before_, i);
  }

  /// The numbers from which another one of the same wheel goes on bit for bit.
  void save(std::vector<double>& out) const;
  /// @param numbers n_saved() of save()
  void restore(std::span<const double> numbers) noexcept;
  /// @param n numbers of a force
  [[nodiscard]] static std::size_t n_saved(std::size_t terms, std::size_t tables,
                                           std::size_t n) noexcept {
    return n * (1 + terms + tables * (2 + terms));
  }

 private:
  struct Step {
    double share, time;
    CreepStep step;
  };
  /// Displacements by one table for each spin.
  using ByTable = std::array<Numbers, 3>;

  void find_sums() noexcept;
  [[nodiscard]] static std::size_t kind(std::size_t term) noexcept { return term == 0 ? 0 : 1; }
  [[nodiscard]] double sum(const ByTable& of, std::size_t i,
                           const TableShares& shares) const noexcept {
    double u = 0.0;
    for (std::size_t a = 0; a < n_tables_; ++a) u += shares[a] * of[a][i];
    return u;
  }
  [[nodiscard]] Lagging lagging_of(const std::vector<Numbers>& force, std::size_t i) const noexcept;
  /// Calls work(numbers) for all that save() keeps.
  template <class Self, class Work>
  static void for_kept(Self& self, Work&& work);

  std::size_t n_tables_, group_;
  Numbers weights_;
  double stiffness_damping_, dt_;
  std::vector<Step> terms_;
  double new_at_once_ = 0.0, new_later_ = 0.0;
  Numbers last_;                               ///< λ at the end of the last step
  Numbers acting_;                             ///< and at that of the step that is made
  std::vector<Numbers> force_, force_before_;  ///< of each term: λ_b
  std::vector<ByTable> moved_, moved_before_;  ///< of each term: G λ_b by its kind of table
  std::array<ByTable, 2> pushed_;              ///< G λ of the last forces, by both kinds
  std::array<ByTable, 2> pushing_;             ///< and of those of the step that is made
  ByTable now_, left_;                         ///< sums by shares of the terms
  mutable Numbers more_, way_;                 ///< (group) of all terms together
};

}  // namespace rondo::rom
