// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/sweep/sweep_target.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rondo/analysis/build/bodies.hpp"
#include "rondo/analysis/build/crush_setup.hpp"
#include "rondo/core/error.hpp"

namespace rondo::study {
namespace {

/// A body that is pressed from first touch, again and again.
class Press {
 public:
  explicit Press(const Case& c)
      : setup_(build_crush(c)),
        body_(fem::assemble_stiffness(setup_.mesh, setup_.materials), setup_.free,
              setup_.model.nodes),
        increments_(c.analysis.increments) {
    condense(c, setup_, body_);
  }

  [[nodiscard]] const CrushSetup& setup() const noexcept { return setup_; }

  /// The ground's force at a depth [N/m]; none: not solved, and why is in trouble().
  std::optional<double> force(double depth) {
    statics::CrushState state = statics::start_crush(setup_.model, setup_.mesh.n_nodes());
    for (int k = 1; k <= increments_; ++k) {
      const statics::CrushReport report =
          statics::press(setup_.model, depth * k / increments_, body_, state);
      trouble_ = crush_trouble(report, state.works, setup_.model.bound);
      if (!trouble_.empty()) return std::nullopt;
    }
    double sum = 0.0;
    for (const Vec2 r : state.force) sum += r.x;
    return sum;
  }
  [[nodiscard]] const std::string& trouble() const noexcept { return trouble_; }

 private:
  CrushSetup setup_;
  statics::Condensation body_;
  int increments_;
  std::string trouble_;
};

struct Point {
  double depth = 0.0, excess = 0.0;  ///< force - the one asked for
};

/// From first touch down, twice as deep each time, until the force is exceeded.
std::optional<Point> bracket(Press& press, double most, TargetFound& found, Point& low) {
  Point high{most / 256.0, 0.0};
  while (true) {
    const auto force = press.force(high.depth);
    ++found.crushes;
    if (!force) {
      found.trouble = fmt::format("at a depth of {:.6g} m {}", high.depth, press.trouble());
      return std::nullopt;
    }
    high.excess = *force - found.force;
    if (high.excess >= 0.0) return high;
    if (high.depth >= most) {
      found.trouble = fmt::format(
          "at the largest depth tried, {:.6g} m, the ground bears {:.6g} N/m", high.depth, *force);
      return std::nullopt;
    }
    low = high;
    high.depth = std::min(most, 2.0 * high.depth);
  }
}

/// Secants between two points that bracket it; an end that stays twice counts half (the Illinois
/// rule), so that both come in.
void search(Press& press, double most, TargetFound& found) {
  constexpr int longest = 60;
  Point low{0.0, -found.force};
  std::optional<Point> end = bracket(press, most, found, low);
  if (!end) return;
  Point high = *end;
  found.depth = high.depth;
  double excess = high.excess;
  int side = 0;
  while (std::abs(excess) > target_tolerance * found.force) {
    found.depth = low.depth - low.excess * (high.depth - low.depth) / (high.excess - low.excess);
    const auto force = press.force(found.depth);
    if (!force || ++found.crushes > longest) {
      found.trouble = force
                          ? fmt::format("not found in {} crushes: the force jumps there", longest)
                          : fmt::format("at a depth of {:.6g} m {}", found.depth, press.trouble());
      return;
    }
    excess = *force - found.force;
    if (excess < 0.0) {
      low = {found.depth, excess};
      if (side == -1) high.excess *= 0.5;
      side = -1;
    } else {
      high = {found.depth, excess};
      if (side == 1) low.excess *= 0.5;
      side = 1;
    }
  }
}

}  // namespace

std::vector<std::string> crush_settings(double depth, int increments) {
  return {"analysis.kind=crush", fmt::format("analysis.depth={}", depth),
          fmt::format("analysis.increments={}", increments > 0 ? increments : target_increments),
          "ground.profile=flat"};
}

std::vector<TargetFound> find_depths(const Case& c, std::span<const double> forces) {
  Press press(c);
  std::vector<TargetFound> all;
  for (const double force : forces) {
    TargetFound& found = all.emplace_back();
    found.force = force;
    search(press, c.analysis.depth, found);
    const CrushSetup& setup = press.setup();
    found.height = setup.ground_height + setup.touch_height - found.depth;
  }
  return all;
}

}  // namespace rondo::study
