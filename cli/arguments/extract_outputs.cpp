// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/extract_outputs.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <utility>

#include "cli/arguments/arguments.h"
#include "io/files/text_scan.h"
#include "io/geo/dem/raster_writer.h"

namespace arete {
namespace {

std::string certificateBeside(const std::string& output) {
  return std::filesystem::path(output).replace_extension(".certificate.json").string();
}

/// A file that exists is replaced where it holds JSON: any other was meant as something else.
bool mayBeCertificate(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  char first = '{';
  file >> first;
  return first == '{';
}

}  // namespace

Status ExtractOutputs::check(bool several) const {
  if (areLevels) ARETE_CHECK(checkLevels(several));
  if (several && isStdout && !areLevels)
    return failure(ErrorCode::usage, "takes one tolerance", "--output -");
  if (certificate && certificate->empty() && isStdout)
    return failure(ErrorCode::usage, "needs a name if the mesh goes to stdout", "--certificate");
  if (packedBits && format.empty() && isGeoTiffName(output))
    return failure(ErrorCode::usage, "is for glTF (.glb, .gltf), not for a raster", "--packed");
  if (packedBits && !map.empty())
    return failure(
        ErrorCode::usage,
        "tells numbers of the file, whose order --packed makes anew: write the map of the same cut "
        "without --packed",
        fmt::format("--map {}", map));
  return {};
}

Status ExtractOutputs::checkLevels(bool several) const {
  const std::string extension = format.empty() ? text::lowerExtension(output) : format;
  if (extension != "glb" && extension != "gltf")
    return failure(ErrorCode::usage, "go into a glTF (.glb, .gltf), the format that has them", "--levels");
  if (!several)
    return failure(ErrorCode::usage, "are several: state a list of tolerances or of budgets", "--levels");
  if (certificate || !map.empty() || !errorRaster.empty())
    return failure(ErrorCode::usage, "tells of one mesh; write that without --levels",
                   certificate   ? "--certificate"
                   : map.empty() ? "--error-raster"
                                 : "--map");
  return {};
}

ExtractRequest ExtractOutputs::requestOf(const CutRequest& criterion, const std::string& tag,
                                         bool several) const {
  ExtractRequest request;
  request.criterion = criterion;
  request.existing = existing;
  request.place = place;
  request.output = areLevels ? output : outputName(output, tag, several);
  request.format = format;
  request.packedBits = packedBits;
  request.flipsV = flipsV;
  if (certificate)
    request.certificate =
        certificate->empty() ? certificateBeside(request.output) : outputName(*certificate, tag, several);
  if (!errorRaster.empty()) request.errorRaster = outputName(errorRaster, tag, several);
  if (!map.empty()) request.map = outputName(map, tag, several);
  return request;
}

Status checkOutputsOf(const std::vector<ExtractRequest>& requests, const std::vector<std::string>& inputs) {
  std::vector<std::string> outputs;
  for (const ExtractRequest& request : requests)
    for (const auto& [option, path] :
         {std::pair{"--output", &request.output}, std::pair{"--certificate", &request.certificate},
          std::pair{"--error-raster", &request.errorRaster}, std::pair{"--map", &request.map}}) {
      if (path->empty()) continue;
      ARETE_CHECK(checkOutput(option, *path, inputs, outputs));
      if (path == &request.certificate && !mayBeCertificate(*path))
        return failure(ErrorCode::usage, "exists and holds something other than a certificate",
                       fmt::format("--certificate {}", *path));
      outputs.push_back(*path);
    }
  return {};
}

}  // namespace arete
