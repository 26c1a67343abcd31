// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/paper/paper_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <numeric>

#include "rondo/core/error.hpp"

namespace rondo::study {
namespace {

double total(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Σ length · weight(k) · term(k) over Σ length · weight(k).
template <class Weight, class Term>
auto weighted_mean(const Intervals& f, Weight&& weight, Term&& term) {
  decltype(term(std::size_t{0})) sum{};
  double weights = 0.0;
  for (std::size_t k = 0; k < f.value.size(); ++k) {
    const double w = f.length[k] * weight(k);
    sum += w * term(k);
    weights += w;
  }
  return sum / weights;
}

double one(std::size_t) {
  return 1.0;
}

}  // namespace

const std::vector<double>& column(const Columns& history, std::string_view name,
                                  const std::filesystem::path& file) {
  const auto found = history.find(name);
  if (found == history.end()) throw FileError(file.string(), fmt::format("has no column {}", name));
  if (found->second.empty()) throw FileError(file.string(), "has no rows");
  return found->second;
}

Intervals intervals(const Columns& history, std::string_view name, double from,
                    const std::filesystem::path& file) {
  const std::vector<double>& time = column(history, "time_s", file);
  const std::vector<double>& value = column(history, name, file);
  Intervals found;
  double before = 0.0;
  for (std::size_t k = 0; k < time.size(); before = time[k++]) {
    if (!std::isfinite(time[k]) || time[k] < 0.0 || (k > 0 && time[k] <= before))
      throw FileError(file.string(), fmt::format("time_s is {} in row {}, after {}: damaged",
                                                 time[k], k + 1, before));
    if (before < from) continue;
    found.middle.push_back(0.5 * (before + time[k]));
    found.length.push_back(time[k] - before);
    found.value.push_back(value[k]);
  }
  if (found.value.empty())
    throw FileError(file.string(), fmt::format("has no rows after {:.6g} s", from));
  return found;
}

double mean(const Intervals& f) noexcept {
  return weighted_mean(f, one, [&](std::size_t k) { return f.value[k]; });
}

double deviation(const Intervals& f) noexcept {
  const double m = mean(f);
  return std::sqrt(
      weighted_mean(f, one, [&](std::size_t k) { return (f.value[k] - m) * (f.value[k] - m); }));
}

double line(const Intervals& f, double frequency) {
  const double begin = f.middle.front() - 0.5 * f.length.front();
  const double span = total(f.length);
  const auto hann = [&](std::size_t k) {
    return 1.0 - std::cos(2.0 * std::numbers::pi * (f.middle[k] - begin) / span);
  };
  const double m = weighted_mean(f, hann, [&](std::size_t k) { return f.value[k]; });
  const auto term = [&](std::size_t k) {
    return (f.value[k] - m) * std::polar(1.0, -2.0 * std::numbers::pi * frequency * f.middle[k]);
  };
  return 2.0 * std::abs(weighted_mean(f, hann, term));
}

double highest_line(const Intervals& f) {
  const auto best_of = [&](double from, double to, double step) {
    double best = from, height = 0.0;
    for (double at = from; at <= to; at += step)
      if (const double here = line(f, at); here > height) {
        height = here;
        best = at;
      }
    return best;
  };
  // A line is about 4 / span wide: steps of a quarter of 1 / span cannot miss it.
  const double resolution = 1.0 / total(f.length), fine = std::max(0.1, 1e-3 * resolution);
  const double nyquist = 0.5 * static_cast<double>(f.value.size()) * resolution;
  if (!std::isfinite(nyquist)) return nyquist;  // rows at no distance in time
  const double near = best_of(4.0 * resolution, nyquist, 0.25 * resolution);
  return best_of(near - 0.25 * resolution, near + 0.25 * resolution, fine);
}

Vec2 edge_displacement(const mesh::Mesh& mesh, std::span<const Vec2> u) {
  Vec2 sum;
  for (const int node : mesh.boundary) {
    const auto i = static_cast<std::size_t>(node);
    const Vec2 outward = (1.0 / norm(mesh.coordinates[i])) * mesh.coordinates[i];
    sum += Vec2{dot(u[i], outward), dot(u[i], {-outward.y, outward.x})};
  }
  return (1.0 / static_cast<double>(mesh.boundary.size())) * sum;
}

EdgeMotion edge_motion(const io::RunReader& run) {
  if (run.n_snapshots() == 0)
    throw FileError(run.directory().string(), "holds no snapshot of the displacement");
  EdgeMotion edge;
  edge.time = run.times().time;
  std::vector<Vec2> u(run.n_points(io::Quantity::displacement));
  for (std::size_t j = 0; j < run.n_snapshots(); ++j) {
    run.read(io::Quantity::displacement, j, 0, u);
    const Vec2 mean = edge_displacement(run.mesh(), u);
    edge.displacement.push_back(mean.x);
    edge.tangential.push_back(mean.y);
  }
  return edge;
}

double swing(const EdgeMotion& edge, double from, double to) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t j = 0; j < edge.time.size(); ++j) {
    if (edge.time[j] < from || edge.time[j] > to) continue;
    low = keep_smaller(low, edge.displacement[j]);
    high = keep_larger(high, edge.displacement[j]);
  }
  return high - low;
}

double outside_cone(const io::RunReader& run, double friction) {
  if (!run.has(io::Quantity::contact))
    throw FileError(run.directory().string(), "holds no contact forces");
  std::vector<Vec2> force(run.n_points(io::Quantity::contact));
  double outside = -std::numeric_limits<double>::infinity(), largest = 0.0;
  for (std::size_t j = 0; j < run.n_snapshots(); ++j) {
    run.read(io::Quantity::contact, j, 0, force);
    for (const Vec2& f : force) {
      outside = keep_larger(outside, std::abs(f.y) - friction * f.x);
      largest = keep_larger(largest, f.x);
    }
  }
  return largest > 0.0 ? outside / largest : std::nan("");
}

}  // namespace rondo::study
