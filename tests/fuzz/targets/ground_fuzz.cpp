// SPDX-License-Identifier: BSD-3-Clause
/// A profile of the ground that a case takes, and places near it: distances and normals are
/// numbers. Input: the value of ground.profile on the first line, of ground.fillet on the second,
/// then places, "x y" on each line.
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "fuzz.hpp"
#include "mutate.hpp"
#include "rondo/case/case.hpp"
#include "rondo/contact/ground.hpp"

using namespace rondo;

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max, unsigned seed) {
  return fuzz::mutate_text(data, size, max, seed);
}

namespace {

constexpr const char* rest_of_case = R"(schema = 1
[disk]
outer_radius = 1.0
inner_radius = 0.5
mesh = {radial = 1, circumferential = 3}
[material]
youngs_modulus = 1.0
poissons_ratio = 0.3
density = 1.0
[motion]
angular_velocity = 0.0
speed = 0.0
height = 1.0
[ground]
profile = "flat"
[time]
end = 1.0
)";

void check_unit(Vec2 normal) {
  // Rounded twice, of a vector that may have been subnormal.
  fuzz::check(std::abs(norm(normal) - 1.0) < 1e-9, "a normal that is no unit vector");
}

double largest_of(Vec2 x) {
  return std::max(std::abs(x.x), std::abs(x.y));
}

/// Farther away the facets of a corner are at the same distance to round-off, and it is not known
/// on which side of them a place is: distances to the ends of a facet of length d differ by d²/2x.
bool is_near(const contact::GroundShape& shape, Vec2 x) {
  constexpr double farthest = 1e6;  // facets
  const std::vector<Vec2>& p = shape.profile;
  double shortest = shape.fillet > 0.0 ? shape.fillet : std::numeric_limits<double>::infinity();
  double largest = largest_of(x);
  for (std::size_t k = 0; k + 1 < p.size(); ++k)
    shortest = std::min(shortest, norm(p[k + 1] - p[k]));
  for (const Vec2 point : p) largest = std::max(largest, largest_of(point));
  return largest <= farthest * shortest;
}

void check_place(const contact::GroundShape& shape, const contact::Ground& ground, Vec2 x) {
  constexpr double farthest = 1e100;  // as of the profile itself
  if (!(largest_of(x) <= farthest)) return;
  const contact::Touches touches = ground.touches(x);
  const double distance = ground.distance(x);
  fuzz::check(!std::isnan(distance), "a distance that is not a number");
  fuzz::check(!std::isnan(ground.abscissa(x)), "an abscissa that is not a number");
  fuzz::check(touches.count >= 0 && touches.count <= 2, "a number of touches");
  for (std::size_t k = 0; k < static_cast<std::size_t>(touches.count); ++k) {
    fuzz::check(touches.at[k].gap <= 0.0, "a touch that is none");
    check_unit(touches.at[k].normal);
  }
  fuzz::check(touches.count < 2 || touches.at[0].gap <= touches.at[1].gap,
              "touches that are not in order");
  // On the surface itself round-off may leave the place on either side.
  if (!is_near(shape, x)) return;
  fuzz::check(touches.count == 0 ? distance >= 0.0 : distance <= 0.0,
              "touches and distance do not agree");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream in(std::string(fuzz::view(data, size)));
  std::string profile, fillet;
  std::getline(in, profile);
  std::getline(in, fillet);
  contact::GroundShape shape;
  if (!fuzz::accepted([&] {
        shape = study::read_case_text("case.toml", rest_of_case,
                                      {"ground.profile=" + profile, "ground.fillet=" + fillet})
                    .ground->shape;
      }))
    return 0;
  const contact::Ground ground(shape);
  for (const contact::Corner& corner : ground.corners())
    for (const Vec2 normal : corner.normals) check_unit(normal);
  for (const Vec2 point : shape.profile)
    for (const double offset : {-1.0, 0.0, 1.0}) {
      check_place(shape, ground, {point.x + offset * shape.fillet, point.y});
      check_place(shape, ground, {point.x, point.y + offset * shape.fillet});
    }
  for (Vec2 x; in >> x.x >> x.y;) check_place(shape, ground, x);
  return 0;
}
