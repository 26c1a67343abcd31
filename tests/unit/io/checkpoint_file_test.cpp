// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/checkpoint_file.hpp"

#include "rondo/io/h5/hash.hpp"
#include "unit/io/support.hpp"

namespace rondo::io::test::checkpoint_file_test {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, double value) {
  write_checkpoint_file(file, [&](h5::File& content) {
    content.write("/a/value", {1}, std::span<const double>(&value, 1), {"m", "a value"});
  });
}

double read(const fs::path& file) {
  return open_checkpoint_file(file).read<double>("/a/value").front();
}

TEST(CheckpointFile, IsReadBackAndReplaced) {
  const Folder folder;
  const fs::path file = folder / "a.h5";
  write(file, 0.1);
  EXPECT_EQ(read(file), 0.1);
  write(file, 0.2);
  EXPECT_EQ(read(file), 0.2);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
  EXPECT_TRUE(text_of(file).starts_with("rondo checkpoint 1\nxxh3-128 "));
}

/// Any byte, in the hash and behind it; and any length.
TEST(CheckpointFile, IsRefusedWhereAnythingIsNotAsWritten) {
  const Folder folder;
  const fs::path file = folder / "a.h5";
  write(file, 0.1);
  const std::string whole = text_of(file);
  const auto refused = [&](const std::string& text) {
    put_text(file, text);
    return error_of<FileError>([&] { static_cast<void>(open_checkpoint_file(file)); });
  };
  for (std::size_t at = 0; at < whole.size(); at += at < hash_block_bytes ? 1 : 37) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    const bool number = at == 17 || at == 18;  // of the format: "rondo checkpoint 1\n"
    ASSERT_NE(refused(damaged).find(number ? "a.h5: is of another version" : "a.h5: is damaged"),
              std::string::npos)
        << at;
  }
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{100}, hash_block_bytes, whole.size() - 1})
    ASSERT_NE(refused(whole.substr(0, size)).find("is damaged"), std::string::npos) << size;
  EXPECT_NE(refused(whole + "x").find("is damaged"), std::string::npos);
  put_text(file, whole);
  EXPECT_EQ(read(file), 0.1);
  EXPECT_NE(error_of<FileError>([&] { read(folder / "none"); }).find("No such file"),
            std::string::npos);
}

TEST(CheckpointFile, TheOldOneStaysWhereTheNewOneFails) {
  const Folder folder;
  const fs::path file = folder / "a.h5";
  write(file, 0.1);
  const int status = in_child([&] {
    limit_files(3000);
    const std::string what = error_of<FileError>([&] {
      const std::vector<double> many(1000);
      write_checkpoint_file(file, [&](h5::File& content) {
        content.write("/a", {many.size()}, std::span<const double>(many), {"m", "many"});
      });
    });
    EXPECT_NE(what.find("File too large"), std::string::npos) << what;
    if (::testing::Test::HasFailure()) std::_Exit(1);
  });
  EXPECT_TRUE(went_well(status));
  EXPECT_EQ(read(file), 0.1);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

/// Vectors of the algorithm's authors: XXH3, 128 bits, of nothing.
TEST(Hash, OfNothingAsPublishedAndOfPiecesAsOfTheWhole) {
  EXPECT_EQ(Hash().text(), "99aa06d3014798d86001c324468d497f");
  const std::string text(10000, 'x');
  Hash whole, pieces;
  whole.add(std::span(text));
  pieces.add(std::span(text).first(1234));
  pieces.add(std::span(text).subspan(1234));
  EXPECT_EQ(whole.text(), pieces.text());
}

}  // namespace
}  // namespace rondo::io::test::checkpoint_file_test
