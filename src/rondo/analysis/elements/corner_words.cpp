// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/elements/corner_words.hpp"

#include <fmt/format.h>

#include "rondo/case/ground/ground_shape.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/model/solid/wheel_ground.hpp"

namespace rondo::study {

CornerWords corner_words(const Case& c, const dynamics::Model& model) {
  RONDO_DEMAND(has_sharp_corners(model));
  std::size_t set = 0;
  while (profile_of(*model.contact, set).corners().empty()) ++set;
  const contact::Corner& corner = profile_of(*model.contact, set).corners()[0];
  const double fillet = corner.radius, spacing = model.contact->ground.spacing();
  const Vec2 first = at_middle(*model.contact, set, corner.position);
  CornerWords words;
  words.corners = fmt::format("sharp convex corners of the ground (the first at {:.6g}, {:.6g} m",
                              first.x, first.y);
  if (fillet > 0.0)
    words.corners += fmt::format(
        "; {} = {:.3g} m is below the {:.3g} m between two contact nodes, so that they "
        "count as sharp",
        fillet_key(c, fillet), fillet, spacing);
  words.corners += ")";
  words.instead =
      fmt::format("{} of at least {:.3g} m, the longest distance of two contact nodes{}",
                  fillet_key(c, fillet), spacing, fillet > 0.0 ? ", or a finer mesh" : "");
  return words;
}

}  // namespace rondo::study
