// SPDX-License-Identifier: BSD-3-Clause
/// @file  From a case to what a run needs: mesh, model, critical step, initial fields.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "rondo/core/error.hpp"
#include "rondo/dynamics/critical_step.hpp"
#include "rondo/dynamics/model.hpp"
#include "rondo/study/case.hpp"

namespace rondo::study {

struct Setup {
  mesh::Mesh mesh;
  dynamics::Model model;
  dynamics::CriticalStep critical;
  long long n_steps = 0;              ///< ceil(end / step); the step is never fitted to the end
  std::vector<Vec2> prestress;        ///< (n) displacement whose stress stiffens the body [m]
  std::vector<Vec2> displacement;     ///< (n) u_0                          [m]
  std::vector<Vec2> velocity;         ///< (n) v_0                          [m/s]
  std::vector<std::string> warnings;  ///< for the user: the caller prints them
};

/// Threads used where the user names none: 1 below this many free degrees of freedom, where
/// starting threads at every step costs more than it brings; all cores above.
inline constexpr std::size_t single_thread_dofs = 20000;

/// Above this many free degrees of freedom, on meshes of equal sectors, the critical step, the
/// stationary start and the check of softening work sector by sector, harmonic by harmonic: memory
/// and time of one sector. Below it, with the assembled K, as they always did: to the same bits.
inline constexpr std::size_t harmonic_setup_dofs = 200000;

/// A fault that shows only once the case is put together, at the place where its key stands.
InputError case_error(const Case& c, const std::string& key, const std::string& message,
                      const std::string& allowed);

/// @throws InputError: layers that coincide in round-off.
mesh::Mesh build_mesh(const Case& c);

/// @param threads 0: chosen by size. @throws InputError: step above the critical one, spin beyond
/// the softening limit with a stationary start, start inside the ground.
Setup build(const Case& c, int threads);

}  // namespace rondo::study
