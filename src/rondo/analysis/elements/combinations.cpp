// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/elements/combinations.hpp"

#include <fmt/format.h>

#include "rondo/analysis/elements/corner_words.hpp"
#include "rondo/case/features/case_features.hpp"

namespace rondo::study {
namespace {

/// Why K is assembled, the case tells better.
dynamics::Features features_of(const Case& c, const dynamics::Model& model) {
  return study::features_of(c) |
         (dynamics::features_of(model) & ~dynamics::Features{dynamics::has::assembled});
}

InputError refusal_of(const Case& c, const dynamics::Model& model, const dynamics::Limit& limit) {
  std::string why(limit.why), instead = instead_of(c, limit);
  std::string_view key = row_of(c, limit.at).key;
  if (((limit.at | limit.with) & dynamics::has::sharp_corners) != 0) {
    const CornerWords words = corner_words(c, model);
    const auto other = (limit.at | limit.with) & ~dynamics::Features{dynamics::has::sharp_corners};
    why += "; here are " + words.corners;
    instead = fmt::format("{}; or {}", row_of(c, other).without, words.instead);
  }
  return case_error(c, std::string(key), why, instead);
}

}  // namespace

void refuse_combinations(const Case& c, const dynamics::Model& model, dynamics::Features more) {
  const dynamics::Features all = features_of(c, model) | more;
  for (const dynamics::Limit& limit : dynamics::step_limits())
    if (limit.is_refusal() && limit.holds_for(all)) throw refusal_of(c, model, limit);
  if ((all & dynamics::has::reduced) == 0) return;
  const auto kind = model.solid ? dynamics::StepKind::solid_reduced : dynamics::StepKind::reduced;
  if (const dynamics::Limit* const why = why_not(kind, all)) throw refusal_of(c, model, *why);
}

std::string told_step(const Case& c, const dynamics::Model& model) {
  return dynamics::step_text(features_of(c, model));
}

}  // namespace rondo::study
