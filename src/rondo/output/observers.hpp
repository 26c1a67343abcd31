// SPDX-License-Identifier: BSD-3-Clause
/// @file  What a run writes down while it goes on: rows of its history, snapshots.
#pragma once
#include <filesystem>
#include <vector>

#include "rondo/case/setup.hpp"
#include "rondo/fem/stress.hpp"
#include "rondo/integrators/integrator.hpp"
#include "rondo/io/csv.hpp"
#include "rondo/io/results.hpp"

namespace rondo::study {

/// Of history.csv and contact.csv, for every kind of analysis. A crush and probes add some.
std::vector<std::string> history_columns();
std::vector<std::string> contact_columns();

/// Where the rows of history.csv stand between two steps.
struct HistoryPlace {
  long long next = 1;   ///< number of the next row's interval
  long long steps = 0;  ///< since the last row
  long long done = 0;   ///< the last step seen
  Vec2 impulse;         ///< since the last row                                      [N·s/m]
  double angular_impulse = 0.0, penetration = 0.0;
};

/// Rows of history.csv: forces as means over the interval since the last row, the ledger at half a
/// step before, probes as they are at the row's time.
class History {
 public:
  /// c.output.history_interval 0: every step. Case and setup must outlive the object.
  History(const Case& c, const Setup& setup, const HistoryPlace& place = {});
  [[nodiscard]] const HistoryPlace& place() const noexcept { return at_; }
  [[nodiscard]] std::vector<std::string> columns() const;
  /// Every step, in turn: appends a row where one is due.
  /// @param state of this step, where there are probes; null: their numbers are NaN
  void observe(const dynamics::StepReport& step, const dynamics::State* state,
               std::vector<double>& rows);
  /// No step comes after the one seen last: its row, where none was due.
  void finish(const dynamics::StepReport& step, const dynamics::State* state,
              std::vector<double>& rows);
  /// The next step that gives a row with probes: its state is wanted. The largest number where
  /// there are none.
  [[nodiscard]] long long next_probed() const noexcept;

 private:
  [[nodiscard]] double slip_ratio(double time) const;
  [[nodiscard]] bool is_due(double time) const noexcept;
  void append_row(const dynamics::StepReport& step, const dynamics::State* state,
                  std::vector<double>& rows);
  void append_probes(const dynamics::State* state, std::vector<double>& rows) const;

  const Case& case_;
  const Setup& setup_;
  double dt_, interval_;
  double radius_ = 0.0;  ///< of what rolls; 0: nothing does                       [m]
  HistoryPlace at_;
};

/// results.h5, fields.xdmf and contact.csv. Made, used and closed by one thread at a time.
class Snapshots {
 public:
  /// @param planned snapshots, at the most. The setup must outlive the object. @throws FileError
  Snapshots(const std::filesystem::path& directory, const Case& c, const Setup& setup,
            std::size_t planned);
  /// Goes on with files that are there, after `kept` snapshots and so many bytes of contact.csv.
  /// @throws FileError
  Snapshots(const std::filesystem::path& directory, const Case& c, const Setup& setup,
            std::size_t planned, std::size_t kept, std::size_t contact_bytes);
  /// @param state step, frame, u, v, poses and active are read. @throws FileError
  void write(const dynamics::State& state);
  /// @throws FileError
  void close();
  [[nodiscard]] std::size_t written() const { return results_.written(); }
  [[nodiscard]] std::size_t contact_bytes() const { return contact_csv_.bytes(); }
  /// All that was written is on the disk, whatever happens to the machine. @throws FileError
  void sync() const;

 private:
  void make_room(const Case& c);
  void collect_contact(const dynamics::State& state);
  std::span<const Vec2> elastic(const dynamics::State& state);
  void write_contact_rows(const dynamics::State& state);

  const Setup& setup_;
  io::Results results_;
  io::Csv contact_csv_;
  std::optional<fem::StressRecovery> stress_;
  std::vector<Vec2> elastic_;  ///< (n) displacement in the frame of its body; empty: no free body
  std::vector<Complex> rotations_;         ///< of the free bodies
  std::vector<Vec2> force_, force_fixed_;  ///< (nb)
  std::vector<char> on_ground_;            ///< (nb) 1: the ground presses it
  std::vector<double> rows_;
};

}  // namespace rondo::study
