// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace arete {

/// Whether PROJ should open a file: one in its data directories, or one that allowProjFiles() names, and no
/// pipe or device. The text of a CRS in any file that GDAL reads can name others (+init=/path, +nadgrids=,
/// +geoidgrids=, PARAMETERFILE). For a program that stands between PROJ and its files. Thread-safe.
bool projMayOpen(const char* name);

/// Lets PROJ open the files that a text names, by the names that stand in it. For texts that a person wrote.
/// Thread-safe.
void allowProjFiles(const std::string& text);

/// Finds what the text of a CRS names outside PROJ's data directories: the path or address of a grid, of an
/// initialisation file, of a parameter file.
///
/// @return The name; empty where there is none.
std::string fileNamedBy(const std::string& crsText);

}  // namespace arete
