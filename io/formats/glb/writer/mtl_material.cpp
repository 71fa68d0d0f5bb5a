// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/glb/writer/mtl_material.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

namespace arete {
namespace {

std::vector<std::string_view> wordsOf(std::string_view line) {
  constexpr std::string_view kBlank = " \t\r";
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(kBlank); at != std::string_view::npos;
       at = line.find_first_not_of(kBlank, at)) {
    const std::size_t end = std::min(line.find_first_of(kBlank, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

std::optional<double> numberOf(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

/// Adds an emission; false if the words are no numbers.
bool addEmission(const std::vector<std::string_view>& words, nlohmann::ordered_json& material) {
  std::vector<double> light;
  for (std::size_t i = 1; i < std::min<std::size_t>(words.size(), 4); ++i) {
    const auto number = numberOf(words[i]);
    if (!number) return false;
    light.push_back(std::max(*number, 0.0));
  }
  if (light.empty()) return false;
  light.resize(3, light[0]);  // one number is gray
  const double most = std::ranges::max(light);
  if (most > 1) {
    for (double& part : light) part /= most;
    material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = most;
  }
  if (most > 0) material["emissiveFactor"] = light;
  return true;
}

}  // namespace

void addMtlStatements(std::string_view statements, nlohmann::ordered_json& material,
                      std::set<std::string>& lost) {
  double metallic = 0, roughness = 1;
  bool hasRoughness = false;
  while (!statements.empty()) {
    const std::size_t end = std::min(statements.find('\n'), statements.size());
    const std::vector<std::string_view> words = wordsOf(statements.substr(0, end));
    statements.remove_prefix(std::min(end + 1, statements.size()));
    if (words.empty() || words[0].starts_with('#')) continue;
    const std::string key(words[0]);
    if (key == "Kd" || key == "d" || key == "Tr") continue;
    const auto number = words.size() > 1 ? numberOf(words[1]) : std::nullopt;
    if (key == "Pm" && number) {
      metallic = std::clamp(*number, 0.0, 1.0);
    } else if (key == "Pr" && number) {
      roughness = std::clamp(*number, 0.0, 1.0);
      hasRoughness = true;
    } else if (key == "Ns" && number) {
      if (!hasRoughness) roughness = 1 - std::sqrt(std::clamp(*number, 0.0, 1000.0) / 1000);
    } else if (key != "Ke" || !addEmission(words, material)) {
      lost.insert(key);
    }
  }
  material["pbrMetallicRoughness"]["metallicFactor"] = metallic;
  material["pbrMetallicRoughness"]["roughnessFactor"] = roughness;
}

}  // namespace arete
