// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "io/store/amt/container.h"
#include "io/store/format/schema.h"

namespace arete {

/// The columns of an open file, of either kind of model, by walking over its schema.

/// Adds what the directory says to the facts of the metadata, and checks that the file has each column that
/// they call for, of its type and size. Errors: corrupt: names the chunk.
template <class Model>
Status checkColumns(const AmtContainer& file, AmtFacts& facts) {
  const auto has = [&](const AmtTag& tag) { return file.find(tag) != nullptr; };
  facts.isPacked = file.isPacked();
  facts.isPaged = file.isPaged();
  facts.hasDisplacement = has(amt_tag::kDirections) || has(amt_tag::kReaches);
  if (has(amt_tag::kSegmentChecksums)) {
    facts.segments = 0;
    for (const AmtChunk& chunk : file.chunks()) *facts.segments += amtSegmentCount(chunk.tag, chunk.bytes);
  }
  std::vector<AmtShape> shapes;
  for (const AmtRow<Model>& row : kAmtSchema<Model>) {
    const AmtChunk* const chunk = file.find(row.tag);
    if (!row.isIn(facts) || (row.need == AmtNeed::whereFound && chunk == nullptr)) continue;
    shapes.push_back(amtShapeOf(row, facts, chunk == nullptr ? 0 : chunk->bytes));
  }
  return file.checkShapes(shapes);
}

/// Calls visit(row, bytes) for the columns that the file has. Precondition: checkColumns() was successful.
template <class Model, class Visit>
void forColumns(const AmtContainer& file, const AmtFacts& facts, const Visit& visit) {
  for (const AmtRow<Model>& row : kAmtSchema<Model>)
    if (row.isIn(facts))
      if (const AmtChunk* const chunk = file.find(row.tag)) visit(row, file.bytes(*chunk));
}

/// The arrays of the MT where they lie in the file; of a packed file none. Precondition: as forColumns().
template <class Model>
void placeMtColumns(const AmtContainer& file, const AmtFacts& facts, MtArrays& to) {
  forColumns<Model>(file, facts, [&](const AmtRow<Model>& row, std::span<const std::byte> bytes) {
    if (row.mt) row.mt.put(to, bytes);
  });
}

/// Copies what lies beside the MT. Preconditions: as forColumns(); the columns were loaded.
template <class Model>
void copyModelColumns(const AmtContainer& file, const AmtFacts& facts, Model& to) {
  forColumns<Model>(file, facts, [&](const AmtRow<Model>& row, std::span<const std::byte> bytes) {
    if (row.model) row.model.put(to, bytes);
  });
}

}  // namespace arete
