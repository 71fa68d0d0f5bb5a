// SPDX-License-Identifier: GPL-3.0-or-later
//
// The height of a node is one more than that of the highest node that removes a triangle of its star. Nodes
// of one height are independent: all threads work on them at once.
#include "surface/displacement/piece_replay.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/cut/cut.h"
#include "engine/mt/hole_limit.h"
#include "engine/parallel/loop_threads.h"
#include "engine/parallel/per_thread.h"
#include "engine/simplify/hole_triangles.h"
#include "surface/error/piece_division.h"
#include "surface/error/star_division.h"
#include "surface/model/charts.h"

namespace arete {
namespace {

/// Nodes per batch: bounds the memory that a visitor holds for their floors.
constexpr std::size_t kBatch = 4096;

HoleTriangulation floorOf(const MultiTriangulation& mt, NodeId n) {
  const auto link = mt.link(n);
  HoleTriangulation floor;
  for (const std::uint32_t t : mt.floor(n)) {
    std::array<int, 3> at{};
    const auto corners = mt.corners(TriangleId(t));
    for (std::size_t i = 0; i < 3; ++i)
      at[i] = static_cast<int>(std::ranges::find(link, corners[i]) - link.begin());
    std::rotate(at.begin(), std::ranges::min_element(at), at.end());
    floor.add(at[0], at[1], at[2]);
  }
  return floor;
}

}  // namespace

PieceReplay::PieceReplay(const SurfaceModel& model) : model_(model), mt_(model.mt) {
  const MultiTriangulation& mt = mt_;
  if (model.boundsLines) parts_ = partsOf(model, partOf_);
  double largest = 0;
  for (std::uint32_t v = 0; v < mt.vertexCount(); ++v) {
    const Vec3 p = mt.position(VertexId(v));
    positions_.push_back(p);
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  const Cut finest = frontOfPrefix(mt, mt.nodeCount());
  faceOf_.resize(mt.triangleIdCount());
  for (std::size_t t = 0; t < finest.triangles.size(); ++t) {
    const auto& [a, b, c] = finest.triangles[t];
    faceOf_[finest.ids[t]] = static_cast<std::uint32_t>(t);
    faces_.push_back({finest.vertices[a], finest.vertices[b], finest.vertices[c]});
  }
  original_ = {positions_, faces_, largest};
  sortByHeight();
}

void PieceReplay::sortByHeight() {
  std::vector<std::uint32_t> heightOf(mt_.nodeCount(), 0);
  std::uint32_t highest = 0;
  for (std::uint32_t n = mt_.nodeCount(); n-- > 0;) {
    for (std::uint32_t i = 0; i < mt_.ceilingSize(NodeId(n)); ++i)
      if (const NodeId above = mt_.remover(mt_.slotTriangle(NodeId(n), i)); above.isValid())
        heightOf[n] = std::max(heightOf[n], heightOf[above.index()] + 1);
    highest = std::max(highest, heightOf[n]);
  }
  heightBegins_.assign(highest + 2, 0);
  for (const std::uint32_t height : heightOf) ++heightBegins_[height + 1];
  for (std::size_t h = 1; h < heightBegins_.size(); ++h) heightBegins_[h] += heightBegins_[h - 1];
  nodes_.resize(mt_.nodeCount());
  std::vector<std::size_t> next(heightBegins_.begin(), heightBegins_.end() - 1);
  for (std::uint32_t n = 0; n < mt_.nodeCount(); ++n) nodes_[next[heightOf[n]]++] = n;
}

/// Where the build divided the star of a node.
StarLine PieceReplay::lineOf(NodeId n) const {
  if (!parts_.hasLines()) return {};
  return lineThrough(parts_, static_cast<int>(mt_.ceilingSize(n)), mt_.isOpen(n), [&](int i) {
    const std::uint32_t t = mt_.slotTriangle(n, static_cast<std::uint32_t>(i)).index();
    return TriangleLabels{model_.faceOf[t],
                          model_.hasWedges() ? model_.wedgesOf[t] : std::array<std::uint32_t, 3>{}};
  });
}

Status PieceReplay::run(CoarseTriangleVisitor& visitor, const char* stage, const RunContext& context) const {
  std::vector<PieceList> pieces(mt_.triangleIdCount());
  PerThread<PieceDivision> divisions([&] { return PieceDivision(original_); });
  std::vector<std::size_t> firstOf;
  for (std::size_t h = 0; h + 1 < heightBegins_.size(); ++h)
    for (std::size_t begin = heightBegins_[h]; begin < heightBegins_[h + 1]; begin += kBatch) {
      if (context.cancelled()) return failure(ErrorCode::interrupted, "interrupted");
      context.report(stage, double(begin) / double(nodes_.size()));
      const std::size_t end = std::min(begin + kBatch, heightBegins_[h + 1]);
      firstOf.assign(1, 0);
      for (std::size_t i = begin; i < end; ++i)
        firstOf.push_back(firstOf.back() + mt_.floor(NodeId(nodes_[i])).size());
      visitor.begin(firstOf.back());
      forRanges(LoopThreads::all, end - begin, 16, [&](std::size_t from, std::size_t to) {
        PieceDivision& division = divisions.local();
        std::array<Vec3, kMaxHoleCorners> places;
        for (std::size_t i = from; i < to; ++i) {
          const NodeId n(nodes_[begin + i]);
          const auto link = mt_.link(n);
          for (std::size_t c = 0; c < link.size(); ++c) places[c] = positions_[link[c]];
          const HoleTriangulation floor = floorOf(mt_, n);
          const StarLine line = lineOf(n);
          const ReplacedStar star{static_cast<int>(mt_.ceilingSize(n)),
                                  mt_.apex(n).index(),
                                  link,
                                  {places.data(), link.size()},
                                  floor,
                                  line};
          divideStar(division, star, [&](int s, const auto& take) {
            const std::uint32_t t = mt_.slotTriangle(n, static_cast<std::uint32_t>(s)).index();
            if (pieces[t].isEmpty())
              take(Piece{faceOf_[t], 0, wholeFace()});
            else
              pieces[t].forEach(take);
          });
          for (std::uint32_t s = 0; s < mt_.ceilingSize(n); ++s) pieces[mt_.slotTriangle(n, s).index()] = {};
          for (int f = 0; f < floor.size; ++f) {
            const std::uint32_t t = mt_.floor(n)[static_cast<std::size_t>(f)];
            pieces[t] = division.takePieces(f);
            visitor.visit(firstOf[i] + static_cast<std::size_t>(f),
                          {t, mt_.corners(TriangleId(t)), pieces[t]});
          }
        }
      });
      visitor.end();
    }
  context.report(stage, 1);
  return {};
}

}  // namespace arete
