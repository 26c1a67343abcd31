// SPDX-License-Identifier: BSD-3-Clause
#include "fmu/zip.hpp"

#include <minizip/zip.h>
#include <zlib.h>

#include <cerrno>
#include <system_error>

#include "rondo/core/error.hpp"
#include "rondo/io/files.hpp"

namespace rondo::app {
namespace {

namespace fs = std::filesystem;

bool add(zipFile zip, const ZipEntry& entry) {
  zip_fileinfo info{};  // a constant date: 1980, the first of zip
  info.tmz_date.tm_year = 1980;
  info.tmz_date.tm_mday = 1;
  const std::string& text = entry.second;
  return zipOpenNewFileInZip64(zip, entry.first.c_str(), &info, nullptr, 0, nullptr, 0, nullptr,
                               Z_DEFLATED, Z_DEFAULT_COMPRESSION, 0) == ZIP_OK &&
         zipWriteInFileInZip(zip, text.data(), static_cast<unsigned>(text.size())) == ZIP_OK &&
         zipCloseFileInZip(zip) == ZIP_OK;
}

}  // namespace

void write_zip(const fs::path& file, const std::vector<ZipEntry>& entries) {
  fs::path part = file;
  part += ".part";
  const io::UnfinishedFile unfinished(part);
  errno = 0;
  const zipFile zip = zipOpen64(part.c_str(), APPEND_STATUS_CREATE);
  bool done = zip != nullptr;
  for (const ZipEntry& entry : entries) done = done && add(zip, entry);
  if (zip != nullptr) done = zipClose(zip, nullptr) == ZIP_OK && done;
  std::error_code error(errno, std::generic_category());
  if (done) fs::rename(part, file, error);
  if (done && !error) return;
  throw FileError(file.string(),
                  "cannot be written" + (error ? ": " + error.message() : std::string()));
}

}  // namespace rondo::app
