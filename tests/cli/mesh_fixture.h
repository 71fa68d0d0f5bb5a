// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes as texts, for the commands of `arete mesh`.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "cli/cli_fixture.h"

namespace arete::cli_test {

class Meshes : public Cli {
 protected:
  static constexpr std::string_view kTetrahedron =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

  /// A text with something appended.
  static std::string plus(std::string_view text, std::string_view more) {
    return std::string(text) + std::string(more);
  }

  /// An ASCII PLY of vertices and faces, a line each.
  static std::string ply(int vertices, int faces, std::string_view lines, std::string_view properties = "") {
    return fmt::format(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double "
        "z\n{}"
        "element face {}\nproperty list uchar int vertex_indices\nend_header\n{}",
        vertices, properties, faces, lines);
  }

  bool says(const Outcome& outcome, std::string_view text) const {
    return (outcome.out + outcome.err).find(text) != std::string::npos;
  }
};

}  // namespace arete::cli_test
