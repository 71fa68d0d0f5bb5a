// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/bindings/surface.h"

#include <pybind11/stl.h>

#include <memory>
#include <optional>

#include "engine/base/float_bounds.h"
#include "engine/criteria/criterion.h"
#include "engine/criteria/refine_order.h"
#include "engine/cut/cut.h"
#include "io/amt/surface_file.h"
#include "python/bindings/calls.h"
#include "python/bindings/tin.h"
#include "surface/displacement/displaced_places.h"

namespace arete::python {
namespace {

namespace py = pybind11;
using SurfacePtr = std::shared_ptr<SurfaceModel>;

Tin takeTin(const SurfaceModel& model, std::optional<double> maxError,
            std::optional<std::uint32_t> maxTriangles, bool isDisplaced, const py::object& progress) {
  return call(progress, [&](const RunContext& context) -> Result<Tin> {
    CutOptions options;
    options.maxTriangles = maxTriangles;
    if (maxTriangles) options.order = std::make_shared<LargestSquaresFirst>();
    const Result<Cut> cut = takeCut(model.mt, UniformError(maxError.value_or(0)), options, context);
    if (!cut) return tl::unexpected(cut.error());
    Tin tin;
    if (isDisplaced && !model.displacement.isEmpty()) {
      const std::vector<double> promised = promisedErrors(model.mt, *cut, nullptr);
      tin.vertices = displacedPlaces(model.mt, model.displacement, *cut, promised);
      for (const double error : promised) tin.errors.push_back(floatAtLeast(error));
    } else {
      for (const std::uint32_t v : cut->vertices) tin.vertices.push_back(model.mt.position(VertexId(v)));
      for (const std::uint32_t t : cut->ids)
        tin.errors.push_back(static_cast<float>(model.mt.error(TriangleId(t))));
    }
    tin.triangles = cut->triangles;
    tin.error = cut->achievedError;
    tin.isComplete = cut->isComplete;
    tin.crsWkt = model.crsWkt;
    return tin;
  });
}

}  // namespace

void defineSurface(py::module_& module) {
  py::class_<SurfaceModel, SurfacePtr>(module, "Surface")
      .def("cut", &takeTin)
      .def_property_readonly("diagonal", [](const SurfaceModel& m) { return m.diagonal; })
      .def_property_readonly("crs_wkt", [](const SurfaceModel& m) { return m.crsWkt; })
      .def_property_readonly("source", [](const SurfaceModel& m) { return m.source; })
      .def_property_readonly("is_displaced", [](const SurfaceModel& m) { return !m.displacement.isEmpty(); })
      .def_property_readonly("largest_error", [](const SurfaceModel& m) { return m.mt.largestError(); })
      .def_property_readonly("vertex_count", [](const SurfaceModel& m) { return m.mt.vertexCount(); })
      .def_property_readonly("finest_triangle_count",
                             [](const SurfaceModel& m) { return m.mt.finestTriangleCount(); });
  module.def("is_surface", [](const std::string& path) {
    const Result<bool> is = isSurfaceAmt(path);
    if (!is) raise(is.error());
    return *is;
  });
  module.def("open_surface", [](const std::string& path, const py::object& progress) {
    return std::make_shared<SurfaceModel>(call(
        progress, [&](const RunContext& context) { return loadSurfaceAmt(path, AmtVerify::all, context); }));
  });
}

}  // namespace arete::python
