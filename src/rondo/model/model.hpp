// SPDX-License-Identifier: BSD-3-Clause
/// @file  Model and state of a run. The model does not change during the run; the size of the state
/// is set once.
#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "rondo/contact/ground.hpp"
#include "rondo/contact/law.hpp"
#include "rondo/contact/space/space_ground.hpp"
#include "rondo/core/field.hpp"
#include "rondo/fem/assembly.hpp"
#include "rondo/fem/finite/swept_forces.hpp"
#include "rondo/fem/finite/swept_rubber.hpp"
#include "rondo/fem/sector_stiffness.hpp"
#include "rondo/fem/viscosity.hpp"
#include "rondo/mesh/mesh.hpp"
#include "rondo/model/motion.hpp"
#include "rondo/model/rim_body.hpp"
#include "rondo/model/scheme.hpp"
#include "rondo/model/subdomains.hpp"

namespace rondo::dynamics {

/// Contact candidates and the objects that they may touch.
struct ContactModel {
  contact::Ground ground;
  contact::Law law;
  std::vector<int> nodes;         ///< (nb) candidates; none is clamped
  std::vector<double> tributary;  ///< (nb) boundary length of each [m]
  /// Edges between candidates (nodes), which corners of the ground may touch; in three dimensions
  /// only the edges around the wheel.
  std::vector<mesh::Edge> edges{};
  contact::EdgeAxes axes{};  ///< of the edges of `ground`, in three dimensions
  /// In three dimensions: the ground, if it is not `ground` extruded along its edges, which is then
  /// flat.
  /// It is asked by the functions of solid/wheel_ground.hpp.
  std::shared_ptr<const contact::SpaceGround> space{};
};

/// An unconstrained body. It moves in the fixed frame, where u is its whole displacement x - X;
/// strains refer to the frame of its mean rotation (docs/theory.md, section 9).
struct FreeBody {
  std::vector<int> nodes;  ///< ascending
  double mass = 0.0;       ///< [kg/m]
  Vec2 center;             ///< center of mass in X                             [m]
};

/// Contact between boundaries of deformable bodies, node to segment.
struct SurfaceContact {
  std::vector<int> nodes;         ///< (nb) candidates, numbered like those of the ground
  std::vector<double> tributary;  ///< (nb)                                           [m]
  std::vector<mesh::Edge> edges;  ///< between candidates
  bool self = false;              ///< whether a body's boundary may also touch itself
  contact::Law law;
};

/// Pressure on a part of the boundary, opposite to the outward normal of the edges.
struct PressureLoad {
  std::vector<mesh::Edge> edges;
  Table pressure;  ///< [Pa]
};

/// When a coupled contact problem counts as difficult, and the limit of its iterations.
struct CoupledSettings {
  int most_iterations = 10000;
  int dump_above = 0;  ///< keep problems that took more iterations than this; 0: none
};

/// The product with K that a run uses.
enum class StiffnessOperator {
  cyclic,  ///< one sector's blocks, on meshes of equal sectors
  sparse,  ///< assembled 2×2 block rows, on any mesh
};

/// "cyclic" or "sparse".
inline const char* operator_name(StiffnessOperator which) noexcept {
  return which == StiffnessOperator::cyclic ? "cyclic" : "sparse";
}

/// Elements that are treated implicitly in the explicit step (docs/theory.md, 3.9).
struct ImplicitPart {
  fem::BlockCsr stiffness;  ///< K_I: of these elements alone, on all nodes                 [N/m²]
  std::vector<int> nodes;   ///< their free nodes, ascending
};

/// Quadrilaterals of rubber at finite strain (docs/rubber.md).
struct RubberPart {
  std::vector<mesh::Cell> cells;
  std::vector<int> material;  ///< (cells) index in `materials`
  std::vector<fem::Rubber> materials;
  fem::BlockCsr linear;  ///< K of all other elements, on the free nodes; as many rows [N/m²]
};

/// Pressure on a part of the surface of a wheel.
struct SolidPressure {
  std::vector<Vec3> force;  ///< (n_local) force per unit of pressure on each row of a sector,
                            ///< radial, tangential, axial; on the reference X              [m²]
  Table pressure;           ///< [Pa]
  bool of_rest = false;     ///< of the state about which the wheel is linear: inner forces, whose
                            ///< moment a rim that moves feels; `force` in N, `pressure` 1
};

/// Cords and air of a wheel whose forces are not linear about its state, K of the rubber alone, and
/// what the rubber has beyond that in a window of columns.
struct SweptPart {
  fem::finite::SweptFaces faces;
  fem::SolidSector sector;                           ///< [N/m]
  std::optional<fem::finite::SweptRubber> rubber{};  ///< absent: it is linear
  fem::finite::ColumnWindow window{};
};

/// Additional data of a wheel in three dimensions (docs/wheel3d.md). The fields of its state have
/// three components; masses are in kg, forces in N, energies in J, tributaries in m². It is cyclic,
/// clamped at its rim, and touches the ground of
/// solid/wheel_ground.hpp.
struct SolidBody {
  std::vector<double> axial;  ///< (n) z of X                                 [m]
  fem::SolidSector sector;    ///< K of one sector                            [N/m]
  std::vector<SolidPressure> pressures;
  std::optional<SweptPart> swept{};                           ///< absent: all forces are K u
  std::vector<fem::ViscousPart<fem::SolidSector>> viscous{};  ///< beside K; empty: none

  /// K of all that is linear.
  [[nodiscard]] const fem::SolidSector& linear() const noexcept {
    return swept ? swept->sector : sector;
  }
};

class FrictionWork;
class InternalForce;
struct Model;
struct Pose;

/// Has the parameters of make_internal_force() (internal_force.hpp).
using InternalForceMaker = std::function<std::unique_ptr<InternalForce>(
    const Model& model, std::span<const Vec2> u0, std::span<const Pose> poses)>;

struct Model {
  std::vector<Vec2> reference;        ///< (n) X                        [m]
  std::vector<double> mass;           ///< (n) lumped; 0 at contact nodes if
                                      ///< lumped_mass is given           [kg/m]
  std::vector<double> lumped_mass{};  ///< (n) for massless candidates of the ground: the mass
                                      ///< they would have; empty: mass itself [kg/m]
  std::vector<int> free;              ///< nodes that are not clamped, ascending
  fem::BlockCsr stiffness;            ///< K on the free nodes, or empty [N/m²]
  InternalForceMaker internal_force;  ///< of a material other than K's; empty: that of K
  std::vector<fem::ViscousPart<fem::BlockCsr>> viscous;  ///< beside K, plane; empty: none
  std::optional<fem::SectorStiffness> sector;            ///< K of one sector; absent: not cyclic
  std::optional<ImplicitPart> implicit;                  ///< absent: all elements are explicit
  /// For rubber, the data of the fused step; internal_force is then set as well, and `stiffness` is
  /// that of small strains.
  std::optional<RubberPart> rubber;
  std::optional<SolidBody> solid;  ///< absent: the body is plane
  StiffnessOperator stiffness_operator = StiffnessOperator::sparse;
  double mass_damping = 0.0;       ///< α                            [1/s]
  double stiffness_damping = 0.0;  ///< β                            [s]
  Motion motion;
  std::optional<RimBody> rim;  ///< absent: the rim follows its tables
  std::optional<ContactModel> contact;
  std::vector<FreeBody> free_bodies;       ///< empty: everything moves in the co-rotating frame
  std::vector<int> free_body;              ///< (n) index in free_bodies, -1: co-rotating frame;
                                           ///< empty: no free body
  std::vector<int> body;                   ///< (n) number of each node's body; empty: there is one
  std::optional<SurfaceContact> surfaces;  ///< absent: bodies do not touch each other
  std::vector<PressureLoad> pressures;
  CoupledSettings coupled;
  /// Receives what friction takes in every step (friction_work.hpp); null: nobody asks.
  std::shared_ptr<FrictionWork> friction_work;
  Scheme scheme = Scheme::symplectic;
  std::optional<Subdomains> subdomains;  ///< only with the scheme "hati"
  double dt = 0.0;                       ///< Δt; with "hati" the coarse step  [s]
  int threads = 1;

  [[nodiscard]] std::size_t n_nodes() const noexcept { return reference.size(); }
  /// Components of a vector at a node: 2 in the plane, 3 in space.
  [[nodiscard]] std::size_t components() const noexcept { return solid ? 3 : 2; }
};

/// Mean position and rotation of a free body.
struct Pose {
  Vec2 center;                 ///< of mass                                         [m]
  Complex rotation{1.0, 0.0};  ///< e^{iθ}
  double angle = 0.0;          ///< θ, counter-clockwise, including whole turns       [rad]
};

template <class Work>
void for_free_nodes(const Model& model, Work&& work) {
  for (const int node : model.free) work(static_cast<std::size_t>(node));
}

/// A contact of the step just made, in its own frame: along the normal and J n, in three dimensions
/// along the normal, the tangent and the line of `space`.
struct ActiveContact {
  std::size_t candidate = 0;  ///< index in ContactModel::nodes
  Vec2 normal;                ///< of plane bodies, out of the ground, fixed frame
  contact::SpaceFrame space;  ///< in three dimensions
  double gap = 0.0;           ///< at t_{n+1}, <= 0                             [m]
  Vec3 before;                ///< w⁻: relative velocity of the previous step    [m/s]
  Vec3 free;                  ///< w without impulse                            [m/s]
  Vec3 after;                 ///< w⁺: relative velocity of the next step        [m/s]
  Vec3 impulse;               ///< r of the ground on the node           [N·s/m], [N·s]
  double bounce = 0.0;        ///< ε of the law (4.3)                           [m/s]
  double friction = 0.0;      ///< μ of the law                                  [-]
  contact::Status status = contact::Status::open;
  bool on_ground = true;  ///< false: against a segment of a body
};

/// After step n: displacement and forces at t_{n+1}, velocities half a step before and after.
struct State {
  State() = default;
  explicit State(const Model& model);

  long long step = 0;                 ///< n + 1: number of the displacement
  FrameStep frame;                    ///< of t_{n+1}
  Field u;                            ///< (n) u_{n+1}, co-rotating frame            [m]
  Field v;                            ///< (n) v_{n+1/2} (at step 0: v_0)            [m/s]
  Field v_next;                       ///< (n) v_{n+3/2}                             [m/s]
  Field force;                        ///< (n) K u_{n+1}, reference step only           [N/m], [N]
  Field force_before;                 ///< (n) K u_n, reference step only               [N/m], [N]
  std::vector<Pose> poses;            ///< (free_bodies) at t_{n+1}
  std::vector<double> rim;            ///< at step 0: saved numbers of a loaded rim (loaded_rim.hpp)
  std::vector<ActiveContact> active;  ///< capacity for two contacts per candidate
};

/// A state with room for displacements and contacts alone, so that Integrator::advance fills it
/// without a pass over the body.
[[nodiscard]] State boundary_state(const Model& model);

/// Whether the node belongs to an unconstrained body: its u and v are then in the fixed frame.
inline bool in_fixed_frame(const Model& model, std::size_t node) noexcept {
  return !model.free_body.empty() && model.free_body[node] >= 0;
}

/// Fills body, free_bodies and free_body: a body of the mesh without a clamped node is free.
/// @pre reference and mass are filled.
void find_free_bodies(const mesh::Mesh& mesh, Model& model);

/// Time step of the explicit part: the fine one of the scheme "hati", else Δt                [s]
inline double explicit_step(const Model& model) noexcept {
  return model.subdomains ? model.dt / model.subdomains->ratio : model.dt;
}

/// Whether nodes of the mesh's boundary may touch something.
inline bool has_candidates(const Model& model) noexcept {
  return model.contact || model.surfaces;
}

/// (n) place of each node among these, -1: it is none of them.
[[nodiscard]] std::vector<int> places_among(std::span<const int> nodes, std::size_t n);

/// Whether the candidates of the ground are massless (docs/theory.md, 3.10).
inline bool has_massless_contact(const Model& model) noexcept {
  return !model.lumped_mass.empty();
}

/// The coefficient of friction of some contacts is no constant.
[[nodiscard]] inline bool has_friction_law(const Model& model) noexcept {
  return (model.contact && !model.contact->law.friction.is_constant()) ||
         (model.surfaces && !model.surfaces->law.friction.is_constant());
}

/// Free nodes that have mass, ascending.
[[nodiscard]] std::vector<int> nodes_with_mass(const Model& model);

/// Smallest ratio of a node's mass, unless it is 0, to its lumped mass, at most 1. Bounds of ω² by
/// elements use lumped masses and must be divided by it.
[[nodiscard]] double least_mass_share(const Model& model) noexcept;

/// (n) Lumped mass, also at massless contact nodes: the weight of modes and of results [kg/m]
inline const std::vector<double>& lumped_mass_of(const Model& model) noexcept {
  return has_massless_contact(model) ? model.lumped_mass : model.mass;
}

/// Whether the ground has corners that may touch the body between two candidates: sharp ones, and
/// arcs whose radius is below the spacing of the candidates.
[[nodiscard]] bool has_sharp_corners(const Model& model) noexcept;

/// Position of a node in the fixed frame at t_{n+1} [m].
inline Vec2 position(const Model& model, const State& state, std::size_t node) noexcept {
  const Vec2 arm = model.reference[node] + state.u.plane()[node];
  if (in_fixed_frame(model, node)) return arm;
  return state.frame.center.plane() + state.frame.rotation * arm;
}

/// K u with the assembled stiffness of the model, else with that of one sector; both (n).
void apply_stiffness(const Model& model, std::span<const Vec2> u, std::span<Vec2> out);

}  // namespace rondo::dynamics
