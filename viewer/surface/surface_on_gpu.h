// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "viewer/fronts/drawn_vertices.h"
#include "viewer/fronts/own_vertices.h"
#include "viewer/gl/gl_objects.h"

namespace arete {

/// Where the attributes of vertices lie in graphics memory: see DrawnVertices.
struct VertexStreams {
  struct Stream {
    GLuint buffer = 0;  ///< 0: the surface has none
    GLintptr first = 0;
    GLsizei stride = 0;
  };
  Stream positions, normals, smoothNormals, textureCoords, colors;
};

/// The vertices of a surface in graphics memory: uploaded once and indexed by every cut.
struct SurfaceOnGpu {
  GlBuffer positions, normals, smoothNormals, textureCoords, colors;

  VertexStreams streams() const;
};

SurfaceOnGpu uploadSurface(const DrawnVertices& drawn);

/// Those of a buffer of OwnVertex, with what the surface has.
VertexStreams streamsOf(GLuint ownVertices, const SurfaceOnGpu& surface);

}  // namespace arete
