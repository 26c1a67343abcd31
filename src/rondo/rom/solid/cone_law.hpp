// SPDX-License-Identifier: BSD-3-Clause
/// @file  Signorini–Coulomb contact of nodes without mass over a step, in space (docs/reduced.md):
/// gaps, and distances slid along two tangents, at its end. All contacts are coupled by a dense
/// compliance that is not symmetric. Sweeps over the contacts find the forces (cone_sweeps.hpp);
/// Newton's method stands behind them (Alart, Curnier, CMAME 92 (1991) 353).
#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "rondo/rom/solid/cone_contact.hpp"
#include "rondo/rom/solid/cone_sweeps.hpp"
#include "rondo/rom/solid/window_compliance.hpp"

namespace rondo::rom {

/// The products of the best instruction set of this machine, or of the one that RONDO_DISPATCH
/// names. @throws InputError as dynamics::kernel_table()
[[nodiscard]] const kernels::ConeTable& cone_table();
/// Those of all instruction sets of this machine, the best first.
[[nodiscard]] std::vector<const kernels::ConeTable*> cone_tables();

class ConeLaw {
 public:
  /// @param tolerance residual of the law, over the largest force
  /// @param most_sweeps before Newton's method
  explicit ConeLaw(double tolerance, const kernels::ConeTable& table = cone_table(),
                   int most_sweeps = 300)
      : tolerance_(tolerance), most_sweeps_(most_sweeps), table_(table), sweeps_(table) {}

  struct Report {
    int sweeps = 0;
    bool by_newton = false;
    double residual = 0.0;  ///< of the law, over the largest force                     [-]
  };
  /// 0 <= normal force ⊥ gap >= 0; |shear| <= μ normal, opposed to the distance slid. Allocates
  /// nothing but room for more contacts than ever before, and in Newton's method.
  /// @param rows of the window that the contacts are in
  /// @param friction of contacts whose coefficient is none of ConeContact; or null
  Report solve(std::span<ConeContact> contacts, const WindowCompliance& compliance,
               Eigen::Index rows, const ConeFriction* friction = nullptr);
  /// No contacts: nothing moves.
  void clear() noexcept { moved_.clear(); }
  /// (rows) What the forces of solve() do in the window, in the axes of the compliance; without
  /// the rim [m]
  [[nodiscard]] std::span<const double> moved() const noexcept { return moved_; }

 private:
  void prepare(std::span<const ConeContact> contacts, const WindowCompliance& compliance);
  void multiply(std::span<const ConeContact> contacts, const WindowCompliance& compliance);
  [[nodiscard]] double residual(std::span<const ConeContact> contacts) const;
  [[nodiscard]] double friction_of(std::size_t contact) const;
  void finish(std::size_t contact, ConeContact& c) const;
  [[nodiscard]] double largest_force() const noexcept;
  bool newton(std::span<const ConeContact> contacts, const WindowCompliance& compliance);

  const double tolerance_;
  const int most_sweeps_;
  const kernels::ConeTable& table_;
  const ConeFriction* friction_ = nullptr;  ///< of the last solve()
  std::vector<ConeLocal> local_;
  std::vector<double> moved_;  ///< (rows) W r
  double mean_ = 0.0;          ///< of the compliance's diagonal                  [m/N]
  ConeSweeps sweeps_;
};

}  // namespace rondo::rom
