// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/case/case_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rondo::study {
namespace {

constexpr std::string_view material_regions = "material.region", initial_regions = "initial.region",
                           pressures = "load.pressure", probes = "output.probe";

/// "output.probe" 2 "name" to "output.probe[2].name".
std::string key_of(std::string_view list, std::size_t index, std::string_view leaf) {
  return item_of(list, index) + "." + std::string(leaf);
}

/// A name that must not be empty, nor be that of an item before.
template <class Items, class Name>
void read_name(CaseValues& in, const std::string& key, const Items& before, Name&& name_of,
               std::string& target) {
  in.read(key, target);
  if (!in.good({key}) || !in.has(key)) return;
  if (target.empty()) return in.fault(key, "must not be empty");
  for (const auto& item : before)
    if (name_of(item) == target) return in.fault(key, "is the name of another one before it");
}

void read_material_region(CaseValues& in, std::size_t k, Case& c) {
  const auto key = [&](std::string_view leaf) { return key_of(material_regions, k, leaf); };
  MaterialRegion region{{}, c.material};
  read_name(
      in, key("surface"), c.regions, [](const MaterialRegion& r) { return r.surface; },
      region.surface);
  in.read(key("youngs_modulus"), region.material.youngs_modulus);
  in.read(key("poissons_ratio"), region.material.poissons_ratio);
  in.read(key("density"), region.material.density);
  c.regions.push_back(std::move(region));
}

void warn_of_locking(const std::string& key, const fem::Material& material, Case& c) {
  if (material.plane != fem::Plane::strain || material.poissons_ratio <= 0.49 ||
      material.integration == fem::Integration::b_bar)
    return;
  c.warnings.push_back(
      fmt::format("{} = {}: in plane strain, full integration is far too stiff this near to 0.5: "
                  "material.integration = \"b-bar\" is made for it",
                  key, material.poissons_ratio));
}

void read_initial_region(CaseValues& in, std::size_t k, Initial& initial) {
  const auto key = [&](std::string_view leaf) { return key_of(initial_regions, k, leaf); };
  InitialRegion region{{}, initial.velocity, initial.angular_velocity};
  read_name(
      in, key("surface"), initial.regions, [](const InitialRegion& r) { return r.surface; },
      region.surface);
  in.read(key("velocity"), region.velocity);
  in.read(key("angular_velocity"), region.angular_velocity);
  initial.regions.push_back(std::move(region));
}

/// Keys of free bodies in a case that can have none.
void refuse_placing(CaseValues& in) {
  const auto refuse = [&](std::string_view key) {
    in.fault(key,
             "is for bodies that nothing holds: the rim gives a bonded disk its place and its "
             "motion ([motion])",
             "disk.rim = \"free\" beside it");
  };
  for (const std::string_view key :
       {"initial.position", "initial.angle", "initial.angular_velocity"})
    if (in.has(key)) refuse(key);
  if (in.n_items(initial_regions) > 0) refuse(item_of(initial_regions, 0));
}

bool is_word(std::string_view name) {
  return std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  });
}

}  // namespace

std::string_view why_not_cyclic(const Case& c) {
  if (c.mesh) return "a mesh from a file is not known to be of equal sectors";
  if (c.free_rim) return "a free disk does not stay in the turning frame of its sectors";
  if (c.body_contact.between != BodyContact::none) return "there is a [contact] of bodies";
  if (c.time.scheme == Scheme::as_printed)
    return "the scheme \"as-printed\" is one of the general step alone";
  return {};
}

void read_mesh_file(CaseValues& in, Case& c) {
  MeshCase& mesh = c.mesh.emplace();
  std::string file;
  in.read("mesh.file", file);
  if (in.good({"mesh.file"}) && file.empty()) in.fault("mesh.file", "must not be empty");
  mesh.file = c.file.parent_path() / file;
  in.read("mesh.scale", mesh.scale);
  in.read("mesh.clamped", mesh.clamped);
  in.read("mesh.contact", mesh.contact);
}

void read_material(CaseValues& in, Case& c) {
  in.read("material.youngs_modulus", c.material.youngs_modulus);
  in.read("material.poissons_ratio", c.material.poissons_ratio);
  in.read("material.density", c.material.density);
  c.material.plane = static_cast<fem::Plane>(in.choice("material.plane"));
  c.material.integration = static_cast<fem::Integration>(in.choice("material.integration"));
  c.stress_stiffening = static_cast<StressStiffening>(in.choice("material.stress_stiffening"));
  if (c.stress_stiffening == StressStiffening::centrifugal && !is_held(c))
    in.fault("material.stress_stiffening",
             "nothing turns a free body: there is no spin whose stress could be taken", "\"none\"");
  if (!c.mesh && in.n_items(material_regions) > 0)
    in.fault(item_of(material_regions, 0), "a [disk] is of one material",
             "a [mesh] with physical surfaces");
  for (std::size_t k = 0; k < in.n_items(material_regions); ++k) read_material_region(in, k, c);
  warn_of_locking("material.poissons_ratio", c.material, c);
  for (std::size_t k = 0; k < c.regions.size(); ++k)
    if (c.regions[k].material.poissons_ratio != c.material.poissons_ratio)
      warn_of_locking(key_of(material_regions, k, "poissons_ratio"), c.regions[k].material, c);
  in.read("damping.mass", c.damping.mass);
  in.read("damping.stiffness", c.damping.stiffness);
}

void read_initial(CaseValues& in, Case& c) {
  Initial& initial = c.initial;
  initial.state = static_cast<InitialState>(in.choice("initial.state"));
  if (initial.state == InitialState::stationary && !is_held(c))
    in.fault("initial.state", "nothing turns a free body: it has no stationary spin", "\"rest\"");
  in.read("initial.velocity", initial.velocity);
  in.read("initial.displacement_gradient", initial.displacement_gradient);
  in.read("initial.position", initial.position);
  in.read("initial.angle", initial.angle);
  in.read("initial.angular_velocity", initial.angular_velocity);
  for (std::size_t k = 0; k < in.n_items(initial_regions); ++k) read_initial_region(in, k, initial);
  if (!may_be_free(c) && in.good({"disk.rim"})) refuse_placing(in);
  if (!c.mesh && c.free_rim && in.n_items(initial_regions) > 0)
    in.fault(item_of(initial_regions, 0), "a [disk] is one body",
             "initial.velocity and initial.angular_velocity");
}

void read_body_contact(CaseValues& in, Case& c) {
  BodyContactCase& contact = c.body_contact;
  contact.between = static_cast<BodyContact>(in.choice("contact.between"));
  in.read("contact.friction", contact.friction);
  in.read("contact.restitution", contact.restitution);
  if (c.analysis.kind == AnalysisKind::crush && contact.between != BodyContact::none)
    in.fault("contact.between", "a crush knows no contact but with the ground", "\"none\"");
  if (!c.mesh && contact.between != BodyContact::none)
    c.warnings.emplace_back(
        "contact.between: a generated disk is one body, and the walls of its grooves are no "
        "candidates: it touches nothing but the ground; for grooves that close take a [mesh]");
  if (c.mesh && c.mesh->contact.empty() && contact.between != BodyContact::none)
    in.fault("contact.between", "no part of the mesh may touch anything",
             "mesh.contact, a physical curve, beside it");
}

void read_pressures(CaseValues& in, Case& c) {
  for (std::size_t k = 0; k < in.n_items(pressures); ++k) {
    PressureCase& pressure = c.pressures.emplace_back();
    const std::string curve = key_of(pressures, k, "curve");
    in.read(curve, pressure.curve);
    if (in.has(curve) && in.good({curve}) && pressure.curve.empty())
      in.fault(curve, "must not be empty");
    in.read(key_of(pressures, k, "value"), pressure.pressure);
  }
  if (c.analysis.kind == AnalysisKind::crush && !c.pressures.empty())
    in.fault(item_of(pressures, 0), "a crush knows no load but the ground", "a dynamic analysis");
}

void read_probes(CaseValues& in, Case& c) {
  std::vector<Probe>& read = c.output.probes;
  for (std::size_t k = 0; k < in.n_items(probes); ++k) {
    Probe probe;
    const std::string name = key_of(probes, k, "name");
    read_name(
        in, name, read, [](const Probe& p) { return p.name; }, probe.name);
    if (in.good({name}) && !is_word(probe.name))
      in.fault(name, "has a character that may not be in the name of a column",
               "letters, digits, _ and -");
    in.read(key_of(probes, k, "position"), probe.position);
    read.push_back(std::move(probe));
  }
}

void check_operator(CaseValues& in, const Case& c) {
  if (c.solver_operator != "cyclic" || c.analysis.kind == AnalysisKind::crush) return;
  const std::string_view why = why_not_cyclic(c);
  if (!why.empty()) in.fault("solver.operator", std::string(why), "\"auto\" or \"sparse\"");
}

}  // namespace rondo::study
