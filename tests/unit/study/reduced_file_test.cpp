// SPDX-License-Identifier: BSD-3-Clause
/// Models that this version does not run.
#include "rondo/analysis/reduced/reduced_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "rondo/core/error.hpp"
#include "rondo/io/checkpoint_file.hpp"

namespace rondo::study::reduced_file_test {
namespace {

TEST(ReducedFile, OneWithPatternsSaysWhatToDo) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("rondo-patterns-" + std::to_string(getpid()));
  io::write_checkpoint_file(path, [](io::h5::File& file) {
    file.set_attribute("/", "format", "rondo reduced model 2");
    file.set_attribute("/", "contact", "patterns");
  });
  try {
    static_cast<void>(read_reduced_file(path));
    ADD_FAILURE() << "it is read";
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("build the model again"), std::string::npos)
        << error.what();
  }
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace rondo::study::reduced_file_test
