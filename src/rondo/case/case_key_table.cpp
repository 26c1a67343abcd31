// SPDX-License-Identifier: BSD-3-Clause
// To add a key: its row here, its member in case.hpp, `docs/cases.md` written again (the test
// Manual.HasTheKeys says how).
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
constexpr double right_angle = 0.5 * std::numbers::pi;
constexpr Allowed less_than_upright{{-right_angle, right_angle, true, true}};
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
bool is_by_bulk(const Case& c) {
  return c.law.is_rubber() && c.law.bulk_modulus;
}
bool region_is_by_ratio(const Case& c, std::size_t k) {
  return !c.regions[k].law.is_rubber() || !c.regions[k].law.bulk_modulus;
}
bool region_is_rubber(const Case& c, std::size_t k) {
  return c.regions[k].law.is_rubber();
}
/// In a body of linear materials alone the quadrature of all is that of [material].
bool region_has_integration(const Case& c, std::size_t k) {
  return has_rubber(c) || c.regions[k].law.integration != c.law.integration;
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
/// Mass damping acts at the old half step, so that the critical step hangs on it.
bool is_lagged(const Case& c) {
  return c.time.scheme == Scheme::as_printed || c.rim;
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
/// A load takes the place of the height, traction or torque that of the speed.
bool has_load(const Case& c) {
  return c.analysis.load.has_value();
}
bool has_traction(const Case& c) {
  return c.analysis.traction.has_value();
}
bool has_torque(const Case& c) {
  return c.analysis.torque.has_value();
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
     "version of the case file's format. A file of a later version is refused"},
    {"title", "-", FIELD(title), any, optional.said("name of the case file").body(never),
     "a line for people; goes into the results"},

    {"disk.outer_radius", "m", FIELD(disk.outer_radius), positive, required,
     "outer radius R_o, to the top of the tread"},
    {"disk.inner_radius", "m", FIELD(disk.inner_radius), with(positive, "< disk.outer_radius"),
     required, "inner radius R_i, bonded to the rigid rim"},
    {"disk.rim", "-", CHOICE(free_rim), one_from("bonded", "free"), optional,
     "\"bonded\": the inner boundary turns and moves with the rim, as `[motion]` says. \"free\": "
     "there is no rim and the disk is unconstrained; see [free bodies](#free-bodies)"},

    {"disk.width", "m", FIELD(wheel.width), positive, optional.if_(has_width, "none"),
     "width of the wheel along its axle. Given, the body is a wheel in three dimensions, "
     "[below](#wheels-in-three-dimensions); left out, it is plane"},
    {"disk.crown_radius", "m", FIELD(wheel.crown_radius), with(positive, ">= disk.width / 2"),
     optional.if_(has_crown, "none"),
     "of a wheel with a width: radius across of its tread, which outer_radius is the middle of. "
     "Left out, the tread is flat"},

    {"disk.mesh.radial", "-", FIELD(disk.radial), between(1, 100000), required,
     "layers of quadrilaterals between the radii; with a tread, between the rim and the bottom of "
     "the grooves"},
    {"disk.mesh.circumferential", "-", FIELD(disk.circumferential), between(3, 10000000),
     required.if_(is_smooth, "required without [disk.tread]"),
     "columns of quadrilaterals round the disk. Refused together with `[disk.tread]`, whose "
     "pitches give the columns"},
    {"disk.mesh.grading", "-", FIELD(disk.grading), between(1, 10), optional,
     "p of the layers' radii r_k = R_i + (R_b - R_i)(1 - (1 - k/n)^p), R_b the top of the n "
     "layers. 1: even; above 1: finer near the tread"},
    {"disk.mesh.axial", "-", FIELD(wheel.axial), between(1, 100000), optional.if_(has_width),
     "of a wheel with a width: hexahedra over it"},

    {"disk.tread.pitches", "-", FIELD(disk.tread->pitches), between(3, 10000000), required,
     "number of pitches round the disk"},
    {"disk.tread.depth", "m", FIELD(disk.tread->depth),
     with(positive, "< disk.outer_radius - disk.inner_radius"), required,
     "height of the lands above the bottom of the grooves"},
    {"disk.tread.land_columns", "-", FIELD(disk.tread->land_columns), between(1, 100000), required,
     "columns of quadrilaterals in a land"},
    {"disk.tread.groove_columns", "-", FIELD(disk.tread->groove_columns), between(0, 100000),
     required,
     "columns of quadrilaterals in a groove. 0, no grooves across: only with "
     "circumferential_grooves"},
    {"disk.tread.layers", "-", FIELD(disk.tread->layers), between(1, 100000), required,
     "layers of quadrilaterals over the depth"},
    {"disk.tread.circumferential_grooves", "m", FIELD(wheel.grooves), any,
     optional.if_(has_grooves, "none"),
     "[[z, width], ...] of a wheel with a width: grooves around it, as deep as the tread, by the z "
     "of their middle; z = 0 is the middle of the wheel. Elements whose middle is in one are left "
     "out"},

    {"mesh.file", "-", FIELD(mesh->file), any, required.free_on_resume(),
     "the file, relative to the case file's directory. The results directory keeps a copy of it, "
     "`mesh.msh`, for its own `case.toml`; of a file above 50 MB the path"},
    {"mesh.scale", "m", FIELD(mesh->scale), positive, optional,
     "metres of one unit of length of the file"},
    {"mesh.clamped", "-", FIELD(mesh->clamped), any, optional,
     "physical curve constrained in the co-rotating frame (u = 0); \"\": none, all bodies are "
     "free"},
    {"mesh.contact", "-", FIELD(mesh->contact), any, optional,
     "physical curve whose nodes may touch the ground or other bodies; \"\": none"},

    {"section.file", "-", FIELD(section->mesh.file), any, required.free_on_resume(),
     "the file, as `mesh.file`: the section of a wheel in three dimensions, "
     "[below](#wheels-in-three-dimensions). Its x is the distance r > 0 from the axle, its y is z "
     "along it; quadrilaterals alone"},
    {"section.scale", "m", FIELD(section->mesh.scale), positive, optional,
     "metres of one unit of length of the file"},
    {"section.clamped", "-", FIELD(section->mesh.clamped), any, required,
     "physical curve that is bonded to the rigid rim"},
    {"section.contact", "-", FIELD(section->mesh.contact), any, optional,
     "physical curve whose nodes may touch the ground; \"\": none"},
    {"section.sectors", "-", FIELD(section->sectors), between(3, 10000000), optional,
     "columns of hexahedra round the wheel, all of the same angle"},

    {"material.model", "-", FIELD(law.model), model, optional.if_(has_rubber, "\"linear\""),
     "\"linear\": isotropic elasticity of small strains, as published. The others are "
     "[rubber](#rubber) at finite strain"},
    {"material.youngs_modulus", "Pa", FIELD(material.youngs_modulus), positive,
     required.if_(is_of<linear>, "required of \"linear\""), "Young's modulus E"},
    {"material.shear_modulus", "Pa", FIELD(law.shear_modulus), positive,
     required.if_(is_of<neo_hooke>, "required of \"neo-hooke\""),
     "shear modulus μ: W = μ/2 (I₁ - 3)"},
    {"material.c10", "Pa", FIELD(law.c10), any,
     required.if_(is_of<mooney_rivlin, yeoh>, "required of \"mooney-rivlin\", \"yeoh\""),
     "of W = c10 (I₁ - 3) + c01 (I₂ - 3), with μ = 2 (c10 + c01), or of W = c10 (I₁ - 3) + c20 (I₁ "
     "- 3)² + c30 (I₁ - 3)³, with μ = 2 c10"},
    {"material.c01", "Pa", FIELD(law.c01), any,
     required.if_(is_of<mooney_rivlin>, "required of \"mooney-rivlin\""), "likewise"},
    {"material.c20", "Pa", FIELD(law.c20), any, required.if_(is_of<yeoh>, "required of \"yeoh\""),
     "likewise"},
    {"material.c30", "Pa", FIELD(law.c30), any, required.if_(is_of<yeoh>, "required of \"yeoh\""),
     "likewise"},
    {"material.terms", "Pa, -", FIELD(law.terms), any,
     required.if_(is_of<ogden>, "required of \"ogden\""),
     "[[μ_1, α_1], ...] of W = Σ μ_i/α_i (λ₁^α_i + λ₂^α_i + λ₃^α_i - 3), with μ = ½ Σ μ_i α_i"},
    {"material.bulk_modulus", "Pa", FIELD(law.bulk_modulus), positive,
     optional.if_(is_by_bulk, "by material.poissons_ratio"),
     "of rubber: bulk modulus κ, 2/3 to 1e7 times μ; or poissons_ratio"},
    {"material.poissons_ratio", "-", FIELD(material.poissons_ratio), poisson,
     required.if_(is_linear_or_by_ratio, "required without bulk_modulus"),
     "Poisson's ratio ν; of rubber that of small strain, not below 0: κ = 2μ(1 + ν)/(3(1 - 2ν)). "
     "In plane strain above 0.49, with triangles above 0.45, there is a warning where integration "
     "is full: elements are then far too stiff"},
    {"material.density", "kg/m3", FIELD(material.density), positive, required, "density ρ"},
    {"material.plane", "-", FIELD(material.plane), one_from("strain", "stress"), optional,
     "plane strain (a wide wheel) or plane stress (a thin sheet)"},
    {"material.integration", "-", FIELD(law.integration), quadrature,
     optional.said("\"full\"; of rubber \"b-bar\""),
     "quadrature of the stiffness: \"full\" 2×2 points, of a triangle one; \"b-bar\" takes the "
     "change of volume as a mean, of the quadrilateral or of the triangles around a node, which "
     "does not lock near ν = 0.5. Rubber is by \"b-bar\" or, quadrilaterals, by \"one-point\" "
     "and a stiffness against hourglasses, which takes half the time and is less exact"},
    {"material.stress_stiffening", "-", FIELD(stress_stiffening), one_from("none", "centrifugal"),
     optional.of(in_motion_but_written),
     "\"centrifugal\": the stress of the stationary spin at the initial angular velocity stiffens "
     "the body, so that it does not soften as it spins. \"none\": small strain alone, as "
     "published"},

    {"material.viscosity[].relative_modulus",
     "-",
     FIELD(law.viscosity[k][0]),
     {{0.0, most_relative_modulus, true, false}},
     required,
     "g: shear modulus of the branch over μ, which is that of slow strains; at once there is "
     "μ (1 + Σ g)"},
    {"material.viscosity[].time", "s", FIELD(law.viscosity[k][1]), positive, required,
     "τ, in which the stress of the branch falls to 1/e. Refused below the step"},

    {"material.region[].surface", "-", FIELD(regions[k].surface), any,
     required.if_(has_surfaces, "required with a [mesh]"), "physical surface of the mesh"},
    {"material.region[].layers", "-", FIELD(regions[k].layers), between(1, 200000),
     optional.if_(is_generated, "required with a [disk]"),
     "layers of elements of the disk, 1 at the rim; those of a tread count on"},
    {"material.region[].model", "-", FIELD(regions[k].law.model), model,
     of_region.if_(has_rubber, of_region.standard),
     "its model. Where it is not that of [material], it takes nothing from there but the density"},
    {"material.region[].youngs_modulus", "Pa", FIELD(regions[k].material.youngs_modulus), positive,
     of_region.if_item(region_is_of<linear>, of_region.standard), "its Young's modulus"},
    {"material.region[].shear_modulus", "Pa", FIELD(regions[k].law.shear_modulus), positive,
     of_region.if_item(region_is_of<neo_hooke>, of_region.standard), "of its rubber"},
    {"material.region[].c10", "Pa", FIELD(regions[k].law.c10), any,
     of_region.if_item(region_is_of<mooney_rivlin, yeoh>, of_region.standard), "likewise"},
    {"material.region[].c01", "Pa", FIELD(regions[k].law.c01), any,
     of_region.if_item(region_is_of<mooney_rivlin>, of_region.standard), "likewise"},
    {"material.region[].c20", "Pa", FIELD(regions[k].law.c20), any,
     of_region.if_item(region_is_of<yeoh>, of_region.standard), "likewise"},
    {"material.region[].c30", "Pa", FIELD(regions[k].law.c30), any,
     of_region.if_item(region_is_of<yeoh>, of_region.standard), "likewise"},
    {"material.region[].terms", "Pa, -", FIELD(regions[k].law.terms), any,
     of_region.if_item(region_is_of<ogden>, of_region.standard), "likewise"},
    {"material.region[].bulk_modulus", "Pa", FIELD(regions[k].law.bulk_modulus), positive,
     of_region.if_item(region_is_rubber, of_region.standard), "likewise"},
    {"material.region[].poissons_ratio", "-", FIELD(regions[k].material.poissons_ratio), poisson,
     of_region.if_item(region_is_by_ratio, of_region.standard), "its Poisson's ratio"},
    {"material.region[].density", "kg/m3", FIELD(regions[k].material.density), positive, of_region,
     "its density"},
    {"material.region[].integration", "-", FIELD(regions[k].law.integration), quadrature,
     of_region.if_item(region_has_integration, "that of [material]; of another model, as there"),
     "its quadrature"},
    {"material.region[].viscosity", "-, s", FIELD(regions[k].law.viscosity), any,
     of_region.if_item(region_is_rubber, of_region.standard),
     "[[relative_modulus, time], ...]: branches of its rubber as those of [[material.viscosity]]; "
     "[]: none"},

    {"damping.mass", "1/s", FIELD(damping.mass), not_negative, optional.body(is_lagged),
     "α. Damps a mode of angular frequency w at the ratio α/(2w): slow motions most; of a free "
     "body it brakes flight and spin too"},
    {"damping.stiffness", "s", FIELD(damping.stiffness), not_negative, optional,
     "β. Damps it at the ratio β w/2: short waves most. It lowers the critical step"},

    {"motion.angular_velocity", "rad/s", FIELD(motion.angular_velocity), any,
     required.if_(is_held, "required if constrained and dynamic").body(never),
     "angular velocity ω of the rim; > 0 turns clockwise, which rolls towards +x. So do all "
     "angular velocities and angles of turns of a case (`initial.turn`), and `angle_rad` of "
     "history.csv, its integral"},
    {"motion.speed", "m/s", FIELD(motion.speed), any,
     required.if_(has_speed, "required if constrained and dynamic").only_in(in_time).body(never),
     "speed V of the center along x"},
    {"motion.height", "m", FIELD(motion.height), any,
     required.if_(has_height, "required if constrained and dynamic").only_in(in_time).body(never),
     "height h of the center above y = 0"},
    {"motion.start_x", "m", FIELD(motion.start_x), any, optional.if_(is_held).body(never),
     "x of the center at t = 0"},
    {"motion.gravity", "m/s2", FIELD(motion.gravity), any, optional.body(never),
     "acceleration of gravity, downwards: 9.81 on Earth"},
    {"motion.slope", "rad", FIELD(motion.slope), less_than_upright,
     optional.of(in_time_untold).body(never),
     "slope of the ground, whose axes stay those of the case: gravity is tilted by it instead, "
     "towards +x where > 0, downhill"},
    {"motion.slip_angle", "rad", FIELD(motion.slip_angle), with(slanted, "in rad: 1° is 0.01745"),
     optional.if_(is_solid).body(never),
     "of a wheel in three dimensions: angle from its heading to the velocity of the center; > 0 "
     "travels to the right as well, towards +z"},
    {"motion.camber", "rad", FIELD(motion.camber), with(slanted, "in rad: 1° is 0.01745"),
     optional.if_(is_solid).body(never),
     "likewise: angle by which the wheel leans; > 0 leans its top to the left, towards -z"},

    {"rim.free", "-",
     [](Case& c, std::size_t /*k*/)
         -> CaseMember { return ChoiceList{{&c.rim->free_x, &c.rim->free_y, &c.rim->free_spin}}; },
     one_from("speed", "height", "angular_velocity"), required,
     "what forces move: of these, `[motion]` gives the value at t = 0. The others are held, as "
     "`[motion]` says. []: all of them, for their reactions"},
    {"rim.mass", "kg/m", FIELD(rim->mass), not_negative,
     optional.said("required if speed or height is free"),
     "mass of the rim and what it carries, without the nodes that are bonded to it"},
    {"rim.inertia", "kg m", FIELD(rim->inertia), not_negative,
     optional.said("required if angular_velocity is free"),
     "moment of inertia about the center, likewise"},
    {"rim.force_x", "N/m", FIELD(rim->force_x), any, optional.if_(has_free_x).body(never),
     "force on the center, along x"},
    {"rim.force_y", "N/m", FIELD(rim->force_y), any, optional.if_(has_free_y).body(never),
     "force on the center, upwards: a load is negative"},
    {"rim.torque", "N", FIELD(rim->torque), any, optional.if_(has_free_spin).body(never),
     "torque on the rim, clockwise as angular velocities: > 0 drives towards +x, < 0 backwards"},
    {"rim.brake", "N", FIELD(rim->brake), not_negative, optional.if_(has_free_spin).body(never),
     "torque of a brake: against the spin, which it brings to rest and never reverses"},
    {"rim.support.x.stiffness", "N/m2", FIELD(rim->support_x.stiffness), not_negative,
     optional.if_(has_free_x), "of a spring between the center and a fixed place, along x"},
    {"rim.support.x.damping", "N s/m2", FIELD(rim->support_x.damping), not_negative,
     optional.if_(has_free_x).body(never), "of a dashpot beside it"},
    {"rim.support.x.at", "m", FIELD(rim->support_x.at), any,
     optional.if_(has_free_x).said("the center's x at t = 0").body(never),
     "x of the center where the spring is at rest"},
    {"rim.support.y.stiffness", "N/m2", FIELD(rim->support_y.stiffness), not_negative,
     optional.if_(has_free_y), "the same along y"},
    {"rim.support.y.damping", "N s/m2", FIELD(rim->support_y.damping), not_negative,
     optional.if_(has_free_y).body(never), "of a dashpot beside it"},
    {"rim.support.y.at", "m", FIELD(rim->support_y.at), any,
     optional.if_(has_free_y).said("the center's height at t = 0").body(never),
     "height of the center where the spring is at rest"},

    {"ground.profile", "m", FIELD(ground->shape.profile), any, required,
     "surface of the ground, see below; required where there is a `[ground]`. Of a CSV file, whose "
     "name is relative to the case file's directory, the `case.toml` of the results has the "
     "points"},
    {"ground.fillet", "m", FIELD(ground->shape.fillet), not_negative, optional.of(in_time_untold),
     "radius that rounds all convex corners; 0: they are sharp"},
    {"ground.friction", "-", FIELD(ground->friction), between(0, 100), optional.body(never),
     "Coulomb's coefficient of friction μ; 0: none"},
    {"ground.restitution", "-", FIELD(ground->restitution), between(0, 1),
     optional.of(in_time).body(never),
     "Newton's coefficient of restitution e of each node's impact; 0: a node that arrives stays "
     "until it is pulled off"},
    {"ground.impact", "-", FIELD(ground->impact), one_from("moreau", "energy-safe"),
     optional.of(in_time).body(never),
     "law of the impacts. \"moreau\": a node that arrives or leaves with w_n⁻ goes on with -e "
     "w_n⁻. \"energy-safe\": one that leaves while it is pressed is sent back no faster; no impact "
     "then creates energy at any step, but more is lost ([theory.md](theory.md), 4.3)"},

    {"contact.between", "-", FIELD(body_contact.between), one_from("none", "bodies", "all"),
     optional,
     "\"bodies\": bodies touch each other; \"all\": the boundary of a body may touch itself as "
     "well, as the walls of a groove that closes"},
    {"contact.friction", "-", FIELD(body_contact.friction), between(0, 100), optional,
     "Coulomb's coefficient of friction μ"},
    {"contact.restitution", "-", FIELD(body_contact.restitution), between(0, 1), optional,
     "Newton's coefficient of restitution e"},
    {"contact.impact", "-", FIELD(body_contact.impact), one_from("moreau", "energy-safe"), optional,
     "law of the impacts, as `ground.impact`"},

    {"load.pressure[].curve", "-", FIELD(pressures[k].curve), any, required,
     "physical curve of the mesh or section, not all of it held; of a disk \"tread\", the tops of "
     "the lands, or, where disk.rim is \"free\", \"rim\", its inner boundary; of one with a width "
     "also \"left\" and \"right\", its sides"},
    {"load.pressure[].value", "Pa", FIELD(pressures[k].pressure), any, required,
     "pressure against the outward normal, > 0 presses on the body"},

    {"initial.state", "-", FIELD(initial.state), one_from("rest", "stationary", "steady-rolling"),
     optional.body(may_be_free),
     "\"rest\": undeformed, at rest relative to the turning rim. \"stationary\": deformed, in "
     "equilibrium with the spin at t = 0. \"steady-rolling\": as it rolls on the ground with the "
     "motion at t = 0, [below](#a-start-in-steady-rolling)"},
    {"initial.velocity", "m/s", FIELD(initial.velocity), any, optional.body(may_be_free),
     "velocity added to every free node, in the fixed frame"},
    {"initial.displacement_gradient", "-", FIELD(initial.displacement_gradient), any,
     optional.body(may_be_free),
     "G, given by rows: the displacement G X is added to every free node, X its place in the "
     "undeformed body (of a free body: as placed)"},
    {"initial.position", "m", FIELD(initial.position), any,
     optional.if_(may_be_free).body(may_be_free),
     "free bodies only: they are moved by that much..."},
    {"initial.turn", "rad", FIELD(initial.turn), any, optional.if_(may_be_free).body(may_be_free),
     "... after they were turned by this angle about the origin of the mesh; > 0 turns clockwise, "
     "as `initial.angular_velocity` does"},
    {"initial.angle", "rad", FIELD(initial.angle), any,
     optional.if_(never, "0, or minus initial.turn").body(may_be_free),
     "the key of earlier versions for −`initial.turn`, counter-clockwise: taken, with a warning, "
     "and written as `initial.turn`"},
    {"initial.angular_velocity", "rad/s", FIELD(initial.angular_velocity), any,
     optional.if_(may_be_free).body(may_be_free),
     "free bodies only: each turns about its center of mass, signed as `motion.angular_velocity`"},

    {"initial.region[].surface", "-", FIELD(initial.regions[k].surface), any,
     required.if_(may_be_free).body(may_be_free),
     "physical surface of the mesh: its free bodies..."},
    {"initial.region[].velocity", "m/s", FIELD(initial.regions[k].velocity), any,
     optional.if_(may_be_free, "that of [initial]").body(may_be_free),
     "... have this velocity of their centers of mass"},
    {"initial.region[].angular_velocity", "rad/s", FIELD(initial.regions[k].angular_velocity), any,
     optional.if_(may_be_free, "that of [initial]").body(may_be_free),
     "... and turn about them like this, signed likewise"},

    {"analysis.kind", "-", FIELD(analysis.kind), kind_of_analysis(), optional,
     "\"dynamic\": the body moves as `[motion]` says, over `[time]`. \"crush\": the body is "
     "pressed on flat ground without turning, slowly. \"steady-rolling\": the state that rolling "
     "at "
     "constant spin settles in, solved directly; see [steady rolling](#steady-rolling)"},
    {"analysis.depth", "m", FIELD(analysis.depth),
     over_increments(with(not_negative, "< disk.outer_radius - disk.inner_radius")),
     required.of(of_crush).said("required if crush").body(never),
     "how far the center is below the place where the undeformed body first touches the ground: a "
     "number > 0, come to in equal parts, or a table over the number of the increment; refused in "
     "a dynamic case"},
    {"analysis.increments", "-", FIELD(analysis.increments), between(1, 1000000),
     required.of(of_crush).said("required if crush").body(never),
     "equal parts of the depth, each an equilibrium; all increments where it is a table; refused "
     "in "
     "a dynamic case"},
    {"analysis.slide", "m", FIELD(analysis.slide), over_increments(any),
     optional.of(of_crush).if_(has_slide, "none").body(never),
     "how far the center of a crush moves along +x, without turning: a number, after the pressing "
     "and at the full depth, or a table beside one of the depth; refused in a dynamic case"},
    {"analysis.slide_increments", "-", FIELD(analysis.slide_increments), between(1, 1000000),
     optional.of(of_crush).if_(has_slide_increments, "required if slide is a number").body(never),
     "equal parts of a slide that is a number, each an equilibrium; refused beside tables and in a "
     "dynamic case"},

    {"analysis.solver", "-", FIELD(analysis.solver), one_from("direct", "latin", "latin-pgd"),
     optional.of(of_crush).body(never),
     "how the increments of a crush are solved. \"direct\": one after another, exactly. \"latin\": "
     "all at once, by iterations between the laws of contact and elasticity; \"latin-pgd\": "
     "likewise, with the field in modes that are found on the way. Of linear "
     "materials alone; the same results to about `tolerance`"},
    {"analysis.search_direction", "N/m2", FIELD(analysis.search_direction), not_negative,
     optional.of(of_crush).if_(is_latin).body(never),
     "of \"latin\" and \"latin-pgd\": stiffness that joins forces and gaps on the way. 0: chosen. "
     "It changes how many iterations there are; what they come to, within `tolerance`"},
    {"analysis.relaxation", "-", FIELD(analysis.relaxation), share,
     optional.of(of_crush).if_(is_latin).body(never),
     "of \"latin\" and \"latin-pgd\": part of the way to what an iteration finds"},
    {"analysis.tolerance", "-", FIELD(analysis.tolerance), between(1e-12, 0.1),
     optional.of(of_crush).if_(is_latin).body(never),
     "of \"latin\" and \"latin-pgd\": of the indicator and the residual that end the iterations"},
    {"analysis.downsizing", "-", FIELD(analysis.downsizing), between(0.0, 3.0),
     optional.of(of_crush).if_(is_latin_pgd, "0.3; 1.0 with a slide").body(never),
     "of \"latin-pgd\": modes are dropped whose part is below 0.3 of this times the indicator. 0: "
     "all are kept"},

    {"analysis.samples_per_sector", "-", FIELD(analysis.samples_per_sector), between(1, 1000),
     optional.of(of_steady_rolling).body(never),
     "places of a sector, over its own length, at which steady rolling is solved; where it is "
     "left out 16 with a `[disk.tread]`; 4 of a wheel in three dimensions, 8 with a "
     "`[disk.tread]`, 2 of a `[section]`"},
    {"analysis.slip", "-", FIELD(analysis.slip), one_from("bdf2", "upwind"),
     optional.of(of_steady_rolling).body(never),
     "how the slip of a node is taken in steady rolling: from its places one and two samples "
     "before, or from one alone, which is more robust and coarser"},
    {"analysis.massless_contact", "-", FIELD(analysis.massless_contact), any,
     optional.of(of_steady_rolling).body(never),
     "the mass of the contact nodes is moved to the nodes below them. false: only with "
     "`samples_per_sector = 1`"},
    {"analysis.accept_scheme_power", "-", FIELD(analysis.accept_scheme_power), any,
     optional.of(of_steady_rolling).body(never),
     "a state is a result even where the discretisation makes or takes more than a quarter of the "
     "largest power and more than 1e-4 of load times speed "
     "([steady.md](steady.md#the-power-of-the-discretisation)): for forces and "
     "footprints, whose rolling resistance means nothing then"},
    {"analysis.load", "N/m", FIELD(analysis.load), positive,
     optional.of(of_steady_rolling).if_(has_load, "none").body(never),
     "force of the ground on the steadily rolling body, upwards, instead of `motion.height`"},
    {"analysis.traction", "N/m", FIELD(analysis.traction), any,
     optional.of(of_steady_rolling).if_(has_traction, "none").body(never),
     "force of the ground along +x, instead of `motion.speed`; < 0 brakes"},
    {"analysis.torque", "N", FIELD(analysis.torque), any,
     optional.of(of_steady_rolling).if_(has_torque, "none").body(never),
     "torque on the rim, clockwise as angular velocities, instead of `motion.speed`: > 0 drives "
     "towards +x. At constant spin it is balanced by the torque of the ground about the center, "
     "counter-clockwise and as large. 0: free rolling"},

    {"time.end", "s", FIELD(time.end), positive,
     required.said("required if dynamic").body(never).free_on_resume(),
     "end of the run, which starts at t = 0"},
    {"time.safety", "-", FIELD(time.safety), with(share, "not together with time.step"),
     optional.if_(is_by_safety).body(never),
     "time-step factor: step over the critical step; of the scheme \"hati\" those of its fine "
     "part. With rubber 0.85 where it is left out"},
    {"time.step", "s", FIELD(time.step), with(positive, "not together with time.safety"),
     optional.if_(is_by_step, "none").body(never),
     "a given time step instead, of the scheme \"hati\" the fine one; at most 1e12 steps to the "
     "end"},
    {"time.scheme", "-", FIELD(time.scheme), one_from("symplectic", "as-printed", "hati"), optional,
     "\"symplectic\": gyroscopic and mass damping forces at the middle of the step; keeps energy. "
     "\"as-printed\": at the old half step, as published; it creates energy, which the ledger "
     "shows as `work_scheme`, and serves for comparison. \"hati\": two parts of the body, each "
     "with a step of its own, [below](#two-parts-with-steps-of-their-own). The ledger closes in "
     "all of them"},

    {"solver.operator", "-", FIELD(solver_operator), one_from("auto", "cyclic", "sparse"),
     optional.of(in_time),
     "how K u is formed: \"cyclic\" from the blocks of one sector, \"sparse\" from an assembled "
     "matrix; \"auto\" takes \"cyclic\" on every mesh of equal sectors, that is on every `[disk]`, "
     "but where it is free, there is a `[contact]` of bodies, some part is rubber, or "
     "`time.scheme` "
     "is not \"symplectic\": there \"cyclic\" is refused. The results are the same to round-off "
     "(docs/performance.md)"},
    {"solver.contact_mass", "-", FIELD(contact_mass),
     one_from("lumped", "singular", "singular-kept"), optional.of(in_time),
     "mass of the nodes that may touch the ground. \"lumped\": theirs. \"singular\": none; it goes "
     "to "
     "the nodes below, and the contact nodes are where stiffness and ground leave them "
     "([theory](theory.md), 3.10): impacts lose and excite next to nothing, gaps are kept, and the "
     "step may be longer. \"singular-kept\": besides, all masses are multiplied by 1 + a + b·X + "
     "d|X|² so that center and inertia of the body stay. Needs a `[ground]` without sharp convex "
     "corners, and is refused with restitution, `[contact]` of bodies, `[rim]`, free bodies and "
     "another scheme than \"symplectic\""},
    {"solver.contact_iterations", "-", FIELD(contact_iterations), between(1, 1000000000),
     optional.of(in_time).body(never),
     "most iterations of contacts that share nodes and are solved together (sharp corners of the "
     "ground, bodies on each other). One that does not meet the law by then is counted in "
     "`run.json`, and its residual ends the run"},
    {"solver.dump_contacts", "-", FIELD(dump_contacts), between(0, 1000000000),
     optional.of(in_time).body(never),
     "such problems that took more iterations than this are kept as files in `contact-problems/` "
     "of the results directory, for those who improve the solver; 0: none"},

    {"solver.implicit[].slower_than", "s", FIELD(implicit[k].slower_than), positive,
     optional.said("none"),
     "elements whose own critical step is below this are implicit in the explicit step. One of "
     "slower_than, layers and region chooses the elements of a table; several tables add up"},
    {"solver.implicit[].layers", "-", FIELD(implicit[k].layers), between(1, 200000),
     optional.said("none"), "these layers of elements of a `[disk]`, 1 at the rim"},
    {"solver.implicit[].region", "-", FIELD(implicit[k].region), any, optional.said("none"),
     "the elements of this physical surface of a `[mesh]`"},

    {"solver.hati.ratio", "-", FIELD(hati->ratio), between(1, 1000), required,
     "m: fine steps in a coarse one. Nodes that may touch the ground must be at least m elements "
     "away from the elements that are not fine"},
    {"solver.hati.fine.layers", "-", FIELD(hati->fine.layers), between(1, 200000),
     optional.if_(has_fine_layers, "none"),
     "of a `[disk]`: the layers of elements, 1 at the rim, that are explicit, in fine steps; all "
     "others are implicit, in coarse ones"},
    {"solver.hati.fine.region", "-", FIELD(hati->fine.region), any,
     optional.if_(has_fine_region, "none"),
     "of a `[mesh]`: the physical surface whose elements are"},

    {"output.history_interval", "s", FIELD(output.history_interval), not_negative,
     optional.of(in_time).body(never),
     "time between rows of `history.csv`; forces are means over it. 0: a row every step"},
    {"output.snapshots", "-", FIELD(output.snapshots), between(0, 1000000),
     optional.of(in_time).body(never),
     "number of fields kept, evenly spread over [snapshots_from, end], both ends included"},
    {"output.snapshots_from", "s", FIELD(output.snapshots_from), with(not_negative, "<= time.end"),
     optional.of(in_time).body(never), "time of the first snapshot"},
    {"output.stress", "-", FIELD(output.stress), any, optional.body(never),
     "keep the stress with the snapshots"},
    {"output.checkpoint_interval", "s", FIELD(output.checkpoint_interval), positive,
     optional.body(never).free_on_resume(),
     "wall time between checkpoints (docs/results.md, [Resuming a "
     "run](results.md#resuming-a-run)); there is one at the end and at a signal anyway. A "
     "crush writes none"},

    {"output.probe[].name", "-", FIELD(output.probes[k].name), any, required,
     "name of its columns: letters, digits, _ and -"},
    {"output.probe[].position", "m", FIELD(output.probes[k].position), any, required,
     "where it is in the undeformed mesh, before free bodies are placed; a point in no cell is "
     "refused with the distance of the nearest"},
};

#undef FIELD
#undef CHOICE

}  // namespace

std::span<const CaseKey> case_keys() noexcept {
  return keys;
}

}  // namespace rondo::study
