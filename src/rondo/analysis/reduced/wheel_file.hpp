// SPDX-License-Identifier: BSD-3-Clause
/// @file  wheel.h5 of `rondo reduce`: the modes of a reduced wheel, its matrices and tables for
/// other programs, and the body that it is of (docs/reduced.md).
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "rondo/case/case.hpp"
#include "rondo/case/setup.hpp"
#include "rondo/rom/wheel/ring_wheel.hpp"

namespace rondo::study {

/// What the modes of a reduced wheel are.
enum class WheelBasis { eigenmodes, pod };

/// Word of the command line and of files.
const char* name_of(WheelBasis basis) noexcept;

/// What a run takes from the file.
struct WheelFile {
  WheelBasis basis = WheelBasis::eigenmodes;
  std::vector<rom::RingHarmonic> harmonics;
};

/// What there is besides the model of a wheel.
struct WheelOrigin {
  WheelBasis basis = WheelBasis::eigenmodes;
  std::vector<std::string> runs;  ///< behind a POD
};

/// Takes the place of `file` at once. @param setup masses of contact nodes are moved
/// @throws FileError
void write_wheel_file(const std::filesystem::path& file, const Case& c, const Setup& setup,
                      const rom::Ring& ring, const rom::WheelModel& model,
                      const WheelOrigin& origin);

/// @throws InputError: no such file, a model of an earlier version, another body; FileError:
/// damaged, or not a reduced wheel
WheelFile read_wheel_file(const std::filesystem::path& file, const Case& c, const Setup& setup,
                          const rom::Ring& ring);

/// Mesh and material of a case as text: modes serve the cases that have the same.
std::string body_text(const Case& c);

/// "radial = 24 against radial = 12"; empty: the same body.
std::string body_difference(const std::string& of_case, const std::string& of_other);

/// Whether there is a file that `rondo reduce` has written, or of an earlier version.
bool is_wheel_file(const std::filesystem::path& file);

}  // namespace rondo::study
