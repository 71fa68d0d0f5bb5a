// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/gdal/vector_file.h"

#include <fmt/format.h>

#include "io/geo/gdal/file_length.h"
#include "io/geo/gdal/whole_text.h"
#include "io/geo/network/network_reading.h"

namespace arete {

Result<GdalDatasetPtr> openVectors(const std::string& path, std::string_view kind, GdalErrors& errors,
                                   Warnings& warnings, const std::vector<std::string>& options) {
  const NetworkReading network(nullptr);  // so that a file of the network is requested once
  if (auto problem = findInputProblem(path)) return tl::unexpected(*problem);
  ARETE_CHECK(checkLengthByContent(path));
  GdalDatasetPtr dataset = openGdal(path, GDAL_OF_VECTOR, options);
  if (!dataset) return tl::unexpected(explainOpenFailure(path, kind, errors));
  if (const std::string said = errors.firstFileFailure(); !said.empty())
    return failure(ErrorCode::corrupt, fmt::format("is cut short or damaged: {}", said));
  GDALDriver* driver = dataset->GetDriver();
  // Its records are parsed when it is opened; one that cannot be is left out.
  if (driver && EQUAL(driver->GetDescription(), "GeoJSONSeq") && errors.anyFailure()) {
    Status whole = checkWholeText(path, driver->GetDescription(), warnings);
    return failure(ErrorCode::corrupt, whole ? fmt::format("has a damaged record: {}", errors.firstFailure())
                                             : whole.error().message);
  }
  if (driver) ARETE_CHECK(checkWholeText(path, driver->GetDescription(), warnings));
  errors.moveTo(warnings);
  return dataset;
}

Status checkFeatureCount(GDALDataset& dataset, OGRLayer& layer, std::uint64_t read) {
  if (!dataset.GetDriver() || !EQUAL(dataset.GetDriver()->GetDescription(), "FlatGeobuf")) return {};
  const GdalErrors quiet;
  const GIntBig stated = layer.GetFeatureCount(false);
  if (stated < 0 || read >= std::uint64_t(stated)) return {};
  return failure(ErrorCode::corrupt,
                 fmt::format("is cut short: its header states {} features and {} are there", stated, read));
}

}  // namespace arete
