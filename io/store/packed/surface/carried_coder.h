// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the nodes of a run carry, from the coarsest to the finest, so that the segments of a part are enough:
//
// 1. The vertex of the source, against the middle one of the link's (vertex_numbers.h).
// 2. The direction of a displacement, against the mean of the link's.
// 3. The faces of a star. A triangle that follows one of the floor (successorSlotOf()) has its face; where
//    coarse triangles have faces of their own, a symbol says which of the floor's, or a new one. The new ones
//    of a run are sorted by the source's numbers of their corners, and each is predicted from the one before.
// 4. The wedges of a star's corners: at the link what the floor and the star have there, at the apex what the
//    star has so far; or the next new wedge of the file; or any.
// 5. Reaches, errors of attributes, and values: of the vertices, and of the faces and wedges that are new
// here.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "engine/mt/multitriangulation.h"
#include "io/store/entropy/numbers.h"
#include "io/store/packed/nodes/layout.h"
#include "io/store/packed/surface/displacement_numbers.h"
#include "io/store/packed/surface/symbol_bytes.h"
#include "io/store/packed/surface/vertex_numbers.h"
#include "surface/model/face_successors.h"
#include "surface/model/surface_model.h"

namespace arete::packed {

inline constexpr unsigned kCarriedSpreads = kVertexSpreads, kCarriedFaceClasses = 24,
                          kCarriedWedgeClasses = 3;
enum CarriedTable : unsigned {
  kCarriedVertexTable = 0,                                      // by the spread of the link's numbers
  kCarriedFaceTable = kCarriedVertexTable + kCarriedSpreads,    // by the symbol before
  kCarriedHeirTable = kCarriedFaceTable + kCarriedFaceClasses,  // by whether a face is expected
  kCarriedLinkWedgeTable = kCarriedHeirTable + 2,               // by how many wedges may be meant
  kCarriedApexWedgeTable = kCarriedLinkWedgeTable + kCarriedWedgeClasses,
  kCarriedOtherWedgeTable = kCarriedApexWedgeTable + kCarriedWedgeClasses,
  kCarriedDirectionTable,                                           // by the bits of the link's mean length
  kCarriedReachTable = kCarriedDirectionTable + kDirectionLengths,  // by the reach before
  kCarriedTables = kCarriedReachTable + kReachClasses
};

/// Symbols: below kOther, which of the candidates.
inline constexpr unsigned kOtherCarried = 254, kNewCarried = 255;

/// What the whole file says once.
struct CarriedRule {
  bool ordersByLargest = false;  ///< new faces of a run are sorted by the largest number of their corners
  bool hasCoarseFaces = false;
  bool hasDisplacement = false;
  double facesPerVertex = 2;  ///< of the source
};

/// @tparam Io  CarriedWriterIo or CarriedReaderIo (carried_io.h)
template <class Io>
class CarriedCoder {
 public:
  CarriedCoder(SurfaceModel& model, const CarriedRule& rule, Io& io)
      : model_(model), mt_(model.mt), rule_(rule), io_(io) {}

  /// What the root carries. @return false if a number is out of range
  bool root() {
    std::uint32_t before = 0;
    for (std::uint32_t v = 0; v < mt_.rootVertexCount(); ++v) {
      std::uint32_t& number = model_.vertexOf[v];
      before = number = moved(before, codeSigned(io_, kSymbols, kCarriedVertexTable + kCarriedSpreads - 1,
                                                 behind(number, before)));
      if (rule_.hasDisplacement) codeDirection(model_.displacement, v, {}, kCarriedDirectionTable, io_);
    }
    newFaces_.clear();
    for (std::uint32_t t = 0; t < mt_.rootTriangleCount(); ++t)
      newFaces_.push_back({key(mt_.rootTriangles()[t]), t});
    if (!codeNewFaces()) return false;
    if (model_.hasWedges() && !rootWedges()) return false;
    for (std::uint32_t t = 0; t < mt_.rootTriangleCount(); ++t) ofTriangle(t);
    for (std::uint32_t v = 0; v < mt_.rootVertexCount(); ++v) values(v);
    return true;
  }

  /// What the nodes of a run carry. @return as root()
  bool run(const Run& run) {
    const std::uint32_t end = run.firstNode + run.nodes;
    for (std::uint32_t n = run.firstNode; n < end; ++n) {
      const auto link = mt_.link(NodeId(n));
      codeVertexNumber(model_.vertexOf, link, mt_.apex(NodeId(n)).index(), kCarriedVertexTable, io_, around_);
      if (rule_.hasDisplacement)
        codeDirection(model_.displacement, mt_.apex(NodeId(n)).index(), link, kCarriedDirectionTable, io_);
    }
    newFaces_.clear();
    firstOfRun_ = mt_.rootTriangleCount() + run.firstSlot;
    labels_.assign(run.slots, 0);
    for (std::uint32_t n = run.firstNode; n < end; ++n)
      if (!facesOfStar(NodeId(n))) return false;
    if (!codeNewFaces()) return false;
    for (std::uint32_t i = 0; i < run.slots; ++i) model_.faceOf[firstOfRun_ + i] = faceOf(labels_[i]);
    if (model_.hasWedges())
      for (std::uint32_t n = run.firstNode; n < end; ++n)
        if (!wedgesOfStar(NodeId(n))) return false;
    for (std::uint32_t n = run.firstNode; n < end; ++n)
      for (std::uint32_t i = 0; i < mt_.ceilingSize(NodeId(n)); ++i)
        ofTriangle(mt_.slotTriangle(NodeId(n), i).index());
    for (std::uint32_t n = run.firstNode; n < end; ++n) values(mt_.apex(NodeId(n)).index());
    return true;
  }

 private:
  struct NewFace {
    std::uint32_t key, triangle;
    auto operator<=>(const NewFace&) const = default;
  };
  /// Different numbers, the likeliest first.
  struct Candidates {
    std::vector<std::uint32_t> all;
    void add(std::uint32_t number) {
      if (std::ranges::find(all, number) == all.end()) all.push_back(number);
    }
  };

  std::uint32_t key(const std::array<std::uint32_t, 3>& corners) const {
    const std::uint32_t a = model_.vertexOf[corners[0]], b = model_.vertexOf[corners[1]],
                        c = model_.vertexOf[corners[2]];
    return rule_.ordersByLargest ? std::max({a, b, c}) : std::min({a, b, c});
  }

  /// What is known of the face of a triangle while a run's are coded: its number, or, of one that is new in
  /// the run, the triangle that has it first.
  using FaceLabel = std::uint64_t;
  static constexpr FaceLabel kNoLabel = ~FaceLabel{0}, kFirstOf = FaceLabel{1} << 32;
  FaceLabel labelOf(std::uint32_t t) const {
    return t < firstOfRun_ ? model_.faceOf[t] : labels_[t - firstOfRun_];
  }
  std::uint32_t faceOf(FaceLabel label) const {
    return label < kFirstOf ? static_cast<std::uint32_t>(label)
                            : model_.faceOf[static_cast<std::uint32_t>(label)];
  }
  static void add(std::vector<FaceLabel>& labels, FaceLabel label) {
    if (std::ranges::find(labels, label) == labels.end()) labels.push_back(label);
  }

  /// Codes which of the floor's faces each triangle of a star has, and notes those that are new.
  bool facesOfStar(NodeId n) {
    const std::uint32_t size = mt_.ceilingSize(n);
    expected_.assign(size, kNoLabel);
    floorLabels_.clear();
    for (const std::uint32_t t : mt_.floor(n)) {
      const std::uint32_t heir = successorSlotOf(mt_, TriangleId(t), mt_.creator(TriangleId(t)), n);
      if (expected_[heir] == kNoLabel) expected_[heir] = labelOf(t);
      add(floorLabels_, labelOf(t));
    }
    for (std::uint32_t i = 0; i < size; ++i) {
      const std::uint32_t t = mt_.slotTriangle(n, i).index();
      FaceLabel label = expected_[i];
      if (rule_.hasCoarseFaces) {
        faceCandidates_.clear();
        if (label != kNoLabel) faceCandidates_.push_back(label);
        for (const FaceLabel other : floorLabels_) add(faceCandidates_, other);
        const unsigned symbol = io_.code(kSymbols, kCarriedHeirTable + (label == kNoLabel ? 0 : 1), [&] {
          for (std::size_t c = 0; c < faceCandidates_.size(); ++c)
            if (faceOf(faceCandidates_[c]) == model_.faceOf[t]) return static_cast<unsigned>(c);
          return kNewCarried;
        });
        if (symbol != kNewCarried && symbol >= faceCandidates_.size()) return false;
        label = symbol == kNewCarried ? kNoLabel : faceCandidates_[symbol];
      }
      if (label == kNoLabel) {
        label = kFirstOf | t;
        newFaces_.push_back({key(mt_.corners(TriangleId(t), n)), t});
      }
      labels_[t - firstOfRun_] = label;
    }
    return true;
  }

  bool codeNewFaces() {
    std::ranges::sort(newFaces_);
    std::int64_t predicted = 0;
    std::uint32_t keyBefore = 0;
    unsigned last = 0;
    for (const auto& [key, t] : newFaces_) {
      predicted += std::llround(rule_.facesPerVertex * (double(key) - double(keyBefore)));
      keyBefore = key;
      std::uint32_t& face = model_.faceOf[t];
      const std::int64_t by =
          codeSigned(io_, kSymbols, kCarriedFaceTable + last,
                     static_cast<std::int64_t>(std::uint64_t{face} - static_cast<std::uint64_t>(predicted)));
      face =
          static_cast<std::uint32_t>(static_cast<std::uint64_t>(predicted) + static_cast<std::uint64_t>(by));
      if (face >= model_.sourceFaces) return false;
      predicted = face;
      last = std::min(bucketOf(zigzag(by)).symbol, kCarriedFaceClasses - 1);
      io_.face(face);
    }
    return true;
  }

  bool rootWedges() {
    std::vector<std::vector<std::uint32_t>> before(mt_.rootVertexCount());
    for (std::uint32_t t = 0; t < mt_.rootTriangleCount(); ++t)
      for (std::size_t c = 0; c < 3; ++c) {
        auto& known = before[mt_.rootTriangles()[t][c]];
        candidates_.all.assign(known.rbegin(), known.rend());
        std::uint32_t& w = model_.wedgesOf[t][c];
        if (!wedge(kCarriedApexWedgeTable, w)) return false;
        std::erase(known, w);
        known.push_back(w);
      }
    return true;
  }

  /// The floor's wedges at a vertex, the triangle at the edge of the link first.
  void addFloorWedges(NodeId n, std::uint32_t vertex, std::uint32_t across) {
    for (const bool atEdge : {true, false})
      for (std::size_t f = 0; f < floorCorners_.size(); ++f) {
        const auto& corners = floorCorners_[f];
        const auto at = std::ranges::find(corners, vertex);
        if (at == corners.end()) continue;
        if (atEdge && std::ranges::find(corners, across) == corners.end()) continue;
        candidates_.add(model_.wedgesOf[mt_.floor(n)[f]][static_cast<std::size_t>(at - corners.begin())]);
      }
  }

  bool wedgesOfStar(NodeId n) {
    floorCorners_.clear();
    for (const std::uint32_t t : mt_.floor(n)) floorCorners_.push_back(mt_.corners(TriangleId(t)));
    const auto link = mt_.link(n);
    const std::uint32_t size = mt_.ceilingSize(n);
    apexWedges_.clear();
    for (std::uint32_t i = 0; i < size; ++i) {
      const std::uint32_t t = mt_.slotTriangle(n, i).index();
      auto& wedges = model_.wedgesOf[t];
      candidates_.all.assign(apexWedges_.rbegin(), apexWedges_.rend());
      if (!wedge(kCarriedApexWedgeTable, wedges[0])) return false;
      std::erase(apexWedges_, wedges[0]);
      apexWedges_.push_back(wedges[0]);
      const std::uint32_t from = link[i], to = link[(i + 1) % link.size()];
      candidates_.all.clear();
      addFloorWedges(n, from, to);
      if (i > 0) candidates_.add(model_.wedgesOf[t - 1][2]);
      if (!wedge(kCarriedLinkWedgeTable, wedges[1])) return false;
      candidates_.all.clear();
      addFloorWedges(n, to, from);
      if (i + 1 == size && link.size() == size) candidates_.add(model_.wedgesOf[t - i][1]);
      if (!wedge(kCarriedLinkWedgeTable, wedges[2])) return false;
    }
    return true;
  }

  /// One of the candidates, the next new one, or any.
  bool wedge(unsigned table, std::uint32_t& number) {
    const std::size_t known = std::min<std::size_t>(candidates_.all.size(), kCarriedWedgeClasses - 1);
    const unsigned symbol = io_.code(kSymbols, table + static_cast<unsigned>(known), [&] {
      const auto found =
          static_cast<std::size_t>(std::ranges::find(candidates_.all, number) - candidates_.all.begin());
      if (found < candidates_.all.size() && found < kOtherCarried) return static_cast<unsigned>(found);
      return number == io_.nextWedge() ? kNewCarried : kOtherCarried;
    });
    if (symbol < kOtherCarried) {
      if (symbol >= candidates_.all.size()) return false;
      number = candidates_.all[symbol];
      return true;
    }
    if (symbol == kOtherCarried)
      number = static_cast<std::uint32_t>(
          codeNumber(io_, kSymbols, kCarriedOtherWedgeTable, [&] { return std::uint64_t{number}; }));
    else
      number = io_.takeNextWedge();
    if (number >= model_.attributes.wedgeCount) return false;
    io_.wedge(number);
    return true;
  }

  void ofTriangle(std::uint32_t t) {
    if (rule_.hasDisplacement && mt_.errorCode(TriangleId(t)) != 0)
      codeReach(model_.displacement.reaches[t], reachBefore_, kCarriedReachTable, io_);
    const std::size_t ids = mt_.triangleIdCount(), levels = 1 + model_.attributeDistances.size();
    for (AttributeErrors& errors : model_.attributeErrors)
      for (std::size_t level = 0; level < levels; ++level)
        io_.bytes(std::as_writable_bytes(std::span(&errors.codes[level * ids + t], 1)));
  }

  void values(std::uint32_t v) {
    for (Attribute& attribute : model_.attributes.vertexAttributes) {
      const std::size_t bytes = attribute.elementBytes();
      io_.bytes(std::span(attribute.values).subspan(v * bytes, bytes));
    }
  }

  SurfaceModel& model_;
  const MultiTriangulation& mt_;
  const CarriedRule& rule_;
  Io& io_;
  std::vector<NewFace> newFaces_;
  std::uint32_t firstOfRun_ = 0;  ///< the first triangle id of the run
  std::vector<FaceLabel> labels_, expected_, floorLabels_, faceCandidates_;
  std::vector<std::uint32_t> apexWedges_, around_;
  std::vector<std::array<std::uint32_t, 3>> floorCorners_;
  Candidates candidates_;
  unsigned reachBefore_ = 0;
};

}  // namespace arete::packed
