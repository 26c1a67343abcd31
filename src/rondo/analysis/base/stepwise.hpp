// SPDX-License-Identifier: BSD-3-Clause
/// @file  A motion that its caller stops at any step, looks at, and drives.
#pragma once
#include <vector>

#include "rondo/case/setup.hpp"
#include "rondo/core/column.hpp"

namespace rondo::study {

class Stepwise {
 public:
  virtual ~Stepwise() = default;
  /// advance() makes no step beyond this one, at which state() and row() are there; called before
  /// begin() as well. What row() is over begins here.
  virtual void pause_at(long long step) = 0;
  [[nodiscard]] virtual long long steps_made() const noexcept = 0;
  [[nodiscard]] virtual const Setup& setup() const noexcept = 0;
  /// Fields, frame and contacts of the last step made; null: they are not at hand, since no step
  /// was made after a checkpoint, it is no pause, or the run has failed.
  [[nodiscard]] virtual const dynamics::State* state() = 0;
  /// A row of history.csv over the steps since the last pause; empty: there are none.
  [[nodiscard]] virtual std::vector<double> row() const = 0;
  [[nodiscard]] virtual std::vector<ColumnLabel> row_columns() const = 0;
  /// Takes the tables of its case, which have changed for times beyond those of the next step.
  /// @throws InputError: it cannot follow them; nothing has changed then
  virtual void take_tables() = 0;
};

}  // namespace rondo::study
