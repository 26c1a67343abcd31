// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/crush/pgd_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <system_error>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/error.hpp"
#include "rondo/core/index.hpp"
#include "rondo/io/basis_file.hpp"
#include "rondo/io/directory.hpp"
#include "rondo/io/files.hpp"
#include "rondo/io/mesh_files.hpp"
#include "rondo/io/pod_files.hpp"
#include "rondo/output/run_files.hpp"
#include "rondo/pod/decompose.hpp"
#include "rondo/pod/spectrum.hpp"

namespace rondo::study {
namespace fs = std::filesystem;
namespace {

using Eigen::Index;

constexpr std::array<double, 3> counted_shares{1e-2, 1e-4, 1e-6};  ///< shares that a POD counts too

const fs::path place = fs::path("pod") / "displacement-pgd";  ///< in the directory of a run

/// The solution as a POD finds it: Σ and V of all, Φ of the modes kept.
struct Found {
  pod::Decomposition d;
  pod::Spectrum spectrum;
  std::vector<double> error;  ///< (N) of the modes kept, relative
};

/// Share of the modes from r on in each increment.
std::vector<double> errors_of(const statics::Separated& s, Index r) {
  const Eigen::MatrixXd parts = s.temporal * s.sigma.asDiagonal();
  std::vector<double> errors;
  for (Index j = 0; j < parts.rows(); ++j) {
    const double all = parts.row(j).norm();
    errors.push_back(all > 0.0 ? parts.row(j).tail(parts.cols() - r).norm() / all : 0.0);
  }
  return errors;
}

Found find(const statics::Separated& s, double share) {
  Found f;
  f.d.sigma = s.sigma;
  f.d.temporal = s.temporal;
  f.d.energy = s.sigma.squaredNorm();
  const double largest = s.sigma.size() > 0 ? s.sigma[0] : 0.0;
  const double least = pod::round_off(s.modes.field.rows(), s.temporal.rows(), largest);
  f.d.rank = (s.sigma.array() > least).count();
  const Index kept = std::min(statics::values_kept(s.sigma, share), f.d.rank);
  f.d.modes = s.modes.field.leftCols(kept);
  fix_signs(f.d);
  f.spectrum = pod::spectrum(f.d);
  f.error = errors_of(s, kept);
  return f;
}

double orthonormality(const statics::Separated& s, Index kept) {
  const Eigen::MatrixXd gram =
      s.modes.contact.leftCols(kept).transpose() * s.modes.load.leftCols(kept);
  if (kept == 0) return 0.0;
  return (gram - Eigen::MatrixXd::Identity(kept, kept)).cwiseAbs().maxCoeff();
}

/// Root of the energy that the first r modes leave, over all of it.
double left_out(const pod::Spectrum& s, Index r) {
  if (r == 0) return s.energy.empty() ? 0.0 : std::sqrt(s.discarded.front() + s.energy.front());
  return std::sqrt(s.discarded[at(r - 1)]);
}

io::PodContent content_of(const PgdModes& m, const Found& found, const fs::path& run) {
  io::PodContent c;
  c.mesh = m.mesh;
  c.mass = m.mass;
  c.quantity = "displacement";
  c.unit = "m";
  c.time_unit = "1";
  c.frame = "rotating";
  c.shift = "none";
  c.weight = "search-direction";
  c.decomposition = &found.d;
  c.spectrum = &found.spectrum;
  c.modes = &found.d.modes;
  c.time = m.parameter;
  c.angle.assign(m.parameter.size(), 0.0);  // nothing turns
  c.run.assign(m.parameter.size(), 0);
  c.error = found.error;
  c.runs = {run.string()};
  c.basis = m.basis;
  return c;
}

/// Modes for each share of the energy, and what they leave of the run.
void add_counts(const pod::Spectrum& spectrum, Json& counts, Json& errors) {
  for (const double share : counted_shares) {
    const std::string key = fmt::format("{:.0e}", share);
    const Index modes = pod::modes_for(spectrum, share);
    counts[key] = modes >= 0 ? Json(modes) : Json();
    errors[key] = modes >= 0 ? Json(left_out(spectrum, modes)) : Json();
  }
}

Json as_json(const PgdModes& m, const Found& found, const PgdFiles& files, const fs::path& run) {
  const auto worst = std::max_element(found.error.begin(), found.error.end());
  const auto at = static_cast<std::size_t>(worst - found.error.begin());
  Json j, errors;
  j["status"] = "done";
  describe_program(j);
  j["field"] = "displacement";
  j["frame"] = "rotating";
  j["weight"] = "search-direction";
  j["unit"] = "m";
  j["time_unit"] = "1";
  j["method"] = "latin-pgd";
  j["rows"] = 2 * m.mesh->n_nodes();
  j["snapshots"] = m.parameter.size();
  j["energy"] = found.d.energy;
  j["sigma_1"] = found.d.sigma.size() > 0 ? found.d.sigma[0] : 0.0;
  j["rank"] = found.d.rank;
  j["modes_kept"] = files.modes;
  add_counts(found.spectrum, j["modes_for"], errors);
  j["worst_snapshot"] = {{"error", *worst}, {"time", m.parameter[at]}, {"run", run.string()}};
  j["orthonormality"] = files.orthonormality;
  j["runs"].push_back({{"directory", run.string()},
                       {"title", m.title},
                       {"snapshots", m.parameter.size()},
                       {"from", m.parameter.front()},
                       {"to", m.parameter.back()},
                       {"energy_share", 1.0},
                       {"error", files.left_out},
                       {"error_with_modes_for", errors}});
  j["latin"] = {{"search_direction", m.direction},  {"last_cut", m.share},
                {"iterations", m.latin.iterations}, {"indicator", m.latin.indicator},
                {"residual", m.latin.residual},     {"solves", m.solves},
                {"most_modes", m.most_modes},       {"basis", m.basis->cols()}};
  return j;
}

void make_directory(const fs::path& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) throw FileError(directory.string(), "cannot create: " + error.message());
}

constexpr const char* wanted =
    "the directory of a run with analysis.solver = \"latin-pgd\" and the same mesh";

[[noreturn]] void refuse(const fs::path& run, const std::string& what) {
  throw request_error("--modes-from", run.string(), what, wanted);
}

/// The directory of the modes. @throws InputError
fs::path directory_of(const fs::path& run) {
  std::error_code none;
  if (!fs::exists(run, none)) refuse(run, "there is no such directory");
  if (!fs::is_directory(run, none)) refuse(run, "is not a directory");
  const bool of_run = !io::mark_of_run(run).empty();
  fs::path directory = of_run ? run / place : run;
  const bool basis = fs::exists(directory / "basis.h5", none);
  if (!basis && !of_run && !fs::exists(directory / "pod.json", none)) refuse(run, "holds no run");
  if (!basis) refuse(run, "holds no modes of LATIN-PGD");
  if (!fs::exists(directory / "pod.json", none))
    refuse(run, fmt::format("its modes are not complete ({} holds no pod.json): the program was "
                            "killed as it wrote them; run it again",
                            directory.string()));
  return directory;
}

}  // namespace

PgdFiles write_pgd(const fs::path& run, const PgdModes& m) {
  RONDO_DEMAND(m.mesh && m.solution && m.basis && !m.parameter.empty(), m.parameter.size());
  RONDO_DEMAND(m.solution->temporal.rows() == static_cast<Index>(m.parameter.size()),
               m.solution->temporal.rows(), m.parameter.size());
  const Found found = find(*m.solution, m.share);
  PgdFiles files;
  files.values = static_cast<int>(found.d.sigma.size());
  files.modes = static_cast<int>(found.d.modes.cols());
  files.left_out = left_out(found.spectrum, files.modes);
  files.orthonormality = orthonormality(*m.solution, files.modes);
  const fs::path directory = run / place;
  make_directory(directory);
  io::PodWriter writer(directory, content_of(m, found, run), 0);
  writer.commit();
  io::write_json(directory / "pod.json", as_json(m, found, files, run));
  return files;
}

fs::path pgd_basis_file(const fs::path& run) {
  return directory_of(run) / "basis.h5";
}

Eigen::MatrixXd read_pgd_basis(const fs::path& run, const mesh::Mesh& mesh) {
  io::Basis basis = io::read_basis(pgd_basis_file(run));
  if (const std::string text = io::mesh_difference(mesh, basis.mesh); !text.empty())
    refuse(run, fmt::format("its modes are of another mesh: here against there, {}", text));
  if (basis.field.cols() == 0)
    refuse(run, "holds no mode: nothing was touched there, or no increment was deformed");
  return std::move(basis.field);
}

}  // namespace rondo::study
