// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/paper/paper_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>

#include "rondo/analysis/build.hpp"
#include "rondo/io/csv.hpp"
#include "rondo/io/files.hpp"
#include "rondo/statics/spinning_annulus.hpp"
#include "rondo/study/paper/paper_results.hpp"

namespace rondo::study {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* other_code = "an independent code of the same scheme on the same mesh";
constexpr const char* identity = "exact identity, up to round-off";

struct Study {
  fs::path directory;
  const PaperPlan& plan;
  bool quick;
  std::vector<PaperRow> rows;

  [[nodiscard]] fs::path path(const std::string& run) const { return directory / "runs" / run; }
  [[nodiscard]] Json summary(const std::string& run) const {
    return io::read_json(path(run) / "run.json");
  }
  [[nodiscard]] Json pod(const std::string& run, const std::string& name) const {
    return io::read_json(path(run) / "pod" / name / "pod.json");
  }
  [[nodiscard]] std::vector<double> column(const std::string& run, std::string_view name) const {
    const fs::path file = path(run) / "history.csv";
    return study::column(io::read_columns(file), name, file);
  }
  [[nodiscard]] Intervals force(const std::string& run, std::string_view name, double from) const {
    const fs::path file = path(run) / "history.csv";
    return intervals(io::read_columns(file), name, from, file);
  }
  [[nodiscard]] const PaperRun& planned(const std::string& name) const {
    return *std::find_if(plan.runs.begin(), plan.runs.end(),
                         [&](const PaperRun& run) { return run.name == name; });
  }

  void within(int figure, const char* name, const std::string& quantity, const char* unit,
              double ours, double expected, double tolerance, const std::string& source) {
    rows.push_back(
        {figure, name, quantity, unit, ours, expected, Comparison::within, tolerance, source});
  }
  void at_most(int figure, const std::string& name, const std::string& quantity, const char* unit,
               double ours, double bound, const std::string& source) {
    rows.push_back({figure, name, quantity, unit, ours, bound, Comparison::at_most, 0.0, source});
  }
  void at_least(int figure, const std::string& name, const std::string& quantity, const char* unit,
                double ours, double bound, const std::string& source) {
    rows.push_back({figure, name, quantity, unit, ours, bound, Comparison::at_least, 0.0, source});
  }
};

/// Of JSON's null, which stands for a number that is not finite or not found: NaN, which passes
/// nothing.
double number(const Json& value) {
  return value.is_number() ? value.get<double>() : std::nan("");
}

/// Null where `json` is no object or has no such key.
Json value_in(const Json& json, const char* key) {
  return json.is_object() && json.contains(key) ? json[key] : Json();
}

/// The largest of a key of run.json over the runs whose name begins so; not a number without any.
double largest(const Study& s, std::initializer_list<const char*> begins, const char* key) {
  double found = -std::numeric_limits<double>::infinity();
  for (const PaperRun& run : s.plan.runs)
    for (const char* begin : begins)
      if (run.name.starts_with(begin))
        found = keep_larger(found, number(value_in(s.summary(run.name), key)));
  return std::isinf(found) ? std::nan("") : found;
}

/// Edge of the ring in stationary spin, of the same mesh by a sparse solve.
double stationary_edge(Case c) {
  c.initial.state = InitialState::stationary;
  constexpr int threads = 1;
  const Setup setup = build(c, threads);
  return edge_displacement(setup.mesh, setup.displacement).x;
}

/// Energy that the scheme created by the end of a run, over the largest energy of another one.
double created(const Study& s, const std::string& run, const std::string& other) {
  const std::vector<double> kinetic = s.column(other, "kinetic"),
                            strain = s.column(other, "strain");
  double energy = 0.0;
  for (std::size_t k = 0; k < kinetic.size(); ++k)
    energy = keep_larger(energy, kinetic[k] + strain[k]);
  return std::abs(s.column(run, "work_scheme").back()) / energy;
}

void check_swing(Study& s) {
  const double stationary = stationary_edge(case_of(s.planned("spin-up-undamped")));
  const EdgeMotion edge = edge_motion(io::RunReader(s.path("spin-up-undamped")));
  const double end = edge.time.back(), part = 0.2 * end;
  // Many waves of one ring: the largest swing of a tenth of a second beats by about a per cent.
  s.within(2, "undamped-swing", "swing of the edge in the last fifth over that in the first", "1",
           swing(edge, end - part, end) / swing(edge, 0.0, part), 1.0, 0.03,
           "without damping it never decays; 3 % for the beat of its waves");
  double tangential = 0.0, sum = 0.0;
  for (std::size_t j = 0; j < edge.time.size() && edge.time[j] <= 0.1; ++j)
    tangential = keep_larger(tangential, std::abs(edge.tangential[j]));
  s.within(
      2, "undamped-tangential", "largest tangential displacement of the edge, first 0.1 s", "m",
      tangential, 4.958e-5, 0.01 * 4.958e-5,
      "an axisymmetric solution by an independent code, 1 %; there by the gyroscopic term alone");
  for (const double u : edge.displacement) sum += u;
  s.within(2, "undamped-mean", "mean radial displacement of the edge, undamped", "m",
           sum / static_cast<double>(edge.displacement.size()), stationary, 0.01 * stationary,
           "stationary spin of the same mesh; 1 % for the periods cut off at the end");
}

void check_spin_up(Study& s) {
  const Case damped = case_of(s.planned("spin-up-damped"));
  const double ours = edge_motion(io::RunReader(s.path("spin-up-damped"))).displacement.back();
  const double radius = damped.disk.outer_radius;
  const statics::SpinningAnnulus exact(damped.material, damped.disk.inner_radius, radius,
                                       damped.motion.angular_velocity.at(0.0));
  const double closed = exact.displacement(radius), stationary = stationary_edge(damped);
  // The error falls with the square of the element size: 1.2 % with four layers (V9).
  const double mesh_error = 0.015 * std::pow(4.0 / damped.disk.radial, 2);
  s.within(2, "damped-closed-form", "radial displacement of the edge at the end, damped", "m", ours,
           closed, mesh_error * closed, "closed form of the spinning annulus; error of the mesh");
  s.within(2, "damped-stationary", "the same, against the mesh's own stationary spin", "m", ours,
           stationary, 1e-6 * stationary, "stationary spin of the same mesh, solved by itself");
  check_swing(s);
  s.at_most(2, "spin-up-ledger", "largest ledger residual of all spin-ups, over the energy", "1",
            largest(s, {"spin-up"}, "energy_residual_relative"), 1e-12, identity);
  const std::string growing =
      "the gyroscopic term at the old half step creates energy; over the largest energy of the "
      "symplectic run";
  s.at_least(2, "printed-creates",
             "energy created by the scheme as printed, 50 rad/s, over E of symplectic", "1",
             created(s, "spin-up-as-printed", "spin-up-undamped"), 0.05, growing);
  s.at_least(2, "printed-blows-up",
             "energy created by the scheme as printed, 200 rad/s, over E of symplectic", "1",
             created(s, "spin-up-fast-as-printed", "spin-up-fast"), 1.0, growing);
}

struct Expected {
  const char *run, *label;
  double force_x, force_y;
};

void check_force(Study& s, int figure, const Expected& e, double from) {
  const std::string source = fmt::format("{}, 0.5 %", other_code);
  const Intervals vertical = s.force(e.run, "force_y", from);
  const Intervals horizontal = s.force(e.run, "force_x", from);
  const std::string name = fmt::format("{}-force", e.run);
  // Quick: F_y moves by 2 % on the coarse mesh; F_x, a small difference of large forces, by more.
  const double share = s.quick ? 0.02 : 0.005;
  s.rows.push_back({figure, name + "-y", fmt::format("mean vertical force, {}", e.label), "N/m",
                    mean(vertical), e.force_y, Comparison::within, share * e.force_y,
                    s.quick ? "an independent code on a finer mesh, 2 %" : source});
  if (e.force_x == 0.0)
    s.at_most(figure, name + "-x", fmt::format("mean horizontal force, {}, over F_y", e.label), "1",
              std::abs(mean(horizontal)) / e.force_y, 1e-12, "no friction, no drag");
  else if (!s.quick)
    s.rows.push_back({figure, name + "-x", fmt::format("mean horizontal force, {}", e.label), "N/m",
                      mean(horizontal), e.force_x, Comparison::within, 0.005 * std::abs(e.force_x),
                      source});
}

void check_regimes(Study& s) {
  constexpr double steady = 0.1;  // s: the ledge is 0.07 s behind
  check_force(s, 3, {"turn-smooth", "smooth", -2.0735e4, 1.89769e5}, steady);
  check_force(s, 3, {"turn-treaded", "treaded", -1.961e4, 1.7209e5}, steady);
  const Intervals smooth = s.force("turn-smooth", "force_y", steady);
  const Intervals treaded = s.force("turn-treaded", "force_y", steady);
  s.at_most(3, "smooth-stationary", "deviation of F_y from its mean, smooth, over the mean", "1",
            deviation(smooth) / mean(smooth), s.quick ? 0.03 : 0.01,
            "stationary but for the polygon of the mesh");
  const Case c = case_of(s.planned("turn-treaded"));
  const double pitch =
      c.disk.tread->pitches * c.motion.angular_velocity.at(0.0) / (2.0 * std::numbers::pi);
  s.within(3, "treaded-frequency", "frequency of the highest line of F_y, treaded", "Hz",
           highest_line(treaded), pitch, 1.0,
           "pitches times turns a second; 1 Hz, a sixth of the resolution of 0.16 s");
  s.at_least(3, "treaded-line", "line of F_y there, treaded over smooth", "1",
             line(treaded, pitch) / line(smooth, pitch), 10.0, "the tread makes it");
  s.at_most(3, "rolling-ledger", "largest ledger residual of all rolling runs, over the energy",
            "1", largest(s, {"ledge", "turn", "friction"}, "energy_residual_relative"), 1e-12,
            identity);
  s.at_most(3, "contact-law", "largest residual of the contact law, over the speed of impact", "1",
            largest(s, {"ledge", "turn", "friction"}, "contact_residual_max"), 1e-12, identity);
}

void check_friction(Study& s) {
  static constexpr std::array<double, 4> coefficients{0.0, 0.2, 0.4, 0.6};
  static constexpr std::array<Expected, 4> expected{
      {{"friction-0.0", "friction 0", 0.0, 1.8944e5},
       {"friction-0.2", "friction 0.2", -1.824e4, 1.8968e5},
       {"friction-0.4", "friction 0.4", -2.189e4, 1.8983e5},
       {"friction-0.6", "friction 0.6", -2.308e4, 1.9000e5}}};
  constexpr double steady = 0.095;  // s
  double outside = -1.0, before = 0.0, growth = 1.0;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const std::string run = expected[k].run;
    check_force(s, 4, expected[k], steady);
    outside = keep_larger(outside, outside_cone(io::RunReader(s.path(run)), coefficients[k]));
    const double drag =
        -mean(s.force(run, "force_x", steady)) / mean(s.force(run, "force_y", steady));
    if (k > 0) growth = keep_smaller(growth, drag - before);
    before = drag;
  }
  s.at_most(4, "shear-in-cone", "largest shear beyond friction times pressure, over the pressure",
            "1", outside, 1e-12, "Coulomb's law, node by node, up to round-off");
  s.at_least(4, "drag-grows", "least growth of -F_x / F_y from one friction to the next", "1",
             growth, 1e-3, "the shear at the contact grows with friction");
}

constexpr std::array<const char*, 3> shares{"1e-02", "1e-04", "1e-06"};

double count(const Study& s, const std::string& run, const std::string& name, const char* share) {
  return number(value_in(value_in(s.pod(run, name), "modes_for"), share));
}

/// Numbers of modes of an independent code: ± 1 below ten, ± 10 % above.
void check_counts(Study& s) {
  struct Counts {
    const char *run, *pod;
    std::array<int, 3> modes;
  };
  static constexpr std::array<Counts, 9> expected{
      {{"turn-smooth", "velocity-rotating", {75, 417, 584}},
       {"turn-treaded", "velocity-rotating", {125, 495, 597}},
       {"turn-smooth", "velocity-rectified", {2, 8, 56}},
       {"turn-treaded", "velocity-rectified", {6, 13, 76}},
       {"turn-smooth", "displacement-rotating", {20, 45, 192}},
       {"turn-treaded", "displacement-rotating", {21, 69, 252}},
       {"turn-smooth", "displacement-rectified", {1, 1, 4}},
       {"turn-treaded", "displacement-rectified", {1, 3, 9}},
       {"crush-smooth", "displacement-rotating", {1, 2, 5}}}};
  for (const Counts& row : expected)
    for (std::size_t k = 0; k < shares.size(); ++k) {
      const double modes = row.modes[k];
      s.rows.push_back(
          {5, fmt::format("{}-{}-{}", row.run, row.pod, shares[k]),
           fmt::format("modes for {}, {}, {}", shares[k], row.run, row.pod), "1",
           count(s, row.run, row.pod, shares[k]), modes, Comparison::within,
           modes < 10.0 ? 1.0 : std::ceil(0.1 * modes),
           fmt::format("{} and the same snapshots, 1 below ten modes, 10 % above", other_code)});
    }
}

/// What goes beyond the paper: rectified, rolling is as reducible as crushing.
void check_reducibility(Study& s) {
  if (!s.quick) check_counts(s);
  for (const std::string body : {"smooth", "treaded"}) {
    for (const std::string field : {"displacement", "contact"})
      s.at_most(5, fmt::format("{}-{}-as-crush", body, field),
                fmt::format("modes for 1e-04, {}, {}: rolling rectified", field, body), "1",
                count(s, "turn-" + body, field + "-rectified", shares[1]),
                count(s, "crush-" + body, field + "-rotating", shares[1]), "the crush's number");
    s.at_least(5, fmt::format("{}-velocity-gain", body),
               fmt::format("modes for 1e-04, velocity, {}: rotating over rectified", body), "1",
               count(s, "turn-" + body, "velocity-rotating", shares[1]) /
                   count(s, "turn-" + body, "velocity-rectified", shares[1]),
               10.0, "a contact at rest in the fixed frame is a few modes there");
  }
}

/// A picture that stands still in the fixed frame is, in the turning one, a Fourier series over one
/// turn: cosine and sine of each harmonic, of the same energy.
void check_modes(Study& s) {
  double orthonormality = 0.0, difference = 0.0;
  for (const PaperPod& pod : s.plan.pods) {
    const Json found = s.pod(pod.run, pod.field + "-" + pod.frame);
    orthonormality = keep_larger(orthonormality, number(value_in(found, "orthonormality")));
    difference =
        keep_larger(difference, number(value_in(value_in(found, "error_identity"), "difference")));
  }
  for (const std::string body : {"smooth", "treaded"}) {
    const fs::path file = s.path("turn-" + body) / "pod" / "velocity-rotating" / "spectrum.csv";
    std::vector<double> sigma = column(io::read_columns(file), "singular_value", file);
    sigma.resize(6, std::nan(""));
    double least = 1.0;
    for (std::size_t k = 0; k < 6; k += 2) least = keep_smaller(least, sigma[k + 1] / sigma[k]);
    s.at_least(6, body + "-pairs", "velocity, rotating, " + body + ": least ratio within a pair",
               "1", least, 0.98, "a travelling pattern: modes in pairs, alike in energy");
  }
  s.at_most(6, "orthonormality", "largest deviation of the modes of all PODs from orthonormal", "1",
            orthonormality, 1e-11, identity);
  s.at_most(6, "error-identity", "largest |error - discarded energy| of all PODs", "1", difference,
            1e-11, identity);
}

}  // namespace

std::vector<PaperRow> check_paper(const fs::path& directory, const PaperPlan& plan, bool quick) {
  Study study{directory, plan, quick, {}};
  check_spin_up(study);
  const std::vector<PaperRow> rolling = check_rolling(directory, plan, quick);
  study.rows.insert(study.rows.end(), rolling.begin(), rolling.end());
  return std::move(study.rows);
}

std::vector<PaperRow> check_rolling(const fs::path& directory, const PaperPlan& plan, bool quick) {
  Study study{directory, plan, quick, {}};
  check_regimes(study);
  check_friction(study);
  check_reducibility(study);
  check_modes(study);
  return std::move(study.rows);
}

}  // namespace rondo::study
