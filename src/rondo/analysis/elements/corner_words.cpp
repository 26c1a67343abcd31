// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/analysis/elements/corner_words.hpp"

#include <fmt/format.h>

#include "rondo/case/ground/ground_shape.hpp"

namespace rondo::study {

CornerWords corner_words(const Case& c, const dynamics::Model& model) {
  const contact::Corner& corner = model.contact->ground.corners()[0];
  const double fillet = corner.radius, spacing = model.contact->ground.spacing();
  const Vec2 first = at_middle(c, corner.position);
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
