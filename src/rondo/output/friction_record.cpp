// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/output/friction_record.hpp"

#include <string>

#include "rondo/model/friction_work.hpp"

namespace rondo::study {

void plan_friction_work(const dynamics::Model& model, io::ResultsLayout& layout) {
  if (!model.friction_work) return;
  const dynamics::FrictionWork& work = *model.friction_work;
  const std::string over = model.solid ? "area" : "length";
  layout.series.push_back({"/contact/friction_work", "J/m2",
                           "energy that friction has taken so far at each node of "
                           "/mesh/boundary, over its undeformed " +
                               over + " /mesh/tributary",
                           work.by_node().size()});
  if (!work.has_places()) return;
  const std::size_t n_along = work.along().count, n_across = work.across().count;
  layout.series.push_back({"/contact/friction_places", "J/m2",
                           "the same by place in the footprint, over the " + over +
                               " of the place: at each of /contact/friction_along" +
                               (model.solid ? ", and of /contact/friction_across" : ""),
                           n_along * n_across, model.solid ? n_along : 0});
  layout.constants.push_back(
      {"/contact/friction_along", "m",
       model.solid ? "the places along t1, from the center" : "the places along x, from the center",
       work.along().places()});
  if (model.solid)
    layout.constants.push_back({"/contact/friction_across", "m",
                                "the places along t2, from the center", work.across().places()});
}

void append_friction_work(const dynamics::Model& model, std::vector<double>& series) {
  if (!model.friction_work) return;
  for (const std::vector<double>& values :
       {model.friction_work->by_node(), model.friction_work->by_place()})
    series.insert(series.end(), values.begin(), values.end());
}

}  // namespace rondo::study
