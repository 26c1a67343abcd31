// SPDX-License-Identifier: BSD-3-Clause
// To add a key: its row here, its member in case.hpp, `docs/cases.md` written again (the test
// Manual.HasTheKeys says how).
#include <algorithm>
#include <numbers>

#include "rondo/case/case_keys.hpp"

namespace rondo::study {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Allowed any{};
constexpr Allowed positive{{0.0, infinity, true, false}};
constexpr Allowed not_negative{{0.0, infinity, false, false}};
constexpr Allowed poisson{{-1.0, 0.5, true, true}};
constexpr Allowed share{{0.0, 1.0, true, false}};
constexpr Allowed loss_or_none{{0.0, 1.0, false, true}};
constexpr double right_angle = 0.5 * std::numbers::pi;
constexpr Allowed less_than_upright{{-right_angle, right_angle, true, true}};
constexpr Allowed of_cords{{-1.5708, 1.5708, false, false}};
constexpr Allowed half_turn{{0.0, 2.0 * right_angle, true, false}};
constexpr Allowed slanted{{-0.78, 0.78, false, false}};  ///< up to about 45°

constexpr Allowed between(double low, double high) {
  return {{low, high, false, false}};
}
constexpr Allowed one_from(std::string_view a, std::string_view b, std::string_view c = {},
                           std::string_view d = {}, std::string_view e = {}) {
  return {{}, {a, b, c, d, e}};
}
constexpr Allowed model = one_from("linear", "neo-hooke", "mooney-rivlin", "yeoh", "ogden");
constexpr Allowed quadrature = one_from("full", "b-bar", "one-point");
constexpr Allowed kind_of_analysis() {
  Allowed allowed;
  for (std::size_t k = 0; k < std::size(analysis_kinds); ++k)
    allowed.choices[k] = analysis_kinds[k].name;
  return allowed;
}
constexpr Allowed with(Allowed allowed, std::string_view also) {
  allowed.also = also;
  return allowed;
}

constexpr Allowed any_band = with(any, "in Hz, as [5.0, 500.0] beside a loss_factor");

constexpr Allowed over_increments(Allowed allowed) {
  allowed.of_increments = true;
  return allowed;
}

template <MaterialModel... models>
bool is_of(const Case& c) {
  return ((c.law.model == models) || ...);
}
template <MaterialModel... models>
bool region_is_of(const Case& c, std::size_t k) {
  return ((c.regions[k].law.model == models) || ...);
}
bool is_linear_or_by_ratio(const Case& c) {
  return !c.law.is_rubber() || !c.law.bulk_modulus;
}
bool has_window(const Case& c) {
  return c.inflation && c.inflation->nonlinear == TyreMotion::window;
}
bool is_by_bulk(const Case& c) {
  return c.law.is_rubber() && c.law.bulk_modulus;
}
bool region_is_by_ratio(const Case& c, std::size_t k) {
  return !c.regions[k].law.is_rubber() || !c.regions[k].law.bulk_modulus;
}
bool has_loss_factor(const Case& c) {
  return c.law.loss_factor > 0.0;
}
bool has_band(const Case& c) {
  return has_loss_factor(c) || std::ranges::any_of(c.regions, [](const MaterialRegion& region) {
           return region.law.loss_factor > 0.0;
         });
}
bool region_has_loss_factor(const Case& c, std::size_t k) {
  return c.regions[k].law.loss_factor != c.law.loss_factor;
}
bool region_is_rubber(const Case& c, std::size_t k) {
  return c.regions[k].law.is_rubber();
}
bool obstacle_has_length(const Case& c, std::size_t k) {
  return c.ground->obstacles[k].kind != contact::ObstacleKind::step;
}
/// A linear region beside rubber has none.
bool region_has_branches(const Case& c, std::size_t k) {
  const MaterialLaw& law = c.regions[k].law;
  if (law.viscosity != c.law.viscosity) return law.is_rubber() || !has_rubber_law(c);
  return law.is_rubber() && law.loss_factor == 0.0;
}
/// If all materials are linear, the integration of [material] applies to all.
bool region_has_integration(const Case& c, std::size_t k) {
  return has_rubber_law(c) || c.regions[k].law.integration != c.law.integration;
}

bool has_surfaces(const Case& c) {
  return !is_generated(c);
}
bool has_width(const Case& c) {
  return c.wheel.width.has_value();
}
bool has_crown(const Case& c) {
  return c.wheel.crown_radius.has_value();
}
bool has_grooves(const Case& c) {
  return !c.wheel.grooves.empty();
}
bool is_smooth(const Case& c) {
  return !c.disk.tread;
}
/// Mass damping acts at the old half step, so that the critical step depends on it.
bool is_lagged(const Case& c) {
  return c.time.scheme == Scheme::as_printed || c.rim;
}
/// The ground is a line: a profile, or the section of a road.
bool has_profile(const Case& c) {
  return !is_on_road_surface(c);
}
bool names_border(const Case& c) {
  return is_on_road_surface(c) && !c.ground->road.border.empty();
}
bool has_free_x(const Case& c) {
  return c.rim && c.rim->free_x;
}
bool has_free_y(const Case& c) {
  return c.rim && c.rim->free_y;
}
bool has_free_spin(const Case& c) {
  return c.rim && c.rim->free_spin;
}
/// A load replaces the height; traction or torque replaces the speed.
bool has_load(const Case& c) {
  return c.analysis.load.has_value();
}
bool is_without_load(const Case& c) {
  return !has_load(c);
}
bool has_traction(const Case& c) {
  return c.analysis.traction.has_value();
}
bool has_torque(const Case& c) {
  return c.analysis.torque.has_value();
}
bool has_slip_angle_step(const Case& c) {
  return c.analysis.slip_angle_step.has_value();
}
bool has_slip_ratio_step(const Case& c) {
  return c.analysis.slip_ratio_step.has_value();
}
bool has_step_distance(const Case& c) {
  return c.analysis.step_distance.has_value();
}
bool has_height(const Case& c) {
  return is_held(c) && !has_load(c);
}
bool has_speed(const Case& c) {
  return is_held(c) && !has_traction(c) && !has_torque(c);
}
bool has_fine_layers(const Case& c) {
  return c.hati && !c.hati->fine.layers.empty();
}
bool has_fine_region(const Case& c) {
  return c.hati && !c.hati->fine.region.empty();
}
bool has_slide_increments(const Case& c) {
  return c.analysis.slide_increments != 0;
}
bool has_slide(const Case& c) {
  return has_slide_increments(c) || c.analysis.slide.points().size() > 1;
}
bool is_lifted(const Case& c, std::size_t k) {
  return c.cords[k].green_radius.has_value();
}
bool has_constant_friction(const Case& c) {
  return !has_friction_table(c);
}
bool has_rest_spin(const Case& c) {
  return c.inflation && c.inflation->spin;
}
bool is_latin(const Case& c) {
  return c.analysis.solver != CrushMethod::direct;
}
bool is_latin_pgd(const Case& c) {
  return c.analysis.solver == CrushMethod::latin_pgd;
}
bool is_by_step(const Case& c) {
  return c.time.step.has_value();
}
bool is_by_safety(const Case& c) {
  return !c.time.step;
}

constexpr Use optional{};
constexpr Use required{true};
constexpr Use of_region = optional.said("that of [material]");

using enum MaterialModel;

#define FIELD(member) [](Case& c, [[maybe_unused]] std::size_t k) { return field_of(c.member); }
#define CHOICE(member) [](Case& c, std::size_t /*k*/) -> CaseMember { return choice_of(c.member); }

constexpr CaseKey keys[] = {
    {"schema", "-", FIELD(schema), between(1, 1), required,
     "Version of the case file's format. A file of a later version is refused"},
    {"title", "-", FIELD(title), any, optional.said("name of the case file").body(never),
     "Title of the run, for people; the results contain it"},

    {"disk.outer_radius", "m", FIELD(disk.outer_radius), positive, required,
     "Outer radius R_o of the disk, to the top of the tread"},
    {"disk.inner_radius", "m", FIELD(disk.inner_radius), with(positive, "< disk.outer_radius"),
     required, "Inner radius R_i of the disk, where it is bonded to the rigid rim"},
    {"disk.rim", "-", CHOICE(free_rim), one_from("bonded", "free"), optional,
     "\"bonded\": the inner boundary moves and turns with the rim, as `[motion]` prescribes. "
     "\"free\": there is no rim, and the disk is one of the [free bodies](#free-bodies)"},

    {"disk.width", "m", FIELD(wheel.width), positive, optional.if_(has_width, "none"),
     "Width along the axle, which makes the disk a [wheel in three "
     "dimensions](#wheels-in-three-dimensions). Without it the body is plane"},
    {"disk.crown_radius", "m", FIELD(wheel.crown_radius), with(positive, ">= disk.width / 2"),
     optional.if_(has_crown, "none"),
     "Radius of the tread across a wheel with a `disk.width`; `disk.outer_radius` is then that of "
     "its middle. Without it the tread is flat"},

    {"disk.mesh.radial", "-", FIELD(disk.radial), between(1, 100000), required,
     "Number of layers of elements from the rim to the top of the disk, or with a `[disk.tread]` "
     "to the bottom of the grooves"},
    {"disk.mesh.circumferential", "-", FIELD(disk.circumferential), between(3, 10000000),
     required.if_(is_smooth, "required without [disk.tread]"),
     "Number of columns of elements around the disk. Refused together with `[disk.tread]`, whose "
     "pitches determine the columns"},
    {"disk.mesh.grading", "-", FIELD(disk.grading), between(1, 10), optional,
     "Exponent p of the layers' radii r_k = R_i + (R_b - R_i)(1 - (1 - k/n)^p), where R_b is the "
     "top of the n layers. 1: even; above 1: finer near the tread"},
    {"disk.mesh.axial", "-", FIELD(wheel.axial), between(1, 100000), optional.if_(has_width),
     "Number of hexahedra across a wheel with a `disk.width`"},

    {"disk.tread.pitches", "-", FIELD(disk.tread->pitches), between(3, 10000000), required,
     "Number of pitches around the disk"},
    {"disk.tread.depth", "m", FIELD(disk.tread->depth),
     with(positive, "< disk.outer_radius - disk.inner_radius"), required,
     "Height of the lands above the bottom of the grooves"},
    {"disk.tread.land_columns", "-", FIELD(disk.tread->land_columns), between(1, 100000), required,
     "Number of columns of elements in a land"},
    {"disk.tread.groove_columns", "-", FIELD(disk.tread->groove_columns), between(0, 100000),
     required,
     "Number of columns of elements in a groove; 0, no grooves across the tread, only with "
     "`circumferential_grooves`"},
    {"disk.tread.layers", "-", FIELD(disk.tread->layers), between(1, 100000), required,
     "Number of layers of elements over the depth of the grooves"},
    {"disk.tread.circumferential_grooves", "m", FIELD(wheel.grooves), any,
     optional.if_(has_grooves, "none"),
     "Grooves around a wheel with a `disk.width`, as deep as the tread: [[z, width], ...] with the "
     "z of their middle, 0 at the middle of the wheel. Elements whose middle is in a groove are "
     "left "
     "out"},

    {"mesh.file", "-", FIELD(mesh->file), any, required.free_on_resume(),
     "Gmsh file of the bodies, relative to the case file's directory. The results directory keeps "
     "a copy, `mesh.msh`, or above 50 MB the path"},
    {"mesh.scale", "m", FIELD(mesh->scale), positive, optional,
     "Length in metres of one unit of length of the file"},
    {"mesh.clamped", "-", FIELD(mesh->clamped), any, optional,
     "Physical curve, or several, whose nodes are constrained in the co-rotating frame (u = 0); "
     "\"\": none, all bodies are free"},
    {"mesh.contact", "-", FIELD(mesh->contact), any, optional,
     "Physical curve whose nodes may touch the ground or other bodies; \"\": none"},

    {"section.file", "-", FIELD(section->mesh.file), any, required.free_on_resume(),
     "Gmsh file of the section of a [wheel in three dimensions](#wheels-in-three-dimensions), "
     "found and kept as for `mesh.file`. Its x is the distance r > 0 from the axle, its y the "
     "coordinate z along the axle; quadrilaterals only"},
    {"section.scale", "m", FIELD(section->mesh.scale), positive, optional,
     "Length in metres of one unit of length of the file"},
    {"section.clamped", "-", FIELD(section->mesh.clamped), any, required,
     "Physical curve that is bonded to the rigid rim, or several: the beads of a tyre"},
    {"section.contact", "-", FIELD(section->mesh.contact), any, optional,
     "Physical curve whose nodes may touch the ground; \"\": none"},
    {"section.sectors", "-", FIELD(section->sectors), between(3, 10000000), optional,
     "Number of columns of hexahedra around the wheel, all of the same angle"},

    {"material.model", "-", FIELD(law.model), model, optional.if_(has_rubber_law, "\"linear\""),
     "\"linear\": isotropic elasticity for small strains. The other laws are [rubber](#rubber) at "
     "finite strain"},
    {"material.youngs_modulus", "Pa", FIELD(material.youngs_modulus), positive,
     required.if_(is_of<linear>, "required for \"linear\""), "Young's modulus E"},
    {"material.shear_modulus", "Pa", FIELD(law.shear_modulus), positive,
     required.if_(is_of<neo_hooke>, "required for \"neo-hooke\""),
     "Shear modulus μ of the law W = μ/2 (I₁ - 3)"},
    {"material.c10", "Pa", FIELD(law.c10), any,
     required.if_(is_of<mooney_rivlin, yeoh>, "required for \"mooney-rivlin\", \"yeoh\""),
     "Coefficient c10 of \"mooney-rivlin\", W = c10 (I₁ - 3) + c01 (I₂ - 3) with μ = 2 (c10 + "
     "c01), or of \"yeoh\", W = c10 (I₁ - 3) + c20 (I₁ - 3)² + c30 (I₁ - 3)³ with μ = 2 c10"},
    {"material.c01", "Pa", FIELD(law.c01), any,
     required.if_(is_of<mooney_rivlin>, "required for \"mooney-rivlin\""),
     "Coefficient c01 of (I₂ - 3) in \"mooney-rivlin\""},
    {"material.c20", "Pa", FIELD(law.c20), any, required.if_(is_of<yeoh>, "required for \"yeoh\""),
     "Coefficient c20 of (I₁ - 3)² in \"yeoh\""},
    {"material.c30", "Pa", FIELD(law.c30), any, required.if_(is_of<yeoh>, "required for \"yeoh\""),
     "Coefficient c30 of (I₁ - 3)³ in \"yeoh\""},
    {"material.terms", "Pa, -", FIELD(law.terms), any,
     required.if_(is_of<ogden>, "required for \"ogden\""),
     "Coefficients [[μ_1, α_1], ...] of \"ogden\", W = Σ μ_i/α_i (λ₁^α_i + λ₂^α_i + λ₃^α_i - 3) "
     "with μ = ½ Σ μ_i α_i"},
    {"material.bulk_modulus", "Pa", FIELD(law.bulk_modulus), positive,
     optional.if_(is_by_bulk, "by material.poissons_ratio"),
     "Bulk modulus κ of rubber, 2/3 to 1e7 times μ, given instead of `poissons_ratio`"},
    {"material.poissons_ratio", "-", FIELD(material.poissons_ratio), poisson,
     required.if_(is_linear_or_by_ratio, "required without bulk_modulus"),
     "Poisson's ratio ν. Of rubber it is that of small strain, at least 0: κ = 2μ(1 + ν)/(3(1 - "
     "2ν)). In plane strain with \"full\" integration there is a warning above 0.49, with "
     "triangles above 0.45: elements are then far too stiff"},
    {"material.density", "kg/m3", FIELD(material.density), positive, required, "Density ρ"},
    {"material.plane", "-", FIELD(material.plane), one_from("strain", "stress"), optional,
     "Plane strain (a wide wheel) or plane stress (a thin sheet)"},
    {"material.integration", "-", FIELD(law.integration), quadrature,
     optional.said("\"full\"; for rubber \"b-bar\""),
     "Quadrature of the stiffness. \"full\": 2×2 points, in a triangle one. \"b-bar\": the mean "
     "change of volume of a quadrilateral, or of the triangles around a node, which does not lock "
     "near ν = 0.5. \"one-point\": one point and a stiffness against hourglass modes, in half the "
     "time and less exact, for quadrilaterals of rubber. Rubber takes \"b-bar\" or \"one-point\""},
    {"material.stress_stiffening", "-", FIELD(stress_stiffening), one_from("none", "centrifugal"),
     optional.of(in_motion_but_written),
     "\"centrifugal\": the stress of the stationary spin at the initial angular velocity stiffens "
     "the body, so that it does not soften as it spins. \"none\": small strain alone"},
    {"material.loss_factor", "-", FIELD(law.loss_factor), loss_or_none,
     optional.if_(has_loss_factor, "none"),
     "Loss factor tan δ of all frequencies within `loss_band`, instead of [[material.viscosity]]: "
     "up to 8 branches are fitted, and `rondo check` tells how well; 0: none. The modulus is that "
     "of strains "
     "slower than the band; it rises with the frequency"},
    {"material.loss_band", "Hz", FIELD(law.loss_band), any_band,
     required.if_(has_band, "required with a loss factor"),
     "Lowest and highest frequency at which the loss factor is met. A point of a rolling wheel is "
     "strained at its turns a second and, in the footprint, at up to some hundred times as many"},

    {"material.viscosity[].relative_modulus",
     "-",
     FIELD(law.viscosity[k][0]),
     {{0.0, most_relative_modulus, true, false}},
     required,
     "Ratio g of the branch's shear modulus to μ, which is that of slow strains. The shear modulus "
     "of sudden strains is μ (1 + Σ g). Of a linear material it is the ratio to Young's modulus, "
     "and "
     "Poisson's ratio is the same at all times"},
    {"material.viscosity[].time", "s", FIELD(law.viscosity[k][1]), positive, required,
     "Relaxation time τ, in which the stress of the branch falls to 1/e. Refused below the time "
     "step"},

    {"material.region[].surface", "-", FIELD(regions[k].surface), any,
     required.if_(has_surfaces, "required with a [mesh]"),
     "Physical surface of the mesh that has this material"},
    {"material.region[].layers", "-", FIELD(regions[k].layers), between(1, 200000),
     optional.if_(is_generated, "required with a [disk]"),
     "Layers of elements of the disk that have this material, counted from 1 at the rim on through "
     "the tread"},
    {"material.region[].model", "-", FIELD(regions[k].law.model), model,
     of_region.if_(has_rubber_law, of_region.standard),
     "Law of the region. If it is not that of [material], only the density is taken from there"},
    {"material.region[].youngs_modulus", "Pa", FIELD(regions[k].material.youngs_modulus), positive,
     of_region.if_item(region_is_of<linear>, of_region.standard), "Young's modulus of the region"},
    {"material.region[].shear_modulus", "Pa", FIELD(regions[k].law.shear_modulus), positive,
     of_region.if_item(region_is_of<neo_hooke>, of_region.standard),
     "Shear modulus μ of the region in \"neo-hooke\""},
    {"material.region[].c10", "Pa", FIELD(regions[k].law.c10), any,
     of_region.if_item(region_is_of<mooney_rivlin, yeoh>, of_region.standard),
     "Coefficient c10 of the region in \"mooney-rivlin\" or \"yeoh\""},
    {"material.region[].c01", "Pa", FIELD(regions[k].law.c01), any,
     of_region.if_item(region_is_of<mooney_rivlin>, of_region.standard),
     "Coefficient c01 of the region in \"mooney-rivlin\""},
    {"material.region[].c20", "Pa", FIELD(regions[k].law.c20), any,
     of_region.if_item(region_is_of<yeoh>, of_region.standard),
     "Coefficient c20 of the region in \"yeoh\""},
    {"material.region[].c30", "Pa", FIELD(regions[k].law.c30), any,
     of_region.if_item(region_is_of<yeoh>, of_region.standard),
     "Coefficient c30 of the region in \"yeoh\""},
    {"material.region[].terms", "Pa, -", FIELD(regions[k].law.terms), any,
     of_region.if_item(region_is_of<ogden>, of_region.standard),
     "Coefficients [[μ_1, α_1], ...] of the region in \"ogden\""},
    {"material.region[].bulk_modulus", "Pa", FIELD(regions[k].law.bulk_modulus), positive,
     of_region.if_item(region_is_rubber, of_region.standard),
     "Bulk modulus κ of the region's rubber"},
    {"material.region[].poissons_ratio", "-", FIELD(regions[k].material.poissons_ratio), poisson,
     of_region.if_item(region_is_by_ratio, of_region.standard), "Poisson's ratio of the region"},
    {"material.region[].density", "kg/m3", FIELD(regions[k].material.density), positive, of_region,
     "Density of the region"},
    {"material.region[].integration", "-", FIELD(regions[k].law.integration), quadrature,
     of_region.if_item(region_has_integration,
                       "that of [material]; with another model \"full\", for rubber \"b-bar\""),
     "Quadrature of the region's stiffness, as for `material.integration`"},
    {"material.region[].viscosity", "-, s", FIELD(regions[k].law.viscosity), any,
     of_region.if_item(region_has_branches, of_region.standard),
     "Branches [[relative_modulus, time], ...] of the region, as in [[material.viscosity]]; []: "
     "none"},
    {"material.region[].loss_factor", "-", FIELD(regions[k].law.loss_factor), loss_or_none,
     of_region.if_item(region_has_loss_factor, of_region.standard),
     "Loss factor of the region within `material.loss_band`; 0: none"},

    {"cords[].curve", "-", FIELD(cords[k].curve), any, required,
     "Physical curve of the section along which the cords lie, on edges of elements; \"layer-K\" "
     "of a `[disk]`: the line between its layers K and K + 1"},
    {"cords[].angle", "rad", FIELD(cords[k].angle), with(of_cords, "in rad: 22° is 0.384"),
     required,
     "Angle of the cords, from the direction around the wheel, in the sense of growing angles, "
     "towards the direction of the curve, which goes from its end of smaller z to that of larger. "
     "0: around, a cap or bead; 1.5708: radial, a carcass"},
    {"cords[].stiffness", "N", FIELD(cords[k].stiffness), positive,
     optional.said("by youngs_modulus and area"),
     "Stiffness EA of a cord: force over nominal strain"},
    {"cords[].youngs_modulus", "Pa", FIELD(cords[k].youngs_modulus), positive,
     optional.said("by stiffness"), "Young's modulus of a cord, beside `area`"},
    {"cords[].area", "m2", FIELD(cords[k].area), positive, optional.said("none"),
     "Cross-section of a cord"},
    {"cords[].spacing", "m", FIELD(cords[k].spacing), positive, required,
     "Distance between cords, across them"},
    {"cords[].spacing_radius", "m", FIELD(cords[k].spacing_radius), positive,
     optional.said("the same everywhere"),
     "Radius at which `spacing` holds; elsewhere it is in proportion to the radius, so that the "
     "number of cords around is constant"},
    {"cords[].density", "kg/m3", FIELD(cords[k].density), positive, optional.said("by excess_mass"),
     "Density of a cord, beside `area`; the cord takes the place of rubber of the mean density on "
     "both sides"},
    {"cords[].excess_mass", "kg/m", FIELD(cords[k].excess_mass), any,
     optional.said("0 without density"),
     "Mass of a metre of cord less that of the rubber in its place"},
    {"cords[].prestrain", "-", FIELD(cords[k].prestrain), between(-0.1, 0.1), optional,
     "Strain of the cords in the undeformed section"},
    {"cords[].compression", "-", FIELD(cords[k].compression), share, optional,
     "Share of the stiffness that resists compression"},
    {"cords[].green_radius", "m", FIELD(cords[k].green_radius), positive,
     optional.said("none: as in the mould"),
     "Radius of the drum on which `angle` and `spacing` are measured before the tyre is lifted "
     "into "
     "its mould: the cosine of the angle grows with the radius, and the number of cords stays"},
    {"cords[].green_extension", "-", FIELD(cords[k].green_extension), between(-0.5, 1.0),
     optional.if_item(is_lifted),
     "Strain of the cords from the drum to the mould, beside `green_radius`"},

    {"inflation.curve", "-", FIELD(inflation->curve), any, optional.said("\"\": no air"),
     "Physical curve of the section on which the air presses, the liner; its ends are on "
     "`section.clamped`"},
    {"inflation.pressure", "Pa", FIELD(inflation->pressure), not_negative, optional,
     "Pressure of the air above that outside. It follows the wall"},
    {"inflation.spin", "rad/s", FIELD(inflation->spin), any,
     optional.if_(has_rest_spin, "motion.angular_velocity at t = 0"),
     "Spin at which the wheel is in equilibrium; its motion is linear about this state, but for "
     "what `inflation.nonlinear` names"},
    {"inflation.steps", "-", FIELD(inflation->steps), between(1, 1000), optional,
     "Number of steps in which pressure, spin and mounting grow together"},
    {"inflation.nonlinear", "-", FIELD(inflation->nonlinear),
     one_from("none", "cords", "window", "all"), optional,
     "What is nonlinear about the inflated state: \"none\"; \"cords\", for cords and air that "
     "follow every displacement; \"window\", for rubber near the ground as well; \"all\""},
    {"inflation.window", "rad", FIELD(inflation->window), half_turn, optional.if_(has_window),
     "Half of the angle about the lowest point in which rubber is not linear, for "
     "inflation.nonlinear = \"window\""},
    {"inflation.mounting[].curve", "-", FIELD(inflation->mounting[k].curve), any, required,
     "Physical curve of `section.clamped` that is moved when the wheel is mounted on its rim"},
    {"inflation.mounting[].radial", "m", FIELD(inflation->mounting[k].radial), any, optional,
     "Its way outwards"},
    {"inflation.mounting[].axial", "m", FIELD(inflation->mounting[k].axial), any, optional,
     "Its way along the axle, towards +z"},

    {"damping.mass", "1/s", FIELD(damping.mass), not_negative, optional.body(is_lagged),
     "Coefficient α of mass damping. It damps a mode of angular frequency w at the ratio α/(2w), "
     "slow motions most; it also brakes flight and spin of a free body"},
    {"damping.stiffness", "s", FIELD(damping.stiffness), not_negative, optional,
     "Coefficient β of stiffness damping. It damps a mode of angular frequency w at the ratio β "
     "w/2, short waves most. It lowers the critical step"},

    {"motion.angular_velocity", "rad/s", FIELD(motion.angular_velocity), any,
     required.if_(is_held, "required if constrained and dynamic")
         .only_in(in_motion)
         .of(not_in_crush)
         .body(never),
     "Angular velocity ω of the rim; > 0 turns clockwise, which rolls towards +x. All angular "
     "velocities and angles of turns of a case, and `angle_rad` of history.csv, have this sign"},
    {"motion.speed", "m/s", FIELD(motion.speed), any,
     required.if_(has_speed, "required if constrained and dynamic")
         .only_in(in_time)
         .of(in_motion)
         .body(never),
     "Speed V of the center along x"},
    {"motion.height", "m", FIELD(motion.height), any,
     required.if_(has_height, "required if constrained and dynamic")
         .only_in(in_time)
         .of(in_motion)
         .body(never),
     "Height h of the center above y = 0"},
    {"motion.start_x", "m", FIELD(motion.start_x), any,
     optional.if_(is_held).of(in_motion).body(never), "Position x of the center at t = 0"},
    {"motion.gravity", "m/s2", FIELD(motion.gravity), any, optional.of(in_motion).body(never),
     "Acceleration of gravity, downwards: 9.81 on Earth"},
    {"motion.slope", "rad", FIELD(motion.slope), less_than_upright,
     optional.of(in_time_untold).body(never),
     "Slope of the ground. The axes of the case stay those of the ground; gravity is tilted "
     "instead, towards +x, downhill, if > 0"},
    {"motion.slip_angle", "rad", FIELD(motion.slip_angle), with(slanted, "in rad: 1° is 0.01745"),
     optional.if_(is_solid).of(in_motion).body(never),
     "Angle from the heading of a wheel in three dimensions to the velocity of its center; > 0 "
     "travels to the right as well, towards +z"},
    {"motion.camber", "rad", FIELD(motion.camber), with(slanted, "in rad: 1° is 0.01745"),
     optional.if_(is_solid).of(not_in_inflation).body(never),
     "Angle by which a wheel in three dimensions leans; > 0 leans its top to the left, towards -z"},
    {"motion.turn_slip", "1/m", FIELD(analysis.turn_slip), any,
     optional.if_(is_solid).of(of_steady_rolling).body(never),
     "Curvature φ of the path of a wheel in three dimensions that rolls steadily: its yaw rate "
     "over "
     "`speed`, one over the radius of the path; > 0 turns to the left, seen from above. The "
     "inertia of the yaw is neglected"},

    {"rim.free", "-",
     [](Case& c, std::size_t /*k*/)
         -> CaseMember { return ChoiceList{{&c.rim->free_x, &c.rim->free_y, &c.rim->free_spin}}; },
     one_from("speed", "height", "angular_velocity"), required,
     "Motions that forces determine; `[motion]` gives their values at t = 0. The others are held, "
     "as `[motion]` prescribes. []: all are held, and the reactions are computed"},
    {"rim.mass", "kg/m", FIELD(rim->mass), not_negative,
     optional.said("required if speed or height is free"),
     "Mass of the rim and what it carries, without the nodes that are bonded to it"},
    {"rim.inertia", "kg m", FIELD(rim->inertia), not_negative,
     optional.said("required if angular_velocity is free"),
     "Moment of inertia about the center, without the nodes that are bonded to the rim"},
    {"rim.force_x", "N/m", FIELD(rim->force_x), any, optional.if_(has_free_x).body(never),
     "Force on the center along x"},
    {"rim.force_y", "N/m", FIELD(rim->force_y), any, optional.if_(has_free_y).body(never),
     "Force on the center, upwards: a load is negative"},
    {"rim.torque", "N", FIELD(rim->torque), any, optional.if_(has_free_spin).body(never),
     "Torque on the rim, clockwise: > 0 drives towards +x, < 0 backwards"},
    {"rim.brake", "N", FIELD(rim->brake), not_negative, optional.if_(has_free_spin).body(never),
     "Torque of a brake, which acts against the spin, brings it to rest and never reverses it"},
    {"rim.support.x.stiffness", "N/m2", FIELD(rim->support_x.stiffness), not_negative,
     optional.if_(has_free_x),
     "Stiffness of a spring along x between the center and a fixed point"},
    {"rim.support.x.damping", "N s/m2", FIELD(rim->support_x.damping), not_negative,
     optional.if_(has_free_x).body(never),
     "Coefficient of a dashpot along x between the center and a fixed point"},
    {"rim.support.x.at", "m", FIELD(rim->support_x.at), any,
     optional.if_(has_free_x).said("the center's x at t = 0").body(never),
     "Position x of the center at which the spring along x exerts no force"},
    {"rim.support.y.stiffness", "N/m2", FIELD(rim->support_y.stiffness), not_negative,
     optional.if_(has_free_y),
     "Stiffness of a spring along y between the center and a fixed point"},
    {"rim.support.y.damping", "N s/m2", FIELD(rim->support_y.damping), not_negative,
     optional.if_(has_free_y).body(never),
     "Coefficient of a dashpot along y between the center and a fixed point"},
    {"rim.support.y.at", "m", FIELD(rim->support_y.at), any,
     optional.if_(has_free_y).said("the center's height at t = 0").body(never),
     "Height of the center at which the spring along y exerts no force"},

    {"ground.profile", "m", FIELD(ground->profile), any,
     optional.if_(has_profile, "required, or ground.road"),
     "Surface of the ground: the line y = 0, a polyline, or a CSV file of its points, relative to "
     "the case file's directory. The `case.toml` of the results contains the points"},
    {"ground.road", "-", FIELD(ground->road.file), any,
     optional.if_(is_on_road_surface, "none").body(never).free_on_resume(),
     "Measured road in place of `profile`, relative to the case file's directory: its section "
     "along u under a plane body ([roads.md](roads.md#3-a-road-under-a-plane-wheel)), its surface "
     "under a wheel with a width ([roads.md](roads.md#4-wheels-with-a-width)). The `case.toml` of "
     "the results contains the points of the section as `profile`, or the path"},
    {"ground.road_start", "m", FIELD(ground->road.start), any,
     optional.if_(is_on_road_surface, "first u of the road + 0.5 m").body(never),
     "Coordinate u of the road where x = 0. The height there is subtracted, so that y = 0 at x = "
     "0"},
    {"ground.road_offset", "m", FIELD(ground->road.offset), any,
     optional.if_(is_on_road_surface, "0.0").body(never),
     "Coordinate v of the road at the plane of the body, > 0 to the left"},
    {"ground.road_border", "-", FIELD(ground->road.border), one_from("keep", "zero", "repeat"),
     optional.if_(names_border, "that of the file, else \"keep\"").body(never),
     "Ground before and behind the road. \"keep\": level at the height of its end. \"zero\": level "
     "at the height 0 of the file, with a step at the end. \"repeat\": the road once more, for "
     "wheels with a width"},
    {"ground.fillet", "m", FIELD(ground->fillet), not_negative, optional.of(in_time_untold),
     "Radius that rounds all convex corners of the ground; 0: they are sharp"},
    {"ground.friction", "-", FIELD(ground->friction.coefficient),
     with(between(0, 100), "or a table [ground.friction]"),
     optional.if_(has_constant_friction).body(never),
     "Coulomb's coefficient of friction μ on the ground; 0: none. A table in its place gives μ "
     "over slip speed and pressure ([roads.md](roads.md))"},
    {"ground.restitution", "-", FIELD(ground->restitution), between(0, 1),
     optional.of(in_time).body(never),
     "Newton's coefficient of restitution e of each node's impact on the ground; 0: a node that "
     "arrives stays until it is pulled off"},
    {"ground.impact", "-", FIELD(ground->impact), one_from("moreau", "energy-safe"),
     optional.of(in_time).body(never),
     "Law of the impacts. \"moreau\": a node that arrives or leaves with the normal velocity w_n⁻ "
     "goes on with -e w_n⁻. \"energy-safe\": a node that leaves while it is pulled back goes on "
     "with -w_n⁻; no impact then creates energy at any step, but more is lost "
     "([theory.md](theory.md), 4.3)"},

    {"ground.obstacle[].kind", "-", FIELD(ground->obstacles[k].kind),
     one_from("cleat", "step", "pothole"), required,
     "Obstacle on the ground, whose height it adds to. \"cleat\": a bar of rectangular section. "
     "\"step\": behind it the ground goes on at another level. \"pothole\": a trough of "
     "rectangular section ([roads.md](roads.md#5-obstacles))"},
    {"ground.obstacle[].at", "m", FIELD(ground->obstacles[k].at), any, required,
     "Position x of its first edge, for a wheel with a width where that crosses the middle of the "
     "track"},
    {"ground.obstacle[].height", "m", FIELD(ground->obstacles[k].height), any, required,
     "Height of a cleat; of a step, < 0: down; depth of a pothole, > 0"},
    {"ground.obstacle[].length", "m", FIELD(ground->obstacles[k].length), positive,
     required.if_item(obstacle_has_length, "required, not for a step"),
     "Length of a cleat or a pothole, normal to its edges"},
    {"ground.obstacle[].angle", "rad", FIELD(ground->obstacles[k].angle),
     with(slanted, "in rad: 30° is 0.5236"), optional,
     "Angle between the edges and the axis across the track of a wheel with a width; > 0: its left "
     "side meets them first. At an angle on ground that is not level an obstacle needs a fillet"},
    {"ground.obstacle[].fillet", "m", FIELD(ground->obstacles[k].fillet), not_negative, optional,
     "Radius that rounds its convex edges; 0: they are sharp. On a road under a wheel with a width "
     "all obstacles need one, and so do those at an angle or of several angles on ground that is "
     "not level"},

    {"ground.friction.coefficient", "-", FIELD(ground->friction.coefficient), between(0, 100),
     required.if_(has_friction_table, "required").body(never),
     "Coefficient of friction μ where all factors are 1. A `--set` or a sweep of a key of this "
     "table takes a number `ground.friction` of the file as the coefficient, and one of "
     "`ground.friction` replaces the whole table"},
    {"ground.friction.slip_speed", "m/s, -", FIELD(ground->friction.slip),
     with(any, "speeds >= 0 and increasing, factors 0 to 100"),
     optional.if_(has_friction_table, "factor 1").body(never),
     "Factor of μ over the slip speed, [[speed, factor], ...]: linear between the points, and "
     "beyond them that of the first and the last one"},
    {"ground.friction.pressure_exponent", "-", FIELD(ground->friction.pressure_exponent),
     between(-1, 1), optional.if_(has_friction_table, "0.0").body(never),
     "Exponent k of the factor (p/p_ref)^k of μ over the pressure p, which counts from a tenth of "
     "`pressure_reference` to ten times that; < 0: higher pressure, less friction, as for rubber"},
    {"ground.friction.pressure_reference", "Pa", FIELD(ground->friction.pressure_reference),
     positive, optional.if_(has_friction_table, "2e+05").body(never),
     "Pressure p_ref at which the factor of the pressure is 1"},

    {"ground.patch[].from", "m", FIELD(ground->friction.patches[k].from), any, required.body(never),
     "Place x where a stretch of the ground with another friction begins"},
    {"ground.patch[].to", "m", FIELD(ground->friction.patches[k].to), with(any, "more than from"),
     required.body(never), "Place x where that stretch ends"},
    {"ground.patch[].side", "-", FIELD(ground->friction.patches[k].side),
     one_from("both", "left", "right"), optional.body(never),
     "Side of the line on the ground along which a wheel in three dimensions begins to roll, seen "
     "towards +x. A node on the line counts by half. For plane bodies \"both\""},
    {"ground.patch[].factor", "-", FIELD(ground->friction.patches[k].factor), between(0, 100),
     required.body(never),
     "Factor of μ on that stretch; where patches overlap, their factors are multiplied"},

    {"contact.between", "-", FIELD(body_contact.between), one_from("none", "bodies", "all"),
     optional,
     "\"bodies\": bodies touch each other. \"all\": the boundary of a body may also touch itself, "
     "for example the walls of a groove that closes"},
    {"contact.friction", "-", FIELD(body_contact.friction), between(0, 100), optional,
     "Coulomb's coefficient of friction μ between bodies"},
    {"contact.restitution", "-", FIELD(body_contact.restitution), between(0, 1), optional,
     "Newton's coefficient of restitution e between bodies"},
    {"contact.impact", "-", FIELD(body_contact.impact), one_from("moreau", "energy-safe"), optional,
     "Law of the impacts between bodies, as for `ground.impact`"},

    {"load.pressure[].curve", "-", FIELD(pressures[k].curve), any, required,
     "Physical curve of the mesh or section, not all of it held. Of a disk: \"tread\", the tops of "
     "the lands; if disk.rim is \"free\" also \"rim\", the inner boundary; if it has a width also "
     "\"left\" and \"right\", the sides"},
    {"load.pressure[].value", "Pa", FIELD(pressures[k].pressure), any, required,
     "Pressure against the outward normal; > 0 presses on the body"},

    {"initial.state", "-", FIELD(initial.state), one_from("rest", "stationary", "steady-rolling"),
     optional.body(may_be_free),
     "\"rest\": undeformed, at rest relative to the turning rim. \"stationary\": deformed, in "
     "equilibrium with the spin at t = 0. \"steady-rolling\": rolling on the ground in the [steady "
     "state](#a-start-in-steady-rolling) of the motion at t = 0"},
    {"initial.velocity", "m/s", FIELD(initial.velocity), any, optional.body(may_be_free),
     "Velocity added to that of every free node, in the fixed frame"},
    {"initial.displacement_gradient", "-", FIELD(initial.displacement_gradient), any,
     optional.body(may_be_free),
     "Matrix G, given by rows: the displacement G X is added to that of every free node, where X "
     "is its "
     "position in the undeformed body (in a free body, as placed)"},
    {"initial.position", "m", FIELD(initial.position), any,
     optional.if_(may_be_free).body(may_be_free),
     "Displacement of all free bodies at t = 0, after they are turned by `initial.turn`"},
    {"initial.turn", "rad", FIELD(initial.turn), any, optional.if_(may_be_free).body(may_be_free),
     "Angle by which all free bodies are turned about the origin of the mesh at t = 0; > 0 turns "
     "clockwise"},
    {"initial.angle", "rad", FIELD(initial.angle), any,
     optional.if_(never, "0, or minus initial.turn").body(may_be_free),
     "Minus `initial.turn`, counter-clockwise: a key of earlier versions, taken with a warning and "
     "written as `initial.turn`"},
    {"initial.angular_velocity", "rad/s", FIELD(initial.angular_velocity), any,
     optional.if_(may_be_free).body(may_be_free),
     "Angular velocity of each free body about its center of mass at t = 0; > 0 turns clockwise"},

    {"initial.region[].surface", "-", FIELD(initial.regions[k].surface), any,
     required.if_(may_be_free).body(may_be_free),
     "Physical surface of the mesh whose free bodies start with this motion"},
    {"initial.region[].velocity", "m/s", FIELD(initial.regions[k].velocity), any,
     optional.if_(may_be_free, "that of [initial]").body(may_be_free),
     "Velocity of the center of mass of each of the region's free bodies at t = 0"},
    {"initial.region[].angular_velocity", "rad/s", FIELD(initial.regions[k].angular_velocity), any,
     optional.if_(may_be_free, "that of [initial]").body(may_be_free),
     "Angular velocity of each of the region's free bodies about its center of mass at t = 0; > 0 "
     "turns clockwise"},

    {"analysis.kind", "-", FIELD(analysis.kind), kind_of_analysis(), optional,
     "\"dynamic\": the body moves as `[motion]` prescribes, over `[time]`. \"crush\": the body is "
     "pressed slowly on flat ground without turning. \"steady-rolling\": the steady state of "
     "rolling at constant spin, solved directly ([steady rolling](#steady-rolling)). "
     "\"inflation\": "
     "the equilibrium of a wheel under its air, its spin and the places of its rim "
     "([inflation](#inflation-air-spin-and-mounting-at-finite-strain))"},
    {"analysis.depth", "m", FIELD(analysis.depth),
     over_increments(with(not_negative, "< disk.outer_radius - disk.inner_radius")),
     required.of(of_crush).if_(is_without_load, "required if crush without load").body(never),
     "Distance of the center below its height at first touch of the undeformed body: a number > 0, "
     "reached in equal parts, or a table over the index of the increment. Only in a crush"},
    {"analysis.increments", "-", FIELD(analysis.increments), between(1, 1000000),
     required.of(of_crush).said("required if crush").body(never),
     "Number of equal parts of the depth or the load, each an equilibrium; if the depth is a "
     "table, of all increments. Only in a crush"},
    {"analysis.slide", "m", FIELD(analysis.slide), over_increments(any),
     optional.of(of_crush).if_(has_slide, "none").body(never),
     "Displacement of the center along +x, without turning: a number, after the pressing and at "
     "the full depth or load, or a table beside one of the depth. Only in a crush"},
    {"analysis.slide_increments", "-", FIELD(analysis.slide_increments), between(1, 1000000),
     optional.of(of_crush).if_(has_slide_increments, "required if slide is a number").body(never),
     "Number of equal parts of a slide that is a number, each an equilibrium. Refused beside "
     "tables. Only in a crush"},

    {"analysis.solver", "-", FIELD(analysis.solver), one_from("direct", "latin", "latin-pgd"),
     optional.of(of_crush).body(never),
     "Method for the increments of a crush. \"direct\": one after another, exactly. \"latin\": all "
     "at once, by iterations between contact and elasticity. \"latin-pgd\": as \"latin\", with the "
     "field in modes. The last two need linear materials and give the same results to about "
     "`tolerance`"},
    {"analysis.search_direction", "N/m2", FIELD(analysis.search_direction), not_negative,
     optional.of(of_crush).if_(is_latin).body(never),
     "Stiffness that joins forces and gaps in the iterations of \"latin\" and \"latin-pgd\"; 0: "
     "chosen by the program. It changes the number of iterations, and the result within "
     "`tolerance`"},
    {"analysis.relaxation", "-", FIELD(analysis.relaxation), share,
     optional.of(of_crush).if_(is_latin).body(never),
     "Relaxation factor of \"latin\" and \"latin-pgd\": the part of an iteration's change that is "
     "applied"},
    {"analysis.tolerance", "-", FIELD(analysis.tolerance), between(1e-12, 0.1),
     optional.of(of_crush).if_(is_latin).body(never),
     "Bound of the indicator and the residual that ends the iterations of \"latin\" and "
     "\"latin-pgd\""},
    {"analysis.downsizing", "-", FIELD(analysis.downsizing), between(0.0, 3.0),
     optional.of(of_crush).if_(is_latin_pgd, "0.3; 1.0 with a slide").body(never),
     "Factor of \"latin-pgd\": modes are dropped if their part is below 0.3 times this factor "
     "times the indicator. 0: all are kept"},

    {"analysis.samples_per_sector", "-", FIELD(analysis.samples_per_sector), between(1, 1000),
     optional.of(of_steady_rolling).body(never),
     "Number of samples, over the length of a sector, at which steady rolling is solved. Default "
     "with a `[disk.tread]` 16; of a wheel in three dimensions 4, with a `[disk.tread]` 8, of a "
     "`[section]` without `[inflation]` 2"},
    {"analysis.slip", "-", FIELD(analysis.slip), one_from("bdf2", "upwind"),
     optional.of(of_steady_rolling).body(never),
     "Formula for the slip of a node in steady rolling. \"bdf2\": from its positions one and two "
     "samples before. \"upwind\": from that one sample before alone, which is more robust and "
     "coarser"},
    {"analysis.inertia", "-", FIELD(analysis.inertia), one_from("all", "waves", "none"),
     optional.of(of_steady_rolling).body(never),
     "Which harmonics of the turn accelerate the masses in steady rolling. \"all\": those of all "
     "samples. \"waves\": those that the sectors resolve as waves around the wheel, up to half "
     "their number; the others, which a node meets as it passes the contact, are quasi-static. "
     "\"none\": none, which is slow rolling with the centrifugal force of the spin. Default with "
     "`[inflation]` \"waves\""},
    {"analysis.estimate_slip_error", "-", FIELD(analysis.estimate_slip_error), any,
     optional.of(of_steady_rolling).body(never),
     "Whether the contact is solved with both formulas of `analysis.slip`, and their difference "
     "kept as `slip_error` in `run.json`: a measure of the error along the ground. "
     "Default "
     "with `[inflation]` true"},
    {"analysis.massless_contact", "-", FIELD(analysis.massless_contact), any,
     optional.of(of_steady_rolling).body(never),
     "Whether the mass of the contact nodes is moved to the nodes below them. false is allowed "
     "only with `samples_per_sector = 1`"},
    {"analysis.accept_scheme_power", "-", FIELD(analysis.accept_scheme_power), any,
     optional.of(of_steady_rolling).body(never),
     "Whether a state is a result even if the discretisation creates or takes more than a quarter "
     "of the largest power and more than 1e-4 of load times speed "
     "([steady.md](steady.md#the-power-of-the-discretisation)); its rolling resistance is then "
     "meaningless, its forces and footprint are not"},
    {"analysis.load", "N/m", FIELD(analysis.load), positive,
     optional.of(of_load).if_(has_load, "none").body(never),
     "Force of the ground on the body, upwards: in steady rolling given instead of "
     "`motion.height`, in a crush of a wheel in three dimensions, which reaches it in equal parts, "
     "instead of `analysis.depth`"},
    {"analysis.traction", "N/m", FIELD(analysis.traction), any,
     optional.of(of_steady_rolling).if_(has_traction, "none").body(never),
     "Force of the ground along +x, given instead of `motion.speed`; < 0 brakes"},
    {"analysis.torque", "N", FIELD(analysis.torque), any,
     optional.of(of_steady_rolling).if_(has_torque, "none").body(never),
     "Torque on the rim, clockwise, given instead of `motion.speed`: > 0 drives towards +x, 0 is "
     "free rolling. At constant spin the torque of the ground about the center is as large and "
     "counter-clockwise"},
    {"analysis.slip_angle_step", "rad", FIELD(analysis.slip_angle_step),
     with(slanted, "in rad: 1° is 0.01745"),
     optional.of(of_steady_rolling).if_(has_slip_angle_step, "none").body(never),
     "Change of the slip angle of a wheel in three dimensions that rolls steadily, after which it "
     "rolls on over `step_distance` ([relaxation lengths](steady.md#relaxation-lengths)). Not "
     "together with `slip_ratio_step`"},
    {"analysis.slip_ratio_step", "-", FIELD(analysis.slip_ratio_step), between(-0.5, 0.5),
     optional.of(of_steady_rolling).if_(has_slip_ratio_step, "none").body(never),
     "Change of the slip ratio of a wheel in three dimensions that rolls steadily, by a change of "
     "its speed at the same spin, after which it rolls on over `step_distance`; > 0 drives"},
    {"analysis.step_distance", "m", FIELD(analysis.step_distance), positive,
     optional.of(of_steady_rolling).if_(has_step_distance, "required with a step").body(never),
     "Distance rolled after a step of the slip"},

    {"time.end", "s", FIELD(time.end), positive,
     required.said("required if dynamic").body(never).free_on_resume(),
     "End of the run, which starts at t = 0"},
    {"time.safety", "-", FIELD(time.safety), with(share, "not together with time.step"),
     optional.if_(is_by_safety).body(never),
     "Ratio of the time step to the critical step; in the scheme \"hati\", both are those of the "
     "fine part. Default with rubber 0.85"},
    {"time.step", "s", FIELD(time.step), with(positive, "not together with time.safety"),
     optional.if_(is_by_step, "none").body(never),
     "Time step, given instead of `time.safety`; in the scheme \"hati\", the fine one. At most "
     "1e12 steps to the end"},
    {"time.scheme", "-", FIELD(time.scheme), one_from("symplectic", "as-printed", "hati"), optional,
     "\"symplectic\": gyroscopic and mass damping forces at the middle of the step; keeps energy. "
     "\"as-printed\": these forces at the old half step, as published; for comparison, because it "
     "creates energy, which the ledger shows as `work_scheme`. \"hati\": two parts of the body, "
     "each with a [step of its own](#two-parts-with-steps-of-their-own)"},

    {"solver.operator", "-", FIELD(solver_operator), one_from("auto", "cyclic", "sparse"),
     optional.of(in_time),
     "How K u is formed: \"cyclic\" from the blocks of one sector, \"sparse\" from an assembled "
     "matrix, with the same results to round-off (docs/performance.md). \"auto\" takes \"cyclic\" "
     "on every mesh of equal sectors, that is on every `[disk]`, unless it is refused: for a free "
     "disk, `[contact]` of bodies, rubber, or a `time.scheme` other than \"symplectic\""},
    {"solver.contact_mass", "-", FIELD(contact_mass),
     one_from("lumped", "singular", "singular-kept"), optional.of(in_time),
     "Mass of the nodes that may touch the ground. \"lumped\": their own. \"singular\": none; it "
     "goes to the nodes below, and stiffness and ground determine the positions of the contact "
     "nodes ([theory](theory.md), 3.10): impacts lose and excite next to nothing, gaps are kept, "
     "and the step may be longer. \"singular-kept\": the masses are also scaled so that center of "
     "mass and inertia of the body stay. Both need a `[ground]` without sharp convex corners, and "
     "are refused with restitution, `[contact]` of bodies, `[rim]`, free bodies and schemes other "
     "than \"symplectic\""},
    {"solver.contact_iterations", "-", FIELD(contact_iterations), between(1, 1000000000),
     optional.of(in_time).body(never),
     "Largest number of iterations for contacts that are solved together (sharp corners of the "
     "ground, bodies on each other). Contacts that do not meet the law by then are counted in "
     "`run.json`, and their residual ends the run. Wheels in three dimensions take no more than "
     "400, "
     "and then fewer contacts ([wheel3d.md](wheel3d.md#corners-of-the-ground))"},
    {"solver.dump_contacts", "-", FIELD(dump_contacts), between(0, 1000000000),
     optional.of(in_time).body(never),
     "Number of iterations above which contacts of plane bodies that are solved together are kept "
     "as "
     "files in `contact-problems/` of the results directory; 0: none"},

    {"solver.implicit[].slower_than", "s", FIELD(implicit[k].slower_than), positive,
     optional.said("none"),
     "Critical step below which an element is implicit in the explicit step. Each table gives one "
     "of `slower_than`, `layers` and `region`; several tables add up"},
    {"solver.implicit[].layers", "-", FIELD(implicit[k].layers), between(1, 200000),
     optional.said("none"), "Layers of elements of a `[disk]` that are implicit, 1 at the rim"},
    {"solver.implicit[].region", "-", FIELD(implicit[k].region), any, optional.said("none"),
     "Physical surface of a `[mesh]` whose elements are implicit"},

    {"solver.hati.ratio", "-", FIELD(hati->ratio), between(1, 1000), required,
     "Number m of fine steps in a coarse one. Nodes that may touch the ground must be at least m "
     "elements away from the elements that are not fine"},
    {"solver.hati.fine.layers", "-", FIELD(hati->fine.layers), between(1, 200000),
     optional.if_(has_fine_layers, "none"),
     "Layers of elements of a `[disk]`, 1 at the rim, that are explicit, in fine steps"},
    {"solver.hati.fine.region", "-", FIELD(hati->fine.region), any,
     optional.if_(has_fine_region, "none"),
     "Physical surface of a `[mesh]` whose elements are explicit, in fine steps"},

    {"output.history_interval", "s", FIELD(output.history_interval), not_negative,
     optional.of(in_time).body(never),
     "Time between rows of `history.csv`, over which forces are averaged. 0: a row every step"},
    {"output.snapshots", "-", FIELD(output.snapshots), between(0, 1000000),
     optional.of(in_time).body(never),
     "Number of snapshots, evenly spread over [snapshots_from, end], both ends included"},
    {"output.snapshots_from", "s", FIELD(output.snapshots_from), with(not_negative, "<= time.end"),
     optional.of(in_time).body(never), "Time of the first snapshot"},
    {"output.stress", "-", FIELD(output.stress), any, optional.of(not_in_inflation).body(never),
     "Whether the snapshots contain the stress"},
    {"output.friction_work", "-", FIELD(output.friction_work), any,
     optional.of(in_time).body(never),
     "Whether the snapshots contain the energy that friction has taken so far, by contact node and "
     "by place in the footprint ([wear.md](wear.md))"},
    {"output.checkpoint_interval", "s", FIELD(output.checkpoint_interval), positive,
     optional.of(not_in_inflation).body(never).free_on_resume(),
     "Wall time between checkpoints (docs/results.md, [Resuming a "
     "run](results.md#resuming-a-run)). One is also written at the end and at a signal. A crush "
     "writes none"},

    {"output.probe[].name", "-", FIELD(output.probes[k].name), any, required,
     "Name of the probe's columns: letters, digits, _ and -"},
    {"output.probe[].position", "m", FIELD(output.probes[k].position), any, required,
     "Position of the probe in the undeformed mesh, before free bodies are placed. A point in no "
     "cell is refused"},
};

#undef FIELD
#undef CHOICE

}  // namespace

std::span<const CaseKey> case_keys() noexcept {
  return keys;
}

}  // namespace rondo::study
