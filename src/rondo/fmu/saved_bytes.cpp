// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/fmu/saved_bytes.hpp"

#include <cstdint>
#include <cstring>
#include <type_traits>

#include "rondo/core/error.hpp"
#include "rondo/core/version.hpp"
#include "rondo/io/h5/hash.hpp"

namespace rondo::fmu {
namespace {

/// Writes if it has no source, reads if it has one, so that one list of members serves both.
class Archive {
 public:
  Archive() = default;
  explicit Archive(std::span<const char> from) : from_(from), reads_(true) {}

  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(T& value) {
    if (!reads_) {
      const char* const raw = reinterpret_cast<const char*>(&value);
      to_.insert(to_.end(), raw, raw + sizeof(T));
      return;
    }
    if (from_.size() < sizeof(T)) fail();
    std::memcpy(static_cast<void*>(&value), from_.data(), sizeof(T));
    from_ = from_.subspan(sizeof(T));
  }
  template <class T>
  void operator()(std::vector<T>& list) {
    resize(list);
    for (T& one : list) (*this)(one);
  }
  void operator()(std::string& text) {
    resize(text);
    for (char& one : text) (*this)(one);
  }
  template <class T>
  void operator()(std::optional<T>& maybe) {
    char there = maybe.has_value() ? 1 : 0;
    (*this)(there);
    if (reads_) maybe = there != 0 ? std::optional<T>(T{}) : std::nullopt;
    if (maybe) (*this)(*maybe);
  }
  void operator()(dynamics::SavedState& s) { all(s.step, s.ring, s.ledger); }
  void operator()(SavedWheel& s) { all(s.values, s.start, s.dt, s.hub, s.state); }

  [[nodiscard]] std::vector<char>& bytes() noexcept { return to_; }
  [[nodiscard]] bool is_at_end() const noexcept { return from_.empty(); }

  [[noreturn]] static void fail() {
    throw request_error("state", "", "its bytes are no state of this FMU, or damaged",
                        "what fmi2SerializeFMUstate of the same FMU has written");
  }

 private:
  template <class... T>
  void all(T&... values) {
    ((*this)(values), ...);
  }
  template <class List>
  void resize(List& list) {
    std::uint64_t n = list.size();
    (*this)(n);
    if (!reads_) return;
    if (n > from_.size()) fail();  // each takes at least a byte
    list.resize(n);
  }

  std::span<const char> from_;
  bool reads_ = false;
  std::vector<char> to_;
};

std::string head_of(const std::string& owner) {
  return std::string("rondo wheel ") + version + " " + owner;
}

}  // namespace

std::vector<char> bytes_of(const SavedWheel& saved, const std::string& owner) {
  Archive archive;
  std::string head = head_of(owner);
  SavedWheel copy = saved;
  archive(head);
  archive(copy);
  return std::move(archive.bytes());
}

SavedWheel saved_of(std::span<const char> bytes, const std::string& owner) {
  Archive archive(bytes);
  std::string head;
  archive(head);
  if (head != head_of(owner)) Archive::fail();
  SavedWheel saved;
  archive(saved);
  if (!archive.is_at_end()) Archive::fail();
  return saved;
}

std::string hash_of(std::span<const char> bytes) {
  io::Hash hash;
  hash.add(std::as_bytes(bytes));
  return hash.text();
}

}  // namespace rondo::fmu
