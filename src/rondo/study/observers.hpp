// SPDX-License-Identifier: BSD-3-Clause
/// @file  What a run writes down while it goes on: rows of its history, snapshots.
#pragma once
#include <filesystem>
#include <vector>

#include "rondo/dynamics/integrator.hpp"
#include "rondo/fem/stress.hpp"
#include "rondo/io/csv.hpp"
#include "rondo/io/results.hpp"
#include "rondo/study/build.hpp"

namespace rondo::study {

/// Of history.csv and contact.csv, for every kind of analysis. A crush and probes add some.
std::vector<std::string> history_columns();
std::vector<std::string> contact_columns();

/// Rows of history.csv: forces as means over the interval since the last row, the ledger at half a
/// step before, probes as they are at the row's time.
class History {
 public:
  /// c.output.history_interval 0: every step. Case and setup must outlive the object.
  History(const Case& c, const Setup& setup);
  [[nodiscard]] std::vector<std::string> columns() const;
  /// Every step, in turn: appends a row where one is due.
  /// @param last no step comes after: a row is appended even where none is due.
  /// @param state of this step, where there are probes; null: their numbers are NaN
  void observe(const dynamics::StepReport& step, bool last, const dynamics::State* state,
               std::vector<double>& rows);
  /// The next step that gives a row with probes: its state is wanted. The largest number where
  /// there are none.
  [[nodiscard]] long long next_probed() const noexcept;

 private:
  [[nodiscard]] double slip_ratio(double time) const;
  [[nodiscard]] bool is_due(double time) const noexcept;
  void append_probes(const dynamics::State* state, std::vector<double>& rows) const;

  const Case& case_;
  const Setup& setup_;
  double dt_, interval_;
  double radius_ = 0.0;  ///< of what rolls; 0: nothing does                       [m]
  long long next_ = 1;   ///< number of the next row's interval
  long long steps_ = 0;  ///< since the last row
  long long done_ = 0;   ///< the last step seen
  Vec2 impulse_;         ///< since the last row [N·s/m]
  double angular_impulse_ = 0.0;
  double penetration_ = 0.0;
};

/// Steps at which snapshots are taken: `count` times evenly spread over [from, end], each at the
/// nearest step, the last one at the last step. Fewer where steps are fewer.
std::vector<long long> snapshot_steps(int count, double from, double dt, long long n_steps);

/// results.h5, fields.xdmf and contact.csv. Made, used and closed by one thread at a time.
class Snapshots {
 public:
  /// @param planned snapshots, at the most. The setup must outlive the object. @throws FileError
  Snapshots(const std::filesystem::path& directory, const Case& c, const Setup& setup,
            std::size_t planned);
  /// @param state step, frame, u, v, poses and active are read. @throws FileError
  void write(const dynamics::State& state);
  /// @throws FileError
  void close();
  [[nodiscard]] std::size_t written() const { return results_.written(); }

 private:
  void collect_contact(const dynamics::State& state);
  std::span<const Vec2> elastic(const dynamics::State& state);
  void write_contact_rows(const dynamics::State& state);

  const Setup& setup_;
  io::Results results_;
  io::Csv contact_csv_;
  std::optional<fem::StressRecovery> stress_;
  std::vector<Vec2> elastic_;    ///< (n) displacement in the frame of its body; empty: no free body
  std::vector<Vec2> rotations_;  ///< of the free bodies
  std::vector<Vec2> force_, force_fixed_;  ///< (nb)
  std::vector<double> rows_;
};

}  // namespace rondo::study
