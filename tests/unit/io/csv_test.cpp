// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/csv.hpp"

#include <limits>
#include <sstream>

#include "unit/io/support.hpp"

namespace rondo::io::test::csv_test {
namespace {

std::string hash_of(const std::string& text, std::size_t bytes) {
  Hash hash;
  hash.add(std::span<const char>(text).first(std::min(bytes, text.size())));
  return hash.text();
}

TEST(Csv, NumbersReadBackTheSameBits) {
  const Folder folder;
  const double third = 1.0 / 3.0, tiny = std::numeric_limits<double>::denorm_min();
  const std::vector<double> values = {third, -tiny, std::numeric_limits<double>::max(), -0.0};
  Csv csv(folder / "a.csv", {"a", "b", "c", "d"});
  csv.row(values);
  csv.close();
  std::istringstream in(text_of(folder / "a.csv"));
  std::string header, row, cell;
  std::getline(in, header);
  std::getline(in, row);
  EXPECT_EQ(header, "a,b,c,d");
  std::istringstream cells(row);
  for (const double value : values) {
    ASSERT_TRUE(std::getline(cells, cell, ','));
    const double again = std::strtod(cell.c_str(), nullptr);
    EXPECT_EQ(again, value);
    EXPECT_EQ(std::signbit(again), std::signbit(value));
  }
}

TEST(Csv, NumbersAreShort) {
  const Folder folder;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Csv csv(folder / "a.csv", {"a", "b", "c"});
  csv.rows(std::vector<double>{0.1, 3.0, 1e-12, -nan, 0.0, 1e300});
  csv.rows({});
  EXPECT_EQ(text_of(folder / "a.csv"), "a,b,c\n0.1,3,1e-12\nnan,0,1e+300\n");
}

TEST(Csv, RowsReachTheFileAtOnce) {
  const Folder folder;
  const int status = in_child([&] {
    Csv csv(folder / "a.csv", {"a"});
    for (int i = 0; i < 100; ++i) csv.row(std::vector<double>{static_cast<double>(i)});
    std::raise(SIGKILL);
  });
  EXPECT_TRUE(WIFSIGNALED(status));
  const std::string text = text_of(folder / "a.csv");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 101);
  EXPECT_TRUE(text.ends_with("\n99\n"));
}

TEST(Csv, GoesOnAfterTheBytesThatAreKept) {
  const Folder folder;
  const auto path = folder / "a.csv";
  Csv csv(path, {"a", "b"});
  csv.row(std::vector<double>{1.0, 2.0});
  const CsvPlace kept = csv.place();
  csv.row(std::vector<double>{3.0, 4.0});
  csv.close();
  Csv again(path, {"a", "b"}, kept);
  again.row(std::vector<double>{5.0, 6.0});
  EXPECT_EQ(again.place().bytes, text_of(path).size());
  again.close();
  EXPECT_EQ(text_of(path), "a,b\n1,2\n5,6\n");
}

TEST(Csv, DoesNotGoOnWithAnotherFile) {
  const Folder folder;
  put_text(folder / "a.csv", "a,b\n1,2\n");
  const auto error = [&](const std::vector<std::string>& columns, std::size_t bytes) {
    const CsvPlace kept{bytes, hash_of("a,b\n1,2\n", bytes)};
    return error_of<FileError>([&] { const Csv csv(folder / "a.csv", columns, kept); });
  };
  EXPECT_NE(error({"a", "b"}, 9).find("holds 8 bytes where it held 9"), std::string::npos);
  EXPECT_NE(error({"a", "c"}, 4).find("does not begin with the columns"), std::string::npos);
  EXPECT_NE(error({"a", "b", "c and more"}, 4).find("does not begin"), std::string::npos);
  EXPECT_EQ(text_of(folder / "a.csv"), "a,b\n1,2\n");
}

TEST(Csv, DamageInWhatIsKeptIsToldWithItsLine) {
  const Folder folder;
  const auto path = folder / "a.csv";
  CsvPlace kept;
  {
    Csv csv(path, {"a", "b"});
    csv.rows(std::vector<double>{1.0, 2.0, 3.0, 444.0, 5.0, 6.0});
    kept = csv.place();
    csv.row(std::vector<double>{7.0, 8.0});
  }
  const std::string whole = text_of(path);
  const auto expect = [&](std::size_t at, const std::string& bytes, const std::string& said) {
    std::string text = whole;
    put_text(path, text.replace(at, bytes.size(), bytes));
    const std::string error = error_of<FileError>([&] { demand_kept(path, kept); });
    EXPECT_NE(error.find(said), std::string::npos) << error;
  };
  EXPECT_NO_THROW(demand_kept(path, kept));
  expect(0, "x", "a.csv: its first 18 bytes are not those that were written: damaged");
  expect(4, std::string(1, '\0'), "line 2: \"?\" is not a number");
  expect(10, "nan", "line 3 holds a number that is not finite; its first 18 bytes");
  expect(14, "566", "line 4: not 2 fields as in the header");
  expect(14, "5,7", "a.csv: its first 18 bytes are not those that were written: damaged");
  put_text(path, whole.substr(0, 18) + std::string(7, '\0'));  // what follows does not matter
  EXPECT_NO_THROW(demand_kept(path, kept));
}

/// As the abscissa of what the ground does not press.
TEST(Csv, ANumberThatIsNotFiniteMayHaveBeenWritten) {
  const Folder folder;
  Csv csv(folder / "a.csv", {"a"});
  csv.row(std::vector<double>{std::nan("")});
  EXPECT_NO_THROW(demand_kept(folder / "a.csv", csv.place()));
}

TEST(Csv, OfWhatHasNoRoomNothingIsLeft) {
  const Folder folder;
  const int status = in_child([&] {
    Csv csv(folder / "a.csv", {"a"});
    limit_files(1001);
    const std::string what = error_of<FileError>([&] {
      for (int i = 0; i < 1000; ++i) csv.row(std::vector<double>{0.125});
    });
    EXPECT_NE(what.find("File too large"), std::string::npos) << what;
    if (::testing::Test::HasFailure()) std::_Exit(1);
  });
  EXPECT_TRUE(went_well(status));
  const std::string text = text_of(folder / "a.csv");
  EXPECT_GT(text.size(), 900U);
  EXPECT_TRUE(text.ends_with("\n0.125\n")) << text.substr(text.size() - 10);
}

TEST(Csv, ErrorsNameTheFileAndTheReason) {
  const Folder folder;
  const std::string none = error_of<FileError>([&] { const Csv csv(folder / "no/a.csv", {"a"}); });
  EXPECT_NE(none.find("no/a.csv: cannot create: No such file"), std::string::npos) << none;
  const std::string full = error_of<FileError>([] { const Csv csv("/dev/full", {"a"}); });
  EXPECT_EQ(full, "/dev/full: cannot write: No space left on device");
}

TEST(ReadColumns, GivesBackTheBitsWritten) {
  const Folder folder;
  const double third = 1.0 / 3.0, tiny = std::numeric_limits<double>::denorm_min();
  Csv csv(folder / "a.csv", {"time_s", "b"});
  csv.row(std::vector<double>{third, -tiny});
  csv.row(std::vector<double>{2.0, std::nan("")});
  csv.close();
  const auto columns = read_columns(folder / "a.csv");
  ASSERT_EQ(columns.size(), 2u);
  EXPECT_EQ(columns.at("time_s"), (std::vector<double>{third, 2.0}));
  EXPECT_EQ(columns.at("b")[0], -tiny);
  EXPECT_TRUE(std::isnan(columns.at("b")[1]));
}

TEST(ReadColumns, LeavesOutARowThatWasNotFinished) {
  const Folder folder;
  put_text(folder / "a.csv", "a,b\n1,2\n3,4");
  EXPECT_EQ(read_columns(folder / "a.csv").at("b"), std::vector<double>{2.0});
}

TEST(ReadColumns, SaysWhatIsWrongAndWhere) {
  const Folder folder;
  const auto error = [&](const std::string& text) {
    put_text(folder / "a.csv", text);
    return error_of<FileError>([&] { read_columns(folder / "a.csv"); });
  };
  EXPECT_NE(error("a,b\n1,2\n3,x4\n").find("line 3: \"x4\" is not a number"), std::string::npos);
  EXPECT_NE(error("a,b\n1\n").find("line 2: not 2 fields"), std::string::npos);
  EXPECT_NE(error("a,b\n1,2,3\n").find("line 2: not 2 fields"), std::string::npos);
  EXPECT_NE(error("").find("no header"), std::string::npos);
  EXPECT_NE(error("a,,c\n").find("column 2 has no name"), std::string::npos);
  EXPECT_NE(error("a,\n").find("column 2 has no name"), std::string::npos);
  EXPECT_NE(error("a,b,a\n").find("column 3 has the name of another"), std::string::npos);
  EXPECT_NE(error_of<FileError>([&] { read_columns(folder / "none.csv"); }).find("No such file"),
            std::string::npos);
}

}  // namespace
}  // namespace rondo::io::test::csv_test
