// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/checkpoint_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <span>
#include <system_error>
#include <vector>

#include "rondo/core/error.hpp"
#include "rondo/core/files/regular_file.hpp"
#include "rondo/io/files.hpp"
#include "rondo/io/h5/hash.hpp"

namespace rondo::io {
namespace fs = std::filesystem;
namespace {

/// Hash of everything after the first block, from the current position of the stream.
std::string hash_of_rest(std::istream& in) {
  Hash hash;
  std::vector<char> piece(1U << 20U);
  while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())), in.gcount() > 0)
    hash.add(std::span<const char>(piece).first(static_cast<std::size_t>(in.gcount())));
  return hash.text();
}

constexpr const char* format = "rondo checkpoint 1\n";

std::string first_block(const std::string& hash) {
  std::string text =
      fmt::format("{}xxh3-128 {} of the bytes from {} on\n", format, hash, hash_block_bytes);
  text.resize(hash_block_bytes, '\0');
  return text;
}

void write_hash(const fs::path& file) {
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekg(hash_block_bytes);
  const std::string block = first_block(hash_of_rest(stream));
  if (stream.bad()) fail_on(file, "read");
  stream.clear();  // clears the end-of-file state
  stream.seekp(0);
  stream.write(block.data(), static_cast<std::streamsize>(block.size()));
  stream.close();
  if (!stream) fail_on(file, "write");
}

}  // namespace

void write_checkpoint_file(const fs::path& file, const std::function<void(h5::File&)>& fill) {
  const UnfinishedFile beside(file.string() + ".new");
  h5::File content = h5::File::create_after(beside.path, hash_block_bytes);
  fill(content);
  content.close();
  write_hash(beside.path);
  replace_file(beside.path, file);
}

h5::File open_checkpoint_file(const fs::path& file) {
  demand_regular_file(file);
  std::ifstream in(file, std::ios::binary);
  std::string block(hash_block_bytes, '\0');
  if (!in) fail_on(file, "read");
  in.read(block.data(), static_cast<std::streamsize>(block.size()));
  if (!in || !block.starts_with("rondo checkpoint "))
    throw FileError(file.string(), "is damaged, or not a checkpoint of rondo's");
  if (!block.starts_with(format))
    throw FileError(file.string(), fmt::format("is of another version of rondo: it begins with "
                                               "\"{}\", and this version reads \"{}\"",
                                               block.substr(0, block.find('\n')),
                                               std::string_view(format).substr(0, 18)));
  if (block != first_block(hash_of_rest(in)))
    throw FileError(file.string(), "is damaged: its content is not what its hash was made of");
  return h5::File::open(file);
}

}  // namespace rondo::io
