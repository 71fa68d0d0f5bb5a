// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/columns_json.h"

#include "io/store/format/schema.h"

namespace arete {

Json columnsJson(const AmtContainer& file) {
  Json columns = Json::array();
  for (const AmtChunk& chunk : file.chunks()) {
    Json column = {{"tag", chunk.name()}, {"bytes", chunk.bytes}};
    if (const AmtColumn* const known = findAmtColumn(chunk.tag)) {
      column["per"] = toString(known->per);
      column["coding"] = toString(known->coding);
    }
    columns.push_back(std::move(column));
  }
  return columns;
}

}  // namespace arete
