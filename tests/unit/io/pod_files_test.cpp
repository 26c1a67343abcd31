// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/pod_files.hpp"

#include <array>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <tuple>

#include "rondo/io/basis_file.hpp"
#include "rondo/io/files.hpp"
#include "rondo/io/h5/h5.hpp"
#include "rondo/io/mesh_files.hpp"
#include "unit/io/support.hpp"

namespace rondo::io::test::pod_files_test {
namespace {

using h5::Shape;
using Vector = std::array<float, 3>;
namespace fs = std::filesystem;

/// A POD whose numbers are easy to check, of no snapshots in particular.
class SmallPod {
 public:
  SmallPod(Eigen::Index r, Eigen::Index k, Eigen::Index t, bool contact = false)
      : modes(2 * n_points(contact), r) {
    d.sigma = Eigen::VectorXd::LinSpaced(k, static_cast<double>(k), 1.0);
    d.temporal.resize(t, k);
    for (Eigen::Index i = 0; i < d.temporal.size(); ++i)
      d.temporal.data()[i] = 0.01 * static_cast<double>(i);
    for (Eigen::Index i = 0; i < modes.size(); ++i) modes.data()[i] = static_cast<double>(i) - 7.0;
    for (Eigen::Index i = 0; i < k; ++i) {
      s.energy.push_back(0.5 / static_cast<double>(i + 1));
      s.cumulative.push_back(0.1 * static_cast<double>(i));
      s.discarded.push_back(1e-9 / static_cast<double>(i + 1));
    }
    for (Eigen::Index j = 0; j < t; ++j) {
      time.push_back(0.1 * static_cast<double>(j));
      angle.push_back(-1.5 * static_cast<double>(j));
      error.push_back(1e-3 * static_cast<double>(j));
      place.push_back(j < 2 ? 0 : 1);
    }
    weight.resize(static_cast<std::size_t>(n_points(contact)), 0.25);
    c.mesh = &run.mesh, c.mass = run.mass;
    c.contact = contact;
    c.quantity = contact ? "contact" : "displacement", c.unit = contact ? "N/m" : "m";
    c.frame = "rectified", c.shift = "fourier", c.weight = contact ? "delassus" : "mass";
    c.point_weight = weight;
    c.decomposition = &d, c.spectrum = &s, c.modes = &modes;
    c.time = time, c.angle = angle, c.run = place, c.error = error, c.runs = runs;
  }
  [[nodiscard]] Eigen::Index n_points(bool contact) const {
    return static_cast<Eigen::Index>(contact ? run.nb() : run.n());
  }
  [[nodiscard]] std::vector<Vec2> field(double value) const {
    std::vector<Vec2> values(weight.size());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = {value + 0.5 * double(i), -value};
    return values;
  }
  void write(const fs::path& directory, std::size_t n_reconstructed) const {
    PodWriter writer(directory, c, n_reconstructed);
    for (std::size_t j = 0; j < n_reconstructed; ++j)
      writer.add(0.5 * double(j), field(double(j)), field(double(j) + 0.125));
    writer.commit();
  }

  SmallRun run;
  pod::Decomposition d;
  pod::Spectrum s;
  Eigen::MatrixXd modes;
  std::vector<double> time, angle, error, weight;
  std::vector<int> place;
  std::vector<std::string> runs = {"first run", "été"};
  PodContent c;
};

std::set<std::string> names_in(const fs::path& directory) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(directory)) names.insert(entry.path().filename());
  return names;
}

const std::set<std::string> all_files = {"pod.h5", "spectrum.csv", "modes.xdmf",
                                         "reconstruction.xdmf"};

TEST(PodFiles, EveryDatasetHasItsShapeUnitsAndDescription) {
  const Folder folder;
  const SmallPod pod(3, 4, 5);
  pod.write(folder.path(), 2);
  EXPECT_EQ(names_in(folder.path()), all_files);
  const h5::File file = h5::File::open(folder / "pod.h5");
  const std::size_t n = pod.run.n();
  const std::string sigma = "m (kg/m)^(1/2)", phi = "(kg/m)^(-1/2)";
  const std::vector<std::tuple<std::string, Shape, std::string>> expected = {
      {"/mesh/coordinates", {n, 2}, "m"},
      {"/mesh/mass", {n}, "kg/m"},
      {"/modes/spatial", {3, n, 2}, phi},
      {"/modes/temporal", {5, 4}, "1"},
      {"/modes/coefficients", {5, 3}, sigma},
      {"/spectrum/singular_value", {4}, sigma},
      {"/spectrum/energy", {4}, "1"},
      {"/spectrum/cumulative_energy", {4}, "1"},
      {"/spectrum/discarded_energy", {4}, "1"},
      {"/snapshots/time", {5}, "s"},
      {"/snapshots/angle", {5}, "rad"},
      {"/snapshots/run", {5}, "1"},
      {"/snapshots/error", {5}, "1"},
      {"/weight", {n}, "kg/m"},
      {"/fields/modes", {3, n, 3}, phi},
      {"/fields/original", {2, n, 3}, "m"},
      {"/fields/reconstructed", {2, n, 3}, "m"},
      {"/fields/error", {2, n, 3}, "m"}};
  for (const auto& [name, shape, units] : expected) {
    EXPECT_EQ(file.dataset(name).shape(), shape) << name;
    EXPECT_EQ(file.dataset(name).label().units, units) << name;
    EXPECT_GT(file.dataset(name).label().description.size(), 10U) << name;
  }
  EXPECT_EQ(file.attribute("/", "format"), "rondo pod 1");
  EXPECT_EQ(file.attribute("/", "quantity"), "displacement");
  EXPECT_EQ(file.attribute("/", "frame"), "rectified");
  EXPECT_EQ(file.attribute("/", "shift"), "fourier");
  EXPECT_EQ(file.attribute("/", "weight"), "mass");
  EXPECT_EQ(file.attribute("/snapshots/run", "run_0"), "first run");
  EXPECT_EQ(file.attribute("/snapshots/run", "run_1"), "été");
}

TEST(PodFiles, WhatWasGivenIsReadBack) {
  const Folder folder;
  const SmallPod pod(3, 4, 5);
  pod.write(folder.path(), 2);
  const h5::File file = h5::File::open(folder / "pod.h5");
  const auto spatial = file.read<double>("/modes/spatial");
  const auto temporal = file.read<double>("/modes/temporal");
  const auto coefficients = file.read<double>("/modes/coefficients");
  const auto rows = static_cast<std::size_t>(pod.modes.rows());
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index p = 0; p < pod.modes.rows(); ++p)
      EXPECT_EQ(spatial[static_cast<std::size_t>(i) * rows + static_cast<std::size_t>(p)],
                pod.modes(p, i));
  for (Eigen::Index j = 0; j < 5; ++j) {
    for (Eigen::Index i = 0; i < 4; ++i)
      EXPECT_EQ(temporal[static_cast<std::size_t>(4 * j + i)], pod.d.temporal(j, i));
    for (Eigen::Index i = 0; i < 3; ++i)
      EXPECT_EQ(coefficients[static_cast<std::size_t>(3 * j + i)],
                pod.d.temporal(j, i) * pod.d.sigma[i]);
  }
  EXPECT_EQ(file.read<double>("/spectrum/singular_value"), (std::vector<double>{4, 3, 2, 1}));
  EXPECT_EQ(file.read<double>("/spectrum/energy"), pod.s.energy);
  EXPECT_EQ(file.read<double>("/spectrum/cumulative_energy"), pod.s.cumulative);
  EXPECT_EQ(file.read<double>("/spectrum/discarded_energy"), pod.s.discarded);
  EXPECT_EQ(file.read<double>("/snapshots/time"), pod.time);
  EXPECT_EQ(file.read<double>("/snapshots/angle"), pod.angle);
  EXPECT_EQ(file.read<int>("/snapshots/run"), pod.place);
  EXPECT_EQ(file.read<double>("/snapshots/error"), pod.error);
  EXPECT_EQ(file.read<double>("/weight"), pod.weight);
  const MeshWithMass mesh = read_mesh(file);
  EXPECT_EQ(mesh.mesh.cells, pod.run.mesh.cells);
  EXPECT_EQ(mesh.mesh.n_sectors, pod.run.mesh.n_sectors);
  EXPECT_EQ(mesh.mass, pod.run.mass);
}

TEST(PodFiles, FieldsForParaViewAreOnTheNodes) {
  const Folder folder;
  const SmallPod pod(2, 2, 2);
  pod.write(folder.path(), 2);
  const h5::File file = h5::File::open(folder / "pod.h5");
  const auto mode = row_of<Vector>(file.dataset("/fields/modes"), 1);
  const auto original = row_of<Vector>(file.dataset("/fields/original"), 1);
  const auto error = row_of<Vector>(file.dataset("/fields/error"), 1);
  for (std::size_t i = 0; i < pod.run.n(); ++i) {
    const auto row = static_cast<Eigen::Index>(2 * i);
    EXPECT_EQ(mode[i], (Vector{float(pod.modes(row, 1)), float(pod.modes(row + 1, 1)), 0.0F}));
    EXPECT_EQ(original[i], (Vector{float(1.0 + 0.5 * double(i)), -1.0F, 0.0F}));
    EXPECT_EQ(error[i], (Vector{-0.125F, 0.125F, 0.0F}));  // original minus reconstructed
  }
}

TEST(PodFiles, ContactIsOnTheCandidatesAndZeroElsewhere) {
  const Folder folder;
  const SmallPod pod(2, 2, 2, true);
  pod.write(folder.path(), 1);
  const h5::File file = h5::File::open(folder / "pod.h5");
  EXPECT_EQ(file.dataset("/modes/spatial").shape(), (Shape{2, pod.run.nb(), 2}));
  EXPECT_EQ(file.dataset("/spectrum/singular_value").label().units, "N/m (kg/m)^(-1/2)");
  EXPECT_EQ(file.dataset("/modes/spatial").label().units, "(kg/m)^(1/2)");
  EXPECT_EQ(file.dataset("/weight").label().units, "m/kg");
  const auto mode = row_of<Vector>(file.dataset("/fields/modes"), 1);
  std::vector<Vector> expected(pod.run.n(), Vector{});
  for (std::size_t b = 0; b < pod.run.nb(); ++b) {
    const auto row = static_cast<Eigen::Index>(2 * b);
    expected[static_cast<std::size_t>(pod.run.mesh.boundary[b])] = {
        float(pod.modes(row, 1)), float(pod.modes(row + 1, 1)), 0.0F};
  }
  EXPECT_EQ(mode, expected);
  const std::string text = text_of(folder / "modes.xdmf");
  EXPECT_NE(text.find("<Attribute Name=\"normal\" AttributeType=\"Scalar\""), std::string::npos);
  EXPECT_NE(text.find("<Attribute Name=\"tangential\" AttributeType=\"Scalar\""),
            std::string::npos);
  EXPECT_NE(text_of(folder / "reconstruction.xdmf").find("\"error_tangential\""),
            std::string::npos);
}

TEST(PodFiles, SpectrumAsText) {
  const Folder folder;
  const SmallPod pod(1, 2, 2);
  pod.write(folder.path(), 0);
  EXPECT_EQ(text_of(folder / "spectrum.csv"),
            "mode,singular_value,energy,cumulative_energy,discarded_energy\n"
            "1,2,0.5,0,1e-09\n"
            "2,1,0.25,0.1,5e-10\n");
}

/// Each slab of the file lies in its dataset; so do the reference mesh and the cells.
void expect_slabs(const fs::path& xdmf, const h5::File& file, std::size_t n_slabs) {
  const std::string text = text_of(xdmf);
  EXPECT_TRUE(is_well_formed(text)) << text;
  const auto numbers = [](const std::string& list) {
    std::istringstream in(list);
    return std::vector<std::size_t>(std::istream_iterator<std::size_t>(in), {});
  };
  const std::regex slab("pod\\.h5:(/[a-z_/]+)\\|([0-9 ]+):([0-9 ]+):([0-9 ]+):([0-9 ]+)<");
  std::size_t found = 0;
  for (std::sregex_iterator i(text.begin(), text.end(), slab), end; i != end; ++i, ++found) {
    const Shape shape = file.dataset((*i)[1]).shape();
    const auto start = numbers((*i)[2]), stride = numbers((*i)[3]), count = numbers((*i)[4]);
    EXPECT_EQ(numbers((*i)[5]), shape) << (*i)[0];
    ASSERT_EQ(start.size(), shape.size());
    for (std::size_t a = 0; a < shape.size(); ++a)
      EXPECT_LE(start[a] + (count[a] - 1) * stride[a] + 1, shape[a]) << (*i)[0];
  }
  EXPECT_EQ(found, n_slabs);
  const std::regex whole("Dimensions=\"([0-9 ]+)\">pod\\.h5:(/mesh/[a-z_]+)<");
  std::set<std::string> meshes;
  for (std::sregex_iterator i(text.begin(), text.end(), whole), end; i != end; ++i) {
    EXPECT_EQ(numbers((*i)[1]), file.dataset((*i)[2]).shape());
    meshes.insert((*i)[2]);
  }
  EXPECT_EQ(meshes, (std::set<std::string>{"/mesh/cells", "/mesh/coordinates"}));
}

TEST(PodFiles, XdmfNamesWhatIsThere) {
  for (const bool contact : {false, true}) {
    const Folder folder;
    SmallPod(3, 4, 5, contact).write(folder.path(), 2);
    const h5::File file = h5::File::open(folder / "pod.h5");
    const std::size_t arrays = contact ? 2 : 1;
    expect_slabs(folder / "modes.xdmf", file, 3 * arrays);
    expect_slabs(folder / "reconstruction.xdmf", file, 2 * 3 * arrays);
    const std::string modes = text_of(folder / "modes.xdmf");
    for (const char* mode : {"<Time Value=\"1\"/>", "<Time Value=\"2\"/>", "<Time Value=\"3\"/>"})
      EXPECT_NE(modes.find(mode), std::string::npos);
    EXPECT_NE(text_of(folder / "reconstruction.xdmf").find("<Time Value=\"0.5\"/>"),
              std::string::npos);
  }
}

TEST(PodFiles, ANormThatIsNotOfPointsHasNoWeights) {
  const Folder folder;
  SmallPod pod(2, 3, 4);
  pod.c.weight = "search-direction";
  pod.c.point_weight = {};
  pod.write(folder.path(), 0);
  const h5::File file = h5::File::open(folder / "pod.h5");
  EXPECT_FALSE(file.contains("/weight"));
  EXPECT_EQ(file.dataset("/modes/spatial").label().units, "m (J/m)^(-1/2)");
  for (const char* name : {"/spectrum/singular_value", "/modes/coefficients"})
    EXPECT_EQ(file.dataset(name).label().units, "(J/m)^(1/2)");
  EXPECT_EQ(file.attribute("/", "weight"), "search-direction");
}

TEST(PodFiles, ABasisComesAndGoesWithItsPod) {
  const Folder folder;
  SmallPod pod(2, 3, 4);
  const Eigen::MatrixXd basis = Eigen::MatrixXd::Random(pod.modes.rows(), 5);
  pod.c.basis = &basis;
  pod.write(folder.path(), 0);
  const Basis read = read_basis(folder / "basis.h5");
  EXPECT_EQ(read.field, basis);
  EXPECT_EQ(mesh_difference(read.mesh, pod.run.mesh), "");
  EXPECT_EQ(h5::File::open(folder / "basis.h5").dataset("/basis/field").label().units,
            "m (J/m)^(-1/2)");
  SmallPod(1, 2, 2).write(folder.path(), 0);
  EXPECT_EQ(names_in(folder.path()),
            (std::set<std::string>{"pod.h5", "spectrum.csv", "modes.xdmf"}));
}

TEST(PodFiles, WithoutModes) {
  const Folder folder;
  const SmallPod pod(0, 4, 5);
  pod.write(folder.path(), 1);
  const h5::File file = h5::File::open(folder / "pod.h5");
  for (const char* name : {"/modes/spatial", "/modes/coefficients", "/fields/modes"})
    EXPECT_FALSE(file.contains(name)) << name;
  EXPECT_EQ(file.dataset("/modes/temporal").shape(), (Shape{5, 4}));
  EXPECT_EQ(file.dataset("/fields/error").shape(), (Shape{1, pod.run.n(), 3}));
  expect_slabs(folder / "modes.xdmf", file, 0);
}

TEST(PodFiles, ReplaceThoseOfAnotherPodOnlyWhenComplete) {
  const Folder folder;
  SmallPod(3, 4, 5).write(folder.path(), 2);
  put_text(folder / "pod.json", "{}");
  put_text(folder / "notes.txt", "mine");
  std::map<std::string, std::string> before;
  for (const std::string& name : names_in(folder.path())) before[name] = text_of(folder / name);
  const auto expect_unchanged = [&] {
    for (const auto& [name, text] : before) EXPECT_EQ(text_of(folder / name), text) << name;
  };
  const SmallPod other(2, 2, 2);
  static_cast<void>(in_child([&] {
    PodWriter writer(folder.path(), other.c, 2);
    writer.add(0.0, other.field(1.0), other.field(1.0));
    std::raise(SIGKILL);
  }));
  expect_unchanged();
  for (const auto& entry : fs::directory_iterator(folder.path()))
    if (entry.is_directory()) fs::remove_all(entry.path());  // left by the killed one
  {
    PodWriter writer(folder.path(), other.c, 2);
    writer.add(0.0, other.field(1.0), other.field(1.0));
  }
  expect_unchanged();
  EXPECT_EQ(names_in(folder.path()).size(), before.size());  // nothing is left
  other.write(folder.path(), 0);
  EXPECT_EQ(names_in(folder.path()),
            (std::set<std::string>{"pod.h5", "spectrum.csv", "modes.xdmf", "notes.txt"}));
  EXPECT_EQ(h5::File::open(folder / "pod.h5").dataset("/modes/spatial").shape()[0], 2U);
}

TEST(PodFiles, OutOfRoomLeavesTheOldOnes) {
  const Folder folder;
  SmallPod(1, 2, 2).write(folder.path(), 0);
  const std::string before = text_of(folder / "pod.h5");
  const SmallPod other(3, 4, 50);
  EXPECT_TRUE(went_well(in_child([&] {
    limit_files(8000);
    const std::string what = error_of<FileError>([&] { other.write(folder.path(), 2); });
    EXPECT_NE(what.find("pod.h5: cannot "), std::string::npos) << what;
    EXPECT_NE(what.find("File too large"), std::string::npos) << what;
    if (::testing::Test::HasFailure()) std::_Exit(1);
  })));
  EXPECT_EQ(text_of(folder / "pod.h5"), before);
  EXPECT_EQ(names_in(folder.path()).size(), 3U);
}

TEST(PodFiles, DirectoryMustBeThere) {
  const Folder folder;
  const SmallPod pod(1, 2, 2);
  const std::string what = error_of<FileError>([&] { pod.write(folder / "none", 0); });
  EXPECT_NE(what.find("none/.pod."), std::string::npos) << what;
  EXPECT_NE(what.find("cannot create directory: No such file"), std::string::npos) << what;
}

TEST(PodFiles, SizeIsForetold) {
  const Folder folder;
  const SmallPod pod(20, 40, 500);
  pod.write(folder.path(), 3);
  const auto size = static_cast<double>(fs::file_size(folder / "pod.h5"));
  const auto told = static_cast<double>(PodWriter::bytes(pod.c, 3));
  EXPECT_GE(told, size);
  EXPECT_LE(told, size + 65536);  // set aside for the descriptions
}

TEST(PodFiles, SameValuesGiveTheSameBytes) {
  const Folder a, b;
  SmallPod(2, 3, 4).write(a.path(), 2);
  SmallPod(2, 3, 4).write(b.path(), 2);
  for (const std::string& name : all_files) EXPECT_EQ(text_of(a / name), text_of(b / name)) << name;
}

}  // namespace
}  // namespace rondo::io::test::pod_files_test
