// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/surface/materials_on_gpu.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>

#include "io/formats/common/picture_pixels.h"
#include "io/formats/common/pictures.h"

namespace arete {
namespace {

/// The picture of a material's colours, as glTF and MTL name it.
const TextureUse* colorsOf(const Material& material) {
  for (const char* role : {"baseColor", "map_Kd"}) {
    const auto found = std::ranges::find(material.textures, role, &TextureUse::role);
    if (found != material.textures.end()) return &*found;
  }
  return nullptr;
}

GlTexture textureOf(const PicturePixels& picture) {
  GlTexture texture = makeTexture(GL_TEXTURE_2D);
  const auto levels = GLsizei(std::bit_width(std::max(picture.width, picture.height)));
  glTextureStorage2D(texture, levels, GL_SRGB8_ALPHA8, GLsizei(picture.width), GLsizei(picture.height));
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(texture, 0, 0, 0, GLsizei(picture.width), GLsizei(picture.height), GL_RGBA,
                      GL_UNSIGNED_BYTE, picture.rgba.data());
  glGenerateTextureMipmap(texture);
  glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_REPEAT);
  return texture;
}

/// Of what no material is said: so that light and shade are seen on it.
constexpr glm::vec4 kGrey{0.72f, 0.71f, 0.69f, 1};

bool hasColors(const MeshAttributes& attributes) {
  const auto isColor = [](const Attribute& a) { return a.meaning == AttributeMeaning::color; };
  return std::ranges::any_of(attributes.vertexAttributes, isColor) ||
         std::ranges::any_of(attributes.wedgeAttributes, isColor);
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
  std::map<std::string, GLuint> textures;  // by the picture's name; 0: it cannot be shown
  const auto textureFor = [&](const TextureUse& use) -> GLuint {
    if (const auto known = textures.find(use.picture); known != textures.end()) return known->second;
    GLuint& name = textures[use.picture];
    const Result<PictureBytes> bytes = source.read(use.picture);
    const Result<PicturePixels> pixels = bytes ? decodePicture(bytes->bytes, std::uint32_t(mostSide))
                                               : Result<PicturePixels>(tl::unexpected(bytes.error()));
    if (!pixels) {
      gpu.warnings_.push_back(
          {WarningCode::display, fmt::format("the picture {} is not shown: {}",
                                             bytes ? bytes->name : use.picture, pixels.error().message)});
      return 0;
    }
    name = gpu.textures_.emplace_back(textureOf(*pixels));
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
    if (const TextureUse* colors = colorsOf(material)) {
      drawn.texture = textureFor(*colors);
      drawn.textureCoords = std::min(colors->textureCoords, 1u);
      // Exporters write MTL files with a black Kd beside the picture that is meant instead of it.
      if (drawn.texture != 0 && colors->role == "map_Kd" && isBlack(drawn.baseColor))
        drawn.baseColor = {1, 1, 1, drawn.baseColor.w};
    }
  }
  DrawnMaterial none;
  if (!hasColors(model.attributes)) none.baseColor = kGrey;
  gpu.materials_.push_back(none);
  return gpu;
}

}  // namespace arete
