// SPDX-License-Identifier: BSD-3-Clause
/// @file  Figures taken from results directories: mean forces, lines of a spectrum, the swing of an
/// edge, numbers of modes.
#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "rondo/core/keep_larger.hpp"
#include "rondo/core/vec2.hpp"
#include "rondo/io/run_reader.hpp"

namespace rondo::study {

/// Columns of a history.csv by name.
using Columns = std::map<std::string, std::vector<double>, std::less<>>;

/// @throws FileError naming `file`: no such column, or no rows
[[nodiscard]] const std::vector<double>& column(const Columns& history, std::string_view name,
                                                const std::filesystem::path& file);

/// A column as a function of time, each row the mean over an interval.
struct Intervals {
  std::vector<double> middle;  ///< (m) of the interval                       [s]
  std::vector<double> length;  ///< (m) of it                                 [s]
  std::vector<double> value;   ///< (m)
};

/// The rows whose interval begins at `from` or later. @throws FileError naming `file`: no such
/// column, no such rows, or times that do not rise
[[nodiscard]] Intervals intervals(const Columns& history, std::string_view name, double from,
                                  const std::filesystem::path& file);

[[nodiscard]] double mean(const Intervals& f) noexcept;
/// Root mean square about the mean.
[[nodiscard]] double deviation(const Intervals& f) noexcept;

/// Amplitude of a harmonic of `frequency` [Hz] in f, seen through a Hann window over its time,
/// whose gain is undone.
[[nodiscard]] double line(const Intervals& f, double frequency);
/// The frequency with the largest line, from four periods in the time of f up to the half of a row
/// a period, to a tenth of a hertz, or to a thousandth of 1 / time where that is more [Hz].
[[nodiscard]] double highest_line(const Intervals& f);

/// Displacement of the outer edge, mean over the candidates, at each snapshot.
struct EdgeMotion {
  std::vector<double> time;          ///< (t) [s]
  std::vector<double> displacement;  ///< (t) radial [m]
  std::vector<double> tangential;    ///< (t) counter-clockwise [m]
};

/// Radial and tangential (counter-clockwise) displacement of the edge, mean over the candidates [m]
[[nodiscard]] Vec2 edge_displacement(const mesh::Mesh& mesh, std::span<const Vec2> u);
/// @throws FileError: no snapshots
[[nodiscard]] EdgeMotion edge_motion(const io::RunReader& run);
/// Largest minus smallest radial displacement over the snapshots with from <= time <= to [m]
[[nodiscard]] double swing(const EdgeMotion& edge, double from, double to);

/// Largest |tangential| - μ · normal of all contact forces of all snapshots, over the largest
/// normal one; not a number where there is no force. @throws FileError: no contact in the results
[[nodiscard]] double outside_cone(const io::RunReader& run, double friction);

}  // namespace rondo::study
