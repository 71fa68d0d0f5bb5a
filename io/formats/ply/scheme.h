// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/formats/ply/header.h"
#include "io/formats/ply/notes.h"
#include "surface/model/attribute.h"

namespace arete {

/// What is done with the values of a property.
struct PlyRole {
  enum class Kind : std::uint8_t {
    skip,
    x,
    y,
    z,
    indices,        ///< list of the vertices of a face or of strips
    error,          ///< of a face
    textureNumber,  ///< of a face: which of the pictures
    number,         ///< a component of an attribute
    list,           ///< an attribute of as many components as the list has values, the same in every record
    cornerList,     ///< an attribute of the corners of a face
  };
  Kind kind = Kind::skip;
  std::uint32_t attribute = 0;  ///< which; of a corner list, which of PlyScheme::corners
  std::uint32_t offset = 0;     ///< in bytes, of a component
};

/// What the properties of an element mean: a role for each, and the attributes that they make up, without
/// values. The components of attributes of corners and lists are 0 where the records say how many there are.
struct PlyScheme {
  std::vector<PlyRole> roles;
  std::vector<Attribute> attributes, corners;
  std::size_t leftOut = 0;  ///< properties beyond the number that is read

  std::size_t count(PlyRole::Kind kind) const;
};

/// Properties that belong together become one attribute if they are of one type that can have that meaning:
/// nx ny nz a normal, red green blue (alpha) a color, s t or u v or texture_u texture_v texture coordinates;
/// others by `notes`. Every other property keeps its name; a name that repeats gets a number.
///
/// @param notes of any element.
PlyScheme vertexScheme(const PlyElement& element, const std::vector<PlyNote>& notes);
/// The same for faces.
/// @param withTextures "texnumber" says which picture.
/// @param withAttributes false: the corners and nothing else is read.
PlyScheme faceScheme(const PlyElement& element, const std::vector<PlyNote>& notes, bool withTextures,
                     bool withAttributes);
PlyScheme stripScheme(const PlyElement& element);

/// The meaning that an attribute has by its name and its components: "color1" of three is a colour.
void giveMeaning(Attribute& attribute);

}  // namespace arete
