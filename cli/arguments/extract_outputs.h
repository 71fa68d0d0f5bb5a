// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "io/files/existing_file.h"
#include "io/geo/bent/target.h"
#include "io/query/request/extract_request.h"

namespace arete {

/// What `arete extract` is to write. In every name {} stands for what is asked for (outputName()).
struct ExtractOutputs {
  std::string output = {};                      ///< as MeshOutput::open() gives it
  std::string format = {};                      ///< MeshOutput::format
  bool isStdout = false;                        ///< the mesh goes to stdout
  std::optional<std::string> certificate = {};  ///< --certificate; empty: beside the output
  std::optional<int> packedBits = {};           ///< MeshOutput::packedBits()
  bool flipsV = false;                          ///< --flip-v
  bool areLevels = false;                       ///< --levels: all go into one file
  std::string errorRaster = {};                 ///< --error-raster; empty: none
  std::string map = {};                         ///< --map; empty: none
  PlaceTarget place = {};                       ///< --to-crs, --metric
  ExistingFile existing = ExistingFile::keepsOtherLayers;

  /// Checks what does not depend on a model. Errors: usage.
  /// @param several there is more than one request.
  Status check(bool several) const;
  Status checkLevels(bool several) const;
  /// The files of one request.
  /// @param tag what stands for the request in a name: "5", "1%_20000".
  ExtractRequest requestOf(const CutRequest& criterion, const std::string& tag, bool several) const;
};

/// Checks all outputs of some requests: each can be written, and none is an input or another's. Errors name
/// the option.
Status checkOutputsOf(const std::vector<ExtractRequest>& requests, const std::vector<std::string>& inputs);

}  // namespace arete
