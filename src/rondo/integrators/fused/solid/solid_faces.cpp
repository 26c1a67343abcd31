// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/integrators/fused/solid/solid_faces.hpp"

#include <array>

#include "rondo/core/contract.hpp"
#include "rondo/core/index.hpp"

namespace rondo::dynamics {
namespace {

using fem::finite::FaceCorners;

void write(Vec3 a, double (&to)[3]) noexcept {
  to[0] = a.x, to[1] = a.y, to[2] = a.z;
}

/// From lines of the section to faces, in the axes of sector 0.
class Maker {
 public:
  Maker(const Model& model, const RingLayout& layout, SolidFacesPlan& plan)
      : model_(model),
        layout_(layout),
        plan_(plan),
        row_of_(rows_of_nodes(layout)),
        first_(model.solid->sector.turn[0]),
        next_(conj(first_) * model.solid->sector.turn[1]) {
    plan_.place.assign(at(layout.n_local), -1);
  }

  /// @return the corners in the state
  FaceCorners corners(const std::array<int, 2>& line, kernels::SolidFaceCorner (&to)[4]) {
    const std::array<int, 4> node{line[0], line[1], line[1], line[0]};
    FaceCorners x;
    for (std::size_t a = 0; a < 4; ++a) {
      const Complex turn = a >= 2 ? next_ : Complex{1.0, 0.0};
      const std::size_t k = at(node[a]);
      x[a] = turn * (conj(first_) * Vec3(model_.reference[k], model_.solid->axial[k]));
      to[a] = corner(row_of_[k], a >= 2, turn);
    }
    return x;
  }

 private:
  kernels::SolidFaceCorner corner(int row, bool next, Complex turn) {
    if (row < 0) return {-1, -1, 1.0, 0.0};
    int& place = plan_.place[at(row)];
    if (place < 0) place = plan_.n_rows++;
    const Complex frame = turn * layout_.frame[at(row)];
    return {row * layout_.row_size() + (next ? 1 : 0),
            (6 * place + (next ? 3 : 0)) * layout_.stride, frame.re, frame.im};
  }

  const Model& model_;
  const RingLayout& layout_;
  SolidFacesPlan& plan_;
  std::vector<int> row_of_;
  Complex first_, next_;
};

void add_cords(const fem::finite::SweptCords& cords, Maker& maker, SolidFacesPlan& plan) {
  for (std::size_t e = 0; e < cords.lines.size(); ++e) {
    kernels::SolidCordFace face{};
    const FaceCorners x = maker.corners(cords.lines[e], face.corner);
    for (std::size_t q = 0; q < 4; ++q) {
      const fem::finite::CordPoint& point = cords.points[e][q];
      Vec3 y;
      for (std::size_t a = 0; a < 4; ++a) {
        face.slope[q][a] = point.slope[a];
        y += point.slope[a] * x[a];
      }
      write(y, face.rest[q]);
      face.length[q] = point.length;
    }
    face.stiffness = cords.law.stiffness;
    face.prestrain = cords.law.prestrain;
    face.compression = cords.law.compression;
    plan.cords.push_back(face);
  }
}

}  // namespace

SolidFacesPlan make_faces_plan(const Model& model, const RingLayout& layout) {
  RONDO_DEMAND(model.solid && model.solid->swept && layout.stride > 0, layout.stride);
  const fem::finite::SweptFaces& faces = model.solid->swept->faces;
  SolidFacesPlan plan;
  plan.pressure = faces.pressure;
  Maker maker(model, layout, plan);
  for (const fem::finite::SweptCords& cords : faces.cords) add_cords(cords, maker, plan);
  for (const auto& line : faces.liner) {
    kernels::SolidAirFace face{};
    const FaceCorners x = maker.corners(line, face.corner);
    write(0.25 * (x[0] + x[1] + x[2] + x[3]), face.middle);
    write(0.25 * (x[1] + x[2] - x[0] - x[3]), face.along);
    write(0.25 * (x[2] + x[3] - x[0] - x[1]), face.across);
    plan.air.push_back(face);
  }
  return plan;
}

kernels::SolidFaces SolidFacesPlan::faces() const noexcept {
  kernels::SolidFaces s{};
  s.cords = cords.data();
  s.air = air.data();
  s.n_cords = static_cast<int>(cords.size());
  s.n_air = static_cast<int>(air.size());
  s.pressure = pressure;
  s.n_rows = n_rows;
  return s;
}

/// The loops run over eight sectors, all of which are in the state.
StateOfFaces state_of_faces(const SolidFacesPlan& plan, const RingLayout& layout,
                            const kernels::SolidTable& table) {
  const std::vector<double> rest(layout.chunk_size());
  std::vector<double> forces(plan.size(layout)), sum(kernels::lanes);
  kernels::SolidFaces s = plan.faces();
  s.now = rest.data() + RingLayout::lead;
  s.force = forces.data() + RingLayout::lead;
  s.stride = layout.stride;
  s.columns = kernels::lanes;
  s.n_sums = 1;
  s.sums = sum.data();
  table.faces(s);
  StateOfFaces state;
  state.energy = 0.5 * sum[0];
  for (const int place : plan.place) {
    const double* const x = s.force + 6 * place * layout.stride;
    const auto of = [&](std::ptrdiff_t c) {
      return x[c * layout.stride] + x[(3 + c) * layout.stride - 1];
    };
    state.force.push_back(place < 0 ? Vec3{} : Vec3{of(0), of(1), of(2)});
  }
  return state;
}

}  // namespace rondo::dynamics
