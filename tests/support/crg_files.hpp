// SPDX-License-Identifier: BSD-3-Clause
/// @file  Road files of OpenCRG that tests write: the four formats, by their definition and not by
/// the reader's code.
#pragma once
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "rondo/road/road.hpp"

namespace rondo::test {

inline const double missing_height = std::numeric_limits<double>::quiet_NaN();

/// The parts of a road file. Rows have a number for each line of `channels`.
struct CrgParts {
  std::string format = "LRFI";
  std::string road = "REFERENCE_LINE_INCREMENT = 0.5\n";
  std::vector<std::string> channels;
  std::vector<std::vector<double>> rows;
  std::string blocks;  ///< further ones
};

/// Numbers of 10 or 20 characters, 8 or 4 a line.
inline std::string crg_text_data(const CrgParts& parts) {
  const bool twofold = parts.format == "LDFI";
  const std::size_t width = twofold ? 20 : 10, per_line = 80 / width;
  std::string text;
  for (const auto& row : parts.rows)
    for (std::size_t k = 0; k < row.size(); ++k) {
      text += std::isnan(row[k]) ? fmt::format("{:>{}}", "*missing*", width)
              : twofold          ? fmt::format("{:20.13e}", row[k])
                                 : fmt::format("{:10.7f}", row[k]);
      if ((k + 1) % per_line == 0 || k + 1 == row.size()) text += '\n';
    }
  return text;
}

/// Big-endian numbers of 4 or 8 bytes, filled up with NaN to a multiple of 80 bytes.
inline std::string crg_binary_data(const CrgParts& parts) {
  const bool twofold = parts.format == "KDBI";
  std::string bytes;
  const auto put = [&](double x) {
    const std::uint64_t bits = twofold ? std::bit_cast<std::uint64_t>(x)
                                       : std::bit_cast<std::uint32_t>(static_cast<float>(x));
    for (int k = twofold ? 7 : 3; k >= 0; --k) bytes += static_cast<char>(bits >> (8 * k) & 0xFF);
  };
  for (const auto& row : parts.rows)
    for (const double x : row) put(x);
  while (bytes.size() % 80 != 0) put(missing_height);
  return bytes;
}

inline std::string crg_header(const CrgParts& parts) {
  std::string text = "$CT\na road of the tests\n$\n$ROAD_CRG\n" + parts.road + "$\n" + parts.blocks;
  text += "$KD_Definition\n#:" + parts.format + "\n";
  for (const std::string& channel : parts.channels) text += "D:" + channel + "\n";
  return text + "$\n$$$$\n";
}

inline std::string crg_of(const CrgParts& parts) {
  const bool binary = parts.format.starts_with('K');
  return crg_header(parts) + (binary ? crg_binary_data(parts) : crg_text_data(parts));
}

/// Numbered long sections.
inline std::vector<std::string> numbered_sections(std::size_t n) {
  std::vector<std::string> channels;
  for (std::size_t j = 1; j <= n; ++j) channels.push_back(fmt::format("long section {},m", j));
  return channels;
}

/// A folder that is removed at the end.
class CrgFolder {
 public:
  CrgFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "rondo-road-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~CrgFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  CrgFolder(const CrgFolder&) = delete;
  CrgFolder& operator=(const CrgFolder&) = delete;

  /// Writes a file and returns its path.
  std::filesystem::path put(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A road that was not read: heights by a function of u and v.
template <class Height>
road::Road road_by(const Height& height, double u_first, double u_step, std::size_t n_u,
                   std::vector<double> v) {
  road::Road road;
  road.u_first = u_first;
  road.u_step = u_step;
  for (std::size_t i = 0; i < n_u; ++i)
    for (const double y : v)
      road.heights.push_back(height(u_first + static_cast<double>(i) * u_step, y));
  road.v = std::move(v);
  road.line_height.assign(n_u, 0.0);
  road.slope = road.banking = road.heading = {0.0};
  return road;
}

}  // namespace rondo::test
