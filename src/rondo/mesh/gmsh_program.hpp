// SPDX-License-Identifier: BSD-3-Clause
/// @file  The program rondo-mesh-reader as a child process with its output in a pipe.
#pragma once
#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <string>

namespace rondo::mesh {

/// Throws FileError if there is none.
std::filesystem::path find_reader_program();

/// Runs until its end is asked for; killed if that never happens.
class ReaderProgram {
 public:
  ReaderProgram(std::filesystem::path program, const std::filesystem::path& file);
  ~ReaderProgram();
  ReaderProgram(const ReaderProgram&) = delete;
  ReaderProgram& operator=(const ReaderProgram&) = delete;

  /// Up to `size` bytes of its output; 0: no more.
  std::size_t read(void* data, std::size_t size);

  /// Waits for its end. @return how it ended, in words; empty: as it should
  std::string wait();

  /// Ends it now: what it wrote is of no use.
  void kill();

  [[nodiscard]] const std::filesystem::path& program() const { return program_; }

 private:
  [[nodiscard]] std::string said() const;

  std::filesystem::path program_;
  pid_t pid_ = -1;
  int pipe_ = -1;
  int errors_ = -1;  ///< file in memory that takes what it says besides
};

}  // namespace rondo::mesh
