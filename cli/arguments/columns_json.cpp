// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/columns_json.h"

#include "io/store/amt/model_columns.h"
#include "io/store/format/metadata.h"
#include "io/store/format/surface_metadata.h"

namespace arete {
namespace {

template <class Model, class Metadata>
Result<Json> columnsOf(const AmtContainer& file, const Result<Metadata>& metadata) {
  if (!metadata) return tl::unexpected(metadata.error());
  AmtFacts facts = amtFactsOf(*metadata);
  ARETE_CHECK(checkColumns<Model>(file, facts));
  Json columns = Json::array();
  for (const AmtChunk& chunk : file.chunks()) {
    Json& column = columns.emplace_back(Json{{"tag", chunk.name()}, {"bytes", chunk.bytes}});
    for (const AmtRow<Model>& row : kAmtSchema<Model>) {
      if (row.tag != chunk.tag || !row.isIn(facts)) continue;
      column["per"] = toString(row.per);
      column["coding"] = toString(row.coding);
    }
  }
  return columns;
}

}  // namespace

Result<Json> columnsJson(const AmtContainer& file) {
  return file.isOfSurface() ? columnsOf<SurfaceModel>(file, fromSurfaceJson(file.metadata()))
                            : columnsOf<TerrainModel>(file, fromAmtJson(file.metadata()));
}

}  // namespace arete
