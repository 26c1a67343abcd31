// SPDX-License-Identifier: BSD-3-Clause
#include "documents/documents.hpp"

namespace rondo::app {
namespace {

using study::ForceErrors;
using study::ReducePart;

struct Reduced {
  const study::ReduceRequest& q;
  const study::ReduceReport& r;
};

struct LeftOut {
  std::string run;
  ForceErrors error;
};

constexpr JsonMember<LeftOut> left_out_members[] = {
    {"run", "string", "", "left out and predicted from the others",
     [](const LeftOut& l) -> Json { return l.run; }},
    {"error_x", "number", "", "of the mean of force_x, over that of force_y",
     [](const LeftOut& l) -> Json { return l.error.x; }},
    {"error_y", "number", "", "of the mean of force_y, over itself",
     [](const LeftOut& l) -> Json { return l.error.y; }},
    {"error_x_of_itself", "number", "",
     "of the mean of force_x, over its own size; null: below 0.1 % of that of force_y",
     [](const LeftOut& l) -> Json { return l.error.x_of_itself; }},
    {"error_friction_power", "number", "",
     "of the mean power of friction, over itself; null: none, or of a steady state",
     [](const LeftOut& l) -> Json { return l.error.friction_power; }},
};

Json left_out(const Reduced& k) {
  std::vector<LeftOut> list;
  for (std::size_t i = 0; i < k.r.estimate.errors.size(); ++i)
    list.push_back({k.r.estimate.runs[i], k.r.estimate.errors[i]});
  return objects_of(left_out_members, list);
}

/// Null where nothing was estimated.
Json estimate(const Reduced& k, double ForceErrors::*part) {
  return k.r.estimate.errors.empty() ? Json() : Json(k.r.estimate.estimate().*part);
}

constexpr JsonMember<ReducePart> part_members[] = {
    {"field", "string", "", "that the modes are of",
     [](const ReducePart& p) -> Json { return p.field; }},
    {"snapshots", "integer", "", "taken", [](const ReducePart& p) -> Json { return p.snapshots; }},
    {"modes", "integer", "", "of this field", [](const ReducePart& p) -> Json { return p.modes; }},
    {"discarded", "number", "", "share of the energy that they leave out",
     [](const ReducePart& p) -> Json { return p.discarded; }},
};

std::vector<study::MemberText> part_texts() {
  return texts_of(part_members);
}

constexpr JsonMember<Reduced> reduce_members[] = {
    {"model", "string", "", "file of the model",
     [](const Reduced& k) -> Json { return k.q.output.string(); }},
    {"model_bytes", "integer", "B", "its size",
     [](const Reduced& k) -> Json { return k.r.file_bytes; }},
    {"dofs", "integer", "", "of the full model", [](const Reduced& k) -> Json { return k.r.dofs; }},
    {"modes", "integer", "", "of the reduced one",
     [](const Reduced& k) -> Json { return k.r.modes; }},
    {"displacement", "object", "", "modes of displacements",
     [](const Reduced& k) -> Json { return object_of(part_members, k.r.displacement); },
     part_texts},
    {"velocity", "object", "", "modes of velocities",
     [](const Reduced& k) -> Json { return object_of(part_members, k.r.velocity); }, part_texts},
    {"displacement_left", "number", "", "share of the energy that all modes leave out",
     [](const Reduced& k) -> Json { return k.r.displacement_left; }},
    {"velocity_left", "number", "", "likewise",
     [](const Reduced& k) -> Json { return k.r.velocity_left; }},
    {"contact", "string", "", "form of the contact points",
     [](const Reduced& k) -> Json { return k.r.contact; }},
    {"contact_points", "integer", "", "round the disk",
     [](const Reduced& k) -> Json { return k.r.contact_points; }},
    {"contact_step", "number", "s", "in which one contact point is passed; 0: none",
     [](const Reduced& k) -> Json { return k.r.contact_step; }},
    {"full_critical_step", "number", "s", "of the mesh",
     [](const Reduced& k) -> Json { return k.r.full_critical_step; }},
    {"reduced_critical_step", "number", "s", "of the modes, explicit",
     [](const Reduced& k) -> Json { return k.r.reduced_critical_step; }},
    {"estimate_x", "number", "", "error of force_x to be expected, over force_y; null: none",
     [](const Reduced& k) -> Json { return estimate(k, &ForceErrors::x); }},
    {"estimate_y", "number", "", "error of force_y to be expected; null: none",
     [](const Reduced& k) -> Json { return estimate(k, &ForceErrors::y); }},
    {"estimate_x_of_itself", "number", "",
     "error of force_x to be expected, over itself; null: none",
     [](const Reduced& k) -> Json { return estimate(k, &ForceErrors::x_of_itself); }},
    {"estimate_friction_power", "number", "",
     "error of the power of friction to be expected, over itself; null: none",
     [](const Reduced& k) -> Json { return estimate(k, &ForceErrors::friction_power); }},
    {"estimate_text", "string", "", "in words, or why there is none",
     [](const Reduced& k) -> Json { return study::in_words(k.r.estimate); }},
    {"left_out", "array", "", "what the estimate is from", left_out,
     [] { return texts_of(left_out_members); }},
    {"wall_s", "number", "s", "all of it", [](const Reduced& k) -> Json { return k.r.wall_s; }},
};

}  // namespace

Json reduce_document(const study::ReduceRequest& request, const study::ReduceReport& report) {
  return object_of(reduce_members, {request, report});
}

Json reduce_schema() {
  return schema_of(texts_of(reduce_members));
}

}  // namespace rondo::app
