// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/output/resume.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "rondo/case/case_keys.hpp"
#include "rondo/case/case_source.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/error.hpp"
#include "rondo/integrators/massless/ring_contact.hpp"
#include "rondo/io/directory.hpp"
#include "rondo/io/files.hpp"
#include "rondo/model/friction_work.hpp"
#include "rondo/model/loaded_rim.hpp"
#include "rondo/model/solid/swept_part.hpp"
#include "rondo/model/steps/step_table.hpp"
#include "rondo/model/viscous_branches.hpp"
#include "rondo/output/run_files.hpp"
#include "rondo/output/snapshot_schedule.hpp"

namespace rondo::study {
namespace {

constexpr const char* or_begin_again = "; or --overwrite to begin again";

constexpr auto first_of = [](const auto& pair) { return pair.first; };
constexpr auto is_finite = [](double number) { return std::isfinite(number); };

bool same(const CaseValue& a, const CaseValue& b) {
  return a.type == b.type && a.number == b.number && a.boolean == b.boolean && a.text == b.text &&
         std::equal(a.items.begin(), a.items.end(), b.items.begin(), b.items.end(), same);
}

/// The table in time of a value; none: it is neither a number nor a table.
std::optional<dynamics::Table> table_of(const CaseValue& value) {
  if (value.items.empty()) return dynamics::Table(value.number);
  std::vector<std::array<double, 2>> points;
  for (const CaseValue& point : value.items) {
    if (point.items.size() != 2) return std::nullopt;
    if (!points.empty() && !(points.back()[0] < point.items[0].number)) return std::nullopt;
    points.push_back({point.items[0].number, point.items[1].number});
  }
  return dynamics::Table(std::move(points));
}

/// Whether two tables in time agree up to a time, except for the round-off of a slope that was cut:
/// where both are linear they agree if they do at both ends.
bool same_until(const CaseValue& a, const CaseValue& b, double until) {
  constexpr double round_off = 1e-12;
  const std::optional<dynamics::Table> one = table_of(a), other = table_of(b);
  if (!one || !other) return false;
  const auto agree = [&](double t) {
    const double x = one->at(t), y = other->at(t);
    return std::abs(x - y) <= round_off * std::max(std::abs(x), std::abs(y));
  };
  for (const auto* table : {&*one, &*other})
    for (const auto& point : table->points())
      if (point[0] <= until && !agree(point[0])) return false;
  return agree(until);
}

bool is_in_time(const CaseKey* key) {
  return key && type_of(*key) == KeyType::history && !key->allowed.of_increments;
}

Fault differs(const std::string& key, const std::string& found, const std::string& message,
              const std::string& allowed) {
  return {"", 0, 0, key, found, message, allowed + or_begin_again};
}

/// Compares the keys of two cases as written out. All keys are present unless the type of a part
/// differs.
void compare_cases(const Checkpoint& k, const Case& c, const Setup& setup,
                   std::vector<Fault>& faults) {
  const CaseSource now = load_case_text("the case", write_case(c), {});
  const CaseSource then = load_case_text("the checkpoint", k.identity.case_text, {});
  const SnapshotSchedule longer = with_end(k.schedule, c.output, setup.model.dt, setup.n_steps);
  const std::array snapshots{static_cast<std::int64_t>(k.schedule.steps.size()),
                             static_cast<std::int64_t>(longer.steps.size())};
  // The values at which the step after the checkpoint begins have been used already.
  const double known_until = static_cast<double>(k.state.step + 1) * k.identity.step;
  for (const auto& [key, value] : now.values) {
    const CaseKey* known = find_case_key(key);
    if (known && known->use.may_change_on_resume) continue;
    // A longer run keeps its interval: its case, as stored, has the number of all its snapshots.
    if (key == "output.snapshots" &&
        std::find(snapshots.begin(), snapshots.end(), value.integer) != snapshots.end())
      continue;
    const auto before = then.values.find(key);
    if (before == then.values.end())
      faults.push_back(differs(key, now.written(value.place), "is not in the checkpoint's case",
                               "the case that the run began with"));
    else if (!same(value, before->second) &&
             !(is_in_time(known) && same_until(value, before->second, known_until)))
      faults.push_back(differs(key, now.written(value.place), "the run to resume has another value",
                               then.written(before->second.place)));
  }
  for (const auto& [key, value] : then.values)
    if (!now.values.contains(key))
      faults.push_back(
          differs(key, "nothing", "the run to resume has a value", then.written(value.place)));
}

std::string in_words(const std::string& reduced) {
  return reduced.empty() ? "the mesh" : reduced;
}

void compare_programs(const RunIdentity& then, const RunIdentity& now, std::vector<Fault>& faults) {
  const auto compare = [&](const char* what, const std::string& a, const std::string& b,
                           const std::string& to_do) {
    if (a != b)
      faults.push_back(differs("--resume", fmt::format("{} {}", what, b),
                               fmt::format("the checkpoint was written with {} {}", what, a),
                               to_do));
  };
  compare("version", then.version, now.version, "that version of rondo");
  compare("build", then.build_id, now.build_id, "the same program (its build id)");
  compare("kernels", then.dispatch, now.dispatch,
          fmt::format("RONDO_DISPATCH={} on a machine that has them", then.dispatch));
}

/// If a run was interrupted before its first checkpoint, and is this run, it starts again.
void clear_without_checkpoint(const Case& c, const std::filesystem::path& directory) {
  const std::string mark = io::mark_of_run(directory);
  if (mark.empty()) return;
  const auto refuse = [&](const std::string& what) {
    io::refuse_directory(directory, what, fmt::format("another -o{}", or_begin_again));
  };
  if (!io::is_cut_off(directory))
    refuse(fmt::format("holds a run without a checkpoint ({} is there)", mark));
  if (io::text_of(directory / "case.toml") != write_case(kept_case(c)))
    refuse("holds another case, cut off before its first checkpoint");
  io::clear_results_directory(directory);
}

/// Number of values of all branches: of elements of rubber, or of the nodes of a body of small
/// strain.
std::size_t branch_numbers(const Setup& setup) {
  using dynamics::ViscousBranches;
  const dynamics::Model& m = setup.model;
  std::size_t n = ViscousBranches<fem::BlockCsr>::numbers(m.viscous, m.n_nodes());
  if (m.solid) n += ViscousBranches<fem::SolidSector>::numbers(m.solid->viscous, m.n_nodes());
  for (std::size_t e = 0; e < setup.mesh.cells.size(); ++e) {
    const fem::Material& m = fem::material_of(setup.mesh, setup.materials, e);
    if (m.rubber) n += 3 * m.rubber->branches.size();
  }
  return n;
}

/// Whether a field has the right number of points and the components of the model.
bool fits(const Field& field, std::size_t points, const dynamics::Model& model) {
  return field.size() == points && (points == 0 || field.components() == model.components());
}

/// Whether the state has exactly what the integrator of this model carries.
bool fits(const dynamics::SavedState& s, const Setup& setup) {
  if (setup.saved_numbers > 0)
    return s.ring.size() == setup.saved_numbers && std::ranges::all_of(s.ring, is_finite) &&
           s.u.empty() && s.v.empty() && s.step > 0;
  const dynamics::Model& model = setup.model;
  const std::size_t n = model.n_nodes(), n_free = model.free_bodies.size();
  const bool parts = model.subdomains.has_value();
  const dynamics::StepKind step = step_of(model);
  const bool general = step == dynamics::StepKind::general || step == dynamics::StepKind::wheel;
  const bool rim = model.rim.has_value(), massless = has_massless_contact(model);
  const bool of_force = general || rim || (model.stiffness_damping > 0.0 && !parts) ||
                        (model.solid && (model.solid->swept || !model.solid->viscous.empty()));
  // The reference step of a wheel in three dimensions always carries it.
  const bool carries_force = of_force || (model.solid && !s.force.empty());
  const std::size_t force = carries_force ? n : 0;
  const std::size_t joined = parts ? 3 * model.subdomains->interface.size() : 0;
  const std::size_t rim_numbers = rim ? dynamics::LoadedRim::n_numbers : 0;
  const std::size_t works = has_internal_work(setup) ? 4 : 0;
  return s.branches.size() == branch_numbers(setup) && s.internal_work.size() == works &&
         s.window.size() == dynamics::window_numbers(model) && fits(s.u, n, model) &&
         fits(s.v, n, model) && fits(s.force, force, model) &&
         fits(s.u_before, rim ? n : 0, model) && s.gradient.size() == (general ? n : 0) &&
         s.energy.size() == n_free && s.poses.size() == n_free &&
         (massless ? dynamics::MasslessContact::is_saved(s.ring, model.contact->nodes.size())
                   : s.ring.empty()) &&
         (model.friction_work ? model.friction_work->is_saved(s.friction_work)
                              : s.friction_work.empty()) &&
         s.interface.size() == joined && s.rim.size() == rim_numbers &&
         std::ranges::all_of(s.rim, is_finite) && s.step > 0 &&
         std::ranges::is_sorted(s.impulses, {}, first_of);
}

/// Whether steps increase within the run, and as many have passed as there are snapshots.
bool fits(const SnapshotSchedule& schedule, const Checkpoint& k) {
  const std::vector<long long>& steps = schedule.steps;
  const auto passed = std::upper_bound(steps.begin(), steps.end(), k.state.step) - steps.begin();
  return std::adjacent_find(steps.begin(), steps.end(), std::greater_equal<>()) == steps.end() &&
         (steps.empty() || (steps.front() >= 0 && steps.back() <= k.n_steps)) &&
         k.files.snapshots.count == static_cast<std::size_t>(passed) &&
         std::isfinite(schedule.interval) && schedule.interval >= 0.0;
}

/// Checks that its numbers are consistent with each other, the case, and the model.
void demand_sound(const Checkpoint& k, const Case& c, const Setup& setup,
                  const std::filesystem::path& directory) {
  const HistoryPlace& h = k.history;
  const std::size_t columns = History(c, setup).columns().size();
  if (fits(k.state, setup) && fits(k.schedule, k) && k.state.step <= k.n_steps && h.next > 0 &&
      h.done == k.state.step && h.steps >= 0 && h.steps <= h.done && k.problems_kept >= 0 &&
      (k.last_row.empty() || k.last_row.size() == columns))
    return;
  throw FileError((directory / checkpoint_name).string(),
                  "is damaged: its numbers contradict each other, or are not of this model");
}

}  // namespace

void demand_same_program(const RunIdentity& then, const RunIdentity& now) {
  std::vector<Fault> faults;
  compare_programs(then, now, faults);
  if (!faults.empty()) throw InputError(std::move(faults));
}

void demand_same_run(const Checkpoint& k, const RunIdentity& now, const Case& c,
                     const Setup& setup) {
  std::vector<Fault> faults;
  if (k.identity.reduced != now.reduced)
    faults.push_back(differs(
        "--reduced", in_words(now.reduced),
        fmt::format("the run to resume is one of {}", in_words(k.identity.reduced)),
        "the options of that run beside --resume: --reduced, and its --modes and --reduced-step "
        "where it had them"));
  compare_cases(k, c, setup, faults);
  if (faults.empty() && k.identity.mesh_hash != now.mesh_hash)
    faults.push_back(differs(c.section ? "section.file" : "mesh.file",
                             mesh_file_of(c) ? as_utf8(mesh_file_of(c)->file.string()) : "",
                             "is not the mesh that the run began with", "that mesh"));
  if (faults.empty() && k.identity.road_hash != now.road_hash)
    faults.push_back(differs("ground.road", c.ground ? c.ground->road.file : "",
                             "is not the road that the run began with", "that road"));
  if (faults.empty() && k.identity.step != now.step)
    faults.push_back(differs("time.step", fmt::format("{}", now.step),
                             "the step of the checkpoint is another one",
                             fmt::format("{}", k.identity.step)));
  const bool behind =
      k.state.step > setup.n_steps || (k.state.step == setup.n_steps && k.n_steps != setup.n_steps);
  if (faults.empty() && behind)
    faults.push_back(differs("time.end", fmt::format("{}", c.time.end),
                             fmt::format("the run has come to t = {:.9g} s",
                                         static_cast<double>(k.state.step) * now.step),
                             "a later end"));
  if (!faults.empty()) throw InputError(std::move(faults));
}

void refuse_without_checkpoints(const std::filesystem::path& directory) {
  std::error_code error;
  if (!std::filesystem::exists(directory / "run.json", error)) return;
  try {
    if (io::read_json(directory / "run.json").value("resumable", true)) return;
  } catch (const std::exception&) {
    return;  // a damaged file: reading it to resume reports that
  }
  throw request_error("--resume", directory.string(),
                      "holds the results of a run that keeps no checkpoints",
                      "the same command with --overwrite to run it again, or another -o");
}

namespace {

/// Differences are reported with the file of the checkpoint.
Checkpoint read_checkpoint_of(const std::filesystem::path& directory, const RunIdentity& now,
                              const Case& c, const Setup& setup) {
  try {
    Checkpoint k = read_checkpoint(
        directory, [&](const RunIdentity& then) { demand_same_program(then, now); });
    demand_same_run(k, now, c, setup);
    return k;
  } catch (const InputError& error) {
    std::vector<Fault> faults = error.faults();
    for (Fault& fault : faults) fault.file = (directory / checkpoint_name).string();
    throw InputError(std::move(faults));
  }
}

}  // namespace

std::optional<Checkpoint> find_checkpoint(const RunIdentity& now, const Case& c, const Setup& setup,
                                          const std::filesystem::path& directory) {
  RONDO_DEMAND(setup.n_steps > 0 && setup.model.dt > 0.0 && now.step == setup.model.dt,
               setup.n_steps, setup.model.dt, now.step);
  std::error_code error;
  const bool there = std::filesystem::exists(directory / checkpoint_name, error);
  if (!there) {
    clear_without_checkpoint(c, directory);
    return std::nullopt;
  }
  Checkpoint k = read_checkpoint_of(directory, now, c, setup);
  demand_sound(k, c, setup, directory);
  k.is_at_end = k.state.step >= setup.n_steps;
  RONDO_DEMAND(k.state.step <= setup.n_steps, k.state.step, setup.n_steps);  // demand_same_run()
  if (k.n_steps != setup.n_steps)
    k.schedule = with_end(std::move(k.schedule), c.output, setup.model.dt, setup.n_steps);
  return k;
}

}  // namespace rondo::study
