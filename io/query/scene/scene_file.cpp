// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each object is read member by member. A member that is not known is an error, not a warning: a misspelt
// "turn" would leave a building in the wrong place without a word.
#include "io/query/scene/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "io/files/file_bytes.h"
#include "io/files/text_scan.h"

namespace arete {
namespace {

using nlohmann::json;

constexpr std::array kSceneMembers = {"crs", "objects", "comment"};
constexpr std::array kObjectMembers = {"name",    "file",    "at",        "lonlat",   "above",
                                       "turn",    "scale",   "up",        "anchor",   "level",
                                       "visible", "comment", "instances", "tolerance"};
constexpr std::array kInstanceMembers = {"name",  "at",    "lonlat",    "above",   "turn",
                                         "scale", "level", "tolerance", "visible", "comment"};
constexpr std::array kLevelMembers = {"error", "triangles"};

/// What is wrong with an object; empty while nothing is.
class Reader {
 public:
  explicit Reader(const json& object) : object_(object) {}

  template <class Names>
  void refuseStrangers(const Names& known) {
    for (const auto& member : object_.items())
      if (std::ranges::find(known, member.key()) == known.end())
        note(fmt::format("knows no \"{}\"", member.key()));
  }
  const json* find(const char* name) const {
    const auto member = object_.find(name);
    return member == object_.end() ? nullptr : &*member;
  }
  void text(const char* name, std::string& value) {
    const json* const member = find(name);
    if (!member) return;
    if (!member->is_string() || member->get<std::string>().empty()) return note(name, "must be a text");
    value = member->get<std::string>();
    if (value.find('\0') != std::string::npos) note(name, "must be a text without a zero byte");
  }
  void flag(const char* name, bool& value) {
    const json* const member = find(name);
    if (!member) return;
    if (!member->is_boolean()) return note(name, "must be true or false");
    value = member->get<bool>();
  }
  void number(const char* name, double& value) {
    if (const json* const member = find(name)) value = numberOf(name, *member);
  }
  void positive(const char* name, double& value) {
    if (!find(name)) return;
    number(name, value);
    if (!(value > 0)) note(name, "must be above 0");
  }
  /// So many numbers, at least and at most.
  std::vector<double> numbers(const char* name, std::size_t least, std::size_t most) {
    const json* const member = find(name);
    if (!member) return {};
    const std::string count = least == most ? std::to_string(least) : fmt::format("{} or {}", least, most);
    if (!member->is_array() || member->size() < least || member->size() > most) {
      note(name, fmt::format("must be {} numbers", count));
      return {};
    }
    std::vector<double> values;
    for (const json& each : *member) values.push_back(numberOf(name, each));
    return values;
  }
  void note(std::string problem) {
    if (problem_.empty()) problem_ = std::move(problem);
  }
  void note(const char* name, std::string_view problem) { note(fmt::format("its {} {}", name, problem)); }
  const std::string& problem() const { return problem_; }

 private:
  double numberOf(const char* name, const json& value) {
    if (!value.is_number()) {
      note(name, fmt::format("is {}, not a number", value.type_name()));
      return 1;
    }
    const double number = value.get<double>();
    if (!std::isfinite(number)) note(name, "is not finite");
    return number;
  }

  const json& object_;
  std::string problem_;
};

void readLevel(Reader& reader, StatedObject& object) {
  const json* const level = reader.find("level");
  if (!level) return;
  if (!level->is_object() || level->size() != 1)
    return reader.note("level", "must be {\"error\": E} or {\"triangles\": N}");
  Reader inside(*level);
  inside.refuseStrangers(kLevelMembers);
  double value = 0;
  const bool isError = inside.find("error") != nullptr;
  inside.number(isError ? "error" : "triangles", value);
  if (!inside.problem().empty()) return reader.note("level", inside.problem());
  object.levelError.reset();
  object.levelTriangles.reset();
  if (isError) {
    if (value < 0) return reader.note("level", "has an error below 0");
    object.levelError = value;
  } else {
    if (!(value >= 1 && value <= 4e9 && value == std::floor(value)))
      return reader.note("level", "has no whole number of triangles");
    object.levelTriangles = static_cast<std::uint32_t>(value);
  }
}

/// What an object and its instances both state.
void readPlace(Reader& reader, StatedObject& object) {
  if (reader.find("at") && reader.find("lonlat")) reader.note("at", "and its lonlat exclude each other");
  for (const char* name : {"at", "lonlat"}) {
    const auto numbers = reader.numbers(name, 2, 3);
    if (numbers.empty()) continue;
    object.hasPlace = true;
    object.isLonLat = std::string_view(name) == "lonlat";
    object.place = {numbers[0], numbers[1]};
    object.height.reset();
    if (numbers.size() == 3) object.height = numbers[2];
    if (object.isLonLat && std::abs(numbers[1]) > 90) reader.note(name, "has a latitude beyond 90 degrees");
  }
  reader.number("above", object.above);
  if (reader.find("above") && object.height)
    reader.note("above", "is over the ground, and its place states a height");
  if (const auto turn = reader.numbers("turn", 3, 3); !turn.empty())
    object.turn = {turn[0], turn[1], turn[2]};
  reader.positive("scale", object.scale);
  reader.positive("tolerance", object.toleranceFactor);
  reader.flag("visible", object.isShown);
  reader.text("name", object.name);
  readLevel(reader, object);
}

void readLook(Reader& reader, StatedObject& object) {
  reader.text("up", object.up);
  if (!object.up.empty() && object.up != "y" && object.up != "z") reader.note("up", "must be \"y\" or \"z\"");
  std::string anchor = "origin";
  reader.text("anchor", anchor);
  if (anchor != "origin" && anchor != "base") reader.note("anchor", "must be \"origin\" or \"base\"");
  object.anchor = anchor == "base" ? StatedObject::Anchor::base : StatedObject::Anchor::origin;
}

/// Gives names to objects that state none: that of the file, numbered where several have it.
Status nameAll(SceneFile& scene) {
  std::unordered_set<std::string> taken;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const std::string& name = scene.objects[i].name;
    if (!name.empty() && !taken.insert(name).second)
      return failure(ErrorCode::invalidData, fmt::format("two objects have the name \"{}\"", name),
                     scene.path);
  }
  std::unordered_map<std::string, std::size_t> last;
  for (StatedObject& object : scene.objects) {
    if (!object.name.empty()) continue;
    const std::string stem = std::filesystem::path(object.file).stem().string();
    std::string name = stem;
    while (!taken.insert(name).second) name = fmt::format("{} {}", stem, 1 + ++last[stem]);
    object.name = name;
  }
  return {};
}

}  // namespace

bool isSceneFile(const std::string& path) {
  return text::lowerExtension(path) == "json";
}

Result<SceneFile> readSceneText(std::string_view text, const std::string& path) {
  const json whole = json::parse(text, nullptr, false);
  if (whole.is_discarded())
    return failure(ErrorCode::corrupt, "is not JSON (which knows no NaN), or has a number too large", path);
  const auto refuse = [&](std::string problem) {
    return failure(ErrorCode::invalidData, std::move(problem), path);
  };
  if (!whole.is_object()) return refuse("is no scene: a JSON object with objects");
  Reader reader(whole);
  reader.refuseStrangers(kSceneMembers);
  SceneFile scene{.path = path, .objects = {}};
  reader.text("crs", scene.crs);
  if (!reader.problem().empty()) return refuse(reader.problem());
  const json* const objects = reader.find("objects");
  if (!objects || !objects->is_array() || objects->empty())
    return refuse("is no scene: it has no list of objects, \"objects\"");

  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  for (std::size_t i = 0; i < objects->size(); ++i) {
    const json& stated = (*objects)[i];
    std::string where = fmt::format("objects[{}]", i);
    if (!stated.is_object()) return refuse(fmt::format("{} is {}, not an object", where, stated.type_name()));
    Reader one(stated);
    one.refuseStrangers(kObjectMembers);
    StatedObject object;
    one.text("file", object.file);
    if (object.file.empty()) one.note("file", "is missing");
    readPlace(one, object);
    readLook(one, object);
    if (!object.name.empty()) where += fmt::format(" \"{}\"", object.name);
    if (!one.problem().empty()) return refuse(fmt::format("{}: {}", where, one.problem()));
    object.file = (folder / object.file).lexically_normal().string();
    const json* const instances = one.find("instances");
    if (!instances) {
      scene.objects.push_back(std::move(object));
      continue;
    }
    if (!instances->is_array() || instances->empty())
      return refuse(fmt::format("{}: its instances must be a list", where));
    // An instance has what the object states, but for what it states itself.
    for (std::size_t k = 0; k < instances->size(); ++k) {
      const json& each = (*instances)[k];
      StatedObject instance = object;
      if (!object.name.empty()) instance.name = fmt::format("{} {}", object.name, k + 1);
      std::string problem = each.is_object() ? "" : fmt::format("is {}, not an object", each.type_name());
      if (problem.empty()) {
        Reader inside(each);
        inside.refuseStrangers(kInstanceMembers);
        readPlace(inside, instance);
        problem = inside.problem();
      }
      if (!problem.empty()) return refuse(fmt::format("{}: instances[{}]: {}", where, k, problem));
      scene.objects.push_back(std::move(instance));
    }
  }
  ARETE_CHECK(nameAll(scene));
  return scene;
}

Result<SceneFile> readScene(const std::string& path) {
  ARETE_TRY(const auto bytes, FileBytes::read(path));
  return readSceneText(bytes.view(), path);
}

}  // namespace arete
