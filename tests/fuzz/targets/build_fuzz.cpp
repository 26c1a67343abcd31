// SPDX-License-Identifier: BSD-3-Clause
/// A small case that is read is put together and makes a few steps: all is numbers, or refused.
/// Meshes from files are looked for in the folder RONDO_FUZZ_MESHES.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "case_input.hpp"
#include "mutate.hpp"
#include "rondo/analysis/build/build.hpp"
#include "rondo/analysis/build/crush/crush_setup.hpp"
#include "rondo/case/solid/wheel_of.hpp"
#include "rondo/integrators/integrator.hpp"
#include "rondo/integrators/start.hpp"

using namespace rondo;

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max, unsigned seed) {
  return fuzz::mutate_text(data, size, max, seed);
}

namespace {

constexpr std::size_t most_nodes = 200;
constexpr int most_sectors = 12;

/// A larger one would only take longer.
bool is_small(const study::Case& c) {
  const study::MeshCase* const mesh = mesh_file_of(c);
  return mesh ? std::filesystem::is_regular_file(mesh->file) &&
                    (!c.section || c.section->sectors <= most_sectors)
              : study::n_generated_nodes(c) <= most_nodes;
}

void check_finite(FieldView field, std::string_view what) {
  fuzz::check(std::ranges::all_of(field.values, [](double x) { return std::isfinite(x); }), what);
}

void check_mass(std::span<const double> mass) {
  fuzz::check(std::ranges::all_of(mass, [](double m) { return std::isfinite(m) && m > 0.0; }),
              "a mass that is none");
}

void build_dynamic(const study::Case& c) {
  study::Setup s = study::build(c, 1);
  check_finite(s.mesh.coordinates, "a node is nowhere");
  check_mass(s.model.mass);
  check_finite(s.displacement, "an initial displacement is not finite");
  check_finite(s.velocity, "an initial velocity is not finite");
  fuzz::check(std::isfinite(s.model.dt) && s.model.dt > 0.0 && s.n_steps > 0, "no step of time");
  // Values that are no numbers are for the run's own checks to tell: the steps must only end.
  const dynamics::State state =
      dynamics::start(s.model, std::move(s.displacement), std::move(s.velocity));
  const auto integrator = dynamics::make_integrator(s.model, state);
  std::vector<dynamics::StepReport> reports(3);
  integrator->advance(reports);
  fuzz::check(reports.back().step == 3, "a step is missing");
}

void build_press(const study::Case& c) {
  const study::CrushSetup s = study::build_crush(c);
  check_finite(s.mesh.coordinates, "a node is nowhere");
  check_mass(s.mass);
  fuzz::check(std::isfinite(s.touch_height) && std::isfinite(s.reach), "no first touch");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const char* meshes = std::getenv("RONDO_FUZZ_MESHES");
  study::Case c;
  if (!fuzz::accepted(
          [&] { c = fuzz::read_case_input(fuzz::view(data, size), fuzz::scratch_folder()); }))
    return 0;
  if (study::MeshCase* mesh = mesh_file_of(c); mesh && meshes != nullptr)
    mesh->file = std::filesystem::path(meshes) / mesh->file.filename();
  if (!is_small(c)) return 0;
  c.contact_iterations = std::min(c.contact_iterations, 300);  // as long as it was asked for
  fuzz::accepted(
      [&] { c.analysis.kind == study::AnalysisKind::crush ? build_press(c) : build_dynamic(c); });
  return 0;
}
