// SPDX-License-Identifier: BSD-3-Clause
/// @file  A reduced wheel with exact contact (docs/reduced.md): step, modes and tables of a case.
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rondo/analysis/reduced/wheel_file.hpp"
#include "rondo/case/setup.hpp"
#include "rondo/output/run_options.hpp"
#include "rondo/rom/make_wheel_model.hpp"
#include "rondo/rom/solid_wheel_run.hpp"
#include "rondo/rom/wheel_run.hpp"

namespace rondo::study {

/// Without equal sectors more modes take too long to find.
inline constexpr int most_modes_of_mesh = 300;

/// What the case says about contact, before the run.
struct ExpectedContact {
  double spin = 0.0;     ///< largest |ω|                                             [rad/s]
  double speed = 0.0;    ///< largest of |V| and |ω| R                                  [m/s]
  double length = 0.0;   ///< of the contact at the lowest height, on flat ground; 0: not known [m]
  double pass = 0.0;     ///< time in which a sector passes, without equal sectors a node;
                         ///< 0: it does not turn                                          [s]
  double spacing = 0.0;  ///< of contact nodes, in the mean                                 [m]
};

struct PreparedWheel {
  std::optional<fem::SectorStiffness> whole;  ///< of a mesh without equal sectors
  std::optional<rom::Ring> ring;              ///< of this or of the setup's sector
  std::optional<rom::SolidRing> solid;        ///< in place of `ring`, in three dimensions
  double law_residual = 1e-6;                 ///< of the law of contact, in three dimensions
  rom::WheelModel model;
  WheelBasis basis = WheelBasis::eigenmodes;
  std::string file;  ///< of its modes; empty: none
  ExpectedContact expected;
  double full_step = 0.0;     ///< step of the full run                                       [s]
  rom::WheelFigures figures;  ///< filled while it runs
  std::vector<std::string> warnings;  ///< for the user

  PreparedWheel() = default;
  PreparedWheel(const PreparedWheel&) = delete;  // the ring refers to `whole`
  PreparedWheel& operator=(const PreparedWheel&) = delete;

  [[nodiscard]] int n_modes() const;
  /// Angular frequencies of the lowest mode, infinite: there is none, and of the highest [rad/s]
  [[nodiscard]] double lowest() const;
  [[nodiscard]] double highest() const;
  /// What passes in the time expected.pass.
  [[nodiscard]] const char* passing() const { return whole ? "contact node" : "sector"; }
  /// Steps in that time, at the largest spin.
  [[nodiscard]] double passes(double dt) const { return expected.pass / dt; }
};

/// Gives the setup the masses and the step of a reduced wheel, and finds its ring. The setup must
/// stay where it is.
/// @param led the spin comes from outside while the wheel runs, up to this [rad/s]
/// @throws InputError: what a reduced wheel cannot do, or options that do not go with it
void begin_wheel(const Case& c, const RunOptions& options, std::optional<double> led, Setup& setup,
                 PreparedWheel& wheel);

/// The tables of these modes. @pre begin_wheel()
void complete_wheel(const Case& c, std::optional<double> led,
                    std::vector<rom::RingHarmonic> harmonics, Setup& setup, PreparedWheel& wheel);

/// The steps of the wheel.
[[nodiscard]] std::unique_ptr<dynamics::Integrator> make_steps(const Setup& setup,
                                                               PreparedWheel& wheel,
                                                               const dynamics::State& start);

/// Whether numbers may come from a checkpoint of the wheel.
[[nodiscard]] bool is_saved(const Setup& setup, const PreparedWheel& wheel,
                            std::span<const double> numbers);

/// Both, with the modes that the options ask for. @throws FileError, InputError: of a file of them
void prepare_wheel(const Case& c, const RunOptions& options, std::optional<double> led,
                   Setup& setup, PreparedWheel& wheel);

/// A warning of friction whose coefficients were often those by the step before; empty: there is
/// none. @param figures of a run
[[nodiscard]] std::string late_friction_text(const rom::WheelFigures& figures);

}  // namespace rondo::study
