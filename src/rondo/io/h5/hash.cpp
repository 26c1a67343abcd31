// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/io/h5/hash.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <new>

namespace rondo::io {

void Hash::Free::operator()(XXH3_state_s* state) const noexcept {
  XXH3_freeState(state);
}

Hash::Hash() : state_(XXH3_createState()) {
  if (!state_) throw std::bad_alloc();
  XXH3_128bits_reset(state_.get());
}

void Hash::add(std::span<const std::byte> bytes) {
  if (!bytes.empty()) XXH3_128bits_update(state_.get(), bytes.data(), bytes.size());
}

std::string Hash::text() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_.get());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace rondo::io
