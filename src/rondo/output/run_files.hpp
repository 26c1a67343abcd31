// SPDX-License-Identifier: BSD-3-Clause
/// @file  What every kind of run writes to its results directory: the case as run, and run.json.
#pragma once
#include <cstddef>
#include <exception>
#include <string_view>

#include "rondo/case/schema/members.hpp"
#include "rondo/contact/coupled/problem_file.hpp"
#include "rondo/io/directory.hpp"
#include "rondo/output/run_options.hpp"

namespace rondo::study {

/// The build of the program: commit, modified, compiler, flags, libraries. All documents use the
/// same keys.
[[nodiscard]] Json build_record_json();
std::vector<MemberText> build_record_members();

/// Adds the program that wrote it and the host: version, build, build id, build record, kernels.
void describe_program(Json& json);

/// The first keys of run.json, with the status "running".
Json describe_run(const Case& c, std::string_view analysis);
/// The members that these two and add_status() write.
std::vector<MemberText> run_file_members();

/// The string of a key; empty if there is none, or the value is not a string.
std::string text_in(const Json& json, const char* key);

/// Passes on the warnings if the options have a receiver for them.
void give_warnings(const std::vector<std::string>& warnings, const RunOptions& options);

/// The case as its results directory keeps it, with the path of the mesh copied there, or of the
/// original mesh.
Case kept_case(const Case& c);

/// Keeps a contact problem as contact-problems/NUMBER.json. @throws FileError
void write_contact_problem(const std::filesystem::path& directory, int number,
                           const contact::ProblemFile& problem);

/// Locks the directory for the run. From then on a signal
/// asks for a clean end.
/// @throws InputError (it contains another run), FileError
[[nodiscard]] io::DirectoryLock take_directory(const Case& c, const RunOptions& options);

/// A sign that a run, sweep or shard is at work there on another machine; empty: none.
std::string warning_of_another_host(const std::filesystem::path& directory);

/// Writes case.toml and run.json. @throws FileError
void begin_files(const Case& c, const RunOptions& options, const Json& json);

/// Writes case.toml alone, because the case has changed. @throws FileError
void write_case_file(const Case& c, const RunOptions& options);

/// Writes to run.json, if that is still possible, that files could not be written or memory ran
/// out.
void note_failure(const RunOptions& options, Json json, const std::exception& error) noexcept;

/// Adds how the run ended to the keys of run.json.
void add_status(Json& json, RunStatus status, const std::string& message);

/// The instruction set of the inner loops. @throws InputError: RONDO_DISPATCH names one that this
/// machine does not have
const char* dispatch_level();

/// Peak memory of this process [B].
long long peak_memory_bytes();

}  // namespace rondo::study
