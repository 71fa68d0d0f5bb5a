// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "io/geo/features/feature_layer.h"
#include "viewer/layers/feature_painter.h"
#include "viewer/layers/ground_features.h"

namespace arete {

/// A file and what is stated about it: FILE[,KEY=VALUE]...
struct FileWithKeys {
  std::string file;
  std::map<std::string, std::string, std::less<>> values;
};

/// Takes the keys off a file. Commas that begin no KEY= belong to the file, or to the value before them. A
/// text that as a whole names a file that exists is that file.
///
/// Errors, with the text as culprit: usage: an unknown key or one stated twice; lists the keys.
Result<FileWithKeys> readFileWithKeys(const std::string& text, const std::vector<std::string_view>& keys);

/// The number that a whole text states, or nothing.
std::optional<double> numberIn(std::string_view text);

/// A number of 0 to 1. Errors: usage.
Result<double> readOpacity(const std::string& text, std::string_view key = "opacity");

/// One of `layer`, as a person states it.
struct LayerArgument {
  std::string file;
  FeatureReadOptions read;
  GroundFeatureOptions ground;
  FeatureStyle style;
  double fill = 0;    ///< opacity of the areas of polygons; 0: they are not filled
  std::string title;  ///< of the legend and the list of layers; empty: of the file

  /// @param number of the layer, from 0: layers without a colour differ by it.
  /// Errors, with the text in the culprit: usage.
  static Result<LayerArgument> of(const std::string& text, std::size_t number);
};

}  // namespace arete
