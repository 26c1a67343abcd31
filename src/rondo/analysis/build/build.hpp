// SPDX-License-Identifier: BSD-3-Clause
/// @file  From a case to what a run needs: mesh, model, critical step, initial fields.
#pragma once
#include <any>
#include <string>
#include <vector>

#include "rondo/analysis/build/bodies.hpp"
#include "rondo/case/setup.hpp"

namespace rondo::study {

/// Runs one after the other share this as long as only friction, motion, mass damping, times and
/// output differ: mesh, masses, stiffness, critical step, the last stationary state. A run built
/// from it has the same bits as one built alone.
struct SharedBody {
  std::string key;  ///< the case without what may differ; empty: none yet
  Setup setup;
  double spin = 0.0;  ///< spin of the stationary state [rad/s]
  Field stationary;   ///< (n) empty: none yet [m]
  std::any other;     ///< what an analysis keeps instead, of a type of its own
};

/// Which run will make its steps from a Setup.
enum class Steps { of_full_run, of_reduced_wheel };

/// Equal for cases that share a body.
std::string body_key(const Case& c);

/// The case's pressures. @throws InputError: no such curve, or one that is held
void add_pressures(const Case& c, const mesh::Mesh& mesh, dynamics::Model& model);

/// ceil(end / step), where that is not a whole number by the last bit. @throws InputError: too many
long long count_steps(const Case& c, double dt);

/// Threads used where the user names none: 1 below this many free degrees of freedom, where
/// starting threads at every step costs more than it brings; all cores above.
inline constexpr std::size_t single_thread_dofs = 20000;

/// Above this many free degrees of freedom, on meshes of equal sectors, the critical step, the
/// stationary start and the check of softening work sector by sector, harmonic by harmonic: memory
/// and time of one sector. Below it, with the assembled K, as they always did: to the same bits.
inline constexpr std::size_t harmonic_setup_dofs = 200000;

/// Degrees of freedom that move: of a node two or, of a wheel in three dimensions, three.
std::size_t count_dofs(const dynamics::Model& model);

/// Sets the threads asked for, or chosen by size for 0, as far as the model's parts allow.
void choose_threads(Setup& s, int asked);

/// Parts that no cell joins.
int count_bodies(const dynamics::Model& model);

/// Whether what can be done harmonic by harmonic is done so.
bool by_harmonics(const dynamics::Model& model);

/// Nodes that move in the co-rotating frame, ascending.
std::vector<int> held_nodes(const dynamics::Model& model);

/// @param threads 0: chosen by size. @throws InputError: what build_mesh() says, step above the
/// critical one, spin beyond the softening limit with a stationary start, start inside the ground.
/// @param shared is used where it fits the case, and else replaced; null: nothing is kept
/// @param steps of a full run must resolve the viscous branches; reduced wheels have other steps
Setup build(const Case& c, int threads, SharedBody* shared = nullptr,
            Steps steps = Steps::of_full_run);

}  // namespace rondo::study
