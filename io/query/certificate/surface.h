// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"
#include "engine/parallel/run_context.h"
#include "io/formats/common/file.h"
#include "io/query/request/cut_request.h"
#include "measure/mesh_distance.h"
#include "surface/model/surface_model.h"

namespace arete {

/// How far a mesh and the source of a surface are from each other. Everything is raised by how far rounding
/// has moved the source (SurfaceModel::positionError).
struct SurfaceMeasure {
  MeshDistanceReport distances;  ///< the mesh is its first, the source its second
  /// Vertices of the source, each held against the error that is asked for where it lies: in a region, or at
  /// its distance from a focus.
  struct Places {
    std::uint64_t vertices = 0;  ///< of the source, with a limited error
    std::uint64_t beyond = 0;    ///< farther from the mesh than that
    double largestShare = 0;     ///< of a vertex's distance in what is allowed
  };
  std::optional<Places> places = {};  ///< with a region or a focus, of a cut that is complete
};

/// Measures by code that shares nothing with the build (measure/mesh_distance.h).
/// @param source      the finest front of the model, without what is left out
/// @param samples     on each mesh: certificateSamples()
/// @param isComplete  whether the cut met the criterion everywhere
/// Errors: as measureDistance().
Result<SurfaceMeasure> measureSurface(const TriangleMesh& source, const TriangleMesh& mesh,
                                      const SurfaceModel& model, const CutRequest& request, bool isComplete,
                                      std::uint64_t samples, const RunContext& context = {});
/// How many samples measure two meshes: ten for each triangle of the larger one, at least 100 000.
std::uint64_t certificateSamples(const TriangleMesh& source, const TriangleMesh& mesh);

/// Whether no point of the source was found farther from the mesh than promised, and no vertex farther than
/// is allowed at its place.
bool keepsPromise(const SurfaceMeasure& measured, double promisedError);

/// What the export of a surface promises, and how a third party can check it.
struct SurfaceCertificate {
  std::string file;
  std::string writtenAt;  ///< where its bytes are until it has its name; no regular file: no checksum
  std::string model;      ///< the .amt it was taken from
  std::string formatName;
  MeshFrame frame;
  MeshFormatTraits holds;
  CutRequest criterion;
  bool isComplete = true;
  std::uint64_t triangles = 0, vertices = 0;
  double storedError = 0;    ///< of the cut: the largest error of its triangles, as stored
  double promisedError = 0;  ///< no point of the source (but what is left out) is farther than this
  struct Fit {
    double rmsBefore = 0, rmsAfter = 0, errorBefore = 0, part = 1;
  };
  std::optional<Fit> fit = {};
  std::uint64_t droppedComponents = 0, droppedFaces = 0;
  SurfaceMeasure measured;
  bool isKept = false;  ///< the measurement agrees
  std::string checkCommand;
};

/// The certificate as JSON, as docs/topics/certificate.md states it. O(bytes of the file and of the model's),
/// whose checksums it has.
std::string certificateJson(const SurfaceCertificate& certificate, const SurfaceModel& model);

/// Writes the certificate as JSON. The file appears whole or not at all. Errors: as FileWriter.
Status writeCertificate(const std::string& path, const SurfaceCertificate& certificate,
                        const SurfaceModel& model);

}  // namespace arete
