// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/bindings/tin.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "engine/base/float_bounds.h"
#include "io/formats/exchange/mesh_formats.h"
#include "python/bindings/arrays.h"
#include "python/bindings/calls.h"
#include "python/bindings/export_files.h"
#include "surface/attributes/attribute_names.h"

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

CutTin::CutTin(Tin taken) : tin(std::move(taken)), errors(tin.errors) {
  if (errors.empty()) errors.assign(tin.mesh.triangles.size(), floatAtLeast(tin.error));
}

namespace {

py::dtype numbersOf(ScalarType type) {
  switch (type) {
    case ScalarType::int8:
      return py::dtype::of<std::int8_t>();
    case ScalarType::uint8:
      return py::dtype::of<std::uint8_t>();
    case ScalarType::int16:
      return py::dtype::of<std::int16_t>();
    case ScalarType::uint16:
      return py::dtype::of<std::uint16_t>();
    case ScalarType::int32:
      return py::dtype::of<std::int32_t>();
    case ScalarType::uint32:
      return py::dtype::of<std::uint32_t>();
    case ScalarType::float32:
      return py::dtype::of<float>();
    case ScalarType::float64:
      break;
  }
  return py::dtype::of<double>();
}

/// By the names that options have: elements by components, as views.
py::dict attributesOf(const std::vector<Attribute>& attributes, const py::object& owner) {
  py::dict all;
  for (const Attribute& a : attributes) {
    py::array view(numbersOf(a.type), std::vector<py::ssize_t>{py::ssize_t(a.elementCount()), a.components},
                   a.values.data(), owner);
    py::detail::array_proxy(view.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    all[py::str(optionNameOf(a.name))] = view;
  }
  return all;
}

void defineRequest(py::module_& module) {
  py::class_<CutRequest>(module, "CutRequest")
      .def(py::init<>())
      .def_readwrite("max_error", &CutRequest::maxError)
      .def_readwrite("max_triangles", &CutRequest::maxTriangles)
      .def_readwrite("outside_error", &CutRequest::outsideError)
      .def_readwrite("pixel_error", &CutRequest::pixelError)
      .def_readwrite("deadline", &CutRequest::deadlineMilliseconds)
      .def_readwrite("displaced", &CutRequest::isDisplaced)
      .def_readwrite("drop_parts", &CutRequest::dropParts)
      .def_readwrite("importance", &CutRequest::importance)
      .def("set_attribute_errors",
           [](CutRequest& request, const std::string& list) {
             auto numbers = parseAttributeNumbers(list);
             if (!numbers) raise(numbers.error());
             request.attributeErrors = std::move(*numbers);
           })
      .def("set_focus",
           [](CutRequest& request, double x, double y, std::optional<double> z, double growth) {
             request.focus = {.xy = {x, y}, .growth = growth, .z = z};
           })
      .def("set_method",
           [](CutRequest& request, const std::string& name) {
             request.method = name == "saturated" ? CutMethod::saturated : CutMethod::minimal;
           })
      .def("set_order",
           [](CutRequest& request, const std::string& name) {
             for (const CutOrder order :
                  {CutOrder::worst, CutOrder::breadth, CutOrder::depth, CutOrder::twoQueues})
               if (orderName(order) == name) request.order = order;
           })
      .def("set_fit", [](CutRequest& request, const std::string& name) {
        for (const CutFit fit : {CutFit::triangles, CutFit::error, CutFit::unbiased, CutFit::rms})
          if (fitName(fit) == name) request.fit = fit;
      });
}

/// @param file vertical unit, its metres, the origin (three numbers or none), which axis is up, and a note.
using FileParts = std::tuple<std::string, double, std::optional<std::array<double, 3>>, int, std::string>;

FileParts filePartsOf(const Tin& tin) {
  std::optional<std::array<double, 3>> origin;
  if (tin.origin) origin = {tin.origin->x, tin.origin->y, tin.origin->z};
  return {tin.verticalUnit, tin.verticalUnitMetres, origin, static_cast<int>(tin.up), tin.note};
}

/// What a file does not hold, in the words of a conversion.
std::vector<std::string> lostOf(const CutTin& tin, const std::string& path, std::vector<std::string> lost) {
  const Result<MeshFormat> format = meshFormatOf(path);
  if (!format) return lost;
  const auto lose = [&](bool isHeld, bool isThere, const char* what) {
    if (!isHeld && isThere) lost.emplace_back(what);
  };
  lose(format->holds.holdsCrs, !tin.tin.crsWkt.empty(), "the CRS");
  lose(format->holds.holdsVerticalUnit, !tin.tin.verticalUnit.empty(), "the unit of the heights");
  lose(format->holds.holdsErrors, !tin.tin.errors.empty() && tin.tin.vertexOf.empty(),
       "the error of each triangle");
  return lost;
}

void defineExportFiles(py::module_& module) {
  py::class_<ExportFiles>(module, "ExportFiles")
      .def(py::init<>())
      .def_readwrite("output", &ExportFiles::output)
      .def_readwrite("certificate", &ExportFiles::certificate)
      .def_readwrite("error_raster", &ExportFiles::errorRaster)
      .def_readwrite("map", &ExportFiles::map)
      .def_property(
          "to_crs", [](const ExportFiles& files) { return files.place.crs; },
          [](ExportFiles& files, const std::string& crs) { files.place.crs = crs; })
      .def_property(
          "metric", [](const ExportFiles& files) { return files.place.isMetric; },
          [](ExportFiles& files, bool isMetric) { files.place.isMetric = isMetric; })
      .def_readwrite("model", &ExportFiles::model)
      .def_readwrite("check_before", &ExportFiles::checkBefore)
      .def_readwrite("check_behind", &ExportFiles::checkBehind)
      .def_readwrite("drop_attributes", &ExportFiles::dropAttributes)
      .def_readwrite("both_ways", &ExportFiles::measuresBothWays)
      .def_readwrite("packed_bits", &ExportFiles::packedBits)
      .def("set_normals", [](ExportFiles& files, const std::string& kind, double creaseAngleDegrees) {
        files.normals.kind = kind == "flat"     ? NormalsKind::flat
                             : kind == "smooth" ? NormalsKind::smooth
                                                : NormalsKind::keep;
        files.normals.creaseAngleDegrees = creaseAngleDegrees;
      });
}

}  // namespace

void defineTin(py::module_& module) {
  defineExportFiles(module);
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  defineRequest(module);
  py::class_<CutTin>(module, "Tin")
      .def(py::init([](const Doubles& vertices, const Indices& triangles,
                       const py::array_t<float, py::array::c_style>& errors, double error, bool isComplete,
                       std::optional<double> pixels, std::string crsWkt, const FileParts& file,
                       const Indices& vertexOf) {
        Tin tin;
        tin.mesh = SurfaceMesh(meshOf(vertices, triangles));
        tin.errors.assign(errors.data(), errors.data() + errors.size());
        tin.error = error;
        tin.isComplete = isComplete;
        tin.pixels = pixels;
        tin.crsWkt = std::move(crsWkt);
        std::optional<std::array<double, 3>> origin;
        int up = 0;
        std::tie(tin.verticalUnit, tin.verticalUnitMetres, origin, up, tin.note) = file;
        if (origin) tin.origin = Vec3{(*origin)[0], (*origin)[1], (*origin)[2]};
        tin.up = static_cast<MeshUp>(up);
        tin.vertexOf.assign(vertexOf.data(), vertexOf.data() + vertexOf.size());
        return CutTin(std::move(tin));
      }))
      .def("save",
           [](const CutTin& self, const std::string& path, const std::string& toCrs, bool isMetric,
              const py::object& progress) {
             // A name without a known ending is a wrong argument.
             if (const Result<MeshFormat> format = meshFormatOf(path); !format)
               raise({ErrorCode::usage, format.error().message, path});
             const PlaceTarget place{.crs = toCrs, .isMetric = isMetric};
             const MeshWriteReport report = call(
                 progress, [&](const RunContext& context) { return write(self.tin, path, place, context); });
             return lostOf(self, path, report.lost);
           })
      .def("save_as",
           [](const CutTin& self, const ExportFiles& files, const py::object& progress) {
             if (const Result<MeshFormat> format = meshFormatOf(files.output); !format)
               raise({ErrorCode::usage, format.error().message, files.output});
             const MeshWriteReport report =
                 call(progress, [&](const RunContext& context) -> Result<MeshWriteReport> {
                   Tin made = self.tin;
                   ARETE_CHECK(makeNormals(made.mesh, files.normals));
                   if (!files.packedBits) return write(made, files.output, context);
                   return write(made, files.output, MeshPacking{.positionBits = *files.packedBits}, context);
                 });
             return lostOf(self, files.output, report.lost);
           })
      .def_property_readonly(
          "vertices",
          [](const py::object& self) {
            const auto& positions = self.cast<const CutTin&>().tin.mesh.positions;
            return viewOf(reinterpret_cast<const double*>(positions.data()), {sizeOf(positions), 3}, self);
          })
      .def_property_readonly("triangles",
                             [](const py::object& self) {
                               const auto& triangles = self.cast<const CutTin&>().tin.mesh.triangles;
                               return viewOf(reinterpret_cast<const std::uint32_t*>(triangles.data()),
                                             {sizeOf(triangles), 3}, self);
                             })
      .def_property_readonly(
          "wedges",
          [](const py::object& self) {
            const auto& wedges = self.cast<const CutTin&>().tin.mesh.wedges;
            return viewOf(reinterpret_cast<const std::uint32_t*>(wedges.data()), {sizeOf(wedges), 3}, self);
          })
      .def_property_readonly("vertex_attributes",
                             [](const py::object& self) {
                               return attributesOf(self.cast<const CutTin&>().tin.mesh.vertexAttributes,
                                                   self);
                             })
      .def_property_readonly("wedge_attributes",
                             [](const py::object& self) {
                               return attributesOf(self.cast<const CutTin&>().tin.mesh.wedgeAttributes, self);
                             })
      .def_property_readonly("triangle_attributes",
                             [](const py::object& self) {
                               return attributesOf(self.cast<const CutTin&>().tin.mesh.triangleAttributes,
                                                   self);
                             })
      .def_property_readonly("source_vertices",
                             [](const py::object& self) {
                               const auto& numbers = self.cast<const CutTin&>().tin.vertexOf;
                               return viewOf(numbers.data(), {sizeOf(numbers)}, self);
                             })
      .def_property_readonly("errors",
                             [](const py::object& self) {
                               const auto& tin = self.cast<const CutTin&>();
                               return viewOf(tin.errors.data(), {sizeOf(tin.errors)}, self);
                             })
      .def_property_readonly("error", [](const CutTin& self) { return self.tin.error; })
      .def_property_readonly("attribute_errors",
                             [](const CutTin& self) {
                               py::dict errors;
                               for (const AttributeNumber& of : self.tin.attributeErrors)
                                 errors[py::str(of.name)] = of.number;
                               return errors;
                             })
      .def_property_readonly("is_complete", [](const CutTin& self) { return self.tin.isComplete; })
      .def_property_readonly("pixels", [](const CutTin& self) { return self.tin.pixels; })
      .def_property_readonly("crs_wkt", [](const CutTin& self) { return self.tin.crsWkt; })
      .def_property_readonly("file_parts", [](const CutTin& self) { return filePartsOf(self.tin); });
}

}  // namespace arete::python
