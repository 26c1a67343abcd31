// SPDX-License-Identifier: BSD-3-Clause
#include "edited_results.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "rondo/io/h5/h5.hpp"

namespace rondo::fuzz {
namespace {

using io::h5::File;
using io::h5::Shape;

struct Array {
  std::string name;
  bool whole = false;  ///< int32 in the file, else float64
  Shape shape;
  std::vector<double> values;
  bool there = true;
};

struct Results {
  std::vector<Array> arrays;
  std::string format = "rondo results 1", analysis = "dynamic";
};

constexpr std::array reals{
    "/mesh/coordinates",     "/mesh/tributary",         "/mesh/mass",
    "/frame/time",           "/frame/time_velocity",    "/frame/angle",
    "/frame/angle_velocity", "/snapshots/displacement", "/snapshots/velocity",
    "/contact/force"};
constexpr std::array wholes{"/mesh/cells", "/mesh/boundary", "/mesh/sector", "/mesh/sector_node"};

Results read_results(const std::filesystem::path& path) {
  const File file = File::open(path);
  Results results;
  for (const char* name : reals) {
    const auto dataset = file.dataset(name);
    results.arrays.push_back({name, false, dataset.shape(), dataset.read<double>()});
  }
  for (const char* name : wholes) {
    const auto dataset = file.dataset(name);
    results.arrays.push_back({name, true, dataset.shape(), dataset.read<double>()});
  }
  return results;
}

std::size_t n_numbers(const Shape& shape) {
  std::size_t n = 1;
  for (const std::size_t extent : shape) n *= extent;
  return n;
}

struct Edit {
  unsigned of, what, place;
  std::uint64_t value;
};

Edit edit_at(std::string_view bytes) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(bytes[k]); };
  Edit edit{byte(0), byte(1), byte(2) + 256U * byte(3), 0};
  std::memcpy(&edit.value, bytes.data() + 4, sizeof edit.value);
  return edit;
}

/// 0: left out; 1: an extent of 0 to 9; 2: one dimension more or less; 3: the other type; else a
/// value: the 8 bytes as a double, or the first four of them as an int.
void apply(const Edit& edit, Array& array) {
  switch (edit.what % 8) {
    case 0:
      array.there = false;
      break;
    case 1:
      if (!array.shape.empty()) array.shape[edit.place % array.shape.size()] = edit.value % 10;
      break;
    case 2:
      if (edit.value % 2 == 0 && array.shape.size() < 9)
        array.shape.push_back(1 + edit.value / 2 % 2);
      else if (!array.shape.empty())
        array.shape.pop_back();
      break;
    case 3:
      array.whole = !array.whole;
      break;
    default:
      if (!array.values.empty())
        array.values[edit.place % array.values.size()] =
            array.whole ? static_cast<double>(static_cast<std::int32_t>(edit.value))
                        : std::bit_cast<double>(edit.value);
  }
  // Numbers that there are not are those from the beginning again.
  const std::vector<double> before = array.values;
  array.values.resize(n_numbers(array.shape));
  for (std::size_t k = before.size(); k < array.values.size(); ++k)
    array.values[k] = before.empty() ? 0.0 : before[k % before.size()];
}

void apply(const Edit& edit, Results& results) {
  static constexpr std::array words{"", "crush", "dynamic", "rondo results 1", "rondo results 2"};
  if (edit.of % 16 < results.arrays.size()) return apply(edit, results.arrays[edit.of % 16]);
  std::string& text = edit.what % 2 == 0 ? results.analysis : results.format;
  text = words[edit.value % words.size()];
}

std::int32_t whole(double value) {
  return value > -2e9 && value < 2e9 ? static_cast<std::int32_t>(value) : -1;
}

void write(const Results& results, const std::filesystem::path& to) {
  File file = File::create(to);
  file.set_attribute("/", "format", results.format);
  file.set_attribute("/", "analysis", results.analysis);
  const io::h5::Label label{"1", "of a fuzz target"};
  for (const Array& array : results.arrays) {
    if (!array.there) continue;
    if (array.whole) {
      std::vector<std::int32_t> values;
      for (const double value : array.values) values.push_back(whole(value));
      file.write<std::int32_t>(array.name, array.shape, values, label);
    } else {
      file.write<double>(array.name, array.shape, array.values, label);
    }
  }
  file.close();
}

}  // namespace

void write_edited(const std::filesystem::path& from, const std::filesystem::path& to,
                  std::string_view edits) {
  static const Results base = read_results(from);
  Results results = base;
  for (; edits.size() >= edit_size; edits.remove_prefix(edit_size)) apply(edit_at(edits), results);
  write(results, to);
}

}  // namespace rondo::fuzz
