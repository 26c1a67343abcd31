// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <array>
#include <cstdint>
#include <vector>

#include "commands.hpp"
#include "documents/documents.hpp"
#include "fmu/zip.hpp"
#include "license_text.hpp"
#include "rondo/case/case_source.hpp"
#include "rondo/core/bytes.hpp"
#include "rondo/core/error.hpp"
#include "rondo/fmu/description.hpp"
#include "rondo/fmu/packed_case.hpp"
#include "rondo/fmu/wheel.hpp"
#include "rondo/io/files.hpp"
#include "rondo/output/run_files.hpp"

namespace rondo::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* binary_name = "rondo_fmu.so";

/// The binary of the FMU, from beside the program or from its installed place.
std::string binary_text() {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& file : {folder / binary_name, folder / ".." / "lib" / "rondo" / binary_name})
    if (fs::exists(file, error)) return io::text_of(file);
  throw FileError((folder / binary_name).string(),
                  "is not there: the binary of FMUs belongs beside the program, or into "
                  "../lib/rondo; build or install rondo whole");
}

/// FNV-1a of both texts, twice.
std::string guid_of(const std::string& a, const std::string& b) {
  std::array<std::uint64_t, 2> hash{0xcbf29ce484222325ULL, 0x9ae16a3b2f90404fULL};
  for (const std::string* text : {&a, &b})
    for (const char c : *text)
      for (std::uint64_t& h : hash) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return fmt::format("{{{:08x}-{:04x}-{:04x}-{:04x}-{:012x}}}", hash[0] >> 32U,
                     (hash[0] >> 16U) & 0xffffU, hash[0] & 0xffffU, hash[1] >> 48U,
                     hash[1] & 0xffffffffffffULL);
}

study::Case read_checked(const study::FmuRequest& a) {
  if (a.case_file.extension() == ".h5")
    throw request_error("CASE", a.case_file.string(),
                        "is a file of modes, and the wheel of an FMU is made of a case",
                        "rondo fmu CASE.toml -o wheel.fmu");
  study::Case c = study::read_case(a.case_file, a.settings);
  if (!study::rules_of(c.analysis.kind).in_time)
    throw study::case_error(c, "analysis.kind", "a wheel of an FMU moves in time", "\"dynamic\"");
  return c;
}

}  // namespace

int fmu(const study::FmuRequest& a, Telling& tell) {
  if (a.output.empty() || a.output.filename().empty())
    throw request_error("-o", a.output.string(), "the FMU needs a file", "-o wheel.fmu");
#if !defined(__linux__) || !defined(__x86_64__)
  throw request_error("fmu", "", "this program is not of the platform that FMI calls linux64",
                      "a build on Linux for x86-64");
#endif
  const study::Case c = read_checked(a);
  const std::string binary = binary_text();
  study::RunOptions options;
  options.reduced_modes = a.modes;
  options.reduced_step = a.step;
  fmu::Wheel wheel(c, options);
  fmu::Values values = fmu::start_values(c, 0.0);
  wheel.begin(values);
  for (const std::string& text : wheel.take_warnings()) spdlog::warn(text);
  const std::vector<fmu::Resource> packed = fmu::packed_case(c);
  fmu::Description d;
  d.identifier = fmu::identifier_of(a.output.stem().string());
  d.title = study::as_utf8(c.title);
  std::string contents;
  for (const auto& [name, text] : packed) contents += text;
  d.guid = guid_of(contents, fmt::format("{} {:.17g}", wheel.n_modes(), wheel.step()));
  d.dimension = wheel.dimension();
  d.start = fmu::start_values(c, wheel.step());
  const Json settings = {{"guid", d.guid},
                         {"step", wheel.step()},
                         {"modes", wheel.n_modes()},
                         {"reduced_step", wheel.step()},
                         {"build_record", study::build_record_json()}};
  std::vector<ZipEntry> entries{{"modelDescription.xml", fmu::model_description(d)},
                                {"binaries/linux64/" + d.identifier + ".so", binary}};
  for (const auto& [name, text] : packed) entries.emplace_back("resources/" + name, text);
  entries.insert(entries.end(), {{"resources/wheel.json", settings.dump(2) + "\n"},
                                 {"documentation/index.html", fmu::index_page(d)},
                                 {"documentation/LICENSE", license_text}});
  write_zip(a.output, entries);
  std::error_code error;
  const FmuReport report{a.output,
                         d.identifier,
                         d.guid,
                         wheel.n_modes(),
                         wheel.step(),
                         values.tyre_mass,
                         values.tyre_inertia,
                         fs::file_size(a.output, error)};
  if (tell.json) {
    tell.result = fmu_document(report);
    return exit_done;
  }
  fmt::print("modes              {}\n", report.modes);
  fmt::print("internal step      {:.6g} s at the most\n", report.step);
  fmt::print("tyre               {:.6g} kg, {:.6g} kg m2{}: the hub's to have\n", report.tyre_mass,
             report.tyre_inertia,
             d.dimension == fmu::Dimension::plane ? " for a width of 1 m" : " about its axle");
  fmt::print("FMU                {} ({})\n", report.file.string(), readable_bytes(report.bytes));
  return exit_done;
}

}  // namespace rondo::app
