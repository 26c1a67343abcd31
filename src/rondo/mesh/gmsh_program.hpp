// SPDX-License-Identifier: BSD-3-Clause
/// @file  The program rondo-mesh-reader as a child process with its output in a pipe.
#pragma once
#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <string>

namespace rondo::mesh {

/// The path of rondo-mesh-reader. Throws FileError if there is none.
std::filesystem::path find_reader_program();

/// The child runs until wait() has seen it end; if wait() is never called, it is killed.
class ReaderProgram {
 public:
  ReaderProgram(std::filesystem::path program, const std::filesystem::path& file);
  ~ReaderProgram();
  ReaderProgram(const ReaderProgram&) = delete;
  ReaderProgram& operator=(const ReaderProgram&) = delete;

  /// Reads up to `size` bytes of its output; returns 0 at the end.
  std::size_t read(void* data, std::size_t size);

  /// Waits for its end. @return how it ended, in words; empty: without an error
  std::string wait();

  /// Ends it now, when its output is of no use.
  void kill();

  [[nodiscard]] const std::filesystem::path& program() const { return program_; }

 private:
  [[nodiscard]] std::string said() const;

  std::filesystem::path program_;
  pid_t pid_ = -1;
  int pipe_ = -1;
  int errors_ = -1;  ///< file in memory that receives its other messages
};

}  // namespace rondo::mesh
