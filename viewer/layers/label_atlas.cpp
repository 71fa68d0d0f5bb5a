// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rows of texts of one height. A text is drawn by the canvas of pictures, white on black, and its red is the
// coverage.
#include "viewer/layers/label_atlas.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "viewer/picture/picture.h"

namespace arete {
namespace {

constexpr int kAtlasSide = 2048;
constexpr double kTextPixels = 15;
constexpr int kHaloPixels = 3, kTextHeight = 23, kBaseline = 17;
constexpr std::size_t kMostSizes = 200'000;  // texts whose size is remembered

TextStyle labelStyle() {
  return {.size = kTextPixels, .color = {255, 255, 255}, .horizontal = Align::start, .vertical = Align::end};
}

}  // namespace

Result<LabelAtlas> LabelAtlas::create() {
  LabelAtlas atlas;
  atlas.texture_ = makeTexture(GL_TEXTURE_2D);
  glTextureStorage2D(atlas.texture_, 1, GL_R8, kAtlasSide, kAtlasSide);
  if (glGetError() != GL_NO_ERROR) return failure(ErrorCode::unsupported, "the device has no room for texts");
  return atlas;
}

Vec2 LabelAtlas::sizeOf(const std::string& text) {
  if (const auto found = sizes_.find(text); found != sizes_.end()) return found->second;
  static const Result<Canvas> ruler = Canvas::create(1, 1);
  const double width = ruler ? ruler->textWidth(text, labelStyle()) : 0;
  const Vec2 size{std::min(std::ceil(width) + 2 * kHaloPixels, double(kAtlasSide)), kTextHeight};
  if (sizes_.size() >= kMostSizes) sizes_.clear();
  sizes_.emplace(text, size);
  return size;
}

Result<std::optional<LabelAtlas::Entry>> LabelAtlas::find(const std::string& text) {
  if (const auto found = entries_.find(text); found != entries_.end()) return std::optional(found->second);
  const Vec2 size = sizeOf(text);
  if (next_.x + size.x > kAtlasSide) next_ = {0, next_.y + kTextHeight};
  if (next_.y + kTextHeight > kAtlasSide) return std::optional<Entry>();
  ARETE_TRY(Canvas canvas, Canvas::create(int(size.x), int(size.y), {0, 0, 0}));
  canvas.text(text, {kHaloPixels, kBaseline}, labelStyle());
  std::vector<std::uint8_t> coverage;
  for (int y = 0; y < canvas.height(); ++y)
    for (int x = 0; x < canvas.width(); ++x) coverage.push_back(canvas.pixel(x, y).r);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(texture_, 0, int(next_.x), int(next_.y), canvas.width(), canvas.height(), GL_RED,
                      GL_UNSIGNED_BYTE, coverage.data());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  const Entry entry{next_, size.x, size.y};
  next_.x += size.x;
  entries_.emplace(text, entry);
  return std::optional(entry);
}

void LabelAtlas::clear() {
  entries_.clear();
  next_ = {};
}

}  // namespace arete
