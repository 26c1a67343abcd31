// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/directory.hpp"

#include "unit/io/support.hpp"

namespace rondo::io::test::directory_test {
namespace {

namespace fs = std::filesystem;

void begin(const fs::path& directory) {
  static_cast<void>(take_results_directory(directory, DirectoryUse::begin));
}
void overwrite(const fs::path& directory) {
  static_cast<void>(take_results_directory(directory, DirectoryUse::overwrite));
}

TEST(ResultsDirectory, IsMadeWithItsParents) {
  const Folder folder;
  begin(folder / "a/b/c");
  EXPECT_TRUE(fs::is_directory(folder / "a/b/c"));
  put_text(folder / "a/b/c/notes.txt", "mine");
  begin(folder / "a/b/c");  // not a run: may be used
}

TEST(ResultsDirectory, HoldingARunIsRefused) {
  for (const char* name : {"run.json", "results.h5", "history.csv"}) {
    const Folder folder;
    put_text(folder / name, "old");
    const std::string what = error_of<InputError>([&] { begin(folder.path()); });
    EXPECT_NE(what.find(name), std::string::npos) << what;
    EXPECT_NE(what.find("choose another -o, or give --overwrite"), std::string::npos) << what;
    EXPECT_NE(what.find(folder.path().string()), std::string::npos) << what;
    EXPECT_EQ(text_of(folder / name), "old");
  }
}

TEST(ResultsDirectory, OverwriteRemovesTheRunAndNothingElse) {
  const Folder folder;
  const std::vector<std::string> run = {"case.toml",       "run.json",       "history.csv",
                                        "contact.csv",     "results.h5",     "fields.xdmf",
                                        "checkpoint.h5",   "results.h5.new", "checkpoint.h5.new",
                                        "convergence.csv", "fields.vtkhdf",  "fields.vtkhdf.new",
                                        "slip-step.csv"};
  for (const std::string& name : run) put_text(folder / name, "old");
  put_text(folder / "notes.txt", "mine");
  fs::create_directories(folder / "pod/displacement-rotating");
  fs::create_directories(folder / "pod/velocity-rotating");
  for (const char* name : {"pod.json", "pod.h5", "spectrum.csv", "modes.xdmf", "basis.h5"})
    put_text(folder / "pod/displacement-rotating" / name, "old");
  put_text(folder / "pod/velocity-rotating/pod.h5", "old");
  put_text(folder / "pod/velocity-rotating/figure.png", "mine");
  overwrite(folder.path());
  for (const std::string& name : run) EXPECT_FALSE(fs::exists(folder / name)) << name;
  EXPECT_EQ(text_of(folder / "notes.txt"), "mine");
  // A POD goes with its run; what else lies there does not.
  EXPECT_FALSE(fs::exists(folder / "pod/displacement-rotating"));
  EXPECT_FALSE(fs::exists(folder / "pod/velocity-rotating/pod.h5"));
  EXPECT_EQ(text_of(folder / "pod/velocity-rotating/figure.png"), "mine");
}

TEST(ResultsDirectory, IsGoneOnWithAsItIs) {
  const Folder folder;
  put_text(folder / "checkpoint.h5", "old");
  put_text(folder / "run.json", "old");
  const std::string what = error_of<InputError>([&] { begin(folder.path()); });
  EXPECT_NE(what.find("--resume to continue it"), std::string::npos) << what;
  static_cast<void>(take_results_directory(folder.path(), DirectoryUse::go_on));
  EXPECT_EQ(text_of(folder / "run.json"), "old");
  EXPECT_EQ(mark_of_run(folder.path()), "run.json");
}

TEST(ResultsDirectory, ThatIsAFileIsRefused) {
  const Folder folder;
  put_text(folder / "file", "mine");
  for (const DirectoryUse use :
       {DirectoryUse::begin, DirectoryUse::overwrite, DirectoryUse::go_on}) {
    const std::string what = error_of<InputError>(
        [&] { static_cast<void>(take_results_directory(folder / "file", use)); });
    EXPECT_NE(what.find("is not a directory"), std::string::npos) << what;
    EXPECT_EQ(text_of(folder / "file"), "mine");
  }
  const std::string what = error_of<FileError>([&] { begin(folder / "file/below"); });
  EXPECT_NE(what.find("file/below: cannot create directory: Not a directory"), std::string::npos)
      << what;
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

TEST(DirectoryLock, SaysWhoHoldsIt) {
  const Folder folder;
  put_text(folder / "run.json", R"({"status": "running", "process": 4711, "host": "far"})");
  const DirectoryLock lock(folder.path());
  const std::string what = error_of<FileError>([&] { const DirectoryLock again(folder.path()); });
  EXPECT_NE(what.find("(process 4711 on far); wait until it ends"), std::string::npos) << what;
}

TEST(DirectoryLock, IsHeldWhileItsDirectoryIsTaken) {
  const Folder folder;
  const auto error = [&] { return error_of<FileError>([&] { begin(folder.path()); }); };
  {
    const DirectoryLock lock = take_results_directory(folder.path(), DirectoryUse::begin);
    EXPECT_NE(error().find("another rondo is at work here"), std::string::npos);
  }
  EXPECT_EQ(error(), "");
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

TEST(IsCutOff, ByTheStatusInRunJson) {
  const Folder folder;
  EXPECT_FALSE(is_cut_off(folder.path()));
  for (const auto& [text, cut] : {std::pair{R"({"status": "running"})", true},
                                  {R"({"status": "done"})", false},
                                  {R"({"status": 3})", false},
                                  {"{", false}}) {
    put_text(folder / "run.json", text);
    EXPECT_EQ(is_cut_off(folder.path()), cut) << text;
  }
}

}  // namespace
}  // namespace rondo::io::test::directory_test
