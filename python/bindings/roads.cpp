// SPDX-License-Identifier: BSD-3-Clause
#include "roads.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>

#include "arrays.hpp"
#include "rondo/core/contract.hpp"
#include "rondo/road/crg/crg_reader.hpp"
#include "rondo/road/road_report.hpp"

namespace rondo::python {
namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// A road with the surfaces that its edges ask for.
class RoadSurfaces {
 public:
  explicit RoadSurfaces(const std::filesystem::path& file)
      : road_(road::read_crg(file)), edges_(road_.edges), surface_(road_, edges_) {}

  void set_borders(int along, int across, double offset_along, double offset_across) {
    const auto border = [](int mode) {
      RONDO_DEMAND(mode >= 0 && mode <= 4, mode);
      return static_cast<road::Border>(mode);
    };
    edges_ = {border(along), border(across), offset_along, offset_across};
    surface_ = road::Surface(road_, edges_);
  }

  [[nodiscard]] py::tuple borders() const {
    return py::make_tuple(static_cast<int>(edges_.u), static_cast<int>(edges_.v), edges_.offset_u,
                          edges_.offset_v);
  }

  [[nodiscard]] py::dict arrays() const {
    const auto n_u = static_cast<py::ssize_t>(road_.n_u()),
               n_v = static_cast<py::ssize_t>(road_.n_v());
    py::dict all;
    all["file"] = road_.file;
    all["format"] = road_.format;
    std::vector<double> u(road_.n_u());
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = surface_.u_axis().position(i);
    all["u"] = owned(std::move(u));
    all["v"] = owned(road_.v);
    all["heights"] = owned(road_.heights, {n_u, n_v});
    all["line_height"] = owned(road_.line_height);
    all["slope"] = owned(road_.slope);
    all["banking"] = owned(road_.banking);
    all["heading"] = owned(road_.heading);
    return all;
  }

  /// (n) [m] @pre arrays of the same length
  [[nodiscard]] py::array_t<double> height(const Numbers& u, const Numbers& v) const {
    RONDO_DEMAND(u.size() == v.size(), u.size(), v.size());
    std::vector<double> z(static_cast<std::size_t>(u.size()));
    for (std::size_t k = 0; k < z.size(); ++k) z[k] = surface_.bilinear(u.data()[k], v.data()[k]);
    return owned(std::move(z));
  }

  /// (n, 6): height, slopes along u and v, second derivatives uu, uv, vv.
  [[nodiscard]] py::array_t<double> smooth(const Numbers& u, const Numbers& v) const {
    RONDO_DEMAND(u.size() == v.size(), u.size(), v.size());
    std::vector<double> points;
    points.reserve(6 * static_cast<std::size_t>(u.size()));
    for (py::ssize_t k = 0; k < u.size(); ++k) {
      const road::SurfacePoint p = surface_.at(u.data()[k], v.data()[k]);
      points.insert(points.end(),
                    {p.height, p.slope_u, p.slope_v, p.bend_uu, p.bend_uv, p.bend_vv});
    }
    return owned(std::move(points), {u.size(), 6});
  }

  [[nodiscard]] std::vector<std::string> lines() const {
    return road::lines_of(road_, road::report_of(road_, surface_), edges_);
  }

 private:
  road::Road road_;
  road::Edges edges_;
  road::Surface surface_;
};

}  // namespace

void add_roads(py::module_& module) {
  py::class_<RoadSurfaces>(module, "Road")
      .def(py::init<std::filesystem::path>(), py::arg("file"))
      .def("set_borders", &RoadSurfaces::set_borders, py::arg("along"), py::arg("across"),
           py::arg("offset_along"), py::arg("offset_across"))
      .def("borders", &RoadSurfaces::borders)
      .def("arrays", &RoadSurfaces::arrays)
      .def("height", &RoadSurfaces::height, py::arg("u"), py::arg("v"))
      .def("smooth", &RoadSurfaces::smooth, py::arg("u"), py::arg("v"))
      .def("lines", &RoadSurfaces::lines);
}

}  // namespace rondo::python
