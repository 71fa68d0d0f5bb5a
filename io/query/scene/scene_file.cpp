// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every key is read by one function, which knows its type and range; keys that no function takes are errors,
// so that a misspelt one does not pass in silence.
#include "io/query/scene/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <set>
#include <unordered_map>
#include <utility>

#include "engine/base/caught_failure.h"
#include "io/files/file_bytes.h"

namespace arete {
namespace {

using SceneJson = nlohmann::json;

Status wrongValue(const std::string& culprit, std::string message) {
  return failure(ErrorCode::invalidData, std::move(message), culprit);
}

/// Looks for a key that one object states twice, of which the parser would keep one in silence. (A callback
/// of the parser would see them too, in a time that grows with the square of a list's length.)
class RepeatedKeys : public nlohmann::json_sax<SceneJson> {
 public:
  std::string repeated;

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override {
    keys_.emplace_back();
    return true;
  }
  bool key(string_t& key) override {
    const auto [known, isNew] = keys_.back().insert(key);
    if (!isNew) repeated = key;
    return isNew;
  }
  bool end_object() override {
    keys_.pop_back();
    return true;
  }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
    return false;  // which the parser reports
  }

 private:
  std::vector<std::set<std::string>> keys_;
};

Result<SceneJson> parsedScene(std::string_view text, const std::string& path) {
  try {
    RepeatedKeys keys;
    if (!SceneJson::sax_parse(text.begin(), text.end(), &keys) && !keys.repeated.empty())
      return failure(ErrorCode::invalidData, fmt::format("states the key '{}' twice", keys.repeated), path);
    return SceneJson::parse(text.begin(), text.end());
  } catch (const SceneJson::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
    std::string what = error.what();
    if (const auto at = what.find("] "); at != std::string::npos) what.erase(0, at + 2);
    return failure(ErrorCode::invalidData, fmt::format("is not a scene in JSON: {}", what), path);
  }
}

/// One object's keys, with what names them in errors.
struct SceneFields {
  const SceneJson& json;
  std::string culprit;

  std::string of(std::string_view key) const { return fmt::format("{}: {}", culprit, key); }
  const SceneJson* find(const char* key) const {
    const auto found = json.find(key);
    return found == json.end() ? nullptr : &*found;
  }

  Status checkKeys(std::initializer_list<std::string_view> known) const {
    for (const auto& [key, value] : json.items())
      if (std::find(known.begin(), known.end(), key) == known.end())
        return wrongValue(
            culprit, fmt::format("has the unknown key '{}'; the keys are {}", key, fmt::join(known, ", ")));
    return {};
  }
  Status text(const char* key, std::string& value) const {
    const SceneJson* found = find(key);
    if (!found) return {};
    if (!found->is_string()) return wrongValue(of(key), "must be a text");
    value = found->get<std::string>();
    if (value.empty()) return wrongValue(of(key), "is empty");
    return {};
  }
  Status number(const char* key, double& value) const {
    const SceneJson* found = find(key);
    if (!found) return {};
    if (!found->is_number()) return wrongValue(of(key), "must be a number");
    value = found->get<double>();
    return std::isfinite(value) ? Status{} : wrongValue(of(key), "must be a finite number");
  }
  Status positive(const char* key, double& value) const {
    ARETE_CHECK(number(key, value));
    return value > 0 ? Status{} : wrongValue(of(key), fmt::format("must be above 0, not {:g}", value));
  }
  Status flag(const char* key, bool& value) const {
    const SceneJson* found = find(key);
    if (!found) return {};
    if (!found->is_boolean()) return wrongValue(of(key), "must be true or false");
    value = found->get<bool>();
    return {};
  }
  Status numbers(const char* key, std::size_t least, std::size_t most, std::vector<double>& values) const {
    values.clear();
    const SceneJson* found = find(key);
    if (!found) return {};
    const auto count = least == most ? fmt::format("{}", least) : fmt::format("{} or {}", least, most);
    if (!found->is_array() || found->size() < least || found->size() > most)
      return wrongValue(of(key), fmt::format("must be a list of {} numbers", count));
    for (const SceneJson& one : *found) {
      if (!one.is_number() || !std::isfinite(one.get<double>()))
        return wrongValue(of(key), fmt::format("must be a list of {} finite numbers", count));
      values.push_back(one.get<double>());
    }
    return {};
  }
};

Status readPlace(const SceneFields& fields, SceneObject& object) {
  std::vector<double> at, lonLat;
  ARETE_CHECK(fields.numbers("at", 2, 3, at));
  ARETE_CHECK(fields.numbers("lonlat", 2, 3, lonLat));
  if (!at.empty() && !lonLat.empty()) return wrongValue(fields.of("at"), "cannot be combined with lonlat");
  if (!lonLat.empty() && (std::abs(lonLat[1]) > 90 || std::abs(lonLat[0]) > 360))
    return wrongValue(fields.of("lonlat"),
                      fmt::format("{:g},{:g} is no longitude and latitude in degrees", lonLat[0], lonLat[1]));
  const std::vector<double>& stated = at.empty() ? lonLat : at;
  if (stated.empty()) return {};
  object.place = ScenePlace{{stated[0], stated[1]}, at.empty(), std::nullopt};
  if (stated.size() == 3) object.place->height = stated[2];
  return {};
}

Status readLevel(const SceneFields& fields, SceneLevel& level) {
  const SceneJson* found = fields.find("level");
  if (!found) return {};
  if (!found->is_object() || found->size() != 1)
    return wrongValue(fields.of("level"), "must be {\"error\": E} or {\"triangles\": N}");
  const SceneFields inner{*found, fields.of("level")};
  ARETE_CHECK(inner.checkKeys({"error", "triangles"}));
  if (inner.find("error")) {
    double error = 0;
    ARETE_CHECK(inner.number("error", error));
    if (error < 0) return wrongValue(inner.of("error"), fmt::format("must be 0 or more, not {:g}", error));
    level.error = error;
  } else {
    const SceneJson& triangles = *inner.find("triangles");
    if (!triangles.is_number_unsigned() || triangles.get<std::uint64_t>() == 0)
      return wrongValue(inner.of("triangles"), "must be a whole number above 0");
    level.triangles = triangles.get<std::uint64_t>();
  }
  return {};
}

Result<SceneObject> readObject(const SceneFields& fields, const std::filesystem::path& folder) {
  ARETE_CHECK(fields.checkKeys({"name", "file", "at", "lonlat", "above", "turn", "scale", "up", "anchor",
                                "tolerance", "level", "visible", "instances"}));
  SceneObject object;
  if (!fields.find("file")) return tl::unexpected(wrongValue(fields.culprit, "has no file").error());
  ARETE_CHECK(fields.text("file", object.file));
  // An address stays as it is.
  if (object.file.find("://") == std::string::npos && !object.file.starts_with("/vsi"))
    object.file = (folder / object.file).lexically_normal().string();
  ARETE_CHECK(fields.text("name", object.name));
  ARETE_CHECK(readPlace(fields, object));
  ARETE_CHECK(fields.number("above", object.above));
  std::vector<double> turn;
  ARETE_CHECK(fields.numbers("turn", 3, 3, turn));
  if (!turn.empty()) object.turn = {turn[0], turn[1], turn[2]};
  ARETE_CHECK(fields.positive("scale", object.scale));
  ARETE_CHECK(fields.text("up", object.up));
  if (!object.up.empty() && object.up != "y" && object.up != "z")
    return tl::unexpected(wrongValue(fields.of("up"), "must be \"y\" or \"z\"").error());
  std::string anchor = "origin";
  ARETE_CHECK(fields.text("anchor", anchor));
  if (anchor != "origin" && anchor != "base")
    return tl::unexpected(wrongValue(fields.of("anchor"), "must be \"origin\" or \"base\"").error());
  object.anchor = anchor == "base" ? SceneObject::Anchor::base : SceneObject::Anchor::origin;
  ARETE_CHECK(fields.positive("tolerance", object.tolerance));
  ARETE_CHECK(readLevel(fields, object.level));
  ARETE_CHECK(fields.flag("visible", object.isVisible));
  for (const char* key : {"at", "lonlat", "above", "turn", "scale", "up", "anchor"})
    object.statesPlacement |= fields.find(key) != nullptr;
  return object;
}

/// The object that an instance states: what it does not say is as the object says. A place of its own
/// replaces the object's, its height above the ground too.
Result<SceneJson> instanceOf(SceneJson object, const SceneFields& instance, std::size_t number) {
  ARETE_CHECK(instance.checkKeys(
      {"name", "at", "lonlat", "above", "turn", "scale", "tolerance", "level", "visible"}));
  object.erase("instances");
  if (instance.find("at") || instance.find("lonlat"))
    for (const char* key : {"at", "lonlat", "above"}) object.erase(key);
  if (const auto name = object.find("name"); name != object.end() && name->is_string())
    *name = fmt::format("{} {}", name->get<std::string>(), number + 1);
  object.update(instance.json);
  return object;
}

/// One object, or as many as it has instances.
Status addObjects(const SceneFields& fields, const std::filesystem::path& folder, SceneFile& scene) {
  const SceneJson* const instances = fields.find("instances");
  if (!instances) {
    ARETE_TRY(auto object, readObject(fields, folder));
    scene.objects.push_back(std::move(object));
    return {};
  }
  if (!instances->is_array() || instances->empty())
    return wrongValue(fields.of("instances"), "must be a list of at least one object");
  for (std::size_t k = 0; k < instances->size(); ++k) {
    const SceneJson& each = (*instances)[k];
    const std::string culprit = fmt::format("{}: instances[{}]", fields.culprit, k);
    if (!each.is_object()) return wrongValue(culprit, "must be an object");
    ARETE_TRY(const SceneJson whole, instanceOf(fields.json, {each, culprit}, k));
    ARETE_TRY(auto object, readObject({whole, culprit}, folder));
    scene.objects.push_back(std::move(object));
  }
  return {};
}

/// Names objects without a name by their file; of several with one name the second is "mast 2".
Status nameObjects(SceneFile& scene) {
  std::unordered_map<std::string, std::size_t> taken;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const std::string& name = scene.objects[i].name;
    if (name.empty()) continue;
    if (const auto [first, isNew] = taken.emplace(name, i); !isNew)
      return wrongValue(sceneCulprit(scene, i, "name"), fmt::format("objects[{}] has it too", first->second));
  }
  std::unordered_map<std::string, std::size_t> next;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    SceneObject& object = scene.objects[i];
    if (!object.name.empty()) continue;
    const std::string stem = std::filesystem::path(object.file).stem().string();
    std::size_t& number = next[stem];
    do {
      ++number;
      object.name = number == 1 ? stem : fmt::format("{} {}", stem, number);
    } while (!taken.emplace(object.name, i).second);
  }
  return {};
}

}  // namespace

std::string sceneCulprit(const SceneFile& scene, std::size_t object, std::string_view key) {
  const std::string& name = scene.objects[object].name;
  std::string culprit = fmt::format("{}: objects[{}]", scene.path, object);
  if (!name.empty()) culprit += fmt::format(" '{}'", name);
  if (!key.empty()) culprit += fmt::format(": {}", key);
  return culprit;
}

bool isSceneFile(std::string_view path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? c + 32 : c; });
  return extension == ".json";
}

Result<SceneFile> readScene(const std::string& path) try {
  ARETE_TRY(const FileBytes bytes, FileBytes::readText(path));
  ARETE_TRY(const SceneJson json, parsedScene(bytes.view(), path));
  SceneFile scene;
  scene.path = path;
  if (!json.is_object())
    return failure(ErrorCode::invalidData, "is no scene: it must be an object with a list of objects", path);
  const SceneFields top{json, path};
  ARETE_CHECK(top.checkKeys({"$schema", "crs", "objects"}));
  ARETE_CHECK(top.text("crs", scene.crs));
  const SceneJson* objects = top.find("objects");
  if (!objects || !objects->is_array() || objects->empty())
    return failure(ErrorCode::invalidData, "must be a list of at least one object", top.of("objects"));
  const auto folder = std::filesystem::path(path).parent_path();
  scene.objects.reserve(objects->size());
  for (std::size_t i = 0; i < objects->size(); ++i) {
    const SceneJson& one = (*objects)[i];
    std::string culprit = fmt::format("{}: objects[{}]", path, i);
    if (!one.is_object()) return failure(ErrorCode::invalidData, "must be an object with a file", culprit);
    if (const auto name = one.find("name"); name != one.end() && name->is_string())
      culprit += fmt::format(" '{}'", name->get<std::string>());
    ARETE_CHECK(addObjects({one, culprit}, folder, scene));
  }
  ARETE_CHECK(nameObjects(scene));
  return scene;
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
