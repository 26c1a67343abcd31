// SPDX-License-Identifier: BSD-3-Clause
#include "mutate.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <string_view>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max);

namespace rondo::fuzz {
namespace {

using Random = std::minstd_rand;

std::size_t below(Random& random, std::size_t n) {
  return n == 0 ? 0 : random() % n;
}

// Text ------------------------------------------------------------------------------------------

constexpr std::array numbers{
    "0",      "-0.0",     "1",         "-1",         "2",           "1e-300",
    "5e-324", "1e300",    "-1e300",    "1.7e308",    "inf",         "-inf",
    "nan",    "0.5",      "1e-9",      "1e9",        "3",           "100",
    "1000",   "1e-16",    "1e16",      "2147483647", "-2147483648", "9223372036854775807",
    "1e5",    "0.999999", "1.0000001", "1e150"};

struct Span {
  std::size_t begin = 0, end = 0;
};

/// Runs of characters of numbers that begin by a digit, a sign or a point.
std::vector<Span> numbers_in(std::string_view text) {
  constexpr std::string_view inside = "0123456789.eE+-";
  std::vector<Span> found;
  for (std::size_t i = 0; i < text.size();) {
    const bool after_word =
        i > 0 && (std::isalnum(static_cast<unsigned char>(text[i - 1])) != 0 || text[i - 1] == '_');
    const bool digit = text[i] >= '0' && text[i] <= '9';
    if ((!digit && text[i] != '-') || after_word) {
      ++i;
      continue;
    }
    const std::size_t end = std::min(text.find_first_not_of(inside, i), text.size());
    found.push_back({i, end});
    i = end;
  }
  return found;
}

std::vector<Span> lines_in(std::string_view text) {
  std::vector<Span> found;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = std::min(text.find('\n', i), text.size() - 1) + 1;
    found.push_back({i, end});
    i = end;
  }
  return found;
}

std::string_view part(std::string_view text, Span span) {
  return text.substr(span.begin, span.end - span.begin);
}

void change_number(std::string& text, Random& random) {
  const std::vector<Span> found = numbers_in(text);
  if (found.empty()) return;
  const Span at = found[below(random, found.size())];
  std::string other(numbers[below(random, numbers.size())]);
  if (random() % 3 == 0) other = part(text, found[below(random, found.size())]);
  text.replace(at.begin, at.end - at.begin, other);
}

void change_lines(std::string& text, Random& random) {
  const std::vector<Span> found = lines_in(text);
  if (found.empty()) return;
  const Span at = found[below(random, found.size())];
  const std::string other(part(text, found[below(random, found.size())]));
  switch (random() % 3) {
    case 0:
      text.erase(at.begin, at.end - at.begin);
      break;
    case 1:
      text.insert(at.begin, other);
      break;
    default:
      text.replace(at.begin, at.end - at.begin, other);
  }
}

// Bytes -----------------------------------------------------------------------------------------

template <class Number>
void put_number(std::uint8_t* at, std::size_t room, Number value) {
  std::memcpy(at, &value, std::min(room, sizeof value));
}

void put_real(std::uint8_t* at, std::size_t room, Random& random) {
  using limits = std::numeric_limits<double>;
  constexpr std::array<double, 12> reals{
      0.0,   -0.0, 1.0,   -1.0,  limits::infinity(),  1e-320,
      1e300, 1e99, 1e101, 1e150, limits::quiet_NaN(), -limits::infinity()};
  put_number(at, room, reals[below(random, reals.size())]);
}

void put_integer(std::uint8_t* at, std::size_t room, Random& random) {
  constexpr std::array<std::int64_t, 11> whole{
      0, 1, -1, 2, 255, 65535, 0x7fffffff, 0x80000000, 0xffffffff, 0x7fffffffffffffff, 64};
  const std::int64_t value = whole[below(random, whole.size())];
  constexpr std::array<std::size_t, 4> widths{1, 2, 4, 8};
  std::memcpy(at, &value, std::min(room, widths[below(random, widths.size())]));
}

void copy_piece(std::uint8_t* data, std::size_t size, std::size_t to, Random& random) {
  const std::size_t from = below(random, size);
  const std::size_t n = std::min(1 + below(random, 32), size - std::max(from, to));
  std::memmove(data + to, data + from, n);
}

}  // namespace

std::size_t mutate_text(std::uint8_t* data, std::size_t size, std::size_t max, unsigned seed) {
  Random random(seed);
  if (size == 0 || random() % 2 == 0) return LLVMFuzzerMutate(data, size, max);
  std::string text(reinterpret_cast<const char*>(data), size);
  for (std::size_t n = 1 + below(random, 3); n > 0; --n)
    random() % 4 == 0 ? change_lines(text, random) : change_number(text, random);
  if (text.size() > max || text.empty()) return LLVMFuzzerMutate(data, size, max);
  std::memcpy(data, text.data(), text.size());
  return text.size();
}

namespace {

/// Somewhere in the bytes from `keep` on, mostly where they are not zero: files have empty room.
std::size_t place_in(std::string_view bytes, std::size_t keep, Random& random) {
  std::size_t at = keep + below(random, bytes.size() - keep);
  for (int tries = 0; tries < 8 && bytes[at] == 0; ++tries)
    at = keep + below(random, bytes.size() - keep);
  const std::size_t aligned = at / 8 * 8;
  return random() % 2 == 0 && aligned >= keep ? aligned : at;
}

void change_bytes(std::uint8_t* data, std::size_t size, std::size_t at, Random& random) {
  switch (random() % 6) {
    case 0:
      data[at] ^= static_cast<std::uint8_t>(1U << (random() % 8));
      break;
    case 1:
      data[at] = static_cast<std::uint8_t>(random());
      break;
    case 2:
      put_real(data + at, size - at, random);
      break;
    case 3:
      put_integer(data + at, size - at, random);
      break;
    case 4:
      copy_piece(data, size, at, random);
      break;
    default:  // nearby values
      data[at] = static_cast<std::uint8_t>(data[at] + random() % 17 - 8);
  }
}

constexpr std::size_t patch_head = 5, longest_patch = 8;

std::string new_patch(std::string_view base, Random& random) {
  const std::size_t at = place_in(base, 0, random);
  std::size_t n = std::min(1 + below(random, longest_patch), base.size() - at);
  if (random() % 20 == 0) n = 0;
  std::string patch(patch_head, '\0');
  for (std::size_t k = 0; k < 4; ++k) patch[k] = static_cast<char>(at >> (8 * k));
  patch[4] = static_cast<char>(n);
  std::string bytes(base.substr(at, n));
  if (n > 0) change_bytes(reinterpret_cast<std::uint8_t*>(bytes.data()), n, 0, random);
  return patch + bytes;
}

}  // namespace

std::size_t mutate_in_place(std::uint8_t* data, std::size_t size, unsigned seed, std::size_t keep) {
  Random random(seed);
  if (size <= keep) return LLVMFuzzerMutate(data, size, std::max<std::size_t>(size, 1));
  if (random() % 50 == 0) return keep + 1 + below(random, size - keep);
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  for (std::size_t n = 1 + below(random, 4); n > 0; --n)
    change_bytes(data, size, place_in(bytes, keep, random), random);
  return size;
}

std::string patched(std::string_view base, std::string_view patches) {
  std::string file(base);
  while (patches.size() >= patch_head && !file.empty()) {
    std::size_t at = 0;
    for (std::size_t k = 0; k < 4; ++k)
      at |= static_cast<std::size_t>(static_cast<unsigned char>(patches[k])) << (8 * k);
    at %= file.size();
    const std::size_t n = static_cast<unsigned char>(patches[4]) % (longest_patch + 1);
    patches.remove_prefix(patch_head);
    const std::string_view bytes = patches.substr(0, std::min(n, file.size() - at));
    patches.remove_prefix(std::min(n, patches.size()));
    if (n == 0)
      file.resize(at);
    else
      file.replace(at, bytes.size(), bytes);
  }
  return file;
}

std::size_t mutate_patches(std::uint8_t* data, std::size_t size, std::size_t max, unsigned seed,
                           std::string_view base) {
  Random random(seed);
  const std::string patch = new_patch(base, random);
  if (random() % 2 == 0 && size + patch.size() <= max) {
    std::memcpy(data + size, patch.data(), patch.size());
    return size + patch.size();
  }
  if (random() % 4 == 0 && patch.size() <= max) {
    std::memcpy(data, patch.data(), patch.size());
    return patch.size();
  }
  return LLVMFuzzerMutate(data, size, max);
}

std::size_t mutate_records(std::uint8_t* data, std::size_t size, std::size_t max, unsigned seed,
                           std::size_t width) {
  Random random(seed);
  const std::size_t n = size / width, number = width - sizeof(double);
  size = n * width;
  if (n > 0 && random() % 4 == 0) {  // the last one takes the place of another
    std::memmove(data + below(random, n) * width, data + size - width, width);
    return size - width;
  }
  const bool more = n == 0 || random() % 2 == 0;
  if (more && size + width > max) return size;
  std::uint8_t* record = data + (more ? n : below(random, n)) * width;
  for (std::size_t k = 0; k < number; ++k)
    if (more || random() % 2 == 0) record[k] = static_cast<std::uint8_t>(random());
  random() % 2 == 0 ? put_real(record + number, sizeof(double), random)
                    : put_integer(record + number, sizeof(double), random);
  return more ? size + width : size;
}

}  // namespace rondo::fuzz
