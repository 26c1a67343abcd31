// SPDX-License-Identifier: BSD-3-Clause
/// @file  results.h5, fields.xdmf, fields.vtkhdf and contact.csv, written snapshot by snapshot.
#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "rondo/fem/solid/solid_stress.hpp"
#include "rondo/fem/stress.hpp"
#include "rondo/mesh/deformed_boundary.hpp"
#include "rondo/output/columns.hpp"
#include "rondo/output/recorder.hpp"

namespace rondo::study {

/// Only one thread at a time may create, use and close it.
class SnapshotFiles {
 public:
  /// Creates the files or, after a checkpoint, continues the existing ones. @throws FileError
  SnapshotFiles(const std::filesystem::path& directory, const RecordPlan& plan,
                const Checkpoint* from);
  /// @throws FileError
  void write(const Snapshot& snapshot);
  /// @throws FileError
  void close();
  [[nodiscard]] std::size_t written() const { return results_.written(); }
  /// Adds the contents of the files so far; also valid once they are closed.
  void add_to(KeptFiles& files) const;
  /// Makes sure that everything written is on the disk even if the machine fails. @throws FileError
  void sync() const;

 private:
  void collect_contact(const Snapshot& snapshot);
  [[nodiscard]] std::span<const Vec2> elastic(const Snapshot& snapshot);
  void write_contact_rows(const Snapshot& snapshot);
  [[nodiscard]] Vec3 position(const Snapshot& snapshot, std::size_t node) const;
  [[nodiscard]] std::span<const Column<ContactRecord>> columns() const {
    return contact_columns(mesh_.is_solid());
  }

  const mesh::Mesh& mesh_;
  const mesh::DeformedBoundary boundary_;
  const contact::Ground* ground_;
  const dynamics::Model* model_;
  const bool contact_;
  const std::span<const Column<ContactRecord>> further_columns_;
  io::Results results_;  ///< first: if copying fails, all files remain unchanged
  io::Csv contact_csv_;
  std::optional<fem::StressRecovery> stress_;
  std::vector<Vec2> elastic_;  ///< (n) displacement in the frame of its body; empty: no free body
  std::vector<Vec3> force_, force_fixed_;  ///< (nb)
  std::vector<double> extent_;             ///< (nb) of the deformed boundary, for nodes in contact
  std::vector<char> on_ground_;            ///< (nb) 1: the ground touches it
  std::vector<double> slip_;               ///< (nb)
  std::vector<double> power_;              ///< (nb)                                  [W/m], [W]
  std::vector<char> sticks_;               ///< (nb)
  std::optional<fem::SolidStressRecovery> solid_stress_;
  GroundFrame in_ground_;
  std::vector<double> rows_;
};

}  // namespace rondo::study
