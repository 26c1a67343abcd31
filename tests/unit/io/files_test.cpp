// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/files.hpp"

#include <limits>

#include "unit/io/support.hpp"

namespace rondo::io::test::files_test {
namespace {

namespace fs = std::filesystem;

std::size_t n_entries(const Folder& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder.path()), {}));
}

TEST(WriteFile, ReplacesAndLeavesNothingBeside) {
  const Folder folder;
  write_file(folder / "a.txt", "first, and longer");
  write_file(folder / "a.txt", "second");
  EXPECT_EQ(text_of(folder / "a.txt"), "second");
  EXPECT_EQ(n_entries(folder), 1U);
}

TEST(WriteFile, KeepsTheOldFileWhenTheDiskIsFull) {
  const Folder folder;
  write_file(folder / "a.txt", "old");
  const int status = in_child([&] {
    limit_files(1000);
    const std::string what =
        error_of<FileError>([&] { write_file(folder / "a.txt", std::string(5000, 'x')); });
    EXPECT_NE(what.find("a.txt: cannot write: File too large"), std::string::npos) << what;
    if (::testing::Test::HasFailure()) std::_Exit(1);
  });
  EXPECT_TRUE(went_well(status));
  EXPECT_EQ(text_of(folder / "a.txt"), "old");
  EXPECT_EQ(n_entries(folder), 1U);
}

TEST(WriteFile, ErrorsNameTheFileAndTheReason) {
  const Folder folder;
  const std::string what = error_of<FileError>([&] { write_file(folder / "no/a.txt", "x"); });
  EXPECT_NE(what.find("no/a.txt: cannot create: No such file"), std::string::npos) << what;
}

TEST(WriteJson, KeepsOrderAndNumbers) {
  const Folder folder;
  nlohmann::ordered_json json;
  json["z"] = 0.1;
  json["a"] = {1, 2};
  json["nan"] = std::numeric_limits<double>::quiet_NaN();
  json["host"] = "not UTF-8: \xff";
  write_json(folder / "run.json", json);
  const std::string text = text_of(folder / "run.json");
  EXPECT_LT(text.find("\"z\": 0.1"), text.find("\"a\""));
  EXPECT_NE(text.find("\"nan\": null"), std::string::npos);
  EXPECT_TRUE(text.ends_with("}\n"));
  EXPECT_EQ(nlohmann::ordered_json::parse(text)["a"], (std::vector<int>{1, 2}));
}

TEST(ReadJson, SaysWhatIsWrong) {
  const Folder folder;
  write_json(folder / "a.json", {{"x", 1.5}});
  EXPECT_EQ(read_json(folder / "a.json")["x"], 1.5);
  put_text(folder / "a.json", "{\"x\": 1.");
  EXPECT_NE(error_of<FileError>([&] { read_json(folder / "a.json"); }).find("damaged"),
            std::string::npos);
  EXPECT_NE(error_of<FileError>([&] { read_json(folder / "none"); }).find("No such file"),
            std::string::npos);
}

}  // namespace
}  // namespace rondo::io::test::files_test
