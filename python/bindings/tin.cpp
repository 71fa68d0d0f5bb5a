// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/bindings/tin.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <utility>

#include "python/bindings/arrays.h"

namespace arete::python {
namespace {

namespace py = pybind11;

/// A view of memory that `owner` keeps alive, read-only.
template <class Number>
py::array viewOf(const Number* data, std::vector<py::ssize_t> shape, const py::object& owner) {
  py::array view(py::dtype::of<Number>(), std::move(shape), data, owner);
  py::detail::array_proxy(view.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return view;
}

py::ssize_t sizeOf(const auto& array) {
  return static_cast<py::ssize_t>(array.size());
}

}  // namespace

void defineTin(py::module_& module) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  py::class_<Tin>(module, "Tin")
      .def(py::init([](const Doubles& vertices, const Indices& triangles,
                       const py::array_t<float, py::array::c_style>& errors, double error, bool isComplete,
                       std::optional<double> pixels, std::string crsWkt) {
        TriangleMesh mesh = meshOf(vertices, triangles);
        return Tin{std::move(mesh.positions),
                   std::move(mesh.triangles),
                   {errors.data(), errors.data() + errors.size()},
                   error,
                   isComplete,
                   pixels,
                   std::move(crsWkt)};
      }))
      .def_property_readonly("vertices",
                             [](const py::object& self) {
                               const auto& tin = self.cast<const Tin&>();
                               return viewOf(reinterpret_cast<const double*>(tin.vertices.data()),
                                             {sizeOf(tin.vertices), 3}, self);
                             })
      .def_property_readonly("triangles",
                             [](const py::object& self) {
                               const auto& tin = self.cast<const Tin&>();
                               return viewOf(reinterpret_cast<const std::uint32_t*>(tin.triangles.data()),
                                             {sizeOf(tin.triangles), 3}, self);
                             })
      .def_property_readonly("errors",
                             [](const py::object& self) {
                               const auto& tin = self.cast<const Tin&>();
                               return viewOf(tin.errors.data(), {sizeOf(tin.errors)}, self);
                             })
      .def_readonly("error", &Tin::error)
      .def_readonly("is_complete", &Tin::isComplete)
      .def_readonly("pixels", &Tin::pixels)
      .def_readonly("crs_wkt", &Tin::crsWkt);
}

}  // namespace arete::python
