// SPDX-License-Identifier: BSD-3-Clause
/// @file  What the analysis of steady rolling asks of a kind of body: one in the plane, or a wheel
/// in three dimensions.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "rondo/analysis/base/analysis.hpp"
#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/steady/slip_step.hpp"
#include "rondo/modal/critical_speeds.hpp"
#include "rondo/output/recorder.hpp"
#include "rondo/output/run_files.hpp"
#include "rondo/output/snapshot.hpp"
#include "rondo/statics/steady/rolling_contact.hpp"
#include "rondo/statics/steady/rolling_power.hpp"

namespace rondo::study {

/// s, counter-clockwise.
[[nodiscard]] double spin_of(const Case& c);
[[nodiscard]] statics::SlipDifference slip_of(const Case& c);
/// The height of the ground [m].
[[nodiscard]] double floor_of(const Case& c);
/// A sample of a turn, from 0 on.
[[nodiscard]] inline int wrapped(int value, int count) noexcept {
  return (value % count + count) % count;
}

/// How well a state meets the laws.
struct SteadyResiduals {
  double energy = 0.0, contact = 0.0;  ///< relative
  double penetration = 0.0;            ///< [m]
};

/// A state, solved; a place is where sector 0 is, so many samples beyond the lowest point in the
/// sense of the spin.
class RolledState {
 public:
  RolledState() = default;
  RolledState(const RolledState&) = delete;
  RolledState& operator=(const RolledState&) = delete;
  virtual ~RolledState() = default;

  /// What is wrong; empty: solved. Else there is nothing to ask for but residuals().
  [[nodiscard]] virtual std::string trouble() const = 0;
  /// Length of a pass over the number of its places [s].
  [[nodiscard]] virtual double sample_time() const noexcept = 0;
  virtual void fill(int place, Snapshot& snapshot) = 0;
  /// Displacements alone.
  virtual void displace(int place, Snapshot& snapshot) const = 0;
  /// Appends a row of history.csv. @param now as filled for the place
  virtual void append_row(int place, const Snapshot& now, std::vector<double>& rows) const = 0;
  [[nodiscard]] virtual SteadyResiduals residuals() const = 0;
  /// How far the lowest place of the body would be below the ground if nothing touched it [m].
  [[nodiscard]] virtual double deflection() const = 0;
  /// Where power goes. @pre it is solved
  [[nodiscard]] virtual const statics::RollingPower& power() const noexcept = 0;
  /// Tells the user that a solved state is not accurate; empty: it is.
  [[nodiscard]] virtual std::string warning() const = 0;
  /// Adds "steady" and "slip_step" to run.json.
  virtual void describe(Json& json) const = 0;
  /// Null: the case has no step of the slip.
  [[nodiscard]] virtual const SlipStep* slip_step() const noexcept = 0;
  /// Forces, height, speed and slip, for the user.
  [[nodiscard]] virtual std::vector<std::string> notes() const = 0;
};

/// What does not hang on height, speed and friction, so that runs may share it: each hands in its
/// case.
class RolledBody {
 public:
  RolledBody() = default;
  RolledBody(const RolledBody&) = delete;  ///< harmonics point into it
  RolledBody& operator=(const RolledBody&) = delete;
  virtual ~RolledBody() = default;

  /// At its largest; an estimate, by the mesh alone [B].
  [[nodiscard]] virtual std::size_t memory(const Case& c) const = 0;
  /// All but the harmonics. @pre mesh and materials are there @throws InputError: layers that
  /// coincide in round-off, a curve that is held, a part of the tread that the rim holds
  virtual void assemble(const Case& c) = 0;
  /// Adds them, if they are not there. @param threads 0: chosen by size
  virtual void find_harmonics(const Case& c, int threads) = 0;
  /// False: the harmonics have no solution in the range of the numbers. @pre find_harmonics()
  [[nodiscard]] virtual bool has_solution() const noexcept = 0;
  /// @pre find_harmonics(), has_solution(). @throws InputError: nothing touches; the speed of what
  /// slides as a whole is asked for. Case and body must outlive the state.
  [[nodiscard]] virtual std::unique_ptr<RolledState> solve(const Case& c) const = 0;
  /// Adds the columns of history.csv and contact.csv.
  virtual void add_columns(RecordPlan& plan) const = 0;

  mesh::Mesh mesh;
  std::vector<fem::Material> materials;  ///< one for each region of the mesh
  std::vector<double> mass;              ///< (n) [kg/m], in three dimensions [kg]
  std::size_t dofs = 0, sector_dofs = 0;
  double radius = 0.0;                ///< outer, undeformed [m]
  std::vector<std::string> warnings;  ///< for the user: the caller prints them
  double harmonics_wall_s = 0.0;
  std::optional<InflationFigures> inflation;  ///< none: about the undeformed shape
};

/// The equations of all harmonics stay within the range of the numbers. @pre mesh, materials and
/// mass are there @throws InputError
void demand_range(const Case& c, const RolledBody& body);

/// What spin, weight and loads alone make of the body is still about as large as it was.
/// @param lowest place of the deformed body that nothing touches, below the axle [m]
/// @throws InputError
void demand_free_shape(const Case& c, double lowest, double radius);

/// For a spin of the case at which a wave has come to stand still.
[[nodiscard]] std::string above_critical_spin(const Case& c, const modal::CriticalSpeed& lowest);

/// The number of threads: the number asked for, or for 0 one chosen by size.
[[nodiscard]] int threads_for(const Case& c, const RolledBody& body, int asked);

/// What `check` tells of size, memory and the inflated state.
void add_body(const Case& c, const RolledBody& body, CheckReport& report);
/// What run.json has of them. @pre find_harmonics()
void describe_body(const Case& c, const RolledBody& body, Json& json);
/// The message where has_solution() is false.
[[nodiscard]] std::string no_solution(const Case& c);
/// The warnings of case and body, and others.
[[nodiscard]] std::vector<std::string> all_warnings(const Case& c, const RolledBody& body,
                                                    const std::vector<std::string>& more);

/// Equal for cases that share harmonics.
[[nodiscard]] std::string harmonics_key(const Case& c);
/// Assembled, or that of the run before where it fits, harmonics included.
/// @param shared null: nothing is kept @throws InputError as assemble(); more memory than there is
[[nodiscard]] std::shared_ptr<RolledBody> rolled_body(const Case& c, SharedBody* shared);

}  // namespace rondo::study
