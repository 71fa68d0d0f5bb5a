// SPDX-License-Identifier: GPL-3.0-or-later
#include "datasets/catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace arete {
namespace {

constexpr double kArcSecond = 1. / 3600;

constexpr PublicDem kGlo30 = {
    "copernicus-glo30",
    "Copernicus GLO-30: surface model of the Earth, 1 arc-second, float32, EGM2008 heights",
    "free for any use with attribution: (c) DLR 2010-2014, (c) Airbus Defence and Space 2014-2018, provided "
    "under "
    "Copernicus by the European Union and ESA",
    "https://registry.opendata.aws/copernicus-dem/",
    "https://copernicus-dem-30m.s3.amazonaws.com/Copernicus_DSM_COG_10_{N00}_00_{E000}_00_DEM/"
    "Copernicus_DSM_COG_10_{N00}_00_{E000}_00_DEM.tif",
    "/vsicurl/",
    kArcSecond,
    4,
    std::nullopt};

constexpr PublicDem kGlo90 = {
    "copernicus-glo90",
    "Copernicus GLO-90: surface model of the Earth, 3 arc-seconds, float32, EGM2008 heights",
    kGlo30.licence,
    kGlo30.page,
    "https://copernicus-dem-90m.s3.amazonaws.com/Copernicus_DSM_COG_30_{N00}_00_{E000}_00_DEM/"
    "Copernicus_DSM_COG_30_{N00}_00_{E000}_00_DEM.tif",
    "/vsicurl/",
    3 * kArcSecond,
    4,
    std::nullopt};

constexpr PublicDem k3dep10 = {
    "usgs-3dep-10m",
    "USGS 3DEP 1/3 arc-second: bare earth of the United States, float32, NAVD88 heights",
    "public domain; credit the U.S. Geological Survey",
    "https://www.usgs.gov/3d-elevation-program",
    "https://prd-tnm.s3.amazonaws.com/StagedProducts/Elevation/13/TIFF/USGS_Seamless_DEM_13.vrt",
    "/vsicurl/",
    kArcSecond / 3,
    4,
    std::nullopt};

constexpr PublicDem k3dep30 = {
    "usgs-3dep-30m",
    "USGS 3DEP 1 arc-second: bare earth of the United States, Canada and Mexico, float32, NAVD88 heights",
    k3dep10.licence,
    k3dep10.page,
    "https://prd-tnm.s3.amazonaws.com/StagedProducts/Elevation/1/TIFF/USGS_Seamless_DEM_1.vrt",
    "/vsicurl/",
    kArcSecond,
    4,
    std::nullopt};

constexpr PublicDem kSkadi = {"terrain-tiles-skadi",
                              "Mapzen Terrain Tiles, skadi: SRTM and its successors with voids filled, 1 "
                              "arc-second, integers, EGM96 heights",
                              "per source, most of it public domain; attribution: "
                              "https://github.com/tilezen/joerd/blob/master/docs/attribution.md",
                              "https://registry.opendata.aws/terrain-tiles/",
                              "https://s3.amazonaws.com/elevation-tiles-prod/skadi/{N00}/{N00}{E000}.hgt.gz",
                              "/vsigzip//vsicurl/",
                              kArcSecond,
                              2,
                              std::nullopt};

constexpr PublicDem scene(const PublicDem& collection, std::string_view name, std::string_view summary,
                          Box2 box) {
  PublicDem dem = collection;
  dem.name = name;
  dem.summary = summary;
  dem.scene = box;
  return dem;
}

constexpr std::array kPublicDems = {
    kGlo30,
    kGlo90,
    k3dep10,
    k3dep30,
    kSkadi,
    scene(kGlo30, "matterhorn", "The Matterhorn, Monte Rosa and Zermatt (Copernicus GLO-30)",
          {7.5, 45.85, 8.0, 46.15}),
    scene(kGlo30, "fuji", "Mount Fuji, a cone without a rival (Copernicus GLO-30)",
          {138.6, 35.2, 138.9, 35.5}),
    scene(kGlo30, "geiranger", "Fjords at 62 degrees north, pixels of 2 by 1 arc-seconds (Copernicus GLO-30)",
          {6.8, 62.0, 7.4, 62.3}),
    scene(k3dep10, "grand-canyon",
          "The Grand Canyon below the South Rim: cliffs and terraces (USGS 3DEP 1/3 arc-second)",
          {-112.3, 36.0, -112.0, 36.2}),
    scene(k3dep10, "mount-st-helens", "The crater of Mount St. Helens (USGS 3DEP 1/3 arc-second)",
          {-122.3, 46.1, -122.1, 46.3}),
};

void replaceAll(std::string& text, std::string_view what, std::string_view by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
}

/// The publisher's path below the mirror: GDAL reads folders plainly and URLs through the same reader.
std::string mirrored(std::string_view reader, const std::string& url, std::string_view mirror) {
  if (mirror.empty()) return std::string(reader) + url;
  const std::string path = url.substr(url.find('/', url.find("://") + 3));
  while (!mirror.empty() && mirror.back() == '/') mirror.remove_suffix(1);
  std::string prefix(reader);
  if (mirror.find("://") == std::string_view::npos) replaceAll(prefix, "/vsicurl/", "");
  return fmt::format("{}{}{}", prefix, mirror, path);
}

}  // namespace

std::span<const PublicDem> publicDems() {
  return kPublicDems;
}

Result<PublicDem> findPublicDem(std::string_view name) {
  std::string names;
  for (const PublicDem& dem : kPublicDems) {
    if (dem.name == name) return dem;
    names += fmt::format("{}{}", names.empty() ? "" : ", ", dem.name);
  }
  return failure(ErrorCode::usage, fmt::format("the catalogue has no such DEM, only {}", names),
                 std::string(name));
}

double sampleBytes(const PublicDem& dem, const Box2& degrees) {
  return (degrees.xMax - degrees.xMin) * (degrees.yMax - degrees.yMin) /
         (dem.pixelDegrees * dem.pixelDegrees) * dem.bytesPerSample;
}

Result<std::vector<std::string>> rasterPaths(const PublicDem& dem, const Box2& degrees,
                                             std::string_view mirror) {
  const std::string box = fmt::format("{},{},{},{}", degrees.xMin, degrees.yMin, degrees.xMax, degrees.yMax);
  if (!(degrees.xMin < degrees.xMax && degrees.yMin < degrees.yMax))
    return failure(ErrorCode::usage, "the box has no area; give west,south,east,north in degrees", box);
  if (degrees.xMin < -180 || degrees.xMax > 180 || degrees.yMin < -90 || degrees.yMax > 90)
    return failure(ErrorCode::usage, "the box leaves the globe; give west,south,east,north in degrees", box);
  if (!dem.isTiled()) return std::vector<std::string>{mirrored(dem.reader, std::string(dem.url), mirror)};

  const int west = static_cast<int>(std::floor(degrees.xMin)),
            east = static_cast<int>(std::ceil(degrees.xMax));
  const int south = static_cast<int>(std::floor(degrees.yMin)),
            north = static_cast<int>(std::ceil(degrees.yMax));
  constexpr int kMostTiles = 64;
  if ((east - west) * (north - south) > kMostTiles)
    return failure(ErrorCode::usage,
                   fmt::format("the box covers {} tiles; at most {} are fetched at once",
                               (east - west) * (north - south), kMostTiles),
                   box);
  std::vector<std::string> paths;
  for (int latitude = south; latitude < north; ++latitude)
    for (int longitude = west; longitude < east; ++longitude) {
      std::string url(dem.url);
      replaceAll(url, "{N00}", fmt::format("{}{:02}", latitude < 0 ? 'S' : 'N', std::abs(latitude)));
      replaceAll(url, "{E000}", fmt::format("{}{:03}", longitude < 0 ? 'W' : 'E', std::abs(longitude)));
      paths.push_back(mirrored(dem.reader, url, mirror));
    }
  return paths;
}

}  // namespace arete
