// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/drape/turned_picture.h"

#include <fmt/format.h>
#include <ogr_spatialref.h>
#include <vrtdataset.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "io/geo/crs/longitude_turns.h"
#include "terrain/model/plan_box.h"

namespace arete {
namespace {

/// The image `copies` times, side by side, with its first pixel at x.
GdalDatasetPtr sideBySide(GDALDataset& picture, int copies, double x) {
  const int columns = picture.GetRasterXSize(), rows = picture.GetRasterYSize();
  auto made = std::make_unique<VRTDataset>(columns * copies, rows);
  std::array<double, 6> transform{};
  picture.GetGeoTransform(transform.data());
  transform[0] = x;
  made->SetGeoTransform(transform.data());
  made->SetSpatialRef(picture.GetSpatialRef());
  for (int b = 1; b <= picture.GetRasterCount(); ++b) {
    GDALRasterBand* source = picture.GetRasterBand(b);
    if (made->AddBand(source->GetRasterDataType(), nullptr) != CE_None) return nullptr;
    auto* band = static_cast<VRTSourcedRasterBand*>(made->GetRasterBand(b));
    band->CopyCommonInfoFrom(source);
    for (int i = 0; i < copies; ++i)
      if (band->AddSimpleSource(source, 0, 0, columns, rows, i * columns, 0, columns, rows) != CE_None)
        return nullptr;
  }
  return GdalDatasetPtr(made.release());
}

}  // namespace

GdalDatasetPtr turnedOnto(GDALDataset& picture, const TerrainModel& model, Warnings& warnings) {
  std::array<double, 6> t{};
  const OGRSpatialReference* crs = picture.GetSpatialRef();
  const double turn = model.georeference.isGeographic ? turnOf(model.georeference) : 0;
  if (!(turn > 0) || !crs || !crs->IsGeographic() || picture.GetGeoTransform(t.data()) != CE_None ||
      t[1] == 0 || t[2] != 0 || t[4] != 0 ||
      std::abs(crs->GetAngularUnits() - model.georeference.angularUnitRadians) > 1e-12)
    return nullptr;
  const int columns = picture.GetRasterXSize();
  const double end = t[0] + t[1] * columns, west = std::min(t[0], end), east = std::max(t[0], end);
  const Box2 box = planBox(model);
  double demWest = std::numeric_limits<double>::infinity(), demEast = -demWest;
  for (const double x : {box.xMin, box.xMax})
    for (const double y : {box.yMin, box.yMax}) {
      demWest = std::min(demWest, model.toSource({x, y}).x);
      demEast = std::max(demEast, model.toSource({x, y}).x);
    }

  struct Copy {
    double shift, width;  // of the part on the DEM
  };
  std::vector<Copy> copies;
  for (const double shift : LongitudeTurns(model).shiftsOnto(west, east))
    if (const double width = std::min(east + shift, demEast) - std::max(west + shift, demWest);
        width > 1e-9 * turn)
      copies.push_back({shift, width});
  if (copies.empty() || (copies.size() == 1 && copies[0].shift == 0)) return nullptr;
  constexpr double kOff = 0.05;  // columns
  const bool goesRound = std::abs(columns - turn / std::abs(t[1])) <= kOff;
  if (copies.size() == 1 || goesRound) {
    const bool isMirrored = t[1] < 0;
    const double shift = isMirrored ? copies.back().shift : copies.front().shift;
    if (copies.size() > std::size_t(std::numeric_limits<int>::max() / columns)) return nullptr;
    return sideBySide(picture, int(copies.size()), t[0] + shift);
  }
  const Copy& largest = *std::ranges::max_element(copies, {}, &Copy::width);
  warnings.push_back({WarningCode::choice, fmt::format("lies on both ends of the DEM, whole turns apart; "
                                                       "only its part from longitude {:.6g} to {:.6g} is "
                                                       "drawn",
                                                       std::max(west + largest.shift, demWest),
                                                       std::min(east + largest.shift, demEast))});
  if (largest.shift == 0) return nullptr;
  return sideBySide(picture, 1, t[0] + largest.shift);
}

}  // namespace arete
