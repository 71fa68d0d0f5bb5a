// SPDX-License-Identifier: GPL-3.0-or-later
//
// A degenerate triangle covers nothing, but it joins its neighbours. So it is left out in a way that joins
// them still:
//
//   a vertex twice         its two other sides are one edge: nothing else changes
//   two vertices at one    the two become one vertex, which leaves out every triangle that has both; only if
//   no position               other triangles would then share an edge (the link condition), else it stays
//   three on one line      the triangles across its longest side are split at the vertex inside that side;
//   only
//                          if they get no edge that exists, else it stays
//
// The last step makes triangles that may be degenerate again, with shorter longest sides, so it ends.
#include <algorithm>
#include <deque>
#include <iterator>

#include "surface/diagnosis/parts.h"
#include "surface/repair/draft.h"
#include "surface/repair/neighbourhood.h"

namespace arete::repair_passes {
namespace {

using diagnosis::hasRepeat;

class DegeneratePass {
 public:
  explicit DegeneratePass(Draft& draft)
      : draft_(draft), mesh_(draft.mesh), neighbours_(draft.mesh), isGone_(draft.mesh.triangles.size(), 0) {}

  void run(std::vector<std::uint32_t> degenerate) {
    pending_.assign(degenerate.begin(), degenerate.end());
    while (!pending_.empty()) {
      const std::uint32_t t = pending_.front();
      pending_.pop_front();
      if (isGone_[t] == 0 && isDegenerate(t)) mend(t);
    }
    draft_.removeTriangles(isGone_);
  }

  bool isDegenerate(std::uint32_t t) const {
    const auto& [a, b, c] = mesh_.triangles[t];
    return hasRepeat(mesh_.triangles[t]) ||
           diagnosis::areCollinear(mesh_.positions[a], mesh_.positions[b], mesh_.positions[c]);
  }

 private:
  void leaveOut(std::uint32_t t) {
    neighbours_.remove(t);
    isGone_[t] = 1;
    ++draft_.counts.degenerateTriangles;
  }

  void mend(std::uint32_t t) {
    const Triangle corners = mesh_.triangles[t];
    if (hasRepeat(corners)) return leaveOut(t);
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = corners[i], b = corners[(i + 1) % 3];
      if (mesh_.positions[a] == mesh_.positions[b]) return join(std::min(a, b), std::max(a, b));
    }
    splitBeyond(t);
  }

  /// Replaces `gone` by `kept`, which is at the same position.
  void join(std::uint32_t kept, std::uint32_t gone) {
    const std::vector<std::uint32_t> between = neighbours_.atEdge(kept, gone);
    std::vector<std::uint32_t> apexes, common;
    for (const std::uint32_t t : between)
      for (const std::uint32_t v : mesh_.triangles[t])
        if (v != kept && v != gone) apexes.push_back(v);
    std::ranges::sort(apexes);
    apexes.erase(std::unique(apexes.begin(), apexes.end()), apexes.end());
    const auto u = neighbours_.around(kept), w = neighbours_.around(gone);
    std::ranges::set_intersection(u, w, std::back_inserter(common));
    if (common != apexes) return;
    for (const std::uint32_t t : between) leaveOut(t);
    const std::vector<std::uint32_t> moved = neighbours_.at(gone);
    for (const std::uint32_t t : moved) {
      neighbours_.remove(t);
      std::ranges::replace(mesh_.triangles[t], gone, kept);
      neighbours_.add(t);
      if (isDegenerate(t)) pending_.push_back(t);
    }
    ++draft_.counts.joinedVertices;
  }

  void splitBeyond(std::uint32_t t) {
    const Triangle corners = mesh_.triangles[t];
    std::size_t inner = 0;  // the corner between the two others
    double longest = -1;
    for (std::size_t i = 0; i < 3; ++i) {
      const double side = norm(mesh_.positions[corners[(i + 1) % 3]] - mesh_.positions[corners[(i + 2) % 3]]);
      if (side > longest) {
        longest = side;
        inner = i;
      }
    }
    const std::uint32_t c = corners[inner], a = corners[(inner + 1) % 3], b = corners[(inner + 2) % 3];
    std::vector<std::uint32_t> beyond = neighbours_.atEdge(a, b);
    std::erase(beyond, t);
    for (const std::uint32_t u : beyond) {
      const std::uint32_t d = apexOf(u, a, b);
      if (d == c) {  // the same three vertices again: the two are a pocket of no width
        leaveOut(t);
        leaveOut(u);
        return;
      }
      if (!neighbours_.atEdge(c, d).empty()) return;
    }
    leaveOut(t);
    for (const std::uint32_t u : beyond) split(u, a, b, c);
  }

  std::uint32_t apexOf(std::uint32_t t, std::uint32_t a, std::uint32_t b) const {
    for (const std::uint32_t v : mesh_.triangles[t])
      if (v != a && v != b) return v;
    return a;
  }

  /// Splits a triangle at a vertex inside its side a-b.
  void split(std::uint32_t t, std::uint32_t a, std::uint32_t b, std::uint32_t inside) {
    const Triangle whole = mesh_.triangles[t];
    neighbours_.remove(t);
    std::ranges::replace(mesh_.triangles[t], b, inside);
    neighbours_.add(t);
    draft_.addTriangle(whole, t);
    std::ranges::replace(mesh_.triangles.back(), a, inside);
    isGone_.push_back(0);
    ++draft_.counts.splitTriangles;
    const auto added = static_cast<std::uint32_t>(mesh_.triangles.size() - 1);
    neighbours_.add(added);
    for (const std::uint32_t part : {t, added})
      if (isDegenerate(part)) pending_.push_back(part);
  }

  Draft& draft_;
  TriangleMesh& mesh_;
  Neighbourhood neighbours_;
  std::vector<std::uint8_t> isGone_;  // by triangle
  std::deque<std::uint32_t> pending_;
};

}  // namespace

void removeDegenerate(Draft& draft) {
  // Triangles with a vertex twice need nothing of their neighbours.
  std::vector<std::uint8_t> isGone(draft.mesh.triangles.size(), 0);
  for (std::size_t t = 0; t < isGone.size(); ++t) {
    isGone[t] = hasRepeat(draft.mesh.triangles[t]) ? 1 : 0;
    draft.counts.degenerateTriangles += isGone[t];
  }
  draft.removeTriangles(isGone);

  std::vector<std::uint32_t> degenerate;
  for (std::uint32_t t = 0; t < draft.mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = draft.mesh.triangles[t];
    const auto& p = draft.mesh.positions;
    if (diagnosis::areCollinear(p[a], p[b], p[c])) degenerate.push_back(t);
  }
  if (!degenerate.empty()) DegeneratePass(draft).run(std::move(degenerate));
}

}  // namespace arete::repair_passes
