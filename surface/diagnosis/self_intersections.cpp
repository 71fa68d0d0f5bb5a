// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pairs of triangles whose boxes meet [ZomorodianEdelsbrunner2000] are decided exactly
// (surface/topology/crossing.h). Two kinds of triangles would make as many such pairs as the square of their
// number, and are not listed so:
//
//   in one place     triangles with the same vertices, or with vertices of their own at the same positions,
//                    are one class. Any two of them cross, and each crosses what the first one does: only the
//                    first is examined, and pairs are counted by products.
//   at one vertex    of many triangles. Two that share a vertex cross where their directions from it do: the
//                    boxes are those of arcs on the sphere of directions, which are short. Only with other
//                    triangles are they compared by their own boxes.
#include <CGAL/Bbox_3.h>
#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "surface/diagnosis/parts.h"
#include "surface/topology/crossing.h"

namespace arete::diagnosis {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t,
                                                      CGAL::Box_intersection_d::ID_FROM_BOX_ADDRESS>;

struct Interrupted {};

/// Sets of at most so many boxes are scanned instead of divided further: triangles of a surface meet few
/// others.
constexpr std::ptrdiff_t kScanned = 2000;
/// A vertex of more triangles is a hub, and at most so many are.
constexpr std::uint32_t kHubTriangles = 128, kMostHubs = 64;

constexpr std::uint32_t kNoHub = std::numeric_limits<std::uint32_t>::max();

/// Pairs that are counted, the first of them kept.
class Found {
 public:
  explicit Found(std::size_t most) : most_(most) {}

  void count(std::uint64_t pairs) { result_.count += pairs; }
  /// Keeps a pair if it may be among the first. Pairs that are offered in increasing order need not be
  /// offered any further once one is refused.
  bool keep(const Pair& pair) {
    if (most_ == 0 || (isFull_ && pair > last_)) return false;
    result_.pairs.push_back(pair);
    if (most_ < kFewest && result_.pairs.size() > 2 * most_ + kFewest) cut();
    return true;
  }
  SelfIntersections finish() {
    std::ranges::sort(result_.pairs);
    if (result_.pairs.size() > most_) result_.pairs.resize(most_);
    return std::move(result_);
  }

 private:
  static constexpr std::size_t kFewest = 1 << 20;

  void cut() {
    const auto end = result_.pairs.begin() + std::ptrdiff_t(most_);
    std::nth_element(result_.pairs.begin(), end - 1, result_.pairs.end());
    last_ = *(end - 1);
    isFull_ = true;
    result_.pairs.erase(end, result_.pairs.end());
  }

  const std::size_t most_;
  bool isFull_ = false;
  Pair last_;
  SelfIntersections result_;
};

class Search {
 public:
  Search(const TriangleMesh& mesh, std::size_t most, const RunContext& context)
      : mesh_(mesh), most_(most), context_(context), found_(most) {}

  SelfIntersections run() {
    findClasses();
    countInPlace();
    findHubs();
    std::vector<std::uint32_t> rest;
    for (std::uint32_t c = 0; c < first_.size(); ++c)
      if (hubOf_[c] == kNoHub) rest.push_back(c);
    std::vector<Box> others = boxesOf(rest);
    withinSet(others);
    for (std::size_t hub = hubs_.size(); hub-- > 0;) {
      std::vector<Box> own = boxesOf(hubs_[hub].classes);
      betweenSets(own, others);
      atHub(hubs_[hub]);
      others.insert(others.end(), own.begin(), own.end());
    }
    return found_.finish();
  }

 private:
  struct Hub {
    std::uint32_t vertex;
    std::vector<std::uint32_t> classes;
  };

  /// The corners of a triangle by what makes them one with those of another: their vertices, or the positions
  /// of vertices that no other triangle has.
  using Key = std::array<std::uint64_t, 3>;

  void findClasses() {
    std::vector<std::uint32_t> uses(mesh_.positions.size(), 0);
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh_.triangles[t];
      if (areCollinear(mesh_.positions[a], mesh_.positions[b], mesh_.positions[c])) continue;
      triangles.push_back(t);
      for (const std::uint32_t v : mesh_.triangles[t]) ++uses[v];
    }
    std::vector<std::uint32_t> single;
    for (std::uint32_t v = 0; v < uses.size(); ++v)
      if (uses[v] == 1) single.push_back(v);
    const auto key = [&](std::uint32_t v) {
      const Vec3& p = mesh_.positions[v];
      return std::tuple(p.x + 0, p.y + 0, p.z + 0);  // -0 and 0 are one
    };
    std::ranges::sort(single, [&](std::uint32_t a, std::uint32_t b) {
      const auto ka = key(a), kb = key(b);
      return ka != kb ? ka < kb : a < b;
    });
    constexpr std::uint64_t kOfPosition = std::uint64_t{1} << 32;
    std::vector<std::uint64_t> label(mesh_.positions.size());
    std::iota(label.begin(), label.end(), std::uint64_t{0});
    for (std::size_t i = 0, begin = 0; i < single.size(); ++i) {
      if (key(single[i]) != key(single[begin])) begin = i;
      label[single[i]] = kOfPosition + single[begin];
    }
    std::vector<std::pair<Key, std::uint32_t>> keys;
    keys.reserve(triangles.size());
    for (const std::uint32_t t : triangles) {
      const auto& [a, b, c] = mesh_.triangles[t];
      Key k{label[a], label[b], label[c]};
      std::ranges::sort(k);
      keys.push_back({k, t});
    }
    std::ranges::sort(keys);
    for (std::size_t i = 0; i < keys.size(); ++i) {
      if (i == 0 || keys[i].first != keys[i - 1].first) {
        first_.push_back(static_cast<std::uint32_t>(members_.size()));
        hubOf_.push_back(kNoHub);
      }
      members_.push_back(keys[i].second);
    }
  }

  std::span<const std::uint32_t> membersOf(std::uint32_t c) const {
    const std::size_t end = c + std::size_t{1} < first_.size() ? first_[c + 1] : members_.size();
    return std::span(members_).subspan(first_[c], end - first_[c]);
  }
  std::uint32_t triangleOf(std::uint32_t c) const { return members_[first_[c]]; }

  void countInPlace() {
    for (std::uint32_t c = 0; c < first_.size(); ++c) {
      const auto members = membersOf(c);
      if (members.size() < 2) continue;
      check();
      found_.count(std::uint64_t{members.size()} * (members.size() - 1) / 2);
      std::size_t offered = 0;
      for (std::size_t i = 0; i < members.size() && offered < most_; ++i)
        for (std::size_t j = i + 1; j < members.size() && offered < most_; ++j, ++offered)
          if (!found_.keep({members[i], members[j]})) offered = most_;
    }
  }

  /// Each class is of the hub of the most triangles among its corners.
  void findHubs() {
    std::vector<std::uint32_t> uses(mesh_.positions.size(), 0);
    for (std::uint32_t c = 0; c < first_.size(); ++c)
      for (const std::uint32_t v : mesh_.triangles[triangleOf(c)]) ++uses[v];
    std::vector<std::uint32_t> order;
    for (std::uint32_t v = 0; v < uses.size(); ++v)
      if (uses[v] > kHubTriangles) order.push_back(v);
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
      return uses[a] != uses[b] ? uses[a] > uses[b] : a < b;
    });
    if (order.size() > kMostHubs) order.resize(kMostHubs);
    std::vector<std::uint32_t> rank(mesh_.positions.size(), kNoHub);
    for (const std::uint32_t v : order) {
      rank[v] = static_cast<std::uint32_t>(hubs_.size());
      hubs_.push_back({v, {}});
    }
    for (std::uint32_t c = 0; c < first_.size() && !hubs_.empty(); ++c) {
      for (const std::uint32_t v : mesh_.triangles[triangleOf(c)]) hubOf_[c] = std::min(hubOf_[c], rank[v]);
      if (hubOf_[c] != kNoHub) hubs_[hubOf_[c]].classes.push_back(c);
    }
  }

  std::vector<Box> boxesOf(const std::vector<std::uint32_t>& classes) const {
    std::vector<Box> boxes;
    boxes.reserve(classes.size());
    for (const std::uint32_t c : classes) {
      CGAL::Bbox_3 box;
      for (const std::uint32_t v : mesh_.triangles[triangleOf(c)]) {
        const Vec3& p = mesh_.positions[v];
        box += CGAL::Bbox_3(p.x, p.y, p.z, p.x, p.y, p.z);
      }
      boxes.emplace_back(box, c);
    }
    return boxes;
  }

  static std::vector<const Box*> pointersTo(const std::vector<Box>& boxes) {
    std::vector<const Box*> pointers;
    pointers.reserve(boxes.size());
    for (const Box& box : boxes) pointers.push_back(&box);
    return pointers;
  }

  void withinSet(const std::vector<Box>& boxes) {
    std::vector<const Box*> pointers = pointersTo(boxes);
    CGAL::box_self_intersection_d(
        pointers.begin(), pointers.end(), [&](const Box* a, const Box* b) { examine(a->info(), b->info()); },
        kScanned);
  }

  void betweenSets(const std::vector<Box>& some, const std::vector<Box>& others) {
    std::vector<const Box*> first = pointersTo(some), second = pointersTo(others);
    CGAL::box_intersection_d(
        first.begin(), first.end(), second.begin(), second.end(),
        [&](const Box* a, const Box* b) { examine(a->info(), b->info()); }, kScanned);
  }

  /// The pairs of triangles of a hub, by boxes of the arcs of their opposite sides as seen from it. An arc is
  /// no farther from its chord than its sagitta.
  void atHub(const Hub& hub) {
    const Vec3& eye = mesh_.positions[hub.vertex];
    std::vector<Box> boxes;
    boxes.reserve(hub.classes.size());
    for (const std::uint32_t c : hub.classes) {
      std::array<Vec3, 2> ends;
      std::size_t i = 0;
      for (const std::uint32_t v : mesh_.triangles[triangleOf(c)])
        if (v != hub.vertex) {
          const Vec3 way = mesh_.positions[v] - eye;
          ends[i++] = way / std::hypot(way.x, way.y, way.z);
        }
      const double cosine = dot(ends[0], ends[1]);
      constexpr double kRounding = 1e-12;
      const double sagitta = 1 - std::sqrt(std::max(0.0, (1 + cosine) / 2)) + kRounding;
      if (!std::isfinite(cosine)) {
        boxes.emplace_back(CGAL::Bbox_3(-2, -2, -2, 2, 2, 2), c);
        continue;
      }
      const auto low = [&](double a, double b) { return std::min(a, b) - sagitta; };
      const auto high = [&](double a, double b) { return std::max(a, b) + sagitta; };
      boxes.emplace_back(
          CGAL::Bbox_3(low(ends[0].x, ends[1].x), low(ends[0].y, ends[1].y), low(ends[0].z, ends[1].z),
                       high(ends[0].x, ends[1].x), high(ends[0].y, ends[1].y), high(ends[0].z, ends[1].z)),
          c);
    }
    withinSet(boxes);
  }

  PlacedTriangle placed(std::uint32_t c) const {
    const Triangle& v = mesh_.triangles[triangleOf(c)];
    return {v, {mesh_.positions[v[0]], mesh_.positions[v[1]], mesh_.positions[v[2]]}};
  }

  void examine(std::uint32_t a, std::uint32_t b) {
    check();
    // In the order of the triangles, as any other pair is examined.
    if (triangleOf(a) > triangleOf(b)) std::swap(a, b);
    if (!cross(placed(a), placed(b))) return;
    const auto s = membersOf(a), t = membersOf(b);
    found_.count(std::uint64_t{s.size()} * t.size());
    if (s.size() == 1 && t.size() == 1) {
      found_.keep({s[0], t[0]});
      return;
    }
    offerProduct(s, t);
  }

  /// Offers the pairs of two classes in increasing order, while they may be among the first.
  void offerProduct(std::span<const std::uint32_t> s, std::span<const std::uint32_t> t) {
    std::size_t i = 0, j = 0, offered = 0;
    while (offered < most_ && i < s.size() && j < t.size()) {
      const bool isOfS = s[i] < t[j];
      const std::uint32_t low = isOfS ? s[i++] : t[j++];
      for (const std::uint32_t high : isOfS ? t.subspan(j) : s.subspan(i)) {
        if (offered++ >= most_ || !found_.keep({low, high})) return;
      }
    }
  }

  void check() const {
    if (context_.cancelled()) throw Interrupted();
  }

  const TriangleMesh& mesh_;
  const std::size_t most_;
  const RunContext& context_;
  Found found_;
  std::vector<std::uint32_t> first_, members_;  // classes: their first members, the triangles of each
  std::vector<std::uint32_t> hubOf_;            // by class
  std::vector<Hub> hubs_;
};

}  // namespace

std::optional<SelfIntersections> countSelfIntersections(const TriangleMesh& mesh, std::size_t most,
                                                        const RunContext& context) {
  try {
    return Search(mesh, most, context).run();
  } catch (const Interrupted&) {
    return std::nullopt;
  }
}

std::optional<std::vector<Pair>> findSelfIntersections(const TriangleMesh& mesh, const RunContext& context) {
  auto found = countSelfIntersections(mesh, std::numeric_limits<std::size_t>::max(), context);
  if (!found) return std::nullopt;
  return std::move(found->pairs);
}

}  // namespace arete::diagnosis
