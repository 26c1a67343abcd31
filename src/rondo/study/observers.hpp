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

/// Of history.csv and contact.csv, for every kind of analysis.
std::vector<std::string> history_columns();
std::vector<std::string> contact_columns();

/// As many as history_columns() has; a crush adds some.
inline constexpr std::size_t n_history_columns = 23;

/// Rows of history.csv: forces as means over the interval since the last row, the ledger at half a
/// step before.
class History {
 public:
  /// c.output.history_interval 0: every step. The case must outlive the object.
  History(const Case& c, const Setup& setup);
  /// Every step, in turn: appends a row where one is due.
  /// @param last no step comes after: a row is appended even where none is due.
  void observe(const dynamics::StepReport& step, bool last, std::vector<double>& rows);

 private:
  [[nodiscard]] double slip_ratio(double time) const;

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

/// results.h5, fields.xdmf and contact.csv. Made, used and closed by one thread at a time.
class Snapshots {
 public:
  /// @param planned snapshots, at the most. The setup must outlive the object. @throws FileError
  Snapshots(const std::filesystem::path& directory, const Case& c, const Setup& setup,
            std::size_t planned);
  /// @param state step, frame, u, v and active are read. @throws FileError
  void write(const dynamics::State& state);
  /// @throws FileError
  void close();
  [[nodiscard]] std::size_t written() const { return results_.written(); }

 private:
  void collect_contact(const dynamics::State& state);
  void write_contact_rows(const dynamics::State& state);

  const Setup& setup_;
  io::Results results_;
  io::Csv contact_csv_;
  std::optional<fem::StressRecovery> stress_;
  std::vector<Vec2> force_, force_fixed_;  ///< (nb)
  std::vector<double> rows_;
};

}  // namespace rondo::study
