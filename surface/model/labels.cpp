// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/model/labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>

namespace arete {
namespace {

template <class Float>
bool areWhole(const Attribute& attribute) {
  bool isAnyFinite = false;
  const std::size_t count = attribute.values.size() / sizeof(Float);
  for (std::size_t i = 0; i < count; ++i) {
    Float number = 0;
    std::memcpy(&number, attribute.values.data() + i * sizeof(Float), sizeof(Float));
    if (!std::isfinite(number)) continue;
    if (number != std::floor(number)) return false;
    isAnyFinite = true;
  }
  return isAnyFinite;
}

}  // namespace

bool isNameOfLabels(std::string_view name) {
  std::string lower;
  for (const char c : name) lower += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  std::string_view text = lower;
  while (text.starts_with('_')) text.remove_prefix(1);
  for (const std::string_view prefix : {"scalar_", "vertex_", "face_"})
    if (text.starts_with(prefix)) text.remove_prefix(prefix.size());
  while (!text.empty() && text.back() >= '0' && text.back() <= '9') text.remove_suffix(1);
  while (text.ends_with('_')) text.remove_suffix(1);
  constexpr std::array<std::string_view, 18> kNames = {
      "feature_id", "featureid",   "batchid",  "batch_id",    "classification", "class",
      "class_id",   "label",       "labels",   "label_id",    "object_id",      "objectid",
      "instance",   "instance_id", "category", "material_id", "segment",        "segment_id"};
  return std::ranges::find(kNames, text) != kNames.end();
}

bool isLabel(const Attribute& attribute) {
  if (attribute.meaning != AttributeMeaning::other) return false;
  if (!isFloat(attribute.type)) return true;
  if (isNameOfLabels(attribute.name)) return true;
  return attribute.type == ScalarType::float32 ? areWhole<float>(attribute) : areWhole<double>(attribute);
}

}  // namespace arete
