// SPDX-License-Identifier: BSD-3-Clause
/// @file  How far a body is strained in a run, and whether a cell turns inside out: looked at now
/// and then, at the cost of a percent or two of the steps.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "rondo/fem/strain.hpp"
#include "rondo/model/model.hpp"
#include "rondo/output/run_files.hpp"

namespace rondo::study {

/// Above it a run says that the law of the material is one of small strains.
inline constexpr double small_strain = 0.10;

/// A look takes as long as two steps, and one more pair where the state is fetched for it alone.
struct Looks {
  long long steps = 250;      ///< between two, at the most
  long long snapshots = 100;  ///< and one at snapshots that are so many steps apart
};
/// Steps of reduced runs are long: their snapshots are all looked at.
inline constexpr Looks looks_of_reduced_runs{25, 1};

/// It depends on the step and the snapshots alone: a run that goes on looks at the same ones.
/// @param snapshot one is taken at this step @param before step of the last one; -1: none
[[nodiscard]] bool is_look(const Looks& looks, long long step, bool snapshot,
                           long long before) noexcept;

/// How the time of a look is told: "t = 0.1 s".
struct TimeWords {
  const char* before = "t = ";
  const char* after = " s";
};

class StrainWatch {
 public:
  /// @param materials one for each region of the mesh. @param model of the free bodies, whose
  /// rotation is no strain; null: there are none. All must outlive the object.
  StrainWatch(const mesh::Mesh& mesh, std::span<const fem::Material> materials,
              const dynamics::Model* model = nullptr);

  /// No law is one of small strains.
  void take_large_strains() noexcept { large_ = true; }
  /// @param u (n) finite [m] @param poses (free_bodies)
  /// @return the trouble: the inverted cell, with its place; empty: there is none
  std::string look(const Field& u, std::span<const dynamics::Pose> poses, double time);

  [[nodiscard]] const fem::LargestDeformation& largest() const noexcept { return largest_; }
  /// Goes on from what was seen before.
  void restore(const fem::LargestDeformation& before) noexcept { largest_ = before; }

  /// Adds to run.json and to the report, which gets a warning where a cell that is not rubber is
  /// strained above small_strain.
  void summarise(const TimeWords& words, Json& json, RunReport& report) const;

 private:
  [[nodiscard]] fem::Deformation deformation(const Field& u, std::span<const dynamics::Pose> poses);
  [[nodiscard]] std::vector<double> middle_of(std::size_t cell) const;
  [[nodiscard]] std::string cell_text(std::size_t cell) const;
  [[nodiscard]] std::string small_strain_warning(const TimeWords& words) const;

  const mesh::Mesh& mesh_;
  const dynamics::Model* model_;
  std::vector<char> rubber_;  ///< (cells) 1: of rubber, whose strains may be large; empty: none is
  bool large_ = false;
  std::vector<Vec2> elastic_;  ///< (n) where bodies are free
  fem::LargestDeformation largest_;
};

/// Texts of the members that summarise() adds to run.json.
std::vector<MemberText> strain_members();

}  // namespace rondo::study
