// SPDX-License-Identifier: BSD-3-Clause
/// Time of a height of a road at the places of a footprint that travels along it, in the order in
/// which contact asks.
///     bench_road FILE.crg [FOOTPRINTS]      by default 2000 footprints of 500 places
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <random>
#include <vector>

#include "rondo/road/crg/crg_reader.hpp"
#include "rondo/road/surface.hpp"

using namespace rondo::road;

namespace {

constexpr double footprint_length = 0.15, footprint_width = 0.2;  // [m]
constexpr std::size_t n_places = 500;
constexpr int n_repeats = 7;

struct Place {
  double u, v;
};

/// Offsets of the nodes of a footprint: a grid with some disorder.
std::vector<Place> footprint() {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> along(0.0, footprint_length);
  std::uniform_real_distribution<double> across(-0.5 * footprint_width, 0.5 * footprint_width);
  std::vector<Place> places;
  for (std::size_t k = 0; k < n_places; ++k) places.push_back(Place{along(random), across(random)});
  std::ranges::sort(places, {}, &Place::u);
  return places;
}

/// Least time of a place over some repeats [ns].
template <class Ask>
double time_of(const Road& road, int n_footprints, const Ask& ask) {
  const std::vector<Place> places = footprint();
  const double step =
      (road.u_last() - road.u_first - footprint_length) / static_cast<double>(n_footprints);
  double least = 1e300, sum = 0.0;
  for (int repeat = 0; repeat < n_repeats; ++repeat) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < n_footprints; ++i)
      for (const Place& p : places) sum += ask(road.u_first + i * step + p.u, p.v);
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
    least = std::min(least, time.count() / (static_cast<double>(n_footprints) * n_places));
  }
  if (!(sum * 0.0 == 0.0)) {
    fmt::print(stderr, "bench_road: a height is not a number\n");
    std::exit(1);
  }
  return least;
}

void measure(const char* file, int n_footprints) {
  const Road road = read_crg(file);
  const Surface surface(road);
  const double smooth = time_of(road, n_footprints, [&](double u, double v) {
    const SurfacePoint p = surface.at(u, v);
    return p.height + p.slope_u + p.slope_v + p.bend_uu + p.bend_uv + p.bend_vv;
  });
  const double bilinear =
      time_of(road, n_footprints, [&](double u, double v) { return surface.bilinear(u, v); });
  fmt::print(
      "smooth, with first and second derivatives: {:.1f} ns a place\nbilinear: {:.1f} ns a place\n",
      smooth, bilinear);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 2) throw std::runtime_error("usage: bench_road FILE.crg [FOOTPRINTS]");
    measure(argv[1], argc > 2 ? std::atoi(argv[2]) : 2000);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
