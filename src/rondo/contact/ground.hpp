// SPDX-License-Identifier: BSD-3-Clause
/// @file  Rigid ground: the solid on the right-hand side of a polyline walked from left to right
/// (so: below it), its convex corners sharp or rounded by a fillet (docs/theory.md, section 4.1).
#pragma once
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rondo/contact/box_tree.hpp"
#include "rondo/core/vec2.hpp"

namespace rondo::contact {

/// The shape of the ground that the user gives. Its end segments go on for ever.
struct GroundShape {
  std::vector<Vec2> profile{{-1.0, 0.0}, {1.0, 0.0}};  ///< (>= 2) corners, left to right    [m]
  double fillet = 0.0;                                 ///< radius at convex corners, 0: sharp [m]
  std::vector<double> radii{};  ///< (points) in place of `fillet`, if there are any           [m]

  /// The radius at a point of the profile if that is a convex corner [m].
  [[nodiscard]] double radius_at(std::size_t i) const { return radii.empty() ? fillet : radii[i]; }
};

/// Something wrong with a shape; `point` is the index of the profile's point it is about, or -1.
struct ShapeFault {
  int point = -1;
  bool about_fillet = false;
  std::string message;
};

/// All that is wrong with a shape: under two points, coincident points, a profile that goes back to
/// the left or turns back on itself, a fillet that is negative or does not fit.
std::vector<ShapeFault> shape_faults(const GroundShape& shape);

/// A turn below this angle is no corner, convex or concave (docs/theory.md, 4.1)          [rad]
inline constexpr double blunt_turn = 0.01;

/// A convex bend of the surface, sharp or rounded: it may stand inside a body between two nodes
/// (docs/theory.md, 4.1).
struct Corner {
  Vec2 position;                ///< a sharp corner, or the middle of an arc              [m]
  std::array<Vec2, 2> normals;  ///< normals of the facets before and after it, out of the solid
  Vec2 center{};                ///< center of the arc                                    [m]
  double radius = 0.0;          ///< radius of the arc; 0: sharp                          [m]
};

/// The bend's point that a straight side of a body meets first, the deepest one inside it.
/// @param inward unit normal of the side, into the body
[[nodiscard]] Vec2 first_met(const Corner& bend, Vec2 inward) noexcept;

/// A place where a point touches the ground.
struct Touch {
  double gap = 0.0;  ///< signed distance to the facet, > 0 outside                          [m]
  Vec2 normal;       ///< unit, out of the solid; the tangent is J n
};

/// At most two facets at once (concave corner), the deepest first.
struct Touches {
  int count = 0;
  std::array<Touch, 2> at;
};

/// The surface straight above or below a place.
struct SurfaceLine {
  double height = 0.0;  ///< [m]
  double slope = 0.0;   ///< infinite at the foot of a fillet of a wall                      [-]
};

class Ground {
 public:
  /// @param spacing of the contact nodes that come to this ground; arcs of smaller radius are
  /// among the corners                                                                     [m]
  /// @pre shape_faults(shape) is empty, spacing >= 0
  explicit Ground(const GroundShape& shape, double spacing = 0.0);

  /// Facets with gap <= 0 at x. Looks at those as far as the
  /// surface is; one comparison where x is above the whole ground.
  [[nodiscard]] Touches touches(Vec2 x) const noexcept;
  /// The facet nearest to x, whether x is inside or not: as if it went on for ever.
  [[nodiscard]] Touch facet_near(Vec2 x) const noexcept;
  /// Signed distance to the line of the facet that meets the one nearest to x in a concave corner,
  /// the nearer of two; infinite: there is no such corner                                  [m]
  [[nodiscard]] double beside_concave_corner(Vec2 x) const noexcept;
  [[nodiscard]] bool has_concave_corners() const noexcept;
  /// Signed distance to the surface, > 0 outside                                           [m]
  [[nodiscard]] double distance(Vec2 x) const noexcept;
  /// The surface at x; at a wall that behind it.
  [[nodiscard]] SurfaceLine surface_at(double x) const noexcept;
  /// Length along the surface, from the first point of the profile, of the point nearest to x [m]
  [[nodiscard]] double abscissa(Vec2 x) const noexcept;
  /// Convex bends that touch a body between its nodes, left to right: sharp corners, and arcs whose
  /// radius is below the spacing of the nodes. Where the surface turns by less than blunt_turn
  /// within a spacing there is none.
  [[nodiscard]] std::span<const Corner> corners() const noexcept { return corners_; }
  /// At least those corners that have a point with x from `low` to `high` [m].
  [[nodiscard]] std::span<const Corner> corners(double low, double high) const noexcept;
  /// All convex bends, the blunt ones and all arcs too, left to right.
  [[nodiscard]] std::span<const Corner> bends() const noexcept { return bends_; }
  /// How far from its `position` a point of a bend may be: 0 where all are sharp           [m]
  [[nodiscard]] double bend_reach() const noexcept { return bend_reach_; }
  /// Points of the surface in a box: ends of facets, and so many between them that none is farther
  /// than `spacing` from the next [m]. @pre spacing > 0
  [[nodiscard]] std::vector<Vec2> surface_points(Vec2 low, Vec2 high, double spacing) const;
  /// Spacing of the contact nodes that it was made for                                     [m]
  [[nodiscard]] double spacing() const noexcept { return spacing_; }
  /// The surface as a line, left to right: its corners, points of its arcs no farther apart than
  /// `step`, or 4096 of an arc, and its ends `beyond` the first and the last point [m].
  /// @pre step > 0
  [[nodiscard]] std::vector<Vec2> outline(double step, double beyond) const;
  /// No ground above this height; infinite where the ground rises for ever                [m]
  [[nodiscard]] double top() const noexcept { return top_; }

 private:
  /// A straight facet, or a fillet's arc (radius > 0).
  struct Facet {
    Vec2 begin;            ///< [m]
    Vec2 tangent, normal;  ///< segments: unit vectors; arcs: normal at `begin`
    Vec2 center;           ///< arcs [m]
    double radius = 0.0;   ///< arcs [m]
    double from = 0.0;     ///< abscissa of its ends along the facet; the first segment's from is
    double to = 0.0;       ///<   -inf, the last one's to is +inf                          [m]
    double start_length = 0.0;  ///< length of the surface before abscissa 0                [m]
    bool concave_end = false;   ///< a concave corner between this facet and the next, not blunt
    bool sharp_end = false;     ///< a sharp convex one
  };
  struct Projection {
    double gap = 0.0;       ///< signed distance to the facet's line or circle              [m]
    double along = 0.0;     ///< abscissa of the foot, on the facet                          [m]
    double distance = 0.0;  ///< to the facet's nearest point, >= 0                          [m]
    Vec2 normal;
  };
  void add_boxes();
  /// Abscissas of a facet's ends as far as it may be in the box; the first is the larger: it is
  /// not.
  [[nodiscard]] static std::pair<double, double> within(const Facet& facet, Vec2 low, Vec2 high);
  [[nodiscard]] static Vec2 point_of(const Facet& facet, double along) noexcept;
  [[nodiscard]] static Projection project(const Facet& facet, Vec2 x) noexcept;
  [[nodiscard]] std::size_t nearest(Vec2 x, Projection& projection) const noexcept;
  /// The first facet that may be the nearest, and the one after the last.
  [[nodiscard]] std::pair<std::size_t, std::size_t> around(Vec2 x) const noexcept;
  /// How the surface turns: by angles > 0 at its bends, < 0 where it is concave.
  struct Turn {
    double angle;   ///< [rad]
    double length;  ///< length of the surface before the bend [m]
  };
  [[nodiscard]] double length_so_far() const noexcept;
  void add_segment(const GroundShape& shape, std::size_t i);
  void add_bend(const GroundShape& shape, std::size_t i);
  void choose_corners(const std::vector<Turn>& turns);

  std::vector<Facet> facets_;
  std::vector<double> begins_;  ///< (n_facets) x of their beginnings [m]
  BoxTree boxes_;               ///< bounding boxes of the facets
  std::vector<Corner> bends_, corners_;
  double spacing_ = 0.0, bend_reach_ = 0.0;               ///< [m]
  double top_ = std::numeric_limits<double>::infinity();  ///< [m]
};

}  // namespace rondo::contact
