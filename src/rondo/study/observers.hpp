// SPDX-License-Identifier: BSD-3-Clause
/// @file  What looks at a run while it goes on, and changes nothing of it: history, snapshots.
#pragma once
#include <filesystem>
#include <vector>

#include "rondo/dynamics/integrator.hpp"
#include "rondo/fem/stress.hpp"
#include "rondo/io/csv.hpp"
#include "rondo/io/results.hpp"
#include "rondo/study/build.hpp"

namespace rondo::study {

/// Of history.csv and contact.csv, for every kind of analysis.
std::vector<std::string> history_columns();
std::vector<std::string> contact_columns();

/// history.csv: forces as means over the interval since the last row, the ledger at half a step
/// before.
class History {
 public:
  /// @param interval [s]; 0: every step.
  History(const std::filesystem::path& file, const Case& c, const Setup& setup);
  /// @param last no step comes after: a row is written even where none is due.
  void observe(const dynamics::StepReport& step, bool last);

 private:
  [[nodiscard]] double slip_ratio(double time) const;

  io::Csv csv_;
  const Case& case_;
  double dt_, interval_;
  long long next_ = 1;   ///< number of the next row's interval
  long long steps_ = 0;  ///< since the last row
  Vec2 impulse_;         ///< since the last row [N·s/m]
  double angular_impulse_ = 0.0;
  double penetration_ = 0.0;
};

/// Steps at which snapshots are taken: `count` times evenly spread over [from, end], each at the
/// nearest step, the last one at the last step. Fewer where steps are fewer.
std::vector<long long> snapshot_steps(int count, double from, double dt, long long n_steps);

/// results.h5, fields.xdmf and contact.csv.
class Snapshots {
 public:
  Snapshots(const std::filesystem::path& directory, const Case& c, const Setup& setup);
  /// The next step at which observe wants to see the state; the largest number where none is left.
  [[nodiscard]] long long next_step() const;
  /// @pre state.step == next_step(), unless the run ends there.
  void observe(const dynamics::State& state);
  void close();
  [[nodiscard]] std::size_t written() const { return results_.written(); }

 private:
  void collect_contact(const dynamics::State& state);
  void write_contact_rows(const dynamics::State& state);

  const Setup& setup_;
  std::vector<long long> steps_;
  std::size_t next_ = 0;
  io::Results results_;
  io::Csv contact_csv_;
  std::optional<fem::StressRecovery> stress_;
  std::vector<Vec2> force_, force_fixed_;  ///< (nb)
  std::vector<double> rows_;
};

}  // namespace rondo::study
