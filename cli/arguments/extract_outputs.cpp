// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/extract_outputs.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <utility>

#include "cli/arguments/arguments.h"

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
  if (several && isStdout) return failure(ErrorCode::usage, "takes one tolerance", "--output -");
  if (certificate && certificate->empty() && isStdout)
    return failure(ErrorCode::usage, "needs a name if the mesh goes to stdout", "--certificate");
  return {};
}

ExtractRequest ExtractOutputs::requestOf(const CutRequest& criterion, const std::string& tag,
                                         bool several) const {
  ExtractRequest request;
  request.criterion = criterion;
  request.existing = existing;
  request.place = place;
  request.output = outputName(output, tag, several);
  request.format = format;
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
