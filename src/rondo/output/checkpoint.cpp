// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/output/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <type_traits>
#include <utility>

#include "rondo/core/build_id.hpp"
#include "rondo/core/column.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/core/error.hpp"
#include "rondo/core/version.hpp"
#include "rondo/io/checkpoint_file.hpp"
#include "rondo/io/mesh_files.hpp"
#include "rondo/io/road_hash.hpp"
#include "rondo/output/run_files.hpp"

namespace rondo::study {
namespace {

namespace h5 = io::h5;
using h5::File;

template <class T>
void put(File& file, const std::string& name, const std::vector<T>& values,
         const h5::Label& label) {
  static_assert(h5::Element<T>::count >= 1);
  h5::Shape shape{values.size()};
  if (h5::Element<T>::count > 1) shape.push_back(h5::Element<T>::count);
  file.write(name, shape, std::span<const T>(values), label);
}

void put(File& file, const std::string& name, const Field& field, const h5::Label& label) {
  file.write(name, {field.size(), field.components()}, FieldView(field).values, label);
}

template <class T>
std::vector<T> get(const File& file, const std::string& name, std::size_t rows = h5::any) {
  h5::Shape shape{rows};
  if (h5::Element<T>::count > 1) shape.push_back(h5::Element<T>::count);
  return file.dataset(name, shape).read<T>();
}

/// Reads a field in the plane or in space, according to its dataset.
Field get_field(const File& file, const std::string& name) {
  const h5::Dataset dataset = file.dataset(name);
  if (dataset.shape().size() == 2 && dataset.shape()[1] == 3) return get<Vec3>(file, name);
  return get<Vec2>(file, name);
}

double stored(double value) {
  return value;
}
/// All integers are stored with 64 bits.
template <class Whole>
std::int64_t stored(Whole value) {
  return static_cast<std::int64_t>(value);
}

/// Visits the figures of the contact in run.json.
template <class Known, class Visit>
void for_contact(Known& c, Visit&& visit) {
  visit("/contact/residual", c.residual, {"1", "largest relative residual of the law"});
  visit("/contact/free_velocity", c.free_velocity, {"m/s", "largest"});
  visit("/contact/penetration", c.penetration, {"m", "largest"});
  visit("/contact/steps", c.contact_steps, {"1", "steps in contact"});
  visit("/contact/nodes_max", c.nodes_max, {"1", "most nodes in contact"});
  visit("/contact/pairs", c.pairs, {"1", "pairs solved"});
  visit("/contact/pairs_not_converged", c.pairs_not_converged, {"1", "of these not"});
  visit("/contact/clusters", c.clusters, {"1", "clusters solved"});
  visit("/contact/clusters_not_converged", c.clusters_not_converged, {"1", "of these not"});
  visit("/contact/cluster_largest", c.cluster_largest, {"1", "contacts of the largest"});
  visit("/contact/cluster_iterations", c.cluster_iterations, {"1", "most of a cluster"});
  visit("/contact/extensions", c.extensions, {"1", "times that nodes joined a massless contact"});
  visit("/contact/extensions_max", c.extensions_max, {"1", "most in a step"});
  visit("/contact/between_bodies", c.between_bodies, {"1", "most in a step"});
  visit("/contact/friction_steepness", c.friction_steepness, {"1", "largest at a row"});
  visit("/contact/friction_alternating", c.friction_alternating,
        {"N*s/m", "friction that alternates, over the rows"});
  visit("/contact/friction_bearable", c.friction_bearable, {"N*s/m", "all of it, likewise"});
}

template <class Known, class Visit>
void for_deformation(Known& d, Visit&& visit) {
  visit("/deformation/strain", d.found.strain, {"1", "largest |principal strain|"});
  visit("/deformation/strain_cell", d.found.strain_cell, {"1", "its cell"});
  visit("/deformation/strain_time", d.strain_time, {"s", "its time"});
  visit("/deformation/linear_strain", d.found.linear_strain, {"1", "likewise, without rubber"});
  visit("/deformation/linear_cell", d.found.linear_cell, {"1", "its cell"});
  visit("/deformation/linear_time", d.linear_time, {"s", "its time"});
  visit("/deformation/jacobian", d.found.jacobian, {"1", "smallest J of a corner"});
  visit("/deformation/jacobian_cell", d.found.jacobian_cell, {"1", "its cell"});
  visit("/deformation/jacobian_time", d.jacobian_time, {"s", "its time"});
}

/// Calls visit(name, text) for the identity of a run, except its step.
template <class Known, class Visit>
void for_texts(Known& identity, Visit&& visit) {
  visit("/identity/version", identity.version);
  visit("/identity/build_id", identity.build_id);
  visit("/identity/dispatch", identity.dispatch);
  visit("/identity/case", identity.case_text);
  visit("/identity/mesh_hash", identity.mesh_hash);
  visit("/identity/reduced", identity.reduced);
  visit("/identity/road_hash", identity.road_hash);
}

/// Calls visit(name, value, label) for all single numbers; units are those of a plane body.
template <class Known, class Visit>
void for_scalars(Known& k, Visit&& visit) {
  const std::string row = "since the last row of history.csv", loop = "of the loop so far, ";
  auto& [next, since, done, impulse, angular_impulse, penetration, hub, hub_angular, iterations,
         extensions, aligning, overturning, aligning_iso, overturning_iso] = k.history;
  visit("/run/step", k.identity.step, {"s", "length of a step"});
  visit("/run/steps_done", k.state.step, {"1", "steps made"});
  visit("/run/steps", k.n_steps, {"1", "steps of the whole run"});
  visit("/run/snapshot_interval", k.schedule.interval, {"s", "time between snapshots"});
  visit("/run/problems_kept", k.problems_kept, {"1", "files in contact-problems"});
  visit("/run/loop_wall", k.loop_wall_s, {"s", loop + "wall clock"});
  visit("/run/loop_cpu", k.loop_cpu_s, {"s", loop + "processor"});
  visit("/history/next", next, {"1", "interval of the next row"});
  visit("/history/since", since, {"1", "steps " + row});
  visit("/history/done", done, {"1", "the last step seen"});
  visit("/history/impulse_x", impulse.x, {"N*s/m", row});
  visit("/history/impulse_y", impulse.y, {"N*s/m", row});
  visit("/history/impulse_z", impulse.z, {"N*s/m", row});
  visit("/history/angular_impulse", angular_impulse, {"N*s", row});
  visit("/history/penetration", penetration, {"m", "largest " + row});
  visit("/history/hub_impulse_x", hub.x, {"N*s/m", row});
  visit("/history/hub_impulse_y", hub.y, {"N*s/m", row});
  visit("/history/hub_angular_impulse", hub_angular, {"N*s", row});
  visit("/history/iterations", iterations, {"1", "of contact in a step, most " + row});
  visit("/history/extensions", extensions, {"1", "of contact in a step, most " + row});
  visit("/history/aligning", aligning, {"N*s", "of the ground about its normal, " + row});
  visit("/history/overturning", overturning, {"N*s", "of the ground about t1, " + row});
  visit("/history/aligning_iso", aligning_iso, {"N*s", "about the contact centre, " + row});
  visit("/history/overturning_iso", overturning_iso, {"N*s", "about the contact centre, " + row});
  for_contact(k.contact, visit);
  for_deformation(k.deformation, visit);
}

void put_text(File& file, const std::string& name, const std::string& text,
              const std::string& meaning) {
  put(file, name, std::vector<std::uint8_t>(text.begin(), text.end()), {"1", meaning});
}

std::string get_text(const File& file, const std::string& name) {
  const auto bytes = get<std::uint8_t>(file, name);
  return {bytes.begin(), bytes.end()};
}

constexpr const char* kept_name = "/files/kept";

KeptFiles get_kept(const File& file) {
  try {
    return kept_files_of(Json::parse(get_text(file, kept_name)));
  } catch (const nlohmann::json::exception& error) {
    throw FileError(file.path(), fmt::format("{} is damaged: {}", kept_name, error.what()));
  }
}

bool is_solid(const dynamics::SavedState& s) noexcept {
  return s.u.components() == 3;
}

void put_state(File& file, const dynamics::SavedState& s) {
  const auto unit = [&](const char* plane) { return std::string(unit_of(plane, is_solid(s))); };
  put(file, "/state/u", s.u, {"m", "displacement, in the integrator's own components"});
  put(file, "/state/v", s.v, {"m/s", "velocity, in the integrator's own components"});
  put(file, "/state/force", s.force, {unit("N/m"), "K u, in the integrator's own components"});
  put(file, "/state/u_before", s.u_before,
      {"m", "u a step before, in the integrator's own components"});
  put(file, "/state/gradient", s.gradient, {"N/m", "derivative of the energy of free bodies"});
  put(file, "/state/energy", s.energy, {"J/m", "energy of each free body"});
  std::vector<std::array<double, 5>> poses;
  for (const dynamics::Pose& p : s.poses)
    poses.push_back({p.center.x, p.center.y, p.rotation.re, p.rotation.im, p.angle});
  put(file, "/state/poses", poses,
      {"1", "of each free body: center [m], e^(i angle), angle [rad]"});
  std::vector<std::int64_t> keys;
  std::vector<Vec2> impulses;
  for (const auto& [key, impulse] : s.impulses) {
    keys.push_back(static_cast<std::int64_t>(key));
    impulses.push_back(impulse);
  }
  put(file, "/state/contact", keys, {"1", "contacts that share nodes, by number"});
  put(file, "/state/impulse", impulses, {"N*s/m", "their impulses in the last step"});
  put(file, "/state/branches", s.branches,
      {"1",
       "of viscous branches: strains of rubber at finite strain, xx, yy, xy of each branch of each "
       "element; at small strain displacements [m], of each branch and node"});
  put(file, "/state/internal_work", s.internal_work,
      {"J/m", "of nonlinear forces: work and dissipation, and what their rounding left"});
  put(file, "/state/window", s.window,
      {"J",
       "of rubber in a window: its work, what its rounding left, weights [1] and energies of "
       "columns"});
  put(file, "/state/rim", s.rim, {"1", "what a loaded rim carries"});
  put(file, "/state/ring", s.ring, {"1", "contacts of a massless boundary"});
  put(file, "/state/friction_work", s.friction_work,
      {"1", "energy that friction took, of contact nodes and places: whole numbers of each sum"});
  put(file, "/state/interface", s.interface,
      {"1", "where two parts meet: u [m] and v [m/s] of the coarse one, multiplier [N/m]"});
  put(file, "/state/ledger", std::vector<double>(s.ledger.begin(), s.ledger.end()),
      {unit("J/m"), "sums of the energy ledger and what their rounding left"});
}

void get_state(const File& file, dynamics::SavedState& s) {
  s.u = get_field(file, "/state/u");
  s.v = get_field(file, "/state/v");
  s.force = get_field(file, "/state/force");
  s.u_before = get_field(file, "/state/u_before");
  s.gradient = get<Vec2>(file, "/state/gradient");
  s.energy = get<double>(file, "/state/energy");
  s.branches = get<double>(file, "/state/branches");
  s.internal_work = get<double>(file, "/state/internal_work");
  s.window = get<double>(file, "/state/window");
  s.rim = get<double>(file, "/state/rim");
  s.ring = get<double>(file, "/state/ring");
  s.friction_work = get<double>(file, "/state/friction_work");
  s.interface = get<Vec2>(file, "/state/interface");
  for (const auto& p : get<std::array<double, 5>>(file, "/state/poses", s.energy.size()))
    s.poses.push_back({{p[0], p[1]}, {p[2], p[3]}, p[4]});
  const auto keys = get<std::int64_t>(file, "/state/contact");
  const auto impulses = get<Vec2>(file, "/state/impulse", keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i)
    s.impulses.emplace_back(static_cast<std::uint64_t>(keys[i]), impulses[i]);
  const auto ledger = get<double>(file, "/state/ledger", s.ledger.size());
  std::copy(ledger.begin(), ledger.end(), s.ledger.begin());
}

}  // namespace

RunIdentity identity_of(const Case& c, const Setup& setup) {
  RONDO_DEMAND(setup.model.dt > 0.0 && setup.mesh.n_nodes() > 0, setup.model.dt,
               setup.mesh.n_nodes());
  return {version,
          build_id(),
          dispatch_level(),
          write_case(c),
          io::mesh_hash(setup.mesh),
          setup.reduced,
          setup.model.dt,
          is_on_road_surface(c) ? io::road_hash(*c.ground->road.read) : std::string()};
}

void write_checkpoint(const std::filesystem::path& directory, const Checkpoint& k) {
  io::write_checkpoint_file(directory / checkpoint_name, [&](File& file) {
    for_texts(k.identity, [&](const char* name, const std::string& text) {
      put_text(file, name, text, "UTF-8 text");
    });
    for_scalars(k, [&](const char* name, const auto& value, const h5::Label& label) {
      const std::string unit(unit_of(label.units, is_solid(k.state)));
      put(file, name, std::vector{stored(value)}, {unit, label.description});
    });
    put(file, "/run/last_row", k.last_row, {"1", "last row of history.csv, if none was due there"});
    put(file, "/run/snapshot_steps",
        std::vector<std::int64_t>(k.schedule.steps.begin(), k.schedule.steps.end()),
        {"1", "steps at which snapshots are taken"});
    put_text(file, kept_name, as_json(k.files).dump(),
             "what the other files held: JSON, as `files` of run.json");
    put_state(file, k.state);
  });
}

Checkpoint read_checkpoint(const std::filesystem::path& directory,
                           const std::function<void(const RunIdentity&)>& check) {
  const File file = io::open_checkpoint_file(directory / checkpoint_name);
  Checkpoint k;
  for_texts(k.identity, [&](const char* name, std::string& text) { text = get_text(file, name); });
  if (check) check(k.identity);
  for_scalars(k, [&](const char* name, auto& value, const h5::Label&) {
    using Value = std::remove_reference_t<decltype(value)>;
    value = static_cast<Value>(get<decltype(stored(value))>(file, name, 1).front());
  });
  k.last_row = get<double>(file, "/run/last_row");
  const auto steps = get<std::int64_t>(file, "/run/snapshot_steps");
  k.schedule.steps.assign(steps.begin(), steps.end());
  k.files = get_kept(file);
  get_state(file, k.state);
  return k;
}

}  // namespace rondo::study
