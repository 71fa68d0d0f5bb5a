// SPDX-License-Identifier: GPL-3.0-or-later
//
// Indices of a colour table cannot be interpolated, so a virtual raster of GDAL expands them to colours
// first. The NODATA index becomes transparent in the table, since its number means another thing among
// colours.
#include "io/geo/drape/source.h"

#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal_rat.h>
#include <gdal_utils.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "engine/base/counted.h"
#include "io/geo/gdal/zipped_raster.h"
#include "io/geo/network/network_reading.h"
#include "io/geo/network/virtual_text.h"

namespace arete {
namespace {

GdalDatasetPtr translate(GDALDataset& dataset, std::initializer_list<const char*> words) {
  CPLStringList list;
  for (const char* word : words) list.AddString(word);
  GDALTranslateOptions* options = GDALTranslateOptionsNew(list.List(), nullptr);
  if (!options) return {};
  GDALDatasetH made = GDALTranslate("", GDALDataset::ToHandle(&dataset), options, nullptr);
  GDALTranslateOptionsFree(options);
  return GdalDatasetPtr(GDALDataset::FromHandle(made));
}

/// The colours of the classes; the class of NODATA becomes transparent.
void takeClasses(DrapeSource& source, int band, const GDALColorTable& table) {
  int isDeclared = 0;
  const double nodata = source.opened.first()->GetRasterBand(band)->GetNoDataValue(&isDeclared);
  for (int i = 0; i < table.GetColorEntryCount(); ++i) {
    GDALColorEntry entry{};
    table.GetColorEntryAsRGB(i, &entry);
    const auto byte = [](short part) { return static_cast<std::uint8_t>(std::clamp<short>(part, 0, 255)); };
    const bool isSeen = !(isDeclared && nodata == i);
    source.classes.push_back(
        {byte(entry.c1), byte(entry.c2), byte(entry.c3), isSeen ? byte(entry.c4) : std::uint8_t{0}});
  }
  source.classBand = band;
}

/// The colour table that an attribute table describes; null if it has no colours.
std::unique_ptr<GDALColorTable> tableOfAttributes(GDALRasterBand& band) {
  const GDALRasterAttributeTable* attributes = band.GetDefaultRAT();
  if (!attributes || attributes->GetColOfUsage(GFU_Red) < 0 || attributes->GetColOfUsage(GFU_Green) < 0 ||
      attributes->GetColOfUsage(GFU_Blue) < 0)
    return nullptr;
  return std::unique_ptr<GDALColorTable>(
      const_cast<GDALRasterAttributeTable*>(attributes)->TranslateToColorTable());
}

Status expandColorTable(DrapeSource& source, int band) {
  const GdalErrors errors;
  GDALRasterBand& indices = *source.dataset().GetRasterBand(band);
  int isDeclared = 0;
  const double nodata = indices.GetNoDataValue(&isDeclared);
  const std::string number = std::to_string(band);
  GdalDatasetPtr plain =
      translate(source.dataset(), {"-of", "VRT", "-b", number.c_str(), "-a_nodata", "none"});
  if (plain && isDeclared) {
    GDALRasterBand& copy = *plain->GetRasterBand(1);
    GDALColorTable table = *copy.GetColorTable();
    const int index = static_cast<int>(nodata);
    if (index >= 0 && index < table.GetColorEntryCount()) {
      GDALColorEntry entry = *table.GetColorEntry(index);
      entry.c4 = 0;
      table.SetColorEntry(index, &entry);
      copy.SetColorTable(&table);
    }
  }
  GdalDatasetPtr expanded = plain ? translate(*plain, {"-of", "VRT", "-expand", "rgba"}) : GdalDatasetPtr();
  if (!expanded)
    return failure(ErrorCode::unsupported,
                   fmt::format("its colour table cannot be expanded: {}", errors.firstFailure()));
  source.opened.push(std::move(plain));
  source.opened.push(std::move(expanded));
  source.colors = {1, 2, 3};
  source.alpha = 4;
  return {};
}

Status chooseColors(DrapeSource& source, const std::vector<int>& stated, Warnings& warnings) {
  GDALDataset& dataset = source.dataset();
  const int count = dataset.GetRasterCount();
  if (count == 0) return failure(ErrorCode::unsupported, "holds no raster band");
  std::vector<int> others;
  int red = 0, green = 0, blue = 0;
  for (int b = 1; b <= count; ++b) {
    const GDALColorInterp meaning = dataset.GetRasterBand(b)->GetColorInterpretation();
    if (meaning == GCI_AlphaBand && source.alpha == 0)
      source.alpha = b;
    else
      others.push_back(b);
    if (meaning == GCI_RedBand && red == 0) red = b;
    if (meaning == GCI_GreenBand && green == 0) green = b;
    if (meaning == GCI_BlueBand && blue == 0) blue = b;
  }
  if (others.empty()) others.push_back(source.alpha), source.alpha = 0;
  if (!stated.empty()) {
    if (stated.size() != 1 && stated.size() != 3)
      return failure(ErrorCode::usage, "a picture has one band (grey) or three (red, green, blue)");
    for (const int b : stated)
      if (b < 1 || b > count)
        return failure(ErrorCode::usage, fmt::format("has {}; there is no band {}",
                                                     counted(std::size_t(count), "band", "bands"), b));
    source.colors = stated;
  } else if (red != 0 && green != 0 && blue != 0) {
    source.colors = {red, green, blue};
  } else if (others.size() >= 3) {
    source.colors = {others[0], others[1], others[2]};
    if (others.size() > 3)
      warnings.push_back(
          {WarningCode::choice, fmt::format("has {} bands; bands {} are taken as red, green and blue", count,
                                            fmt::join(source.colors, ", "))});
  } else {
    source.colors = {others[0]};
    if (others.size() > 1)
      warnings.push_back(
          {WarningCode::choice, fmt::format("has {} bands; band {} is shown in grey", count, others[0])});
  }
  for (const int b : source.colors)
    if (GDALDataTypeIsComplex(dataset.GetRasterBand(b)->GetRasterDataType()))
      return failure(ErrorCode::unsupported, fmt::format("band {} holds complex numbers, not colours", b));
  if (source.colors.size() == 1) {
    GDALRasterBand& band = *dataset.GetRasterBand(source.colors[0]);
    if (const GDALColorTable* table = band.GetColorTable()) {
      takeClasses(source, source.colors[0], *table);
      return expandColorTable(source, source.colors[0]);
    }
    if (const auto table = tableOfAttributes(band)) takeClasses(source, source.colors[0], *table);
  }
  source.isStretched = std::ranges::any_of(
      source.colors, [&](int b) { return dataset.GetRasterBand(b)->GetRasterDataType() != GDT_Byte; });
  return {};
}

Result<DrapeSource> openLevel(const std::string& path, const std::vector<int>& bands,
                              std::optional<int> overview, Warnings& warnings) {
  registerGdal();
  GdalErrors errors;
  const NetworkReading network(nullptr);  // so that a file of the network is requested once
  if (auto problem = findPipeProblem(path)) return tl::unexpected(*problem);
  ARETE_TRY(const std::string gdalPath, rasterPathOf(path));
  DrapeSource source;
  if (overview) {
    CPLStringList options;
    options.SetNameValue("OVERVIEW_LEVEL", std::to_string(*overview).c_str());
    source.opened.push(GdalDatasetPtr(GDALDataset::Open(servedDatasetPath(gdalPath).c_str(),
                                                        GDAL_OF_RASTER | GDAL_OF_READONLY, nullptr,
                                                        options.List(), nullptr)));
  } else {
    source.opened.push(openGdal(gdalPath, GDAL_OF_RASTER));
  }
  if (!source.opened.last()) return tl::unexpected(explainOpenFailure(gdalPath, "raster", errors));
  if (Status ok = chooseColors(source, bands, warnings); !ok)
    return failure(ok.error().code, ok.error().message, path);
  return source;
}

}  // namespace

Result<DrapeSource> openDrapeSource(const std::string& path, const std::vector<int>& bands,
                                    Warnings& warnings) {
  return openLevel(path, bands, std::nullopt, warnings);
}

Result<DrapeSource> openDrapeOverview(const std::string& path, DrapeSource source, double coarser) {
  if (!source.classes.empty()) return source;
  GDALDataset& file = *source.opened.first();
  GDALRasterBand& band = *file.GetRasterBand(1);
  std::optional<int> best;
  int bestColumns = file.GetRasterXSize();
  for (int i = 0; i < band.GetOverviewCount(); ++i) {
    GDALRasterBand* overview = band.GetOverview(i);
    if (!overview) continue;
    const int columns = overview->GetXSize();
    if (columns < bestColumns && double(file.GetRasterXSize()) / columns <= coarser * 1.01) {
      best = i;
      bestColumns = columns;
    }
  }
  if (!best) return source;
  Warnings repeated;  // the warnings of the first opening suffice
  const bool isExpanded = source.opened.isExpanded();
  Result<DrapeSource> smaller =
      openLevel(path, isExpanded ? std::vector<int>() : source.colors, best, repeated);
  if (!smaller) return source;
  smaller->coarser = double(file.GetRasterXSize()) / bestColumns;
  return smaller;
}

}  // namespace arete
