// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/bindings/surface.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <variant>

#include "io/query/extract/extract.h"
#include "io/query/parts/lasting_file.h"
#include "io/query/parts/open_surface.h"
#include "io/query/surface/build_model.h"
#include "io/query/surface/extractor.h"
#include "io/query/surface/region.h"
#include "io/query/surface/write_model.h"
#include "measure/mesh_distance.h"
#include "python/bindings/arrays.h"
#include "python/bindings/calls.h"
#include "python/bindings/export_files.h"
#include "python/bindings/questions.h"
#include "python/bindings/terrain.h"
#include "python/bindings/tin.h"
#include "surface/front/front.h"
#include "surface/region/boxes_region.h"
#include "surface/region/closed_mesh_region.h"

namespace arete::python {
namespace {

namespace py = pybind11;
using SurfacePtr = std::shared_ptr<OpenSurface>;
using AnyModel = std::variant<std::shared_ptr<Terrain>, SurfacePtr>;

/// A region of space that Python keeps.
struct RegionOfSpace {
  std::shared_ptr<const SpaceRegion> region;
};

SurfacePtr buildOf(MeshInput input, const std::string& source, const SurfaceFileOptions& options,
                   const py::object& progress) {
  const bool isArgument = source == "arrays";
  BuiltSurface built = callOn(isArgument, progress, [&](const RunContext& context) {
    return buildSurfaceModel(std::move(input), source, options, context);
  });
  warn(built.warnings);
  return std::make_shared<OpenSurface>(std::move(built.model));
}

SurfacePtr buildFile(const std::string& path, const SurfaceFileOptions& options, const py::object& progress) {
  MeshInput input = call(progress, [&](const RunContext& context) -> Result<MeshInput> {
    Result<MeshInput> read = readMeshInput(path, context);
    if (read && read->file.mesh.triangles.empty())
      return failure(ErrorCode::invalidData, "has no faces, which a surface needs", path);
    if (read) ARETE_CHECK(warnOfGaps(*read, context));
    return read;
  });
  warn(input.file.warnings);
  return buildOf(std::move(input), path, options, progress);
}

SurfacePtr buildArrays(const Doubles& vertices, const Indices& triangles, const SurfaceFileOptions& options,
                       const py::object& progress) {
  MeshInput input;
  input.file.mesh = SurfaceMesh(meshOf(vertices, triangles));
  input.fileVertices = input.file.mesh.positions.size();
  input.fileFaces = input.file.mesh.triangles.size();
  return buildOf(std::move(input), "arrays", options, progress);
}

CutTin takeSurfaceTin(const OpenSurface& surface, CutRequest request,
                      const std::optional<RegionOfSpace>& region, const std::optional<SurfaceCamera>& camera,
                      const py::object& progress) {
  if (region) request.spaceRegion = region->region;
  request.spaceCamera = camera;
  Tin tin = call(progress, [&](const RunContext& context) -> Result<Tin> {
    ExtractRequest needed;
    needed.criterion = request;
    ARETE_TRY(const auto model, surface.forRequest(needed, context));
    return cut(*model, request, context);
  });
  constexpr std::string_view kBits = "positionBits";
  for (Warning& warning : tin.warnings)
    if (const std::size_t at = warning.sentence.find(kBits); at != std::string::npos)
      warning.sentence.replace(at, kBits.size(), "position_bits");
  warn(tin.warnings);
  return CutTin(std::move(tin));
}

/// Cuts, writes and measures as `arete extract` does. Returns its report as JSON.
std::string extractSurfaceTo(const OpenSurface& surface, CutRequest asked,
                             const std::optional<RegionOfSpace>& region, const std::string& regionText,
                             const std::optional<SurfaceCamera>& camera, const ExportFiles& files,
                             const py::object& progress) {
  if (region) asked.spaceRegion = region->region;
  asked.region = regionText;
  asked.spaceCamera = camera;
  return call(progress, [&](const RunContext& context) -> Result<std::string> {
    ExtractRequest request;
    request.criterion = asked;
    request.output = files.output;
    request.certificate = files.certificate;
    request.map = files.map;
    request.dropAttributes = files.dropAttributes;
    request.measuresBothWays = files.measuresBothWays;
    request.packedBits = files.packedBits;
    request.normals = files.normals;
    ARETE_TRY(const auto model, surface.forRequest(request, context));
    SurfaceExtractor extractor(
        *model, files.model,
        [&](const ExtractRequest&, double promised, std::uint64_t) { return files.check(promised); },
        [&]() -> Result<SurfaceModel> {
          ARETE_TRY(const auto all, surface.whole(context));
          return *all;
        });
    ARETE_TRY(ExtractedSurface extracted, extractor.extract(request, context));
    return toJson(request, ExtractReport(std::move(extracted))).dump();
  });
}

py::dict oneWay(const DistanceOneWay& way) {
  py::dict found;
  found["max_distance"] = way.maximum;
  found["at_most"] = way.atMost;
  found["mean"] = way.mean;
  found["rms"] = way.rms;
  return found;
}

/// From the source to the mesh, from the mesh to the source, and both together; each with how far rounding
/// may have moved the source.
py::dict measureSurfaceMesh(const OpenSurface& surface, const Doubles& vertices, const Indices& triangles,
                            std::uint64_t samples, std::uint64_t seed, const py::object& progress) {
  const MeshDistanceReport report =
      callOn(true, progress, [&](const RunContext& context) -> Result<MeshDistanceReport> {
        ARETE_TRY(const auto model, surface.whole(context));
        const SurfaceFront source = finestSurfaceOf(*model);
        auto measured = measureDistance(source.mesh.shape(), meshOf(vertices, triangles),
                                        {.samples = samples, .seed = seed}, context);
        // "second" is its name there.
        if (!measured && measured.error().culprit == "second")
          return failure(measured.error().code, measured.error().message, "mesh");
        if (measured) measured->raise(model->positionError);
        return measured;
      });
  py::dict found;
  found["position_error"] = surface.outline().positionError;
  found["max_distance"] = report.hausdorff();
  found["at_most"] = report.hausdorffAtMost();
  found["mean"] = report.mean();
  found["rms"] = report.rms();
  found["from_source"] = oneWay(report.forward);
  found["from_mesh"] = oneWay(report.backward);
  return found;
}

/// The least and the largest coordinates of the vertices.
std::array<Vec3, 2> boxOfSource(const SurfaceModel& model) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Vec3 low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};
  for (const Vec3& p : finestSurfaceOf(model).mesh.positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return {low, high};
}

void defineRegion(py::module_& module) {
  py::class_<RegionOfSpace>(module, "RegionOfSpace");
  const auto regionOrRaise = [](const auto& region) {
    if (!region) raise(region.error());
    return RegionOfSpace{*region};
  };
  module.def("region_of_numbers",
             [=](const std::vector<double>& numbers) { return regionOrRaise(regionOfNumbers(numbers)); });
  module.def("region_of_file", [](const std::string& path, const py::object& progress) {
    return RegionOfSpace{
        call(progress, [&](const RunContext& context) { return readRegionMesh(path, context); })};
  });
  module.def("region_of_boxes", [](const Doubles& boxes) {
    std::vector<std::array<Vec3, 2>> all;
    for (py::ssize_t i = 0; i < boxes.shape(0); ++i) {
      const double* const b = boxes.data() + 6 * i;
      all.push_back({Vec3{b[0], b[1], b[2]}, Vec3{b[3], b[4], b[5]}});
    }
    return RegionOfSpace{std::make_shared<BoxesRegion>(std::move(all))};
  });
  module.def("region_of_mesh", [=](const Doubles& vertices, const Indices& triangles) {
    return RegionOfSpace{callOn(true, py::none(), [&](const RunContext&) {
      return ClosedMeshRegion::create(meshOf(vertices, triangles));
    })};
  });
}

void defineModel(py::module_& module) {
  py::class_<SurfaceCamera>(module, "SurfaceCameraNumbers")
      .def(py::init([](const std::array<double, 3>& eye, const std::array<double, 3>& target,
                       double fieldOfView, const std::array<double, 2>& size) {
        return SurfaceCamera{
            {eye[0], eye[1], eye[2]}, {target[0], target[1], target[2]}, fieldOfView, size[0], size[1]};
      }));
  py::class_<OpenSurface, SurfacePtr> surface(module, "Surface");
  defineQuestions(surface);
  surface.def("cut", &takeSurfaceTin)
      .def("extract", &extractSurfaceTo)
      .def("measure", &measureSurfaceMesh)
      .def("save",
           [](const OpenSurface& of, const std::string& path, bool isPacked, bool isPaged, int positionBits,
              const py::object& progress) {
             call(progress, [&](const RunContext& context) -> Status {
               const auto model = of.whole(context);
               if (!model) return tl::unexpected(model.error());
               return writeSurfaceModel(
                   path, **model, context,
                   {.isPacked = isPacked, .isPaged = isPaged, .positionBits = positionBits});
             });
           })
      .def_property_readonly("box",
                             [](const OpenSurface& s) {
                               const auto model = call(
                                   py::none(), [&](const RunContext& context) { return s.whole(context); });
                               const auto box = boxOfSource(*model);
                               return std::array{box[0].x, box[0].y, box[0].z, box[1].x, box[1].y, box[1].z};
                             })
      .def_property_readonly("diagonal", [](const OpenSurface& s) { return s.outline().diagonal; })
      .def_property_readonly("crs_wkt", [](const OpenSurface& s) { return s.outline().crsWkt; })
      .def_property_readonly("source", [](const OpenSurface& s) { return s.outline().source; })
      .def_property_readonly("position_error", [](const OpenSurface& s) { return s.outline().positionError; })
      .def_property_readonly("is_displaced",
                             [](const OpenSurface& s) { return !s.outline().displacement.isEmpty(); })
      .def_property_readonly(
          "largest_error",
          [](const OpenSurface& s) {
            return call(py::none(), [&](const RunContext& context) { return s.largestError(context); });
          })
      .def_property_readonly("vertex_count", &OpenSurface::vertexCount)
      .def_property_readonly("finest_triangle_count", &OpenSurface::finestTriangleCount);
}

SurfaceFileOptions optionsOf(bool isDisplaced, bool keepsBorders, std::optional<double> ratio,
                             std::optional<std::uint32_t> maxDegree, std::optional<double> creaseAngle,
                             std::vector<std::string> dropAttributes = {}, bool boundsAttributes = false) {
  SurfaceBuildOptions build{.keepsBorders = keepsBorders};
  build.boundsAttributes = boundsAttributes;
  build.creaseAngleDegrees = creaseAngle;
  build.thresholdRatio = ratio.value_or(build.thresholdRatio);
  build.maxDegree = maxDegree.value_or(build.maxDegree);
  return {.build = build, .isDisplaced = isDisplaced, .dropAttributes = std::move(dropAttributes)};
}

}  // namespace

void defineSurface(py::module_& module) {
  defineRegion(module);
  defineModel(module);
  module.def("build_surface_file", [](const std::string& path, bool isDisplaced, bool keepsBorders,
                                      std::optional<double> ratio, std::optional<std::uint32_t> maxDegree,
                                      std::optional<double> creaseAngle,
                                      const std::vector<std::string>& dropAttributes, bool boundsAttributes,
                                      const py::object& progress) {
    return buildFile(
        path,
        optionsOf(isDisplaced, keepsBorders, ratio, maxDegree, creaseAngle, dropAttributes, boundsAttributes),
        progress);
  });
  module.def("build_surface_arrays", [](const Doubles& vertices, const Indices& triangles, bool isDisplaced,
                                        bool keepsBorders, std::optional<double> ratio,
                                        std::optional<std::uint32_t> maxDegree,
                                        std::optional<double> creaseAngle, const py::object& progress) {
    return buildArrays(vertices, triangles,
                       optionsOf(isDisplaced, keepsBorders, ratio, maxDegree, creaseAngle), progress);
  });
  module.def("open_model", [](const std::string& path, const py::object& progress) -> AnyModel {
    return call(progress, [&](const RunContext& context) -> Result<AnyModel> {
      ARETE_TRY(LastingFile file, LastingFile::open(path, context));
      ARETE_TRY(const AmtContainer container, file.current(context));
      if (container.isOfSurface()) {
        ARETE_TRY(auto surface, OpenSurface::open(std::move(file), context));
        return AnyModel(std::move(surface));
      }
      ARETE_TRY(auto terrain, OpenTerrain::open(std::move(file), context));
      return AnyModel(std::move(terrain));
    });
  });
}

}  // namespace arete::python
