// SPDX-License-Identifier: BSD-3-Clause
/// @file  MODEL.h5 of `rondo reduce`: a reduced model, the body it is of, and what it was built
/// from (docs/reduced.md, 7).
#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "rondo/analysis/error_estimate.hpp"
#include "rondo/case/case.hpp"
#include "rondo/rom/reduced_model.hpp"

namespace rondo::study {

/// Values that the runs behind a model had. None: low > high.
struct ModelRange {
  double low = 1.0, high = 0.0;
  void take(double value) noexcept;
  [[nodiscard]] bool empty() const noexcept { return low > high; }
};

/// The part of a case outside of the range of a model, as a warning; empty: inside but for a
/// thousandth of the range, of the value or of the scale, which is no news.
std::string outside(const char* what, const ModelRange& built, const ModelRange& wanted,
                    double scale = 0.0);

struct ModelRanges {
  ModelRange friction, angular_velocity, speed, height, slip_ratio;
};

/// Names of the command line and of the file.
inline constexpr std::array<std::pair<const char*, rom::ModelFrame>, 2> frame_names{
    {{"rectified", rom::ModelFrame::rectified},
     {"turning", rom::ModelFrame::turning}}};  // in files
inline constexpr std::array<std::pair<const char*, rom::ContactForm>, 2> contact_names{
    {{"places", rom::ContactForm::places}, {"nodes", rom::ContactForm::nodes}}};

template <class Names, class Value>
const char* name_in(const Names& names, Value value) noexcept {
  for (const auto& [name, known] : names)
    if (known == value) return name;
  return "";
}

struct ReducedFile {
  rom::ReducedModel model;
  mesh::Mesh mesh;           ///< without `clamped`
  std::vector<double> mass;  ///< (n) [kg/m]
  std::string body;          ///< body_text() of the case
  ModelRanges ranges;
  std::vector<std::string> runs;  ///< directories, as given
  Eigen::Index displacement_modes = 0, velocity_modes = 0;
  ErrorEstimate estimate;
};

/// Mesh and material of a case as text: a model serves the cases that have the same.
std::string body_text(const Case& c);

/// "radial = 24, the model has radial = 12"; empty: the same body.
std::string body_difference(const std::string& of_case, const std::string& of_model);

/// dynamics::slip_ratio of the motion at a time.
double slip_ratio_at(const Case& c, double time);

/// Takes the place of `file` at once. @throws FileError
void write_reduced_file(const std::filesystem::path& file, const ReducedFile& content);

/// @throws InputError: no such file; FileError: damaged, or not a reduced model
ReducedFile read_reduced_file(const std::filesystem::path& file);

}  // namespace rondo::study
