// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/road/crg/crg_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "rondo/road/crg/crg_text.hpp"

namespace rondo::road {
namespace {

/// The standard allows 72 characters; comments are longer in files of this world.
constexpr std::size_t line_room = 4096;
constexpr std::size_t record_length = 72;
constexpr int most_lines = 4'000'000;

/// Takes the header apart, line by line.
class HeaderSplitter {
 public:
  explicit HeaderSplitter(CrgHeader& header) : header_(header) {}

  /// False: the line is the separator.
  bool take(std::string_view line, int number) {
    if (line.starts_with("$$")) return false;
    if (line.starts_with('$')) {
      begin_block(without_blanks(line.substr(1, line.find('!') - 1)), number);
      return true;
    }
    if (block_ == "CT") return true;  // text for readers
    const std::string_view text = without_blanks(line.substr(0, line.find('!')));
    if (text.empty() || text.front() == '*') return true;
    demand_short(line, number);
    if (block_.empty())
      refuse_header(
          {header_.file, number, ""}, "",
          fmt::format("\"{}\" stands outside of a block", shown_part(text)),
          "a line that begins with $ and the name of a block before it, or * before a comment");
    header_.blocks.back().lines.push_back(CrgLine{number, std::string(text)});
    return true;
  }

 private:
  /// An empty name ends the block.
  void begin_block(std::string_view name, int number) {
    block_ = upper_case(name.substr(0, name.find_first_of(" \t")));
    if (block_.empty()) return;
    if (header_.block(block_) != nullptr)
      refuse_header({header_.file, number, "$" + block_}, "", "the block stands twice in the file",
                    "one block of each name");
    header_.blocks.push_back(CrgBlock{block_, number, {}});
  }

  void demand_short(std::string_view line, int number) const {
    const std::string_view content = line.substr(0, line.find('!'));
    if (content.find_last_not_of(" \t\r") + 1 > record_length)
      refuse_header({header_.file, number, block_.empty() ? "" : "$" + block_}, "",
                    fmt::format("\"{}\" is longer than {} characters, behind which OpenCRG ignores "
                                "what stands there",
                                shown_part(content), record_length),
                    fmt::format("at most {} characters before the comment", record_length));
  }

  CrgHeader& header_;
  std::string block_;  ///< empty: outside of blocks
};

}  // namespace

const CrgBlock* CrgHeader::block(const std::string& name) const noexcept {
  const auto found = std::ranges::find(blocks, name, &CrgBlock::name);
  return found == blocks.end() ? nullptr : &*found;
}

CrgHeader read_crg_header(std::istream& in, const std::filesystem::path& file) {
  CrgHeader header{file.string(), {}, 0, 0};
  HeaderSplitter splitter(header);
  std::array<char, line_room> buffer{};
  std::size_t bytes = 0;
  while (in.getline(buffer.data(), line_room)) {
    const auto taken = static_cast<std::size_t>(in.gcount());
    bytes += taken;
    ++header.last_line;
    std::string_view line(buffer.data(), taken - (in.eof() ? 0 : 1));
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (!splitter.take(line, header.last_line)) {
      header.data_begin = bytes;
      return header;
    }
    if (header.last_line == most_lines) break;
  }
  if (!in.eof())
    refuse_header(
        {header.file, header.last_line + 1, ""}, "",
        "the header does not end, or a line of it is longer than 4095 characters: this is "
        "no OpenCRG file, or a damaged one");
  return header;
}

}  // namespace rondo::road
