// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/basis_file.hpp"

#include <cmath>

#include "rondo/io/h5/h5.hpp"
#include "unit/io/support.hpp"

namespace rondo::io::test::basis_file_test {
namespace {

Eigen::Index rows_of(const SmallRun& run) {
  return static_cast<Eigen::Index>(2 * run.n());
}

TEST(BasisFile, MayHoldNoField) {
  const Folder folder;
  const SmallRun run;
  write_basis(folder / "basis.h5", run.mesh, run.mass, Eigen::MatrixXd(rows_of(run), 0));
  EXPECT_FALSE(h5::File::open(folder / "basis.h5").contains("/basis/field"));
  EXPECT_EQ(read_basis(folder / "basis.h5").field.rows(), rows_of(run));
  EXPECT_EQ(read_basis(folder / "basis.h5").field.cols(), 0);
}

TEST(BasisFile, IsNamedWhereItIsDamaged) {
  const Folder folder;
  const SmallRun run;
  Eigen::MatrixXd field = Eigen::MatrixXd::Ones(rows_of(run), 2);
  field(3, 1) = std::nan("");
  const std::filesystem::path file = folder / "basis.h5";
  const auto expect = [&](const char* part) {
    const std::string what = error_of<FileError>([&] { static_cast<void>(read_basis(file)); });
    EXPECT_NE(what.find("basis.h5"), std::string::npos) << what;
    EXPECT_NE(what.find(part), std::string::npos) << what;
  };
  expect("cannot");
  write_basis(file, run.mesh, run.mass, field);
  expect("/basis/field holds what is not a number: damaged");
  h5::File other = h5::File::create(file);
  other.set_attribute("/", "format", "rondo pod 1");
  other.close();
  expect("its format is \"rondo pod 1\", not \"rondo basis 1\"");
  const std::string text = text_of(file);
  put_text(file, text.substr(0, text.size() / 2));
  expect("cannot");
}

}  // namespace
}  // namespace rondo::io::test::basis_file_test
