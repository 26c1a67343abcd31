// SPDX-License-Identifier: BSD-3-Clause
/// @file  Cases as text, and reading them.
#pragma once
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "rondo/case/case.hpp"
#include "rondo/core/error.hpp"

namespace rondo::study::test {

/// A file of its own for this process, removed at the end.
class CaseFile {
 public:
  explicit CaseFile(const std::string& text, const std::string& stem = "case")
      : folder_(std::filesystem::temp_directory_path() /
                ("rondo_case_" + std::to_string(getpid()) + "_" + std::to_string(++count_))),
        path_(folder_ / (stem + ".toml")) {
    std::filesystem::create_directories(folder_);
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~CaseFile() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  CaseFile(const CaseFile&) = delete;
  CaseFile& operator=(const CaseFile&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  static inline int count_ = 0;
  std::filesystem::path folder_, path_;
};

inline Case read_text(const std::string& text, const std::vector<std::string>& settings = {}) {
  const CaseFile file(text);
  return read_case(file.path(), settings);
}

/// Empty where the case is good.
inline std::vector<Fault> faults_of(const std::string& text,
                                    const std::vector<std::string>& settings = {}) {
  try {
    read_text(text, settings);
  } catch (const InputError& error) {
    return error.faults();
  }
  return {};
}

inline std::filesystem::path source_folder() {
  return std::filesystem::path(RONDO_CASES).parent_path();
}

inline std::string file_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// A smooth disk; the tests count its lines, from 1.
inline const std::string base = R"(schema = 1
title = "Base"
[disk]
outer_radius = 0.30
inner_radius = 0.15
[disk.mesh]
radial = 12
circumferential = 180
grading = 1.0
[material]
youngs_modulus = 2.0e7
poissons_ratio = 0.3
density = 1100.0
plane = "strain"
[damping]
mass = 200.0
stiffness = 2.0e-5
[motion]
angular_velocity = 33.333333
speed = 10.0
height = 0.29
start_x = -0.35
gravity = 0.0
[ground]
profile = [[-10, -0.1], [0, -0.1], [0, 0], [10, 0]]
fillet = 0.02
friction = 0.3
restitution = 0.0
[initial]
state = "rest"
velocity = [0.0, 0.0]
[time]
end = 0.12
safety = 0.8
[output]
snapshots = 400
snapshots_from = 0.0
)";

/// The base with a line put in the place of another; "" leaves an empty line.
inline std::string with_line(int line, const std::string& replacement,
                             const std::string& text = base) {
  std::size_t begin = 0;
  for (int i = 1; i < line; ++i) begin = text.find('\n', begin) + 1;
  const std::size_t end = text.find('\n', begin);
  return text.substr(0, begin) + replacement + text.substr(end);
}

/// The base with the lines of a rubber in the place of E and ν.
inline std::string rubber(const std::string& law, const std::string& volume =
                                                      "poissons_ratio = "
                                                      "0.49") {
  return with_line(11, law, with_line(12, volume));
}

/// The base with a tread in the place of its columns.
inline std::string treaded() {
  return with_line(8, "") +
         "[disk.tread]\npitches = 60\ndepth = 0.02\nland_columns = 3\ngroove_columns = 1\n"
         "layers = 2\n";
}

}  // namespace rondo::study::test
