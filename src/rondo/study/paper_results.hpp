// SPDX-License-Identifier: BSD-3-Clause
/// @file  Figures taken from results directories: mean forces, lines of a spectrum, the swing of an
/// edge, numbers of modes.
#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "rondo/core/vec2.hpp"
#include "rondo/io/run_reader.hpp"

namespace rondo::study {

/// Columns of a history.csv by name.
using Columns = std::map<std::string, std::vector<double>, std::less<>>;

/// @throws FileError naming `file`: no such column
[[nodiscard]] const std::vector<double>& column(const Columns& history, std::string_view name,
                                                const std::filesystem::path& file);

/// A column as a function of time, each row the mean over an interval.
struct Intervals {
  std::vector<double> middle;  ///< (m) of the interval                       [s]
  std::vector<double> length;  ///< (m) of it                                 [s]
  std::vector<double> value;   ///< (m)
};

/// The rows whose interval begins at `from` or later. @throws FileError naming `file`: no such
/// column or no such rows
[[nodiscard]] Intervals intervals(const Columns& history, std::string_view name, double from,
                                  const std::filesystem::path& file);

[[nodiscard]] double mean(const Intervals& f) noexcept;
/// Root mean square about the mean.
[[nodiscard]] double deviation(const Intervals& f) noexcept;

/// Amplitude of a harmonic of `frequency` [Hz] in f, seen through a Hann window over its time,
/// whose gain is undone.
[[nodiscard]] double line(const Intervals& f, double frequency);
/// The frequency in [from, to] with the largest line, to a tenth of a hertz [Hz].
[[nodiscard]] double highest_line(const Intervals& f, double from, double to);

/// Radial displacement of the outer edge, mean over the candidates, at each snapshot.
struct EdgeMotion {
  std::vector<double> time;          ///< (t) [s]
  std::vector<double> displacement;  ///< (t) [m]
};

[[nodiscard]] double edge_displacement(const mesh::Mesh& mesh, std::span<const Vec2> u);
[[nodiscard]] EdgeMotion edge_motion(const io::RunReader& run);
/// Largest minus smallest displacement over the snapshots with from <= time <= to [m]
[[nodiscard]] double swing(const EdgeMotion& edge, double from, double to);

/// Largest |tangential| - μ · normal of all contact forces of all snapshots, over the largest
/// normal one.
[[nodiscard]] double outside_cone(const io::RunReader& run, double friction);

}  // namespace rondo::study
