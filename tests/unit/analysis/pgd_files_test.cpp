// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/crush/pgd_files.hpp"

#include <set>

#include "rondo/fem/stiffness_product.hpp"
#include "rondo/io/files.hpp"
#include "rondo/io/h5/h5.hpp"
#include "support/latin.hpp"
#include "unit/io/support.hpp"

namespace rondo::study::pgd_files_test {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using io::test::error_of;
using io::test::Folder;
using rondo::test::LatinDisk;
using rondo::test::pressing;

constexpr int increments = 30;
constexpr double share = 1e-3;
constexpr const char* in_run = "pod/displacement-pgd";

/// A disk pressed by LATIN-PGD, and what a run would write of it.
class SolvedDisk {
 public:
  explicit SolvedDisk(double friction = 0.3)
      : problem_(disk.problem(pressing(increments, 0.02), friction)),
        direction(statics::chosen_direction(problem_.compliance, false)),
        stiffened_(disk.stiffened(direction)),
        pgd(*stiffened_, disk.nodes(), {.direction = direction}),
        mass_(disk.mesh().n_nodes(), 0.5) {
    statics::Latin latin(problem_, pgd, direction, 0.8);
    for (int k = 0; k < 15; ++k) modes.latin = latin.iterate();
    all = pgd.separated(0.0);
    basis = pgd.basis().field;
    modes.mesh = &disk.mesh();
    modes.mass = mass_;
    modes.title = "small";
    for (int k = 1; k <= increments; ++k)
      modes.parameter.push_back(static_cast<double>(k) / increments);
    modes.solution = &all;
    modes.basis = &basis;
    modes.share = share;
    modes.direction = direction;
    modes.solves = pgd.solves();
    modes.most_modes = pgd.most_modes();
  }

  /// uᵀ(K + k HᵀH)v, by the stiffness itself.
  [[nodiscard]] double product(const VectorXd& u, const VectorXd& v) const {
    const fem::BlockCsr a = statics::with_springs(disk.stiffness(), disk.nodes(), direction);
    std::vector<Vec2> from(a.n_rows()), to(a.n_rows());
    for (std::size_t i = 0; i < from.size(); ++i)
      from[i] = {v[static_cast<Index>(2 * i)], v[static_cast<Index>(2 * i + 1)]};
    fem::apply(a, from, to, 1);
    double sum = 0.0;
    for (std::size_t i = 0; i < to.size(); ++i)
      sum += u[static_cast<Index>(2 * i)] * to[i].x + u[static_cast<Index>(2 * i + 1)] * to[i].y;
    return sum;
  }

  LatinDisk disk{4, 60, 15};

 private:
  statics::LatinProblem problem_;

 public:
  double direction;

 private:
  std::unique_ptr<statics::Condensation> stiffened_;

 public:
  statics::Pgd pgd;
  statics::Separated all;
  MatrixXd basis;
  PgdModes modes;

 private:
  std::vector<double> mass_;
};

const SolvedDisk& solved() {
  static const SolvedDisk disk;
  return disk;
}

/// The folder of a run, with its modes.
class RunFolder : public Folder {
 public:
  RunFolder() {
    io::test::put_text(path() / "run.json", "{}");
    files = write_pgd(path(), solved().modes);
  }
  [[nodiscard]] fs::path pod() const { return path() / in_run; }
  PgdFiles files;
};

MatrixXd columns_of(const io::h5::File& file, const char* name, Index rows) {
  const std::vector<double> numbers = file.read<double>(name);
  return Eigen::Map<const MatrixXd>(numbers.data(), rows,
                                    static_cast<Index>(numbers.size()) / rows);
}

TEST(PgdFiles, ADirectoryAsThatOfAPodAndTheBasis) {
  const RunFolder run;
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(run.pod())) names.insert(entry.path().filename());
  EXPECT_EQ(names, (std::set<std::string>{"basis.h5", "modes.xdmf", "pod.h5", "pod.json",
                                          "spectrum.csv"}));
  const io::h5::File file = io::h5::File::open(run.pod() / "pod.h5");
  EXPECT_EQ(file.attribute("/", "weight"), "search-direction");
  EXPECT_EQ(file.attribute("/", "frame"), "rotating");
  EXPECT_EQ(file.read<double>("/snapshots/time"), solved().modes.parameter);
  EXPECT_EQ(file.dataset("/snapshots/time").label().units, "1");
  EXPECT_EQ(file.attribute("/snapshots/run", "run_0"), run.path().string());
  EXPECT_FALSE(file.contains("/weight"));
}

TEST(PgdFiles, ModesAreThoseOfTheLastCutOrthonormalInTheNorm) {
  const RunFolder run;
  const SolvedDisk& s = solved();
  const statics::Separated cut = s.pgd.separated(share);
  const io::h5::File file = io::h5::File::open(run.pod() / "pod.h5");
  const MatrixXd spatial = columns_of(file, "/modes/spatial", cut.modes.field.rows());
  ASSERT_EQ(spatial.cols(), cut.sigma.size());
  ASSERT_GE(spatial.cols(), 3);
  EXPECT_LT(spatial.cols(), s.all.sigma.size());
  EXPECT_EQ(run.files.modes, spatial.cols());
  EXPECT_EQ(run.files.values, s.all.sigma.size());
  double off = 0.0;
  for (Index i = 0; i < spatial.cols(); ++i) {
    Index at = 0;
    spatial.col(i).cwiseAbs().maxCoeff(&at);
    EXPECT_GT(spatial(at, i), 0.0) << i;
    for (Index j = 0; j < spatial.cols(); ++j)
      off = std::max(off, std::abs(s.product(spatial.col(i), spatial.col(j)) - (i == j)));
  }
  EXPECT_LT(off, 1e-9);
  EXPECT_LT(run.files.orthonormality, 1e-9);
  EXPECT_GT(run.files.orthonormality, 0.0);
}

TEST(PgdFiles, ModesAndCoefficientsGiveTheDisplacementAndItsErrors) {
  const RunFolder run;
  const SolvedDisk& s = solved();
  const io::h5::File file = io::h5::File::open(run.pod() / "pod.h5");
  const MatrixXd spatial = columns_of(file, "/modes/spatial", s.all.modes.field.rows());
  const MatrixXd coefficients = columns_of(file, "/modes/coefficients", spatial.cols());
  const MatrixXd field = s.all.modes.field * s.all.sigma.asDiagonal() * s.all.temporal.transpose();
  const std::vector<double> errors = file.read<double>("/snapshots/error");
  double left = 0.0, whole = 0.0;
  for (Index k = 0; k < increments; ++k) {
    const VectorXd rest = field.col(k) - spatial * coefficients.col(k);
    const double squares = s.product(field.col(k), field.col(k));
    const double off = s.product(rest, rest);
    EXPECT_NEAR(errors[static_cast<std::size_t>(k)], std::sqrt(off / squares), 1e-7) << k;
    left += off;
    whole += squares;
  }
  EXPECT_NEAR(run.files.left_out, std::sqrt(left / whole), 1e-8);
  EXPECT_LE(run.files.left_out, share);
  EXPECT_GT(run.files.left_out, 0.0);
}

TEST(PgdFiles, TheSpectrumIsThatOfAllBeforeTheLastCut) {
  const RunFolder run;
  const SolvedDisk& s = solved();
  const io::h5::File file = io::h5::File::open(run.pod() / "pod.h5");
  const VectorXd sigma = columns_of(file, "/spectrum/singular_value", s.all.sigma.size());
  EXPECT_EQ(sigma, s.all.sigma);
  const auto discarded = file.read<double>("/spectrum/discarded_energy");
  EXPECT_EQ(discarded.back(), 0.0);
  EXPECT_NEAR(discarded[0], s.all.sigma.tail(sigma.size() - 1).squaredNorm() / sigma.squaredNorm(),
              1e-14);
  EXPECT_EQ(std::sqrt(discarded[static_cast<std::size_t>(run.files.modes - 1)]),
            run.files.left_out);
}

TEST(PgdFiles, PodJsonSaysWhatThePackageReads) {
  const RunFolder run;
  const SolvedDisk& s = solved();
  const auto j = io::read_json(run.pod() / "pod.json");
  for (const auto& [key, value] : {std::pair("status", "done"), std::pair("field", "displacement"),
                                   std::pair("frame", "rotating"), std::pair("unit", "m"),
                                   std::pair("weight", "search-direction"),
                                   std::pair("time_unit", "1"), std::pair("method", "latin-pgd")})
    EXPECT_EQ(j.at(key).get<std::string>(), value) << key;
  EXPECT_EQ(j.at("modes_kept"), run.files.modes);
  EXPECT_EQ(j.at("snapshots"), increments);
  const auto& counts = j.at("modes_for");
  EXPECT_EQ(counts.at("1e-02"), 1);
  const int modes = counts.at("1e-06").get<int>();
  EXPECT_EQ(modes, statics::values_kept(s.all.sigma, 1e-3));
  const auto& of_run = j.at("runs").at(0);
  EXPECT_LE(of_run.at("error_with_modes_for").at("1e-06").get<double>(), 1e-3);
  EXPECT_EQ(of_run.at("error"), run.files.left_out);
  EXPECT_EQ(of_run.at("title"), "small");
  const auto& latin = j.at("latin");
  EXPECT_EQ(latin.at("iterations"), 15);
  EXPECT_EQ(latin.at("solves"), s.pgd.solves());
  EXPECT_EQ(latin.at("most_modes"), s.pgd.most_modes());
  EXPECT_EQ(latin.at("search_direction"), s.direction);
  EXPECT_EQ(latin.at("last_cut"), share);
  EXPECT_EQ(latin.at("basis"), s.basis.cols());
  EXPECT_EQ(latin.at("indicator"), s.modes.latin.indicator);
  EXPECT_EQ(latin.at("residual"), s.modes.latin.residual);
}

TEST(PgdFiles, OfABodyThatNothingTouchesThereAreNoModes) {
  const Folder folder;
  PgdModes modes = solved().modes;
  statics::Separated none = solved().all;
  none.sigma.setZero();
  const MatrixXd basis(none.modes.field.rows(), 0);
  modes.solution = &none;
  modes.basis = &basis;
  const PgdFiles files = write_pgd(folder.path(), modes);
  EXPECT_EQ(files.modes, 0);
  EXPECT_EQ(files.left_out, 0.0);
  const auto j = io::read_json(folder.path() / in_run / "pod.json");
  EXPECT_EQ(j.at("modes_kept"), 0);
  EXPECT_EQ(j.at("modes_for").at("1e-06"), 0);
  io::test::put_text(folder / "run.json", "{}");
  const std::string what = error_of<InputError>(
      [&] { static_cast<void>(read_pgd_basis(folder.path(), solved().disk.mesh())); });
  EXPECT_NE(what.find("holds no mode:"), std::string::npos) << what;
}

TEST(PgdBasis, IsReadBackFromTheRunAndFromTheDirectory) {
  const RunFolder run;
  const SolvedDisk& s = solved();
  ASSERT_GT(s.basis.cols(), run.files.modes);
  EXPECT_EQ(read_pgd_basis(run.path(), s.disk.mesh()), s.basis);
  EXPECT_EQ(read_pgd_basis(run.pod(), s.disk.mesh()), s.basis);
  const statics::Adopted adopted = statics::adopt(s.disk.stiffness(), s.disk.nodes(), s.direction,
                                                  read_pgd_basis(run.path(), s.disk.mesh()));
  EXPECT_LT(adopted.foreign, 1e-9);
}

std::string refused(const fs::path& run, const mesh::Mesh& mesh) {
  return error_of<InputError>([&] { static_cast<void>(read_pgd_basis(run, mesh)); });
}

void expect_parts(const std::string& what, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(what.find(part), std::string::npos) << part << ": " << what;
}

TEST(PgdBasis, ARunWithoutModesIsRefused) {
  const Folder folder;
  const mesh::Mesh& mesh = solved().disk.mesh();
  expect_parts(refused(folder / "none", mesh),
               {"--modes-from", (folder / "none").string(), "there is no such directory"});
  expect_parts(refused(folder.path(), mesh), {"holds no run"});
  io::test::put_text(folder / "run.json", "{}");
  expect_parts(refused(folder / "run.json", mesh), {"is not a directory"});
  expect_parts(refused(folder.path(), mesh),
               {"holds no modes of LATIN-PGD", "analysis.solver = \"latin-pgd\""});
}

TEST(PgdBasis, ModesThatWereNotWrittenToTheEndAreRefused) {
  const RunFolder run;
  fs::remove(run.pod() / "pod.json");
  expect_parts(refused(run.path(), solved().disk.mesh()),
               {"its modes are not complete", in_run, "pod.json", "run it again"});
  fs::rename(run.pod() / "basis.h5", run.pod() / "pod.json");  // as of `rondo pod`: no basis
  expect_parts(refused(run.pod(), solved().disk.mesh()), {"holds no modes of LATIN-PGD"});
}

TEST(PgdBasis, ModesOfAnotherMeshAreRefused) {
  const RunFolder run;
  expect_parts(refused(run.path(), LatinDisk(5, 60, 15).mesh()),
               {"of another mesh", "360 nodes against 300"});
  mesh::Mesh moved = solved().disk.mesh();
  moved.coordinates[7].x += 1e-6;
  expect_parts(refused(run.path(), moved), {"of another mesh", "node 7 by 1e-06 m"});
  mesh::Mesh joined = solved().disk.mesh();
  std::swap(joined.cells[3], joined.cells[4]);
  expect_parts(refused(run.path(), joined), {"of another mesh", "cells differ at cell 3"});
  joined.cells.pop_back();
  expect_parts(refused(run.path(), joined), {"of another mesh", "239 cells against 240"});
}

TEST(PgdBasis, ADamagedFileIsAnErrorOfFiles) {
  const RunFolder run;
  const fs::path file = run.pod() / "basis.h5";
  const std::string text = io::test::text_of(file);
  io::test::put_text(file, text.substr(0, text.size() / 2));
  const std::string what = error_of<FileError>(
      [&] { static_cast<void>(read_pgd_basis(run.path(), solved().disk.mesh())); });
  expect_parts(what, {"basis.h5"});
}

}  // namespace
}  // namespace rondo::study::pgd_files_test
