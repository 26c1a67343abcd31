// SPDX-License-Identifier: BSD-3-Clause
/// @file  Small disks whose modes are the whole space: what is reduced is the frame and the step.
#pragma once
#include <cmath>
#include <span>
#include <vector>

#include "rondo/fem/sector_stiffness.hpp"
#include "rondo/rom/integrator.hpp"
#include "support/models.hpp"

namespace rondo::rom::test {

using rondo::test::Built;
using rondo::test::DiskCase;

struct Form {
  rom::ContactForm contact = rom::ContactForm::places;
  rom::ModelFrame frame = rom::ModelFrame::rectified;
  StepScheme scheme = StepScheme::midpoint;
  int stride = 1;
};

struct Reduced {
  Built full;
  Form form;
  rom::ReducedModel model;
  StepFigures figures;

  [[nodiscard]] ReducedIntegrator start(const dynamics::State& state) {
    return {IntegratorInput{full.mesh, full.model, model, figures, form.scheme}, state};
  }
};

/// @param left_out every so-manieth column of the whole space; 0: none
inline Reduced whole_space(const DiskCase& c, Form form = {}, Index left_out = 0) {
  Reduced r{rondo::test::build(c), form, {}, {}};
  const auto sector = fem::assemble_sector(r.full.mesh, {&c.material, 1});
  const auto n = static_cast<Index>(r.full.model.free.size());
  const Index columns = 2 * n - (left_out > 0 ? 2 * n / left_out : 0);
  MatrixXd basis = MatrixXd::Zero(static_cast<Index>(2 * r.full.mesh.n_nodes()), columns);
  for (Index k = 0, column = 0; k < 2 * n; ++k)
    if (left_out == 0 || (k + 1) % left_out != 0)
      basis(2 * r.full.model.free[static_cast<std::size_t>(k / 2)] + k % 2, column++) = 1.0;
  r.model = rom::make_reduced_model(
      {r.full.mesh, r.full.model.mass,
       [&](std::span<const Vec2> in, std::span<Vec2> out) { fem::apply(sector, in, out); }},
      basis, form.frame);
  const bool standing = form.contact != rom::ContactForm::nodes;
  rom::set_contact(r.full.mesh, form.contact,
                   standing ? rom::hat_weights(r.full.mesh.n_sectors, form.stride) : MatrixXd(),
                   r.model);
  return r;
}

/// A disk that is pressed on a ledge with both dampings while its spin changes.
inline Reduced pressed(Form form, Index left_out = 0) {
  DiskCase c = rondo::test::rolling_disk(2, 48);
  c.motion.start_x = -0.1;
  c.motion.angular_velocity = dynamics::Table({{0.0, 33.0}, {0.005, 36.0}});
  c.motion.height = dynamics::Table({{0.0, 0.3}, {0.01, 0.29}});
  Reduced r = whole_space(c, form, left_out);
  rondo::test::add_ground(r.full, rondo::test::ledge(), {0.4, 0.2});
  if (form.scheme == StepScheme::midpoint) r.full.model.dt *= 10.0;
  return r;
}

inline double difference(std::span<const Vec2> a, std::span<const Vec2> b) {
  double sum = 0.0, all = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += dot(a[i] - b[i], a[i] - b[i]);
    all += dot(a[i], a[i]);
  }
  return std::sqrt(sum / all);
}

}  // namespace rondo::rom::test
