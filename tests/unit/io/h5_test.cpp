// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/h5/h5.hpp"

#include "unit/io/support.hpp"

namespace rondo::io::test::h5_test {
namespace {

using h5::File;
using h5::Shape;
using h5::Type;

TEST(H5, ValuesShapesAndLabelsComeBack) {
  const Folder folder;
  const std::vector<std::int64_t> numbers = {1, -2, 1LL << 40};
  const std::vector<Vec2> points = {{1, 2}, {3, 4}};
  {
    File file = File::create(folder / "a.h5");
    file.write("/deep/down/numbers", {3}, std::span<const std::int64_t>(numbers), {"1", "some"});
    file.write("/points", {2, 2}, std::span<const Vec2>(points), {"m", "été σ"});
    file.set_attribute("/", "format", "x");
    file.close();
  }
  const File file = File::open(folder / "a.h5");
  EXPECT_EQ(file.read<std::int64_t>("/deep/down/numbers"), numbers);
  EXPECT_EQ(file.read<Vec2>("/points"), points);
  EXPECT_EQ(file.read<float>("/points"), (std::vector<float>{1, 2, 3, 4}));
  EXPECT_EQ(file.dataset("/points").shape(), (Shape{2, 2}));
  EXPECT_EQ(file.dataset("/points").label().units, "m");
  EXPECT_EQ(file.dataset("/points").label().description, "été σ");
  EXPECT_EQ(file.attribute("/", "format"), "x");
  EXPECT_TRUE(file.contains("/deep/down"));
  EXPECT_FALSE(file.contains("/deep/nothing/here"));
}

TEST(H5, ScalarsAndEmptyArrays) {
  const Folder folder;
  const std::vector<double> one = {42.5}, none;
  File file = File::create(folder / "a.h5");
  file.write("/one", {}, std::span<const double>(one), {"1", "scalar"});
  file.write("/none", {0, 3}, std::span<const double>(none), {"1", "no rows"});
  file.close();
  const File again = File::open(folder / "a.h5");
  EXPECT_EQ(again.read<double>("/one"), one);
  EXPECT_TRUE(again.read<double>("/none").empty());
  EXPECT_EQ(again.dataset("/none").shape(), (Shape{0, 3}));
}

TEST(H5, RowsAreWrittenInAnyOrderAndCut) {
  const Folder folder;
  const std::vector<double> a = {1, 2, 3}, b = {4, 5, 6};
  {
    File file = File::create(folder / "a.h5");
    h5::Dataset rows = file.create_rows("/rows", Type::float64, {5, 3}, {"1", "rows"});
    EXPECT_EQ(rows.shape(), (Shape{0, 3}));
    rows.resize(5);
    rows.write_row(1, std::span<const double>(b));
    rows.write_row(0, std::span<const double>(a));
    rows.resize(2);
  }
  const File file = File::open(folder / "a.h5");
  EXPECT_EQ(file.read<double>("/rows"), (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(row_of<double>(file.dataset("/rows"), 1), b);
}

TEST(H5, ChunksAreARowOrPartsOfItOrSome) {
  EXPECT_EQ(h5::chunk_shape({100, 2340, 2}, 8), (Shape{1, 2340, 2}));
  EXPECT_EQ(h5::chunk_shape({100}, 8), Shape{100});
  EXPECT_EQ(h5::chunk_shape({100000, 2}, 8), (Shape{1024, 2}));
  const Shape parts = h5::chunk_shape({100, 1000, 2}, 8, 6000);  // 16000 bytes: 3 parts
  EXPECT_EQ(parts, (Shape{1, 334, 2}));
  const std::size_t huge = 200'000'000;  // nodes: 3.2 GB a row
  EXPECT_LE(h5::chunk_shape({10, huge, 2}, 8)[1] * 16, std::size_t{1} << 30U);
}

TEST(H5, ErrorsNameTheFileAndTheReason) {
  const Folder folder;
  const auto what = [&](const std::string& name) {
    return error_of<FileError>([&] { File::open(folder / name); });
  };
  EXPECT_NE(what("none.h5").find("none.h5: cannot open: No such file"), std::string::npos);
  put_text(folder / "text.h5", "not a data file at all, though long enough to look at");
  EXPECT_NE(what("text.h5").find("text.h5: cannot open: "), std::string::npos);
  File file = File::create(folder / "a.h5");
  const std::string missing = error_of<FileError>([&] { (void)file.dataset("/no/such"); });
  EXPECT_NE(missing.find("a.h5: cannot open /no/such: "), std::string::npos) << missing;
}

TEST(H5, TruncatedFileIsRefused) {
  const Folder folder;
  const std::vector<double> values(1000, 1.0);
  File file = File::create(folder / "a.h5");
  file.write("/values", {1000}, std::span<const double>(values), {"1", "ones"});
  file.close();
  std::filesystem::resize_file(folder / "a.h5", 4000);
  const std::string what = error_of<FileError>([&] { File::open(folder / "a.h5"); });
  EXPECT_NE(what.find("truncated"), std::string::npos) << what;
}

TEST(H5, NothingIsPrinted) {
  const Folder folder;
  ::testing::internal::CaptureStderr();
  error_of<FileError>([&] { File::open(folder / "none.h5"); });
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace rondo::io::test::h5_test
