// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace arete {

/// Confines GDAL to some files, for the rest of the process: for services that read files of strangers. A
/// VRT, an XML of a web service, an external mask can otherwise name any file and host.
///
/// What can be read then: the named files; files beside one of them whose names begin with its name up to the
/// extension (sidecars); the data directories of GDAL and PROJ. What can be written: files in the folders of
/// the named files. A symbolic link counts as what it leads to. Formats that refer to other files or hosts,
/// or are read by libraries with input of their own, are not read. There is no network.
/// docs/topics/services.md.
///
/// @param names Files that a person named, inputs and outputs; they need not exist. Archives may be named by
/// GDAL's paths ("/vsizip/a.zip/b.tif").
///
/// Errors: unreadable: a named file is a link to another folder. Call it once, before GDAL opens anything.
Status confineGdal(const std::vector<std::string>& names);

/// The local file of a name: of a path in an archive ("/vsizip/a.zip/b.tif") the archive, else the name
/// itself. Empty for another path of GDAL's virtual file systems.
std::string localFileOf(const std::string& name);

/// Whether confineGdal() was called.
bool gdalIsConfined() noexcept;

/// Whether a file may be read: any, unless confineGdal() was called. For readers that open the files that a
/// file names without GDAL.
bool mayRead(const std::filesystem::path& file);

}  // namespace arete
