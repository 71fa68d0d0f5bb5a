// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "engine/base/result.h"
#include "io/formats/common/file.h"
#include "io/formats/exchange/placed_mesh.h"
#include "io/query/request/cut_request.h"

namespace arete {

// What the certificates of terrain and of surfaces share.

constexpr int kCertificateVersion = 1;  ///< of the schema

/// "Arete 0.1.0".
std::string programName();

/// JSON has no infinity: null stands for an error without a limit.
nlohmann::ordered_json limitJson(double value);

/// What was asked for.
nlohmann::ordered_json toJson(const CutRequest& request);

/// What became of a mesh on its way into another CRS or into metres.
nlohmann::ordered_json placedJson(const PlacedFigures& placed);

/// What a file holds, and what its format cannot hold.
struct StatedFormat {
  std::string name;
  MeshFrame frame = {};
  double heightRounding = 0, planTolerancePixels = 0;  ///< of terrain
  struct {
    bool crs = false, verticalUnit = false, errors = false;
  } says = {};
  std::string crsWkt, verticalUnit;  ///< of the source
};
nlohmann::ordered_json formatJson(const StatedFormat& format);

/// A certificate as the text of its file.
std::string certificateText(const nlohmann::ordered_json& certificate);

/// Errors: those of FileWriter.
Status writeCertificateText(const std::string& path, const std::string& text);

}  // namespace arete
