// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/build_id.hpp"

#include <elf.h>
#include <fmt/format.h>
#include <link.h>

#include <cstddef>
#include <cstring>
#include <string_view>
#include <utility>

namespace rondo {
namespace {

std::string& given() {
  static std::string id;
  return id;
}

std::size_t padded(std::size_t bytes) {
  return (bytes + 3) / 4 * 4;
}

/// Searches a segment of notes: header, name and content of each, padded to four bytes.
std::string id_in(const char* notes, std::size_t bytes) {
  constexpr std::string_view owner{"GNU\0", 4};
  for (std::size_t at = 0; at + sizeof(ElfW(Nhdr)) <= bytes;) {
    ElfW(Nhdr) header;
    std::memcpy(&header, notes + at, sizeof header);
    const char* name = notes + at + sizeof header;
    const char* content = name + padded(header.n_namesz);
    if (header.n_type == NT_GNU_BUILD_ID && std::string_view(name, header.n_namesz) == owner) {
      std::string id;
      for (std::size_t k = 0; k < header.n_descsz; ++k)
        id += fmt::format("{:02x}", static_cast<unsigned char>(content[k]));
      return id;
    }
    at += sizeof header + padded(header.n_namesz) + padded(header.n_descsz);
  }
  return {};
}

/// Called first for the program itself; returning 1 then ends the loop over its libraries.
int look(dl_phdr_info* info, std::size_t, void* found) {
  for (int k = 0; k < info->dlpi_phnum; ++k) {
    const ElfW(Phdr)& segment = info->dlpi_phdr[k];
    if (segment.p_type != PT_NOTE) continue;
    const std::string id =
        id_in(reinterpret_cast<const char*>(info->dlpi_addr + segment.p_vaddr), segment.p_memsz);
    if (!id.empty()) *static_cast<std::string*>(found) = id;
  }
  return 1;
}

}  // namespace

void set_build_id(std::string id) {
  given() = std::move(id);
}

std::string build_id() {
  if (!given().empty()) return given();
  std::string found;
  dl_iterate_phdr(look, &found);
  return found;
}

}  // namespace rondo
