// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each triangle is cut by itself (box_clip.h); vertices, wedges and attributes of what is left are gathered
// afterwards. An outline is split into triangles from the corner from which the smallest of them is largest.
#include "surface/edit/crop.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <tuple>
#include <utility>

#include "engine/base/caught_failure.h"
#include "surface/edit/box_clip.h"
#include "surface/edit/unused.h"
#include "surface/model/average.h"
#include "surface/model/labels.h"

namespace arete {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// The corner of a convex outline with which to begin a fan.
std::size_t bestApex(const BoxClip& clip, const std::vector<std::uint32_t>& outline) {
  const std::size_t n = outline.size();
  std::size_t best = 0;
  double largest = -1;
  for (std::size_t apex = 0; apex < n; ++apex) {
    double least = std::numeric_limits<double>::infinity();
    const Vec3& a = clip.positionOf(outline[apex]);
    for (std::size_t i = 1; i + 1 < n; ++i)
      least = std::min(least, norm(cross(clip.positionOf(outline[(apex + i) % n]) - a,
                                         clip.positionOf(outline[(apex + i + 1) % n]) - a)));
    if (least > largest) {
      largest = least;
      best = apex;
    }
  }
  return best;
}

class Crop {
 public:
  Crop(const SurfaceMesh& mesh, const Box3& box, const CropOptions& options)
      : mesh_(mesh), options_(options), clip_(mesh.positions, box), box_(box) {}

  // Cancelling is looked for at intervals only, since most triangles take little time.
  Status run(const RunContext& context) {
    context.report("crop", 0);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (t % 65536 == 0) {
        if (context.cancelled()) return failure(ErrorCode::interrupted, "the crop was interrupted");
        context.report("crop", double(t) / double(mesh_.triangles.size()));
      }
      take(t);
    }
    context.report("crop", 1);
    return {};
  }

  bool isEmpty() const { return triangles_.empty(); }

  // The order matters: the numbers of vertices come first, then what refers to them, and the names that are
  // left without a triangle go last.
  CroppedMesh finish() {
    CroppedMesh cropped;
    SurfaceMesh& to = cropped.mesh;
    numberVertices(cropped);
    addWedges(to);
    for (const Attribute& attribute : mesh_.vertexAttributes)
      to.vertexAttributes.push_back(gatheredAtVertices(attribute, cropped.vertexOf));
    for (const Attribute& attribute : mesh_.triangleAttributes) {
      Attribute& kept = to.triangleAttributes.emplace_back(emptyLike(attribute));
      for (const std::uint32_t t : triangleOf_) kept.append(attribute.element(t));
    }
    const auto carry = [&](const std::vector<std::uint32_t>& from, std::vector<std::uint32_t>& kept) {
      if (!from.empty())
        for (const std::uint32_t t : triangleOf_) kept.push_back(from[t]);
    };
    carry(mesh_.objectOf, to.objectOf);
    carry(mesh_.groupOf, to.groupOf);
    carry(mesh_.materialOf, to.materialOf);
    to.objects = mesh_.objects;
    to.groups = mesh_.groups;
    to.materials = mesh_.materials;
    to.pictures = mesh_.pictures;
    removeUnusedNames(to);
    cropped.triangleOf = std::move(triangleOf_);
    cropped.cutTriangles = cutTriangles_;
    return cropped;
  }

 private:
  // Most triangles are wholly outside or inside, which their boxes decide without cutting.
  void take(std::uint32_t t) {
    const Triangle& triangle = mesh_.triangles[t];
    Vec3 low = mesh_.positions[triangle[0]], high = low;
    for (const std::uint32_t v : triangle) {
      const Vec3& p = mesh_.positions[v];
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const Vec3 &l = box_.low, &h = box_.high;
    if (high.x < l.x || high.y < l.y || high.z < l.z || low.x > h.x || low.y > h.y || low.z > h.z) return;
    if (low.x >= l.x && low.y >= l.y && low.z >= l.z && high.x <= h.x && high.y <= h.y && high.z <= h.z)
      return add(triangle, t);
    bool touches = false;
    const std::vector<std::uint32_t>& outline = clip_.clip(triangle, touches);
    // Whole triangles are kept where any part of them, be it a corner, lies in the box; nothing is cut then.
    if (options_.keepsWhole) {
      if (touches) add(triangle, t);
      return;
    }
    if (outline.empty()) return;
    ++cutTriangles_;
    const std::size_t apex = bestApex(clip_, outline), n = outline.size();
    for (std::size_t i = 1; i + 1 < n; ++i)
      add({outline[apex], outline[(apex + i) % n], outline[(apex + i + 1) % n]}, t);
  }

  void add(const Triangle& triangle, std::uint32_t from) {
    triangles_.push_back(triangle);
    triangleOf_.push_back(from);
  }

  // Vertices of cuts are numbered behind the mesh's own ones.
  bool isCut(std::uint32_t vertex) const { return vertex >= mesh_.positions.size(); }
  const BoxClip::Cut& cutOf(std::uint32_t vertex) const {
    return clip_.cuts()[vertex - mesh_.positions.size()];
  }

  /// Positions and triangles; cuts that later ones have removed are left out.
  void numberVertices(CroppedMesh& cropped) {
    std::vector<std::uint32_t> numberOf(mesh_.positions.size() + clip_.cuts().size(), SurfaceMesh::kNone);
    for (const Triangle& triangle : triangles_)
      for (const std::uint32_t v : triangle) numberOf[v] = 0;
    for (std::uint32_t v = 0; v < numberOf.size(); ++v) {
      if (numberOf[v] == SurfaceMesh::kNone) continue;
      numberOf[v] = static_cast<std::uint32_t>(sourceOf_.size());
      sourceOf_.push_back(v);
      cropped.mesh.positions.push_back(clip_.positionOf(v));
      cropped.vertexOf.push_back(isCut(v) ? SurfaceMesh::kNone : v);
      cropped.cutVertices += isCut(v) ? 1 : 0;
    }
    cropped.mesh.triangles = triangles_;
    for (Triangle& triangle : cropped.mesh.triangles)
      for (std::uint32_t& v : triangle) v = numberOf[v];
  }

  Attribute gatheredAtVertices(const Attribute& from, const std::vector<std::uint32_t>& vertexOf) const {
    Attribute to = emptyLike(from);
    const bool isOfLabels = isLabel(from);
    for (std::size_t v = 0; v < vertexOf.size(); ++v)
      if (vertexOf[v] != SurfaceMesh::kNone)
        to.append(from.element(vertexOf[v]));
      else
        appendAverage(to, from, cutOf(sourceOf_[v]).vertices, cutOf(sourceOf_[v]).weights, isOfLabels);
    return to;
  }

  /// Wedges keep their order; those of cuts follow. Cuts of one vertex between the same wedges share one.
  void addWedges(SurfaceMesh& to) {
    if (!mesh_.hasWedges()) return;
    std::vector<bool> areLabels;
    for (const Attribute& attribute : mesh_.wedgeAttributes) areLabels.push_back(isLabel(attribute));
    std::vector<std::uint32_t> numberOf(mesh_.wedgeCount, SurfaceMesh::kNone);
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      for (const std::uint32_t v : triangles_[t])
        if (!isCut(v)) numberOf[wedgeAt(triangleOf_[t], v)] = 0;
    for (std::uint32_t w = 0; w < numberOf.size(); ++w)
      if (numberOf[w] != SurfaceMesh::kNone) {
        numberOf[w] = to.wedgeCount++;
        for (std::size_t a = 0; a < mesh_.wedgeAttributes.size(); ++a) {
          if (a == to.wedgeAttributes.size())
            to.wedgeAttributes.push_back(emptyLike(mesh_.wedgeAttributes[a]));
          to.wedgeAttributes[a].append(mesh_.wedgeAttributes[a].element(w));
        }
      }
    for (std::size_t a = to.wedgeAttributes.size(); a < mesh_.wedgeAttributes.size(); ++a)
      to.wedgeAttributes.push_back(emptyLike(mesh_.wedgeAttributes[a]));
    to.wedges.resize(triangles_.size());
    std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t> cutWedges;
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t v = triangles_[t][i], from = triangleOf_[t];
        if (!isCut(v)) {
          to.wedges[t][i] = numberOf[wedgeAt(from, v)];
          continue;
        }
        const BoxClip::Cut& cut = cutOf(v);
        std::array<std::uint32_t, 3> wedges{};
        for (std::size_t k = 0; k < 3; ++k) wedges[k] = wedgeAt(from, cut.vertices[k]);
        const auto [found, isNew] =
            cutWedges.try_emplace({v, wedges[0], wedges[1], wedges[2]}, to.wedgeCount);
        to.wedges[t][i] = found->second;
        if (!isNew) continue;
        ++to.wedgeCount;
        for (std::size_t a = 0; a < to.wedgeAttributes.size(); ++a)
          appendAverage(to.wedgeAttributes[a], mesh_.wedgeAttributes[a], wedges, cut.weights, areLabels[a]);
      }
  }

  std::uint32_t wedgeAt(std::uint32_t triangle, std::uint32_t vertex) const {
    const Triangle& corners = mesh_.triangles[triangle];
    const std::size_t i = corners[0] == vertex ? 0 : corners[1] == vertex ? 1 : 2;
    return mesh_.wedges[triangle][i];
  }

  const SurfaceMesh& mesh_;
  const CropOptions& options_;
  BoxClip clip_;
  const Box3& box_;
  std::vector<Triangle> triangles_;  // vertices of the source, and behind them the cuts
  std::vector<std::uint32_t> triangleOf_, sourceOf_;
  std::uint64_t cutTriangles_ = 0;
};

/// "x 0 to 1, y 0 to 2, z 0 to 3", of the vertices that triangles use.
std::string extentOf(const SurfaceMesh& mesh) {
  Box3 box;
  std::swap(box.low, box.high);
  for (const Triangle& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) {
      const Vec3& p = mesh.positions[v];
      box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
      box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
    }
  return fmt::format("x {:.9g} to {:.9g}, y {:.9g} to {:.9g}, z {:.9g} to {:.9g}", box.low.x, box.high.x,
                     box.low.y, box.high.y, box.low.z, box.high.z);
}

Status checkBox(const Box3& box) {
  const auto isWrong = [](double low, double high) { return !(low < high); };
  if (isWrong(box.low.x, box.high.x) || isWrong(box.low.y, box.high.y) || isWrong(box.low.z, box.high.z))
    return failure(ErrorCode::usage, "each lower bound must be below the upper one: x0,y0,z0,x1,y1,z1",
                   "box");
  return {};
}

}  // namespace

Result<CroppedMesh> crop(const SurfaceMesh& mesh, const Box3& box, const CropOptions& options,
                         const RunContext& context) try {
  ARETE_CHECK(checkBox(box));
  ARETE_CHECK(mesh.validate());
  Crop work(mesh, box, options);
  ARETE_CHECK(work.run(context));
  if (work.isEmpty())
    return mesh.triangles.empty()
               ? failure(ErrorCode::invalidData, "the mesh has no triangles")
               : failure(
                     ErrorCode::usage,
                     fmt::format("no part of the mesh is in the box: the mesh is from {}", extentOf(mesh)),
                     "box");
  return work.finish();
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
