// SPDX-License-Identifier: BSD-3-Clause
/// @file  What every kind of run does with its results directory: the case as run, run.json.
#pragma once
#include <cstddef>
#include <exception>
#include <string_view>

#include "rondo/case/schema/members.hpp"
#include "rondo/contact/coupled/problem_file.hpp"
#include "rondo/io/directory.hpp"
#include "rondo/output/run_options.hpp"

namespace rondo::study {

/// What the program was built from: commit, modified, compiler, flags, libraries. The same in all
/// documents.
[[nodiscard]] Json build_record_json();
std::vector<MemberText> build_record_members();

/// Adds what program wrote it, where: version, build, build id, build record, kernels, host.
void describe_program(Json& json);

/// The first keys of run.json, with the status "running".
Json describe_run(const Case& c, std::string_view analysis);
/// The members that these two and add_status() write.
std::vector<MemberText> run_file_members();

/// The string under a key; empty where there is none, or something else.
std::string text_in(const Json& json, const char* key);

/// Gives the warnings, if there is somebody to take them.
void give_warnings(const std::vector<std::string>& warnings, const RunOptions& options);

/// The case as its results directory keeps it: with the copy of the mesh in it, or where the mesh
/// is.
Case kept_case(const Case& c);

/// Keeps a contact problem as contact-problems/NUMBER.json. @throws FileError
void write_contact_problem(const std::filesystem::path& directory, int number,
                           const contact::ProblemFile& problem);

/// The directory is the run's as long as the lock is held. From here on signals ask for a clean
/// end.
/// @throws InputError (it holds another run), FileError
[[nodiscard]] io::DirectoryLock take_directory(const Case& c, const RunOptions& options);

/// The run, sweep or shard there may still be at work on another machine; empty: no sign of that.
std::string warning_of_another_host(const std::filesystem::path& directory);

/// case.toml and run.json. @throws FileError
void begin_files(const Case& c, const RunOptions& options, const Json& json);

/// case.toml alone, whose case has changed. @throws FileError
void write_case_file(const Case& c, const RunOptions& options);

/// After an error of files, or where memory ran out: run.json says so, where it can still be
/// written itself.
void note_failure(const RunOptions& options, Json json, const std::exception& error) noexcept;

/// Adds how the run ended, for run.json.
void add_status(Json& json, RunStatus status, const std::string& message);

/// Instruction set of the inner loops. @throws InputError: RONDO_DISPATCH names none of this
/// machine's
const char* dispatch_level();

/// Of this process [B].
long long peak_memory_bytes();

}  // namespace rondo::study
