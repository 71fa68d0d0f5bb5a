// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/surface/surface_on_gpu.h"

#include <cstddef>

namespace arete {

SurfaceOnGpu uploadSurface(const DrawnVertices& drawn) {
  SurfaceOnGpu gpu;
  const auto upload = []<class T>(const std::vector<T>& data) {
    return makeBuffer(std::span<const T>(data));
  };
  gpu.positions = upload(drawn.positions);
  gpu.normals = upload(drawn.normals);
  if (!drawn.smoothNormals.empty()) gpu.smoothNormals = upload(drawn.smoothNormals);
  if (!drawn.textureCoords.empty()) gpu.textureCoords = upload(drawn.textureCoords);
  if (!drawn.colors.empty()) gpu.colors = upload(drawn.colors);
  return gpu;
}

VertexStreams SurfaceOnGpu::streams() const {
  VertexStreams all;
  all.positions = {positions, 0, 12};
  all.normals = {normals, 0, 12};
  all.smoothNormals = {smoothNormals, 0, 12};
  all.textureCoords = {textureCoords, 0, 16};
  all.colors = {colors, 0, 4};
  return all;
}

VertexStreams streamsOf(GLuint ownVertices, const SurfaceOnGpu& surface) {
  constexpr GLsizei stride = sizeof(OwnVertex);
  VertexStreams all;
  all.positions = {ownVertices, offsetof(OwnVertex, position), stride};
  all.normals = {ownVertices, offsetof(OwnVertex, normal), stride};
  if (surface.smoothNormals != 0)
    all.smoothNormals = {ownVertices, offsetof(OwnVertex, smoothNormal), stride};
  if (surface.textureCoords != 0)
    all.textureCoords = {ownVertices, offsetof(OwnVertex, textureCoords), stride};
  if (surface.colors != 0) all.colors = {ownVertices, offsetof(OwnVertex, color), stride};
  return all;
}

}  // namespace arete
