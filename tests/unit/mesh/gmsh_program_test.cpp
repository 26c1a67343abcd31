// SPDX-License-Identifier: BSD-3-Clause
/// Whatever the program that reads does, the one that started it goes on.
#include "rondo/mesh/gmsh_program.hpp"

#include <gtest/gtest.h>

#include <sys/wait.h>

#include <csignal>
#include <cstdlib>
#include <optional>

#include "rondo/core/error.hpp"
#include "rondo/mesh/gmsh_reader.hpp"
#include "support/msh_files.hpp"

namespace gmsh_program_test {

using namespace rondo;
using test::squares;
using test::TemporaryFile;

namespace {

/// RONDO_MESH_READER is something else as long as this lives.
class OtherReader {
 public:
  explicit OtherReader(const std::string& program) {
    if (const char* before = std::getenv("RONDO_MESH_READER")) before_ = before;
    setenv("RONDO_MESH_READER", program.c_str(), 1);
  }
  ~OtherReader() {
    if (before_)
      setenv("RONDO_MESH_READER", before_->c_str(), 1);
    else
      unsetenv("RONDO_MESH_READER");
  }
  OtherReader(const OtherReader&) = delete;
  OtherReader& operator=(const OtherReader&) = delete;

 private:
  std::optional<std::string> before_;
};

struct Outcome {
  std::string kind, said;
};

Outcome read_with(const std::string& program) {
  const OtherReader reader(program);
  const TemporaryFile file(squares().text());
  try {
    static_cast<void>(mesh::read_gmsh({.file = file.path()}));
  } catch (const InputError& error) {
    return {"input", error.what()};
  } catch (const FileError& error) {
    return {"file", error.what()};
  }
  return {"taken", ""};
}

Outcome read_with_script(const std::string& commands) {
  const TemporaryFile script("#!/bin/bash\n" + commands + "\n", ".sh");
  std::filesystem::permissions(script.path(), std::filesystem::perms::owner_all);
  return read_with(script.path());
}

void expect(const Outcome& outcome, const std::string& kind, const std::string& words) {
  EXPECT_EQ(outcome.kind, kind) << outcome.said;
  EXPECT_NE(outcome.said.find(words), std::string::npos) << outcome.said;
}

/// The beginning of a right stream: start mark, a mesh follows.
constexpr const char* start = "printf 'rondmsh1\\0\\0\\0\\0'; ";
/// A u64 of a small value; and one that is absurd.
constexpr const char* none = "printf '\\0\\0\\0\\0\\0\\0\\0\\0'; ";
constexpr const char* absurd = "printf '\\377\\377\\377\\377\\377\\377\\377\\177'; ";

}  // namespace

TEST(GmshProgram, ThatCrashes) {
  expect(read_with_script("kill -SEGV $$"), "input", "ended by signal 11");
  expect(read_with_script("kill -KILL $$"), "input", "ended by signal 9");
  expect(read_with_script("kill -XCPU $$"), "input", "ended by its limit of time");
  expect(read_with_script("echo broken >&2; kill -ABRT $$"), "input", "saying: broken");
  expect(read_with_script("exit 3"), "input", "ended by exit code 3");
}

TEST(GmshProgram, ThatCannotBeLoaded) {
  expect(read_with_script("echo no library >&2; exit 127"), "file", "no library");
}

TEST(GmshProgram, ThatSaysNothingOrNonsense) {
  expect(read_with("/bin/true"), "file", "no working mesh reader");
  expect(read_with_script("exec yes"), "file", "no working mesh reader");
  expect(read_with_script(std::string(start).append("exec yes")), "file", "no working mesh reader");
}

TEST(GmshProgram, OfAnotherVersion) {
  const std::string why = "printf '\\1\\0\\0\\0\\5\\0\\0\\0\\0\\0\\0\\0wrong'";
  expect(read_with_script("printf 'rondmsh1'; " + why), "input", "cannot be read: wrong");
  expect(read_with_script("printf 'rondmsh9'; " + why), "file", "of this version of rondo");
}

TEST(GmshProgram, CountsAreNotBelieved) {
  // Nodes in the file, then no warnings, types, groups, entities: the absurd count is the k-th.
  for (int k = 0; k < 5; ++k) {
    std::string stream = std::string(start) + none;
    for (int j = 0; j < k; ++j) stream += none;
    expect(read_with_script(stream + absurd + "sleep 100"), "file", "no working mesh reader");
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "nothing is left behind";
  }
}

TEST(GmshProgram, ThatIsNotThere) {
  expect(read_with("/no/such/program"), "file", "RONDO_MESH_READER names it");
  const OtherReader unset("");
  unsetenv("RONDO_MESH_READER");
  try {
    EXPECT_EQ(mesh::find_reader_program().filename(), "rondo-mesh-reader");
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("set the environment variable RONDO_MESH_READER"),
              std::string::npos);
  }
}

TEST(GmshProgram, ChildrenThatNobodyWaitsFor) {
  // The system keeps no status where SIGCHLD is ignored.
  const auto before = std::signal(SIGCHLD, SIG_IGN);
  const TemporaryFile file(squares().text());
  EXPECT_EQ(mesh::read_gmsh({.file = file.path()}).mesh.cells.size(), 3U);
  std::signal(SIGCHLD, before);
}

}  // namespace gmsh_program_test
