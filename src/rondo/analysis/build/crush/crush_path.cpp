// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/build/crush/crush_path.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "rondo/core/contract.hpp"

namespace rondo::study {

CrushPath::CrushPath(const AnalysisCase& analysis)
    : depth_(analysis.depth),
      slide_(analysis.slide),
      load_(analysis.load.value_or(0.0)),
      increments_(analysis.increments),
      slide_increments_(analysis.slide_increments) {
  RONDO_DEMAND(increments_ >= 1 && slide_increments_ >= 0, increments_, slide_increments_);
}

double CrushPath::depth(int k) const noexcept {
  RONDO_ASSERT(k >= 0 && k <= n_increments(), k, n_increments());
  if (is_of_tables()) return depth_.at(k);
  return depth_.at(0.0) * std::min(k, increments_) / increments_;
}

double CrushPath::load(int k) const noexcept {
  RONDO_ASSERT(k >= 0 && k <= n_increments(), k, n_increments());
  return load_ * std::min(k, increments_) / increments_;
}

double CrushPath::slide(int k) const noexcept {
  RONDO_ASSERT(k >= 0 && k <= n_increments(), k, n_increments());
  if (is_of_tables()) return slide_.at(k);
  return k <= increments_ ? 0.0 : slide_.at(0.0) * (k - increments_) / slide_increments_;
}

std::string CrushPath::target(int k) const {
  const std::string text =
      has_load() ? fmt::format("load {:.6g} N", load(k)) : fmt::format("depth {:.6g} m", depth(k));
  const bool slides = is_of_tables() ? has_slide() : k > increments_;
  return slides ? fmt::format("{}, slide {:.6g} m", text, slide(k)) : text;
}

}  // namespace rondo::study
