// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/vec.h"
#include "engine/mt/multitriangulation.h"
#include "surface/algebra/symmetric3.h"

namespace arete {

/// The least squares problem of directions d, one for each vertex of a multitriangulation: the sum over all
/// its triangles of (r - d(s))' M (r - d(s)), where d(s) is the mean of the directions of a triangle's
/// corners with the shares s; and of a small multiple of |d|^2.
///
/// Every edge of a multitriangulation leads from the vertex of a node to its link, but for those of the root.
/// So an edge is named by a slot, and the matrix has one block for each slot. 170 bytes a vertex.
class DirectionProblem {
 public:
  explicit DirectionProblem(const MultiTriangulation& mt);

  /// What the samples of a triangle add: blocks of corners 00, 11, 22, 01, 12, 20, and right sides.
  struct Part {
    Part() { blocks.fill(Symmetric3::Zero()); }

    std::array<Symmetric3, 6> blocks;
    Eigen::Matrix3d right = Eigen::Matrix3d::Zero();  ///< a column for each corner
    void add(const std::array<double, 3>& shares, const Symmetric3& metric, const Vec3& residual);
  };
  void add(const std::array<std::uint32_t, 3>& corners, const Part& part);

  /// The directions, by conjugate gradients with the diagonal blocks as preconditioner.
  std::vector<Vec3> solve() const;

 private:
  using Block = Symmetric3Of<float>;
  using RootEdge = std::array<std::uint32_t, 2>;

  Block& blockOf(std::uint32_t a, std::uint32_t b);
  void multiply(std::span<const Symmetric3> diagonal, const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& y) const;

  const MultiTriangulation& mt_;
  std::vector<Symmetric3> diagonal_;  // by vertex
  Eigen::Matrix3Xd right_;            // a column for each vertex
  std::vector<Block> ofSlot_;
  std::vector<RootEdge> rootEdges_;  // sorted, the lower vertex first
  std::vector<Block> ofRootEdge_;
};

}  // namespace arete
