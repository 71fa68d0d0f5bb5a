// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "engine/mt/multitriangulation.h"
#include "engine/mt/node_blocks.h"

namespace arete {

/// A multitriangulation's arrays by value, to be spoilt one element at a time.
struct CopiedMt {
  std::vector<std::array<std::uint32_t, 3>> rootTriangles;
  std::vector<std::uint32_t> slotBegin, link, remover, floor, creatorHint;
  std::vector<std::uint16_t> error, below, above, saturatedError;
  std::vector<Sphere> sphere;
  NodeBlocks blocks;
  MultiTriangulation original;

  explicit CopiedMt(const MultiTriangulation& mt) : original(mt) {
    const MtArrays& a = mt.arrays();
    const auto copy = [](auto& to, const auto& from) { to.assign(from.begin(), from.end()); };
    copy(rootTriangles, a.rootTriangles);
    copy(slotBegin, a.slotBegin);
    copy(link, a.link);
    copy(remover, a.remover);
    copy(floor, a.floor);
    copy(creatorHint, a.creatorHint);
    copy(error, a.error);
    copy(below, a.columns.of(kBelow));
    copy(above, a.columns.of(kAbove));
    copy(saturatedError, a.saturatedError);
    copy(sphere, a.sphere);
    copy(blocks.error, a.blockError);
    copy(blocks.sphere, a.blockSphere);
  }

  MultiTriangulation mt() const {
    MtArrays a = original.arrays();
    a.rootTriangles = rootTriangles;
    a.slotBegin = slotBegin;
    a.link = link;
    a.remover = remover;
    a.floor = floor;
    a.creatorHint = creatorHint;
    a.error = error;
    a.columns.set(kBelow, below);
    a.columns.set(kAbove, above);
    a.saturatedError = saturatedError;
    a.sphere = sphere;
    a.blockError = blocks.error;
    a.blockSphere = blocks.sphere;
    return MultiTriangulation(a, nullptr);
  }
};

}  // namespace arete
