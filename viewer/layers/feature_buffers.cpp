// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/layers/feature_buffers.h"

#include <array>
#include <span>

namespace arete {
FeatureBuffers uploadFeatures(const GroundFeatures& features, const DrawnPlace& place) {
  FeatureBuffers buffers;
  std::vector<std::array<float, 4>> vertices;
  vertices.reserve(features.vertices.size() + 3);
  vertices.push_back({});
  for (std::uint64_t line = 0; line < features.lines(); ++line)
    for (std::uint64_t i = features.begin[line]; i < features.begin[line + 1]; ++i) {
      const Vec3 p = place(features.vertices[i].xy, features.vertices[i].height);
      const bool isThere = isFinite(p);
      // An edge to a place that cannot be drawn is left out.
      if (!isThere) vertices.back()[3] = 0;
      const bool isJoined = isThere && i + 1 < features.begin[line + 1];
      vertices.push_back(isThere
                             ? std::array<float, 4>{float(p.x), float(p.y), float(p.z), isJoined ? 1.f : 0.f}
                             : std::array<float, 4>{});
    }
  vertices.push_back({});
  vertices.push_back({});
  buffers.lineVertices = std::uint32_t(features.vertices.size());
  buffers.lines = makeBuffer(std::span<const std::array<float, 4>>(vertices));

  std::vector<std::array<float, 3>> anchors;
  const bool isKept = !features.labels.empty() || features.points.size() <= FeatureBuffers::kMostKeptFree;
  const auto add = [&](const GroundFeatures::Place& at) {
    const Vec3 p = place(at.xy, at.height);
    // Not a number is outside of every picture.
    anchors.push_back({float(p.x), float(p.y), float(p.z)});
    if (isKept) buffers.anchorPlaces.push_back(p);
  };
  for (const auto& point : features.points) add(point);
  for (const auto& label : features.labels) add(label.at);
  buffers.points = std::uint32_t(features.points.size());
  buffers.labels = std::uint32_t(features.labels.size());
  buffers.anchors = makeBuffer(std::span<const std::array<float, 3>>(anchors));
  buffers.seen = makeBuffer(anchors.size() * sizeof(std::uint32_t));
  return buffers;
}

}  // namespace arete
