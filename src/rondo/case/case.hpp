// SPDX-License-Identifier: BSD-3-Clause
/// @file  A case: the contents of the user's file, validated, as plain structs (docs/cases.md).
#pragma once
#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rondo/case/analysis_kinds.hpp"
#include "rondo/case/inflation_case.hpp"
#include "rondo/contact/friction_table.hpp"
#include "rondo/contact/ground.hpp"
#include "rondo/contact/law.hpp"
#include "rondo/contact/obstacle.hpp"
#include "rondo/core/error.hpp"
#include "rondo/fem/elasticity.hpp"
#include "rondo/mesh/disk.hpp"
#include "rondo/model/motion.hpp"
#include "rondo/model/rim_body.hpp"
#include "rondo/model/scheme.hpp"

namespace rondo::road {
struct Road;
}

namespace rondo::study {

struct Damping {
  double mass = 0.0;       ///< α >= 0 [1/s]
  double stiffness = 0.0;  ///< β >= 0 [s]
};

/// A Gmsh file instead of a generated disk; all names are those of physical groups.
struct MeshCase {
  std::filesystem::path file;        ///< absolute, or relative to the working directory
  double scale = 1.0;                ///< m per unit of length of the file
  std::vector<std::string> clamped;  ///< physical curves that are clamped
  std::string contact;               ///< physical curve of candidates; empty: none
};

/// The keys that make a generated disk a wheel in three dimensions (docs/wheel3d.md).
struct WheelCase {
  std::optional<double> width;         ///< along the axle; absent: the body is plane     [m]
  int axial = 4;                       ///< elements over the width
  std::optional<double> crown_radius;  ///< of the tread's section; absent: flat               [m]
  std::vector<std::array<double, 2>> grooves;  ///< around the wheel: z of the middle, width [m]
};

/// The section of a wheel in three dimensions in r and z, used instead of a generated disk.
struct SectionCase {
  MeshCase mesh;  ///< its x is r, its y is z
  int sectors = 180;
};

/// Largest modulus of a viscous branch, relative to the shear modulus at slow strains.
inline constexpr double most_relative_modulus = 1e6;

enum class MaterialModel { linear, neo_hooke, mooney_rivlin, yeoh, ogden };
enum class Quadrature { full, b_bar, one_point };

/// The material keys other than E, ν and ρ. For rubber, fem::Material::rubber, E and ν follow from
/// them (fill_material). Keys of other models have no meaning.
struct MaterialLaw {
  MaterialModel model = MaterialModel::linear;
  double shear_modulus = 0.0;                         ///< of "neo-hooke"                 [Pa]
  double c10 = 0.0, c01 = 0.0, c20 = 0.0, c30 = 0.0;  ///< of laws that have them    [Pa]
  std::vector<std::array<double, 2>> terms;           ///< of "ogden": μ_i [Pa], α_i
  std::optional<double> bulk_modulus;                 ///< of rubber; absent: ν given    [Pa]
  Quadrature integration = Quadrature::full;
  std::vector<std::array<double, 2>> viscosity;  ///< relative modulus, time [s]
  double loss_factor = 0.0;                      ///< tan δ in the band; 0: `viscosity` instead
  Vec2 loss_band;                                ///< its lowest and highest frequency  [Hz]

  [[nodiscard]] bool is_rubber() const noexcept { return model != MaterialModel::linear; }
};

/// Material of a part of the body that differs from [material].
struct MaterialRegion {
  std::string surface;      ///< for a mesh: physical surface
  std::vector<int> layers;  ///< for a disk: layers of elements, 1 at the rim
  fem::Material material;
  MaterialLaw law;
};

enum class StressStiffening { none, centrifugal };

/// Which bodies' boundaries touch each other.
enum class BodyContact { none, bodies, all };  ///< all: a body may also touch itself

struct BodyContactCase {
  BodyContact between = BodyContact::none;
  double friction = 0.0;     ///< μ >= 0
  double restitution = 0.0;  ///< e in [0, 1]
  contact::Impact impact = contact::Impact::moreau;
};

struct PressureCase {
  std::string curve;         ///< physical curve
  dynamics::Table pressure;  ///< opposite to the outward normal [Pa]
};

/// A point of the reference configuration; history.csv contains its motion and stress.
struct Probe {
  std::string name;  ///< used in the names of its columns
  Vec2 position;     ///< [m]
};

/// A measured road. Its section along u is the ground of a plane body (docs/roads.md, section 3):
/// the reader makes the points of the ground from it, and a case as written has only the points.
/// Its smooth surface is the ground of a wheel in three dimensions (section 4).
struct RoadCase {
  std::string file;             ///< as written, relative to the case file's directory; of a wheel
                                ///< in three dimensions with this directory; empty: none
  std::optional<double> start;  ///< u at x = 0; the reader sets it to what it is by default  [m]
  double offset = 0.0;          ///< v of the section, or of the wheel's middle plane         [m]
  std::string border;           ///< "keep", "zero" or "repeat"; empty: that of the file
  std::shared_ptr<const road::Road> read{};  ///< the contents of the file; null: none is read
  double height = 0.0;                       ///< in the file at x = 0: the ground has 0 there [m]
};

struct GroundCase {
  std::vector<Vec2> profile = contact::GroundShape{}.profile;  ///< without the obstacles     [m]
  double fillet = 0.0;                                         ///< of the profile            [m]
  RoadCase road;
  std::vector<contact::Obstacle> obstacles;
  // Made by the reader from the profile and the obstacles:
  contact::GroundShape shape;  ///< normal to the edges of the obstacles
  double edge_angle = 0.0;     ///< of these, across the track of a wheel with a width         [rad]
  /// The obstacles are not in `shape`, which is flat then: each is in axes of its own, on a road or
  /// a profile (contact/space/obstacle_ground.hpp).
  bool has_own_axes = false;
  contact::FrictionTable friction;
  double restitution = 0.0;  ///< e in [0, 1]
  contact::Impact impact = contact::Impact::moreau;
};

enum class RollingSlip { bdf2, upwind };

/// Which harmonics of steady rolling accelerate the masses.
enum class RollingMasses { all, waves, none };

/// Solution of the increments of a crush: one after another, or all at once by iterations.
enum class CrushMethod { direct, latin, latin_pgd };

struct AnalysisCase {
  AnalysisKind kind = AnalysisKind::dynamic;
  // Keys of a crush: numbers, or tables over the number of the increment (CrushPath).
  dynamics::Table depth{};   ///< of the center below first touch, >= 0                         [m]
  int increments = 0;        ///< >= 1
  dynamics::Table slide{};   ///< of the center along +x; a number acts after pressing          [m]
  int slide_increments = 0;  ///< >= 1 if the slide is a number other than 0, else 0
  CrushMethod solver = CrushMethod::direct;
  double search_direction = 0.0;  ///< of LATIN; 0: automatic            [N/m²]
  double relaxation = 0.8;        ///< of LATIN, in (0, 1]
  double tolerance = 1e-3;        ///< of LATIN
  double downsizing = 0.3;        ///< of LATIN-PGD, of the modes that are kept; 0: none
  // Keys of steady rolling:
  int samples_per_sector = 8;                  ///< P >= 1
  RollingSlip slip = RollingSlip::bdf2;        ///< discretisation of the slip
  RollingMasses inertia = RollingMasses::all;  ///< default with [inflation]: waves
  bool estimate_slip_error = false;            ///< default with [inflation]: true
  bool massless_contact = true;                ///< always the case with more than one sample
  bool accept_scheme_power = false;            ///< a large power of the discretisation is no fault
  std::optional<double> load{};  ///< F_y > 0, instead of height or depth                   [N/m]
  double turn_slip = 0.0;        ///< φ: yaw rate of the path over the speed, > 0 to the left [1/m]
  // A step of the slip of a wheel that rolls steadily, after which it rolls on:
  std::optional<double> slip_angle_step{};  ///< instead of slip_ratio_step; none: no step [rad]
  std::optional<double> slip_ratio_step{};  ///< instead of slip_angle_step; none: no step      [-]
  std::optional<double> step_distance{};    ///< > 0; given with a step                         [m]
  std::optional<double> traction{}, torque{};  ///< F_x, or clockwise torque on the rim, instead of
                                               ///< the speed                             [N/m], [N]
};

enum class InitialState { rest, stationary, steady_rolling };

/// Rigid motion of the free bodies of a physical surface at t = 0, used instead of [initial].
struct InitialRegion {
  std::string surface;
  Vec2 velocity;                  ///< of the center of mass [m/s]
  double angular_velocity = 0.0;  ///< about it, > 0 clockwise [rad/s]
};

struct Initial {
  InitialState state = InitialState::rest;
  Vec2 velocity;  ///< added to every free node, fixed frame [m/s]
  std::array<std::array<double, 2>, 2> displacement_gradient{};  ///< u0 += G X on free nodes [-]
  // A free mesh is first turned by `turn` about the origin, then moved by `position`.
  Vec2 position;                  ///< [m]
  double turn = 0.0;              ///< > 0 clockwise, as `angular_velocity` [rad]
  double angle = 0.0;             ///< as given: minus `turn`; 0 after reading the case [rad]
  double angular_velocity = 0.0;  ///< of each body about its center of mass, > 0 clockwise [rad/s]
  std::vector<InitialRegion> regions;
};

/// Mass of contact nodes on the ground: lumped, none, or none with center and inertia conserved.
enum class ContactMass { lumped, singular, singular_kept };

using dynamics::Scheme;

/// A selection of elements of a body by one of three criteria.
struct ElementChoice {
  std::optional<double> slower_than;  ///< elements whose own critical step is below this [s]
  std::vector<int> layers;            ///< for a disk: layers of elements, 1 at the rim
  std::string region;                 ///< physical surface of a mesh
};

/// Default of time.safety if some part is rubber.
inline constexpr double rubber_safety = 0.85;

/// Keys of the scheme "hati": which elements are explicit with fine steps.
struct HatiCase {
  ElementChoice fine;  ///< by layers or region
  int ratio = 1;       ///< m >= 1 fine steps in a coarse one
};

struct Time {
  double end = 0.0;            ///< > 0 [s]
  double safety = 0.8;         ///< step / critical step, 0 < safety <= 1; rubber: rubber_safety
  std::optional<double> step;  ///< given step, for "hati" the fine one [s]; excludes safety
  Scheme scheme = Scheme::symplectic;
};

struct Output {
  double history_interval = 1.0e-4;  ///< [s]; 0: every step
  int snapshots = 400;               ///< >= 0
  double snapshots_from = 0.0;       ///< [s], in [0, end]
  bool stress = true;
  bool friction_work = false;
  std::vector<Probe> probes;
  double checkpoint_interval = 60.0;  ///< [s of wall time]
};

/// The place of a given key in the file; line 0: by --set.
struct KeyPlace {
  std::string file;
  int line = 0, column = 0;
  std::string written;  ///< the value as the user wrote it
};

/// Keys without a meaning for an analysis have their defaults here, whatever the file says. For a
/// crush these are damping, motion, initial state, time, restitution, fillet and output times.
struct Case {
  std::filesystem::path file;
  std::map<std::string, KeyPlace> places;  ///< of the given keys, by dotted key
  int schema = 1;                          ///< version of the format
  std::string title;
  mesh::Disk disk;                     ///< unused if there is a mesh
  bool free_rim = false;               ///< of a disk: its inner boundary is not clamped
  WheelCase wheel;                     ///< of the disk
  std::optional<MeshCase> mesh;        ///< instead of the disk
  std::optional<SectionCase> section;  ///< instead of the disk
  fem::Material material;
  MaterialLaw law;  ///< of the material
  std::vector<MaterialRegion> regions;
  StressStiffening stress_stiffening = StressStiffening::none;
  std::vector<CordsCase> cords;
  std::optional<InflationCase> inflation;  ///< absent: no finite strain at rest
  std::vector<PressureCase> pressures;
  Damping damping;
  dynamics::Motion motion;
  std::optional<dynamics::RimBody> rim;  ///< absent: the rim follows its tables
  std::optional<GroundCase> ground;      ///< absent: no contact
  BodyContactCase body_contact;
  Initial initial;
  AnalysisCase analysis;
  Time time;
  std::string solver_operator = "auto";  ///< "auto" | "cyclic" | "sparse"
  std::vector<ElementChoice> implicit;   ///< elements treated implicitly in the explicit step
  ContactMass contact_mass = ContactMass::lumped;
  std::optional<HatiCase> hati;    ///< present if time.scheme is "hati"
  int contact_iterations = 10000;  ///< largest number for a coupled contact problem
  int dump_contacts = 0;  ///< contact problems with more iterations are written to files; 0: none
  Output output;
  std::vector<std::string> warnings;  ///< found while reading; the caller prints them

  // These are compiled once; each would take 10 kB in every file that copies a case.
  Case();
  ~Case();
  Case(const Case&);
  Case(Case&&) noexcept;
  Case& operator=(const Case&);
  Case& operator=(Case&&) noexcept;
};

/// Whether something is clamped in the co-rotating frame, so that there is a motion of the rim.
inline bool is_held(const Case& c) {
  return c.mesh ? !c.mesh->clamped.empty() : !c.free_rim;
}

/// Whether the body is a wheel in three dimensions.
inline bool is_solid(const Case& c) {
  return c.wheel.width.has_value() || c.section.has_value();
}

/// Spin of the state about which an inflated wheel moves. @pre it is inflated            [rad/s]
inline double spin_at_rest(const Case& c) {
  return c.inflation->spin ? *c.inflation->spin : c.motion.angular_velocity.at(0.0);
}

/// Whether the body is a [disk], in the plane or with a width.
inline bool is_generated(const Case& c) {
  return !c.mesh && !c.section;
}

/// The key that gives the ground its shape. @pre there is ground
inline const char* base_ground_key(const Case& c) {
  return c.ground->road.read ? "ground.road" : "ground.profile";
}
/// The key that changes the shape of the ground last: the one of its obstacles, if there are any.
inline const char* ground_key(const Case& c) {
  return c.ground->obstacles.empty() ? base_ground_key(c) : "ground.obstacle";
}

/// Whether the friction of the ground is written as a table, not as a number.
inline bool has_friction_table(const Case& c) {
  return c.ground &&
         (!c.ground->friction.slip.empty() || c.ground->friction.pressure_exponent != 0.0);
}

/// Whether the ground is the surface of a road, under a wheel in three dimensions.
inline bool is_on_road_surface(const Case& c) {
  return c.ground && c.ground->road.read && is_solid(c);
}

/// Whether obstacles stand each at an angle of its own, or on a road, under such a wheel.
inline bool has_obstacles_of_own_axes(const Case& c) {
  return c.ground && c.ground->has_own_axes;
}

/// The Gmsh file that the body comes from; null: it is generated.
inline const MeshCase* mesh_file_of(const Case& c) {
  return c.mesh ? &*c.mesh : c.section ? &c.section->mesh : nullptr;
}
inline MeshCase* mesh_file_of(Case& c) {
  return c.mesh ? &*c.mesh : c.section ? &c.section->mesh : nullptr;
}

/// Whether a body may be unconstrained; for a mesh, this is known only from its cells.
inline bool may_be_free(const Case& c) {
  return c.mesh.has_value() || c.free_rim;
}

/// Whether some part of the body has a law of rubber.
bool has_rubber_law(const Case& c) noexcept;

/// Whether some part of the body is rubber that moves at finite strain: not in a wheel that is
/// linear about its inflated state.
inline bool has_rubber(const Case& c) noexcept {
  return !c.inflation && has_rubber_law(c);
}

/// Whether the law of some part is for large strains and is used as such: of rubber, and of a tyre
/// whose rubber is nonlinear, if only near the ground.
inline bool has_large_strains(const Case& c) noexcept {
  return has_rubber(c) || (c.inflation && c.inflation->nonlinear >= TyreMotion::window);
}

/// Reads and validates. `settings` are the "a.b=value" of --set, applied before validation; a value
/// that is not TOML is taken as a string. @throws InputError with every fault, in the file's order.
Case read_case(const std::filesystem::path& file, const std::vector<std::string>& settings = {});
/// Reads the text of a case, whose file need not exist; messages call it `file`.
Case read_case_text(const std::filesystem::path& file, std::string text,
                    const std::vector<std::string>& settings = {});

/// The case as TOML with all defaults written out; reading it again gives bitwise the same case.
std::string write_case(const Case& c);

/// The key of the largest of the disk's numbers of layers and columns.
std::string_view largest_count(const mesh::Disk& disk) noexcept;

/// A fault found only once the case is complete; it is reported at the place of its key, else at
/// that of its table.
InputError case_error(const Case& c, const std::string& key, const std::string& message,
                      const std::string& allowed);

}  // namespace rondo::study
