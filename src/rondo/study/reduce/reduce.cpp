// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/reduce/reduce.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>
#include <system_error>
#include <utility>

#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/reduced/reduced_file.hpp"
#include "rondo/core/error.hpp"
#include "rondo/core/process_wide.hpp"
#include "rondo/rom/step_matrices.hpp"
#include "rondo/study/pod/pod_input.hpp"
#include "rondo/study/reduce/reduce_error.hpp"
#include "rondo/study/reduce/reduce_modes.hpp"
#include "rondo/study/reduce/reduce_steady.hpp"

namespace rondo::study {
namespace {

using Clock = std::chrono::steady_clock;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void check_options(const ReduceRequest& r) {
  const auto demand_one_of = [](const char* option, const std::string& name, const auto& names) {
    std::string allowed;
    for (const auto& [known, value] : names) {
      if (name == known) return;
      allowed += (allowed.empty() ? "" : ", ") + std::string(known);
    }
    throw request_error(option, name, "not one of those there are", allowed);
  };
  if (r.contact == "patterns")
    throw request_error("--contact", r.contact, "patterns lose the friction and are gone",
                        "places, which a smooth disk has if --contact is left out");
  if (!r.contact.empty()) demand_one_of("--contact", r.contact, contact_names);
  if (!(r.contact_weight >= 0.0 && r.contact_weight <= 1e6))
    throw request_error("--contact-weight", fmt::format("{:.9g}", r.contact_weight),
                        "not a share of the mass that can be", "0 to 1e6, e.g. 10");
  if (r.output.empty()) throw request_error("-o", "", "the model needs a file", "-o MODEL.h5");
  for (const auto& [option, modes] : {std::pair{"--displacement-modes", r.displacement_modes},
                                      {"--velocity-modes", r.velocity_modes}})
    if (modes && *modes < 1)
      throw request_error(option, fmt::to_string(*modes), "no modes to keep", "1 or more");
  for (const auto& [option, share] : {std::pair{"--tolerance", r.displacement_tolerance},
                                      {"--velocity-tolerance", r.velocity_tolerance}})
    if (share && !(*share > 0.0 && *share < 1.0))
      throw request_error(option, fmt::format("{:.9g}", *share), "not a share of the energy",
                          "between 0 and 1, e.g. 1e-5");
}

/// Checks what can be reduced: a disk in one piece, clamped at its rim, that finished its run.
void check_run(const io::RunReader& run, const Case& c) {
  const std::string name = run.directory().string();
  if (!run.is_motion())
    throw request_error("RUN", name, "a crush does not roll: there is no motion to reduce",
                        "runs of analysis.kind = \"dynamic\" or \"steady-rolling\"");
  if (is_solid(c))
    throw request_error("RUN", name,
                        "the body is a wheel in three dimensions, and reduced models are plane",
                        "runs of a [disk] without disk.width; rondo pod decomposes this one");
  if (c.mesh || c.free_rim || run.mesh().n_sectors == 0)
    throw request_error("RUN", name,
                        "the body has no equal sectors round a rim that holds it: its fields "
                        "cannot be moved to the fixed frame",
                        "runs of a [disk] whose rim is constrained");
  if (c.rim)
    throw request_error("RUN", name,
                        "its rim moves by itself, and that of a model of runs follows tables",
                        "runs without [rim]; or rondo run CASE --reduced, which needs no model");
  if (run.status() != "done")
    throw request_error("RUN", name,
                        fmt::format("the run is not finished (status {})", run.status()),
                        "finish it (rondo run RUN --resume), or leave it out");
  if (has_rubber(c))
    throw request_error("RUN", name,
                        "the body is rubber at finite strain, and a reduced run is of small strain",
                        "runs with material.model = \"linear\"");
  if (!c.pressures.empty())
    throw request_error("RUN", name, "a reduced run does not support pressures on the body",
                        "runs without [[load.pressure]]");
  if (!is_steady(run) && run.n_snapshots() < 2)
    throw request_error("RUN", name, fmt::format("{} snapshots make no model", run.n_snapshots()),
                        "a run with output.snapshots of 2 or more, some hundreds better");
}

/// Reported before the whole file is read, which would call it damaged.
void check_velocities(const std::filesystem::path& directory) {
  const std::filesystem::path results = directory / "results.h5";
  std::error_code error;
  if (!std::filesystem::exists(results, error)) return;  // the reader reports what is missing
  const io::h5::File file = io::h5::File::open(results);
  if (file.contains("/snapshots/displacement") && !file.contains("/snapshots/velocity"))
    throw request_error("RUN", directory.string(),
                        "holds no velocities: displacements alone cannot roll",
                        "a run whose results.h5 has /snapshots/velocity");
}

struct Source {
  std::vector<io::RunReader> runs;
  std::vector<Case> cases;
};

bool is_turning(const ReduceRequest& r) {
  return is_co_rotating(r.frame, {});
}

PodRequest pod_request(const ReduceRequest& r, const char* field) {
  PodRequest pod;
  pod.runs = r.runs;
  pod.field = field;
  pod.frame = r.frame;
  pod.from = r.from;
  pod.to = r.to;
  pod.warn = r.warn;
  return with_members(pod);
}

Source open_source(const ReduceRequest& r) {
  const PodRequest pod = pod_request(r, "velocity");
  Source source;
  for (const std::filesystem::path& directory : pod.runs) {
    check_velocities(directory);
    const io::RunReader run(directory);
    Case& c = source.cases.emplace_back(read_case(directory / "case.toml"));
    check_run(run, c);
    // The model has its own step, with the mass of all nodes.
    c.contact_mass = ContactMass::lumped;
    c.implicit.clear();
    if (is_steady(run)) take_steady(run, is_turning(r), c);
    const std::string difference = body_difference(body_text(c), body_text(source.cases.front()));
    if (!difference.empty())
      throw request_error(
          "RUN", directory.string(),
          fmt::format("not the body of {}: {}", pod.runs.front().string(), difference),
          "runs of one mesh and material together");
  }
  source.runs = open_runs(pod, snapshot_choice_of(pod));
  const std::size_t snapshots = columns_of(pod, snapshot_choice_of(pod), source.runs).size();
  if (snapshots < 2)
    throw request_error("--from, --to", "",
                        fmt::format("{} snapshots of the runs lie between: no model", snapshots),
                        "a window with 2 snapshots or more, some hundreds better");
  return source;
}

RunSnapshots snapshots_of(const ReduceRequest& r, const Source& source, const char* field) {
  const PodRequest pod = pod_request(r, field);
  const SnapshotChoice choice = snapshot_choice_of(pod);
  std::vector<SnapshotColumn> columns = columns_of(pod, choice, source.runs);
  weigh_steady(source.runs, columns);
  return {source.runs, std::move(columns), choice};
}

ModelRanges ranges_of(const ReduceRequest& r, const Source& source) {
  const PodRequest pod = pod_request(r, "displacement");
  ModelRanges ranges;
  for (const Case& c : source.cases)
    if (c.ground) ranges.friction.take(c.ground->friction);
  for (const SnapshotColumn& column : columns_of(pod, snapshot_choice_of(pod), source.runs)) {
    const Case& c = source.cases[column.run];
    ranges.angular_velocity.take(c.motion.angular_velocity.at(column.time));
    ranges.speed.take(c.motion.speed.at(column.time));
    ranges.height.take(c.motion.height.at(column.time));
    ranges.slip_ratio.take(slip_ratio_at(c, column.time));
  }
  return ranges;
}

/// The requested form of contact, or a suitable one (docs/reduced.md, 5).
rom::ContactForm contact_form(const ReduceRequest& r, const mesh::Mesh& mesh) {
  const bool smooth = pod::boundary_rings(mesh).n_rings() == 1;
  const bool standing = smooth && !is_turning(r);
  auto form = standing ? rom::ContactForm::places : rom::ContactForm::nodes;
  for (const auto& [name, known] : contact_names)
    if (r.contact == name) form = known;
  if (form != rom::ContactForm::nodes && !standing)
    throw request_error("--contact", r.contact,
                        smooth ? "in the co-rotating frame nothing stands still in space"
                               : "between the blocks of a tread there is no place to stand still",
                        "nodes");
  if ((r.contact_stride != 0 || r.contact_phases != 1) && form != rom::ContactForm::places)
    throw request_error(r.contact_stride != 0 ? "--contact-stride" : "--contact-phases",
                        fmt::to_string(r.contact_stride != 0 ? r.contact_stride : r.contact_phases),
                        "only places have a stride and phases", "--contact places, or without");
  return form;
}

/// The requested stride, or the largest divisor that leaves enough contact points.
int contact_stride(const ReduceRequest& request, int n_sectors) {
  int stride = request.contact_stride;
  if (stride == 0) {
    stride = std::max(1, n_sectors / enough_contact_points);
    while (n_sectors % stride != 0) --stride;
  }
  if (stride < 1 || n_sectors % stride != 0)
    throw request_error("--contact-stride", fmt::to_string(stride),
                        "does not share out the columns of the mesh",
                        fmt::format("a divisor of {}", n_sectors));
  if (stride > 1 && n_sectors / stride < least_contact_points)
    throw request_error("--contact-stride", fmt::to_string(stride),
                        fmt::format("leaves {} contact points: each would be the mean of an arc "
                                    "that does not touch as a whole",
                                    n_sectors / stride),
                        fmt::format("a divisor that leaves {} or more", least_contact_points));
  return stride;
}

/// Points at every stride-th node, or several per node if these would be too few.
MatrixXd place_weights(const ReduceRequest& request, int n_sectors) {
  const int stride = contact_stride(request, n_sectors);
  const int phases = request.contact_phases;
  if (phases > 1 && stride > 1)
    throw request_error(
        "--contact-phases", fmt::to_string(phases),
        fmt::format("with a stride of {} there are fewer points than nodes", stride),
        "--contact-stride 1, or no phases");
  return phases > 1 ? rom::between_weights(n_sectors, phases) : rom::hat_weights(n_sectors, stride);
}

/// The modes of displacement, their derivatives by the angle (a pattern that is fixed in space has
/// the velocity -s D u), the modes of velocity.
MatrixXd basis_of(const ReduceRequest& r, const mesh::Mesh& mesh, const VectorXd& roots,
                  const MatrixXd& u, const MatrixXd& v) {
  if (is_turning(r)) return rom::join(std::array{u, v});
  const MatrixXd fields = roots.cwiseInverse().asDiagonal() * u;
  const MatrixXd derived = roots.asDiagonal() * rom::differentiate(mesh, fields);
  return rom::join(std::array{u, derived, v});
}

/// The contact points of the model.
struct ContactChoice {
  rom::ContactForm form;
  MatrixXd weights;  ///< (sectors, points); empty: nodes
};

ContactChoice choose_contact(const ReduceRequest& request, const mesh::Mesh& mesh) {
  ContactChoice contact{contact_form(request, mesh), {}};
  if (contact.form == rom::ContactForm::places)
    contact.weights = place_weights(request, mesh.n_sectors);
  return contact;
}

rom::ReducedModel make_model(const ReduceRequest& request, const Setup& setup,
                             const MatrixXd& basis, const ContactChoice& contact) {
  rom::ReducedModel model = rom::make_reduced_model(
      {setup.mesh, setup.model.mass,
       [&](std::span<const Vec2> in, std::span<Vec2> out) {
         fem::apply(*setup.model.sector, in, out);
       }},
      basis, is_turning(request) ? rom::ModelFrame::turning : rom::ModelFrame::rectified);
  rom::set_contact(setup.mesh, contact.form, contact.weights, model);
  return model;
}

ReducedFile make_file(const ReduceRequest& request, const Source& source, const Setup& setup,
                      const MatrixXd& basis, const ContactChoice& contact) {
  ReducedFile file;
  file.model = make_model(request, setup, basis, contact);
  file.mesh = setup.mesh;
  file.mass = setup.model.mass;
  file.body = body_text(source.cases.front());
  file.ranges = ranges_of(request, source);
  for (const io::RunReader& run : source.runs) file.runs.push_back(run.directory().string());
  return file;
}

/// The reason why no error is estimated; empty: it is estimated.
std::string why_no_estimate(const ReduceRequest& r, const Source& source) {
  if (!r.error_estimate) return "not asked for (--no-error-estimate)";
  if (is_turning(r)) return "in the co-rotating frame it would take steps of the mesh";
  if (std::ranges::any_of(source.cases, [](const Case& c) {
        return c.ground && c.ground->impact == contact::Impact::energy_safe;
      }))
    return "runs of ground.impact = \"energy-safe\" are predicted in explicit steps only";
  const std::size_t runs = source.runs.size();
  if (runs < least_runs_to_estimate)
    return fmt::format("{} run{}, and {} are needed to leave one out", runs, runs == 1 ? "" : "s",
                       least_runs_to_estimate);
  return {};
}

/// Predicts each run with the modes of the others (docs/reduced.md, 8b).
ErrorEstimate estimate_errors(const ReduceRequest& r, const Source& source, const Setup& setup,
                              const std::array<const FieldModes*, 2>& fields,
                              const ContactChoice& contact) {
  ErrorEstimate estimate;
  estimate.none = why_no_estimate(r, source);
  if (!estimate.none.empty()) return estimate;
  const VectorXd roots = rom::mass_roots(setup.model.mass);
  std::array<std::vector<SnapshotColumn>, 2> columns;
  for (std::size_t k = 0; const char* field : {"displacement", "velocity"}) {
    const PodRequest pod = pod_request(r, field);
    columns[k++] = columns_of(pod, snapshot_choice_of(pod), source.runs);
  }
  const std::vector<std::size_t> left_out = runs_to_leave_out(source.runs);
  const auto n = static_cast<long long>(left_out.size());
  for (long long done = 0; const std::size_t run : left_out) {
    if (r.progress) r.progress(done++, n);
    const std::optional<MeanForce> own = mean_force_of(source.runs[run]);
    if (!own || !source.cases[run].ground || !(own->y > 0.0)) continue;
    const MatrixXd basis =
        basis_of(r, setup.mesh, roots, modes_without(*fields[0], columns[0], run),
                 modes_without(*fields[1], columns[1], run));
    const MeanForce found =
        predicted_force(source.cases[run], make_model(r, setup, basis, contact), source.runs[run]);
    estimate.runs.push_back(source.runs[run].directory().string());
    estimate.errors.push_back(errors_of(found, *own));
  }
  if (r.progress) r.progress(n, n);
  if (estimate.errors.empty())
    estimate.none = "no run presses the ground in the last quarter of its history.csv";
  return estimate;
}

/// Reports sizes and steps of the model.
ReduceReport describe(const Source& source, const Setup& setup, const ReducedFile& file) {
  ReduceReport report;
  report.dofs = 2 * static_cast<long long>(setup.model.free.size());
  report.modes = file.model.size();
  report.full_critical_step = setup.critical.step;
  report.reduced_critical_step =
      rom::critical_step(file.model, source.cases.front().damping.stiffness);
  const bool nodes = file.model.form == rom::ContactForm::nodes;
  report.contact = name_in(contact_names, file.model.form);
  report.contact_points =
      static_cast<long long>(nodes ? setup.mesh.boundary.size() : file.model.contact.points.size());
  const double spin = std::max(std::abs(file.ranges.angular_velocity.low),
                               std::abs(file.ranges.angular_velocity.high));
  if (spin > 0.0)
    report.contact_step =
        2.0 * std::numbers::pi / static_cast<double>(report.contact_points) / spin;
  return report;
}

}  // namespace

ReduceReport run_reduce(const ReduceRequest& request) {
  const auto begin = Clock::now();
  const OneBlasThread one;  // the same model for any number of cores
  static_cast<void>(is_co_rotating(request.frame, request.warn));
  check_options(request);
  const Source source = open_source(request);
  const Setup setup = build(off_the_ground(source.cases.front()), 1);
  // Reported before the long calculation.
  const ContactChoice contact = choose_contact(request, setup.mesh);
  const VectorXd roots = rom::mass_roots(setup.model.mass);
  const TouchedNodes touched = touched_nodes(setup, source.runs, request);
  const FieldModes u =
      modes_of_field(request, snapshots_of(request, source, "displacement"), roots, touched,
                     {"displacement", request.displacement_modes, request.displacement_tolerance,
                      default_displacement_modes});
  const FieldModes v = modes_of_field(
      request, snapshots_of(request, source, "velocity"), roots, touched,
      {"velocity", request.velocity_modes, request.velocity_tolerance, default_velocity_modes});
  const MatrixXd basis = basis_of(request, setup.mesh, roots, u.modes, v.modes);
  ReducedFile file = make_file(request, source, setup, basis, contact);
  file.displacement_modes = u.report.modes;
  file.velocity_modes = v.report.modes;
  file.estimate = estimate_errors(request, source, setup, {&u, &v}, contact);
  write_reduced_file(request.output, file);

  ReduceReport report = describe(source, setup, file);
  report.displacement = u.report;
  report.velocity = v.report;
  report.estimate = file.estimate;
  report.displacement_left =
      energy_left(snapshots_of(request, source, "displacement"), basis, roots);
  report.velocity_left = energy_left(snapshots_of(request, source, "velocity"), basis, roots);
  std::error_code error;
  report.file_bytes = std::filesystem::file_size(request.output, error);
  report.wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  return report;
}

}  // namespace rondo::study
