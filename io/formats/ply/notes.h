// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace arete {

/// What a comment says of properties whose names alone do not say which attribute they are: "comment
/// attribute vertex tangent 4 tangent". Vertices have `components` scalars, "tangent_0" to "tangent_3", if
/// there is more than one; faces and corners have a list. Arete's own convention.
struct PlyNote {
  std::string element;   ///< "vertex", "face" or "corner"
  std::string property;  ///< a word
  std::uint8_t components = 1;
  bool isNormalized = false;  ///< Attribute::isNormalized; an "n" behind the number
  std::string name;           ///< of the attribute
};

/// @param comment The text behind "comment ".
std::optional<PlyNote> plyNoteOf(std::string_view comment);
std::string plyComment(const PlyNote& note);

/// The picture of a comment "TextureFile NAME", as MeshLab and others write it: a path that may have blanks.
/// The word counts in either case, as CloudCompare once wrote it.
std::optional<std::string> plyTextureFile(std::string_view comment);

/// The name of the material that a picture stands for: that of the file, without folder and extension.
std::string plyMaterialName(std::string_view picture);

}  // namespace arete
