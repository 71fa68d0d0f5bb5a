// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/drape/class_names.h"

#include <fmt/format.h>
#include <gdal_priv.h>
#include <gdal_rat.h>

#include <algorithm>
#include <map>

#include "engine/base/caught_failure.h"
#include "io/geo/drape/source.h"

namespace arete {
namespace {

/// By number: from the column of names of the attribute table, or from the list of categories.
std::map<std::uint32_t, std::string> namesOf(GDALRasterBand& band) {
  std::map<std::uint32_t, std::string> names;
  if (const GDALRasterAttributeTable* table = band.GetDefaultRAT()) {
    const int text = table->GetColOfUsage(GFU_Name);
    int value = table->GetColOfUsage(GFU_MinMax);
    if (value < 0) value = table->GetColOfUsage(GFU_Min);
    for (int row = 0; text >= 0 && row < table->GetRowCount(); ++row) {
      const int number = value >= 0 ? table->GetValueAsInt(row, value) : row;
      const std::string name = table->GetValueAsString(row, text);
      if (number >= 0 && !name.empty()) names[std::uint32_t(number)] = name;
    }
  }
  char** categories = band.GetCategoryNames();
  for (std::uint32_t i = 0; names.empty() && categories != nullptr && categories[i] != nullptr; ++i)
    if (*categories[i] != '\0') names[i] = categories[i];
  return names;
}

}  // namespace

Result<std::vector<DrapeClass>> readDrapeClasses(const std::string& path, const std::vector<int>& bands) try {
  Warnings said;  // by the reading of the picture as well
  ARETE_TRY(const DrapeSource source, openDrapeSource(path, bands, said));
  if (source.classes.empty()) return std::vector<DrapeClass>();
  const GdalErrors errors;
  GDALRasterBand& band = *source.opened.first()->GetRasterBand(source.classBand);
  constexpr int kMostSide = 1024;
  const int columns = std::min(band.GetXSize(), kMostSide), rows = std::min(band.GetYSize(), kMostSide);
  std::vector<std::int32_t> numbers(std::size_t(columns) * std::size_t(rows));
  if (band.RasterIO(GF_Read, 0, 0, band.GetXSize(), band.GetYSize(), numbers.data(), columns, rows, GDT_Int32,
                    0, 0, nullptr) != CE_None)
    return failure(ErrorCode::unreadable, "its classes cannot be read: " + errors.firstFailure(), path);
  std::vector<bool> occurs(source.classes.size());
  for (const std::int32_t n : numbers)
    if (n >= 0 && std::size_t(n) < occurs.size()) occurs[std::size_t(n)] = true;
  const auto names = namesOf(band);
  std::vector<DrapeClass> classes;
  for (std::uint32_t i = 0; i < occurs.size(); ++i) {
    // A transparent class shows the ground.
    if (!occurs[i] || source.classes[i][3] == 0) continue;
    const auto found = names.find(i);
    classes.push_back(
        {i, source.classes[i], found != names.end() ? found->second : fmt::format("class {}", i)});
  }
  return classes;
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
