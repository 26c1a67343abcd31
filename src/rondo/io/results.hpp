// SPDX-License-Identifier: BSD-3-Clause
/// @file  results.h5, fields.xdmf and fields.vtkhdf of a run, readable at any moment of it
/// (docs/results.md).
///
/// Every dataset is created at full size with its storage reserved. The file's metadata is then
/// flushed once and never changes during the run, so that a run killed at any moment leaves a file
/// that opens. /frame/time is NaN for snapshots that were not reached. close() cuts the datasets to
/// the snapshots written. fields.xdmf and fields.vtkhdf list only these.
#pragma once
#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rondo/core/complex.hpp"
#include "rondo/core/field.hpp"
#include "rondo/core/ground_frame.hpp"
#include "rondo/io/files.hpp"
#include "rondo/io/h5/h5.hpp"
#include "rondo/io/snapshot.hpp"
#include "rondo/io/vtkhdf.hpp"
#include "rondo/io/xdmf.hpp"
#include "rondo/mesh/mesh.hpp"

namespace rondo::io {

/// A dataset with one value per snapshot, in addition to those of every analysis.
struct Series {
  std::string path, unit, meaning;
  std::size_t components = 1;
  std::size_t rows = 0;  ///< of each value, which is then (rows, components / rows); 0: it has none
};

/// A dataset that is the same for all snapshots, in addition to those of every analysis.
struct Constants {
  std::string path, unit, meaning;
  std::vector<double> values;
};

/// Names that an analysis gives its times and rates; the defaults are those of motion in time.
struct ResultsWords {
  std::string analysis = "dynamic";
  std::string time_unit = "s";
  std::string time =
      "of displacement, angle, center, contact and fields; NaN: snapshot not written";
  std::string velocity_time = "of velocity: half a step before /frame/time";
  std::string velocity_unit = "m/s";
  std::string velocity;        ///< empty: du/dt in the frames of the nodes
  std::string field_velocity;  ///< the same along the fixed axes
  std::string force = "impulse of the step over its length";
};

struct ResultsLayout {
  const mesh::Mesh* mesh = nullptr;
  std::span<const double> mass;  ///< (n) lumped mass per unit thickness [kg/m]; solid: mass [kg]
  std::size_t n_snapshots = 0;   ///< planned
  bool contact = false;          ///< whether something may be touched: /contact is written
  bool stress = false;           ///< whether the fields include stress
  /// (n) index of the free body of a node, which moves in the fixed frame; -1: the node moves in
  /// the co-rotating frame. Empty: no free body.
  std::span<const int> free_body = {};
  std::size_t components = 2;  ///< of a snapshot's vectors; 3 for a solid mesh
  double camber = 0.0;         ///< for a solid mesh, inclination of the ground    [rad]
  ResultsWords words = {};
  std::vector<Series> series = {};
  std::vector<Constants> constants = {};
  std::span<const double> mass_dynamic{};  ///< (n) mass used in the motion; empty: `mass` [kg/m]
};

/// Contents of results.h5 at some moment: the number of snapshots, and, by name, the hash of the
/// rows of each dataset that has one row per snapshot.
struct KeptSnapshots {
  std::size_t count = 0;
  std::map<std::string, std::string> hashes;

  friend bool operator==(const KeptSnapshots&, const KeptSnapshots&) = default;
};

/// @throws FileError: cannot be read, has fewer snapshots, or differs from `kept` in a bit; the
/// message names dataset and snapshot if one contains a number that is not finite
void demand_kept(const std::filesystem::path& results, const KeptSnapshots& kept);

class Results {
 public:
  /// Creates directory/results.h5 and, for fields, fields.xdmf and fields.vtkhdf beside it.
  /// @param kept continues existing files after that many of their snapshots: these are
  /// copied into a new results.h5, which replaces the old one when it is complete. @pre the
  /// same mesh, at most as many snapshots as planned. @throws FileError: damaged, or fewer
  /// snapshots in the file
  Results(const std::filesystem::path& directory, const ResultsLayout& layout,
          std::optional<std::size_t> kept = {});
  ~Results();
  Results(const Results&) = delete;
  Results& operator=(const Results&) = delete;

  /// Writes the next snapshot and flushes it. @pre fewer than n_snapshots written. @throws
  /// FileError
  void write(const Snapshot& snapshot, const SnapshotFields& fields);
  /// Cuts the datasets to the snapshots written and closes. @throws FileError
  void close();
  [[nodiscard]] std::size_t written() const noexcept { return written_; }
  /// The contents so far; also valid once it is closed.
  [[nodiscard]] KeptSnapshots place() const;
  /// Makes sure that everything written is on the disk even if the machine fails. @throws FileError
  void sync() const;

  /// Final size of results.h5 in bytes, for `rondo check`.
  [[nodiscard]] static std::size_t bytes(const ResultsLayout& layout) noexcept;

 private:
  struct Counts {
    std::size_t nodes, candidates, times, components;
    bool contact, stress;
    bool solid;
  };
  [[nodiscard]] static Counts counts_of(const ResultsLayout& layout) noexcept;
  [[nodiscard]] static std::size_t index_bytes(const Counts& counts) noexcept;
  void begin_shown(const mesh::Mesh& mesh);
  [[nodiscard]] XdmfSeries labelled(XdmfSeries series) const;
  void add_rows(h5::Dataset& to, const std::string& name, h5::Type type, const h5::Shape& shape,
                const h5::Label& label);
  void create_frame();
  void create_snapshots();
  void create_contact();
  void create_fields();
  void create_series();
  void reserve();
  void resize(std::size_t rows);
  void check(const Snapshot& s, const SnapshotFields& fields) const;
  void write_fields(const Snapshot& s);
  void write_stress(const Snapshot& s, const SnapshotFields& fields);
  void write_contact(const SnapshotFields& fields);
  void write_series(std::span<const double> values);
  /// The frame of displacements and velocities, for descriptions.
  [[nodiscard]] std::string frame() const {
    return free_body_.empty() ? "co-rotating frame"
                              : "co-rotating frame, of free bodies fixed frame";
  }
  [[nodiscard]] bool is_free(std::size_t node) const {
    return !free_body_.empty() && free_body_[node] >= 0;
  }
  template <class T>
  void row(h5::Dataset& dataset, const std::vector<T>& values) {
    dataset.write_row(written_, std::span<const T>(values));
  }
  void row(h5::Dataset& dataset, double value) {
    dataset.write_row(written_, std::span<const double>(&value, 1));
  }

  Counts c_;
  std::filesystem::path directory_;
  UnfinishedFile unfinished_;  ///< results.h5 until it is complete
  std::vector<Vec2> coordinates_;
  std::vector<double> axial_;  ///< (n) for a solid mesh
  GroundFrame ground_;
  std::vector<int> boundary_;
  std::vector<double> tributary_;
  std::vector<int> free_body_;
  std::size_t written_ = 0;
  KeptSnapshots at_end_;  ///< set once it is closed
  std::vector<std::array<float, 3>> vectors_, forces_;
  std::vector<std::array<float, 6>> tensors_;
  std::vector<float> scalars_;
  std::vector<double> of_candidates_;  ///< (nb, components) a row of forces or tractions
  h5::File file_;
  struct {
    h5::Dataset time, time_velocity, angle, angle_velocity, center, lateral, displacement, velocity,
        force, traction, position, field_displacement, field_velocity, field_force, von_mises,
        stress;
  } d_;
  ResultsWords words_;
  std::vector<Series> series_;
  std::vector<h5::Dataset> series_rows_;  ///< one for each series
  std::vector<h5::Dataset*> all_rows_;    ///< all datasets with rows, of d_ and series_rows_
  std::unique_ptr<Xdmf> xdmf_;            ///< null: no fields
  std::unique_ptr<Vtkhdf> vtkhdf_;        ///< null: no fields
};

}  // namespace rondo::io
