// SPDX-License-Identifier: GPL-3.0-or-later
//
// What has a CRS or a distance of its own is read as a file is, from one in memory where there is none.
#include "python/bindings/region.h"

#include <cpl_vsi.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "io/geo/crs/longitude_turns.h"
#include "io/query/extract/region_argument.h"
#include "terrain/model/plan_region.h"

namespace arete::python {
namespace {

/// A file in memory, removed with this. The text outlives it.
class TextFile {
 public:
  TextFile(const std::string& text, const char* extension) {
    static std::atomic<unsigned> number = 0;
    path_ = fmt::format("/vsimem/arete-region-{}.{}", ++number, extension);
    const auto* const bytes = reinterpret_cast<const GByte*>(text.data());
    VSIFCloseL(VSIFileFromMemBuffer(path_.c_str(), const_cast<GByte*>(bytes), text.size(), FALSE));
  }
  ~TextFile() { VSIUnlink(path_.c_str()); }
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// An error or warning about a file that the caller never saw is about the region.
void nameRegion(std::string& text, const std::string& path) {
  const std::size_t begin = path.rfind('/') + 1;
  const std::string layer = fmt::format("the layer '{}'", path.substr(begin, path.rfind('.') - begin));
  for (const std::string& name : {layer, path})
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name))
      text.replace(at, name.size(), "the region");
}

Result<RegionArgument> readText(const RegionOfText& asked, const Georeference& dem,
                                const LongitudeTurns& turns, const RunContext& context) {
  const auto& [text, content, crs, distance] = asked;
  if (content.empty()) return readRegionArgument({text, distance, crs}, dem, turns, context);
  // A table of WKT, which has no CRS of its own.
  const TextFile file(content, "csv");
  Result<RegionArgument> read = readRegionArgument({file.path(), distance, crs}, dem, turns, context);
  if (!read) {
    Error error = read.error();
    nameRegion(error.message, file.path());
    error.culprit = "region";
    if (error.code != ErrorCode::interrupted && error.code != ErrorCode::outOfMemory)
      error.code = ErrorCode::usage;
    return tl::unexpected(std::move(error));
  }
  for (Warning& warning : read->warnings) nameRegion(warning.sentence, file.path());
  return read;
}

Result<RegionArgument> argumentOf(const AskedRegion& asked, const Georeference& dem,
                                  const LongitudeTurns& turns, const RunContext& context) {
  if (const auto* const text = std::get_if<RegionOfText>(&asked)) return readText(*text, dem, turns, context);
  StatedRegion stated;
  if (const auto* const box = std::get_if<RegionBox>(&asked)) {
    stated.box = *box;
  } else {
    for (const auto& polygon : std::get<RegionPolygons>(asked)) {
      auto& rings = stated.polygons.emplace_back();
      for (const auto& ring : polygon) {
        auto& points = rings.emplace_back();
        for (const auto& [x, y] : ring) points.push_back({x, y});
      }
    }
  }
  return regionArgumentOf(stated, dem, turns);
}

template <class Heightfield>
Result<std::vector<std::uint8_t>> samplesInField(const AskedRegion& asked, const Heightfield& field,
                                                 Warnings& warnings, const RunContext& context) {
  ARETE_TRY(RegionArgument argument, argumentOf(asked, field.georeference, LongitudeTurns(field), context));
  warnings = std::move(argument.warnings);
  std::vector<std::uint8_t> mask = samplesInside(planRegion(std::move(argument.shape), field), field);
  bool holdsAny = false;
  for (std::size_t i = 0; i < mask.size() && !holdsAny; ++i)
    holdsAny = mask[i] != 0 && !std::isnan(field.heights[i]);
  if (!holdsAny) return failure(ErrorCode::usage, "holds no sample", "region");
  return mask;
}

}  // namespace

Result<Region> planRegionOf(const AskedRegion& asked, const TerrainModel& model, Warnings& warnings,
                            const RunContext& context) {
  ARETE_TRY(RegionArgument argument, argumentOf(asked, model.georeference, LongitudeTurns(model), context));
  warnings = std::move(argument.warnings);
  Region region = planRegion(std::move(argument.shape), model);
  if (region.isEmpty() || !meetsDomain(region, model.mt))
    return failure(ErrorCode::usage, "does not meet the terrain", "region");
  return region;
}

Result<std::vector<std::uint8_t>> samplesIn(const AskedRegion& asked, const RasterHeightfield& field,
                                            Warnings& warnings, const RunContext& context) {
  return samplesInField(asked, field, warnings, context);
}

Result<std::vector<std::uint8_t>> samplesIn(const AskedRegion& asked, const PointHeightfield& field,
                                            Warnings& warnings, const RunContext& context) {
  return samplesInField(asked, field, warnings, context);
}

void stateRegion(const AskedRegion& asked, CutRequest& request) {
  if (const auto* const text = std::get_if<RegionOfText>(&asked)) {
    const auto& [name, content, crs, distance] = *text;
    request.region = content.empty() ? name : content;
    request.regionCrs = crs;
    request.distance = distance;
  } else if (const auto* const box = std::get_if<RegionBox>(&asked)) {
    request.region = fmt::format("{}", fmt::join(*box, ","));
  } else {
    request.region = fmt::format("{} polygons", std::get<RegionPolygons>(asked).size());
  }
}

}  // namespace arete::python
