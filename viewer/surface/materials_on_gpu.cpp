// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/surface/materials_on_gpu.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <map>
#include <set>
#include <string_view>
#include <tuple>

#include "io/files/text_scan.h"
#include "io/formats/common/picture_pixels.h"
#include "io/formats/common/pictures.h"

namespace arete {
namespace {

struct PictureRole {
  DrawnPicture::Role role;
  std::initializer_list<std::string_view> names;  // as glTF and MTL have them
  bool isColor;
};
const std::array<PictureRole, DrawnPicture::count> kPictureRoles{{
    {DrawnPicture::color, {"baseColor", "map_Kd"}, true},
    {DrawnPicture::metalAndRoughness, {"metallicRoughness"}, false},
    {DrawnPicture::normal, {"normal", "norm"}, false},
    {DrawnPicture::occlusion, {"occlusion"}, false},
    {DrawnPicture::emission, {"emissive", "map_Ke"}, true},
    {DrawnPicture::opacity, {"map_d"}, false},
}};

/// Colours with alpha multiplied in, in proportion to light: what is between two of them has the colour of
/// what is seen alone.
void multiplyAlphaIn(PicturePixels& picture) {
  std::array<double, 256> linear{};
  for (std::size_t i = 0; i < linear.size(); ++i) {
    const double c = double(i) / 255;
    linear[i] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  }
  for (auto& pixel : picture.rgba) {
    if (pixel[3] == 255) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const double x = linear[pixel[c]] * pixel[3] / 255;
      pixel[c] = std::uint8_t(
          std::lround(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055)));
    }
  }
}

GLint wrapOf(PictureLookup::Wrap wrap) {
  return wrap == PictureLookup::Wrap::clamp    ? GL_CLAMP_TO_EDGE
         : wrap == PictureLookup::Wrap::mirror ? GL_MIRRORED_REPEAT
                                               : GL_REPEAT;
}

/// @param isColor whether its numbers are sRGB.
GlTexture textureOf(const PicturePixels& picture, bool isColor, const PictureLookup& lookup) {
  GlTexture texture = makeTexture(GL_TEXTURE_2D);
  const auto levels = lookup.hasLevels ? GLsizei(std::bit_width(std::max(picture.width, picture.height))) : 1;
  glTextureStorage2D(texture, levels, isColor ? GL_SRGB8_ALPHA8 : GL_RGBA8, GLsizei(picture.width),
                     GLsizei(picture.height));
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(texture, 0, 0, 0, GLsizei(picture.width), GLsizei(picture.height), GL_RGBA,
                      GL_UNSIGNED_BYTE, picture.rgba.data());
  if (lookup.hasLevels) glGenerateTextureMipmap(texture);
  const bool isNearestFar = lookup.isNearestFar;
  glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER,
                      lookup.hasLevels ? (isNearestFar ? GL_NEAREST_MIPMAP_LINEAR : GL_LINEAR_MIPMAP_LINEAR)
                                       : (isNearestFar ? GL_NEAREST : GL_LINEAR));
  glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, lookup.isNearest ? GL_NEAREST : GL_LINEAR);
  glTextureParameteri(texture, GL_TEXTURE_WRAP_S, wrapOf(lookup.acrossU));
  glTextureParameteri(texture, GL_TEXTURE_WRAP_T, wrapOf(lookup.acrossV));
  return texture;
}

bool hasColors(const MeshAttributes& attributes) {
  const auto isColor = [](const Attribute& a) { return a.meaning == AttributeMeaning::color; };
  return std::ranges::any_of(attributes.vertexAttributes, isColor) ||
         std::ranges::any_of(attributes.wedgeAttributes, isColor);
}

/// What is not stated has other values in glTF than elsewhere.
bool isOfGltf(const SurfaceModel& model) {
  const std::string extension = text::lowerExtension(model.source);
  return extension == "glb" || extension == "gltf";
}

bool hasGltfStatements(const Material& material) {
  return std::ranges::any_of(material.verbatim,
                             [](const auto& kept) { return kept.first.starts_with("gltf"); });
}

bool isBlack(const glm::vec4& color) {
  return color.x == 0 && color.y == 0 && color.z == 0;
}

}  // namespace

MaterialsOnGpu MaterialsOnGpu::load(const SurfaceModel& model) {
  MaterialsOnGpu gpu;
  const PictureSource source(model.attributes, {});
  GLint mostSide = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &mostSide);
  // By the picture's name, whether it is of colours, with alpha multiplied in, and how it is looked up; 0: it
  // cannot be shown.
  std::map<std::tuple<std::string, bool, bool, int>, GLuint> textures;
  std::set<std::string> notShown;
  const auto textureFor = [&](const TextureUse& use, bool isColor, bool hasAlphaIn,
                              const PictureLookup& lookup) -> GLuint {
    const int sampling = int(lookup.acrossU) + 3 * int(lookup.acrossV) + 9 * int(lookup.isNearest) +
                         18 * int(lookup.isNearestFar) + 36 * int(lookup.hasLevels);
    const std::tuple key(use.picture, isColor, hasAlphaIn, sampling);
    if (const auto known = textures.find(key); known != textures.end()) return known->second;
    GLuint& name = textures[key];
    if (notShown.contains(use.picture)) return 0;
    const Result<PictureBytes> bytes = source.read(use.picture);
    Result<PicturePixels> pixels = bytes ? decodePicture(bytes->bytes, std::uint32_t(mostSide))
                                         : Result<PicturePixels>(tl::unexpected(bytes.error()));
    if (!pixels) {
      gpu.warnings_.push_back(
          {WarningCode::display, fmt::format("the picture {} is not shown: {}",
                                             bytes ? bytes->name : use.picture, pixels.error().message)});
      notShown.insert(use.picture);
      return 0;
    }
    if (hasAlphaIn) multiplyAlphaIn(*pixels);
    name = gpu.textures_.emplace_back(textureOf(*pixels, isColor, lookup));
    return name;
  };
  for (const Material& material : model.attributes.materials) {
    DrawnMaterial& drawn = gpu.materials_.emplace_back();
    const auto& c = material.baseColor;
    drawn.baseColor = {float(c[0]), float(c[1]), float(c[2]), float(c[3])};
    drawn.isDoubleSided = material.isDoubleSided;
    drawn.alpha = material.alphaMode == "MASK"    ? DrawnMaterial::Alpha::masked
                  : material.alphaMode == "BLEND" ? DrawnMaterial::Alpha::blended
                                                  : DrawnMaterial::Alpha::opaque;
    drawn.alphaCutoff = float(material.alphaCutoff);
    drawn.finish = finishOf(material, isOfGltf(model) || hasGltfStatements(material));
    const TextureUse* const colors = textureOfRole(material, kPictureRoles[DrawnPicture::color].names);
    for (const PictureRole& role : kPictureRoles) {
      const TextureUse* const use = textureOfRole(material, role.names);
      if (!use) continue;
      // A picture of colours and opacity: its alpha counts already.
      if (role.role == DrawnPicture::opacity && colors && colors->picture == use->picture) continue;
      DrawnPicture& picture = drawn.pictures[role.role];
      picture.lookup = lookupOf(material, *use);
      const bool hasAlphaIn = role.role == DrawnPicture::color && drawn.alpha != DrawnMaterial::Alpha::opaque;
      picture.texture = textureFor(*use, role.isColor, hasAlphaIn, picture.lookup);
      if (picture.texture == 0 && role.role == DrawnPicture::emission) drawn.finish.emission = {};
    }
    // Exporters write MTL files with a black Kd beside the picture that is meant instead of it.
    if (drawn.pictures[DrawnPicture::color].texture != 0 && colors->role == "map_Kd" &&
        isBlack(drawn.baseColor))
      drawn.baseColor = {1, 1, 1, drawn.baseColor.w};
  }
  DrawnMaterial none;
  if (!hasColors(model.attributes)) none.baseColor = kUncolored;
  gpu.materials_.push_back(none);
  return gpu;
}

}  // namespace arete
