// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/amt/mt_chunks.h"

namespace arete {

std::vector<AmtChunkBytes> mtChunks(const MtArrays& a) {
  return {{amt_tag::kRootTriangles, bytesOf(a.rootTriangles)},
          {amt_tag::kSlotBegin, bytesOf(a.slotBegin)},
          {amt_tag::kLink, bytesOf(a.link)},
          {amt_tag::kRemover, bytesOf(a.remover)},
          {amt_tag::kError, bytesOf(a.error)},
          {amt_tag::kFloor, bytesOf(a.floor)},
          {amt_tag::kSaturatedError, bytesOf(a.saturatedError)},
          {amt_tag::kSphere, bytesOf(a.sphere)},
          {amt_tag::kBlockError, bytesOf(a.blockError)},
          {amt_tag::kBlockSphere, bytesOf(a.blockSphere)},
          {amt_tag::kCreatorHint, bytesOf(a.creatorHint)}};
}

MtArrays placeMtChunks(const AmtContainer& file) {
  MtArrays a;
  const auto place = [&]<class T>(AmtTag tag, std::span<const T>& to) { to = file.elements<T>(tag); };
  place(amt_tag::kRootTriangles, a.rootTriangles);
  place(amt_tag::kSlotBegin, a.slotBegin);
  place(amt_tag::kLink, a.link);
  place(amt_tag::kRemover, a.remover);
  place(amt_tag::kError, a.error);
  place(amt_tag::kFloor, a.floor);
  place(amt_tag::kSaturatedError, a.saturatedError);
  place(amt_tag::kSphere, a.sphere);
  place(amt_tag::kBlockError, a.blockError);
  place(amt_tag::kBlockSphere, a.blockSphere);
  place(amt_tag::kCreatorHint, a.creatorHint);
  return a;
}

}  // namespace arete
