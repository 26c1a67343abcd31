// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/files.hpp"

#include <limits>

#include "unit/io/support.hpp"

namespace rondo::io::test {
namespace {

namespace fs = std::filesystem;

std::size_t n_entries(const Folder& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder.path()), {}));
}

TEST(ResultsDirectory, IsMadeWithItsParents) {
  const Folder folder;
  prepare_results_directory(folder / "a/b/c", false);
  EXPECT_TRUE(fs::is_directory(folder / "a/b/c"));
  put_text(folder / "a/b/c/notes.txt", "mine");
  prepare_results_directory(folder / "a/b/c", false);  // not a run: may be used
}

TEST(ResultsDirectory, HoldingARunIsRefused) {
  for (const char* name : {"run.json", "results.h5", "history.csv"}) {
    const Folder folder;
    put_text(folder / name, "old");
    const std::string what =
        error_of<InputError>([&] { prepare_results_directory(folder.path(), false); });
    EXPECT_NE(what.find(name), std::string::npos) << what;
    EXPECT_NE(what.find("choose another -o, or give --overwrite"), std::string::npos) << what;
    EXPECT_NE(what.find(folder.path().string()), std::string::npos) << what;
    EXPECT_EQ(text_of(folder / name), "old");
  }
}

TEST(ResultsDirectory, OverwriteRemovesTheRunAndNothingElse) {
  const Folder folder;
  const std::vector<std::string> run = {"case.toml",  "run.json",    "history.csv",  "contact.csv",
                                        "results.h5", "fields.xdmf", "checkpoint.h5"};
  for (const std::string& name : run) put_text(folder / name, "old");
  put_text(folder / "notes.txt", "mine");
  fs::create_directories(folder / "pod/displacement-rotating");
  fs::create_directories(folder / "pod/velocity-rotating");
  for (const char* name : {"pod.json", "pod.h5", "spectrum.csv", "modes.xdmf"})
    put_text(folder / "pod/displacement-rotating" / name, "old");
  put_text(folder / "pod/velocity-rotating/pod.h5", "old");
  put_text(folder / "pod/velocity-rotating/figure.png", "mine");
  prepare_results_directory(folder.path(), true);
  for (const std::string& name : run) EXPECT_FALSE(fs::exists(folder / name)) << name;
  EXPECT_EQ(text_of(folder / "notes.txt"), "mine");
  // A POD goes with its run; what else lies there does not.
  EXPECT_FALSE(fs::exists(folder / "pod/displacement-rotating"));
  EXPECT_FALSE(fs::exists(folder / "pod/velocity-rotating/pod.h5"));
  EXPECT_EQ(text_of(folder / "pod/velocity-rotating/figure.png"), "mine");
}

TEST(ResultsDirectory, ThatIsAFileIsRefused) {
  const Folder folder;
  put_text(folder / "file", "mine");
  for (const bool overwrite : {false, true}) {
    const std::string what =
        error_of<InputError>([&] { prepare_results_directory(folder / "file", overwrite); });
    EXPECT_NE(what.find("is not a directory"), std::string::npos) << what;
    EXPECT_EQ(text_of(folder / "file"), "mine");
  }
  const std::string what =
      error_of<FileError>([&] { prepare_results_directory(folder / "file/below", false); });
  EXPECT_NE(what.find("file/below: cannot create directory: Not a directory"), std::string::npos)
      << what;
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

TEST(DirectoryLock, IsHeldByOneAtATime) {
  const Folder folder;
  const auto error = [&] {
    return error_of<FileError>([&] { const DirectoryLock again(folder.path()); });
  };
  {
    const DirectoryLock lock(folder.path());
    EXPECT_NE(error().find("another rondo is at work here"), std::string::npos);
  }
  EXPECT_EQ(error(), "");
  EXPECT_NE(
      error_of<FileError>([&] { const DirectoryLock lock(folder / "none"); }).find("No such file"),
      std::string::npos);
}

TEST(DirectoryLock, EndsWithItsHolderHoweverThatEnds) {
  const Folder folder;
  const int status = in_child([&] {
    const DirectoryLock lock(folder.path());
    std::raise(SIGKILL);
  });
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(error_of<FileError>([&] { const DirectoryLock lock(folder.path()); }), "");
}

}  // namespace
}  // namespace rondo::io::test
