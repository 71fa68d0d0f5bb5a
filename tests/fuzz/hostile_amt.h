// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace arete::fuzz {

/// Writes .amt files of small models in which numbers have been changed so that all checksums are right:
/// vertices moved onto others or far away, heights and errors of any size, spheres, indices, sizes and texts
/// of the metadata, a CRS that names files. The same seed gives the same files.
///
/// @return The files, by name: "017 points in a circle, plan.amt".
std::vector<std::filesystem::path> writeHostileAmts(const std::filesystem::path& folder, std::size_t count,
                                                    std::uint64_t seed);

}  // namespace arete::fuzz
