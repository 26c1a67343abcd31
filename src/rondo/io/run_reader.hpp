// SPDX-License-Identifier: BSD-3-Clause
/// @file  Reads a run, mesh, motion and the complete snapshots of DIR/results.h5, in any state of
/// the run (done, running, killed, interrupted, failed).
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
  displacement,  ///< (n) rotating frame, at `time`; in three dimensions also axial  [m]
  velocity,      ///< (n) rotating frame, at `time_velocity`; likewise               [m/s]
  contact,       ///< (nb) normal, tangential, at `time`                                   [N/m]
                 ///<      in three dimensions also along t2                              [N]
};

/// Times of the complete snapshots, which are the first m of the file.
struct RunTimes {
  std::vector<double> time;            ///< (m) increasing                                 [s]
  std::vector<double> time_velocity;   ///< (m) of the velocities                          [s]
  std::vector<double> angle;           ///< (m) θ at `time`                                [rad]
  std::vector<double> angle_velocity;  ///< (m) θ at `time_velocity`; empty if the file
                                       ///<      of an earlier version has none              [rad]
};

class RunReader {
 public:
  /// @throws InputError: `directory` is missing, has no results.h5 or only snapshots of modes;
  /// FileError: results.h5 is damaged, truncated, not from this program, or its datasets are
  /// inconsistent
  explicit RunReader(std::filesystem::path directory);

  [[nodiscard]] const std::filesystem::path& directory() const noexcept { return directory_; }
  /// From run.json; "unknown" if that is missing or damaged.
  [[nodiscard]] const std::string& title() const noexcept { return title_; }
  [[nodiscard]] const std::string& status() const noexcept { return status_; }
  /// Name of the analysis, from results.h5; "dynamic" if a file of an earlier version has none.
  [[nodiscard]] const std::string& analysis() const noexcept { return analysis_; }
  /// "s"; "1" if times are fractions of a load and velocities are rates over that fraction [m].
  [[nodiscard]] const std::string& time_unit() const noexcept { return time_unit_; }
  [[nodiscard]] bool is_motion() const noexcept { return time_unit_ == "s"; }
  [[nodiscard]] const mesh::Mesh& mesh() const noexcept { return mesh_; }  ///< `clamped` is empty
  /// (n) lumped mass, per unit thickness [kg/m]; in three dimensions [kg]
  [[nodiscard]] const std::vector<double>& mass() const noexcept { return mass_; }
  [[nodiscard]] const RunTimes& times() const noexcept { return times_; }
  [[nodiscard]] std::size_t n_snapshots() const noexcept { return times_.time.size(); }
  /// Rows of the datasets: more than n_snapshots() during a run and after one was killed.
  [[nodiscard]] std::size_t n_planned() const noexcept { return n_planned_; }

  [[nodiscard]] bool has(Quantity quantity) const noexcept;
  [[nodiscard]] std::size_t n_points(Quantity quantity) const noexcept;  ///< nodes or candidates
  /// Components of a point: 3 in three dimensions, else 2.
  [[nodiscard]] std::size_t n_components(Quantity quantity) const noexcept;
  /// Reads the points [first, first + out.size()) of a snapshot directly into `out`; one thread at
  /// a time. @pre has(quantity), snapshot < n_snapshots(), same number of components. @throws
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

/// Empty if both runs have bitwise the same mesh and masses; else the first difference.
std::string mesh_difference(const RunReader& a, const RunReader& b);

}  // namespace rondo::io
