// SPDX-License-Identifier: BSD-3-Clause
/// @file  Reading a run: mesh, motion and the complete snapshots of DIR/results.h5, whatever state
/// the run is in (done, running, killed, interrupted, failed).
#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "rondo/core/field.hpp"
#include "rondo/io/h5/h5.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::io {

enum class Quantity {
  displacement,  ///< (n) turning frame, at `time`; in three dimensions with the axial one [m]
  velocity,      ///< (n) turning frame, at `time_velocity`; likewise                      [m/s]
  contact,       ///< (nb) normal, tangential, at `time`                                   [N/m]
                 ///<      in three dimensions with that along t2 besides                  [N]
};

/// Of the complete snapshots: the first m of the file.
struct RunTimes {
  std::vector<double> time;            ///< (m) rising                                     [s]
  std::vector<double> time_velocity;   ///< (m) of the velocities                          [s]
  std::vector<double> angle;           ///< (m) θ at `time`                                [rad]
  std::vector<double> angle_velocity;  ///< (m) θ at `time_velocity`; empty: not in the file, which
                                       ///<     is of an earlier version                   [rad]
};

class RunReader {
 public:
  /// @throws InputError: `directory` is not there, holds no results.h5 or snapshots of modes;
  /// FileError: results.h5 is damaged, truncated, not of this program, or its datasets do not fit
  /// each other
  explicit RunReader(std::filesystem::path directory);

  [[nodiscard]] const std::filesystem::path& directory() const noexcept { return directory_; }
  /// From run.json; "unknown" where that is missing or damaged.
  [[nodiscard]] const std::string& title() const noexcept { return title_; }
  [[nodiscard]] const std::string& status() const noexcept { return status_; }
  /// Name of the analysis, from results.h5; "dynamic" where an earlier version did not say.
  [[nodiscard]] const std::string& analysis() const noexcept { return analysis_; }
  /// "s"; "1" where the times are shares of a load, and velocities rates over that share [m].
  [[nodiscard]] const std::string& time_unit() const noexcept { return time_unit_; }
  [[nodiscard]] bool is_motion() const noexcept { return time_unit_ == "s"; }
  [[nodiscard]] const mesh::Mesh& mesh() const noexcept { return mesh_; }  ///< `clamped` is empty
  /// (n) lumped mass, per unit thickness [kg/m]; in three dimensions [kg]
  [[nodiscard]] const std::vector<double>& mass() const noexcept { return mass_; }
  [[nodiscard]] const RunTimes& times() const noexcept { return times_; }
  [[nodiscard]] std::size_t n_snapshots() const noexcept { return times_.time.size(); }
  /// Rows of the datasets: more than n_snapshots() while a run goes on and after one was killed.
  [[nodiscard]] std::size_t n_planned() const noexcept { return n_planned_; }

  [[nodiscard]] bool has(Quantity quantity) const noexcept;
  [[nodiscard]] std::size_t n_points(Quantity quantity) const noexcept;  ///< nodes or candidates
  /// Of a point: 3 in three dimensions, else 2.
  [[nodiscard]] std::size_t n_components(Quantity quantity) const noexcept;
  /// The points [first, first + out.size()) of a snapshot, straight into `out`; one thread at a
  /// time. @pre has(quantity), snapshot < n_snapshots(), as many components as there. @throws
  /// FileError
  void read(Quantity quantity, std::size_t snapshot, std::size_t first, MutableFieldView out) const;

 private:
  void read_summary();
  void read_analysis();
  void read_times();
  void open_snapshots();
  [[nodiscard]] const h5::Dataset& dataset(Quantity quantity) const noexcept;

  std::filesystem::path directory_;
  std::string title_ = "unknown", status_ = "unknown", analysis_ = "dynamic", time_unit_ = "s";
  h5::File file_;
  mesh::Mesh mesh_;
  std::vector<double> mass_;
  RunTimes times_;
  std::size_t n_planned_ = 0;
  h5::Dataset displacement_, velocity_, contact_;
};

/// Empty if both runs have the same mesh and masses, bit by bit; else what differs first.
std::string mesh_difference(const RunReader& a, const RunReader& b);

}  // namespace rondo::io
