// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/base/vec.h"
#include "io/files/text/json_tree.h"

namespace arete::json_fields {

/// One declaration of the fields of a JSON object for both directions. A function visits the fields of a
/// value:
///
///     template <class Visitor, class Value>
///     void visitFields(Visitor& visitor, Value& value) {
///       visitor.field("columns", value.columns);
///       visitor.object("counts", [&](auto& counts) { counts.field("nodes", value.counts.nodes); });
///     }
///
/// Called with a Writer and a const value it writes the object, with a Reader and a value it reads it.
/// field()           a bool, an unsigned number, a double, a text, a row of doubles or a Vec3; required
/// choice()          an enumerator by its name; required
/// object()          an object, whose fields the function visits; required
/// optional()        a field, or a row of texts, that is absent when the value is empty (or a number that is
///                   not finite)
/// flag()            a truth value that is absent when it is false
/// optionalObject()  an object that is absent when none of its fields is present

/// A name for a value.
template <class T>
struct Choice {
  T value;
  std::string_view name;
};

/// A text as JSON that reads back to the same bytes: a string, or {"hex": "..."} where it is not UTF-8.
inline nlohmann::ordered_json exactText(const std::string& text) {
  try {
    static_cast<void>(nlohmann::json(text).dump());
    return text;
  } catch (const nlohmann::json::type_error&) {
    std::string hex;
    for (const char c : text) hex += fmt::format("{:02x}", static_cast<unsigned char>(c));
    return {{"hex", hex}};
  }
}

/// The bytes that lower-case hexadecimal digits stand for; nothing if there are other characters or half a
/// byte.
inline std::optional<std::string> bytesOfHex(std::string_view hex) {
  const auto digit = [](char c) {
    return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
  };
  if (hex.size() % 2 != 0) return std::nullopt;
  std::string text;
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    const int high = digit(hex[i]), low = digit(hex[i + 1]);
    if (high < 0 || low < 0) return std::nullopt;
    text += static_cast<char>(high * 16 + low);
  }
  return text;
}

/// Adds fields to a JSON object in the order in which they are visited.
class Writer {
 public:
  explicit Writer(nlohmann::ordered_json& object) : object_(object) {}

  template <class T>
  void field(const char* key, const T& value) {
    object_[key] = value;
  }
  void field(const char* key, const std::string& text) { object_[key] = exactText(text); }
  void field(const char* key, const Vec3& v) {
    object_[key] = nlohmann::ordered_json::array({v.x, v.y, v.z});
  }
  template <class T, std::size_t N>
  void choice(const char* key, const T& value, const std::array<Choice<T>, N>& choices) {
    for (const Choice<T>& choice : choices)
      if (choice.value == value) object_[key] = choice.name;
  }
  template <class Visit>
  void object(const char* key, Visit visit) {
    object_[key] = visited(visit);
  }
  template <class T>
  void optional(const char* key, const std::optional<T>& value) {
    if (!value) return;
    if constexpr (std::is_floating_point_v<T>)
      if (!std::isfinite(*value)) return;  // JSON has no infinity
    field(key, *value);
  }
  void optional(const char* key, const std::string& text) {
    if (!text.empty()) field(key, text);
  }
  void optional(const char* key, const std::vector<std::string>& texts) {
    if (texts.empty()) return;
    nlohmann::ordered_json& row = object_[key] = nlohmann::ordered_json::array();
    for (const std::string& text : texts) row.push_back(exactText(text));
  }
  template <std::size_t N>
  void optional(const char* key, const std::vector<std::array<double, N>>& rows) {
    if (!rows.empty()) object_[key] = rows;
  }
  void flag(const char* key, bool isSet) {
    if (isSet) field(key, isSet);
  }
  template <class Visit>
  void optionalObject(const char* key, Visit visit) {
    if (nlohmann::ordered_json object = visited(visit); !object.empty()) object_[key] = std::move(object);
  }

 private:
  template <class Visit>
  nlohmann::ordered_json visited(const Visit& visit) const {
    nlohmann::ordered_json object = nlohmann::ordered_json::object();
    Writer writer(object);
    visit(writer);
    return object;
  }

  nlohmann::ordered_json& object_;
};

/// Reads fields from a JSON object. Keeps the first problem of it and the objects in it as a sentence that
/// names the field ("counts.nodes is missing"); fields with a problem keep their value. Fields that are not
/// visited are ignored.
class Reader {
 public:
  /// @param problem  empty; receives the first problem
  Reader(const nlohmann::json& object, std::string& problem) : Reader(object, "", problem) {}

  void field(const char* key, bool& value) {
    if (const Json* found = find(key, "true or false", [](const Json& j) { return j.is_boolean(); }))
      value = found->get<bool>();
  }
  void field(const char* key, double& value) {
    if (const Json* found = find(key, "a number", [](const Json& j) { return j.is_number(); }))
      value = found->get<double>();
  }
  void field(const char* key, std::uint64_t& value) {
    if (const Json* found = find(key, "a whole number", [](const Json& j) { return j.is_number_unsigned(); }))
      value = found->get<std::uint64_t>();
  }
  void field(const char* key, std::uint32_t& value) {
    std::uint64_t wide = value;
    field(key, wide);
    if (wide > 0xFFFFFFFFu)
      fail(key, fmt::format("is {}, beyond 32 bits", wide));
    else
      value = static_cast<std::uint32_t>(wide);
  }
  void field(const char* key, std::string& text) {
    const Json* found = find(key, "a text", [](const Json& j) {
      return j.is_string() || (j.is_object() && j.contains("hex") && j["hex"].is_string());
    });
    if (found == nullptr) return;
    if (found->is_string())
      text = found->get<std::string>();
    else if (std::optional<std::string> bytes = bytesOfHex((*found)["hex"].get<std::string>()))
      text = std::move(*bytes);
    else
      fail(key, "is not hexadecimal text");
  }
  template <std::size_t N>
  void field(const char* key, std::array<double, N>& row) {
    const Json* found = find(key, fmt::format("an array of {} numbers", N), [](const Json& j) {
      if (!j.is_array() || j.size() != N) return false;
      for (const Json& number : j)
        if (!number.is_number()) return false;
      return true;
    });
    if (found == nullptr) return;
    for (std::size_t i = 0; i < N; ++i) row[i] = (*found)[i].get<double>();
  }
  void field(const char* key, Vec3& v) {
    std::array<double, 3> row = {v.x, v.y, v.z};
    field(key, row);
    v = {row[0], row[1], row[2]};
  }
  template <class T, std::size_t N>
  void choice(const char* key, T& value, const std::array<Choice<T>, N>& choices) {
    std::string name;
    field(key, name);
    std::string names;
    for (std::size_t i = 0; i < N; ++i) {
      if (choices[i].name == name) {
        value = choices[i].value;
        return;
      }
      names += fmt::format("{}{}", i == 0 ? "" : i + 1 < N ? ", " : " or ", choices[i].name);
    }
    fail(key, fmt::format("is not {}", names));
  }
  template <class Visit>
  void object(const char* key, Visit visit) {
    const Json* found = find(key, "an object", [](const Json& j) { return j.is_object(); });
    if (found == nullptr) return;
    Reader reader(*found, fmt::format("{}{}.", prefix_, key), problem_);
    visit(reader);
  }
  template <class T>
  void optional(const char* key, std::optional<T>& value) {
    if (object_.contains(key)) field(key, value.emplace());
  }
  void optional(const char* key, std::string& text) {
    if (object_.contains(key)) field(key, text);
  }
  void optional(const char* key, std::vector<std::string>& texts) {
    if (!object_.contains(key)) return;
    if (!object_[key].is_array()) return fail(key, "is not an array of texts");
    for (const Json& element : object_[key]) {
      // Each is read as a field of its own, so that the forms of a text are known in one place.
      const JsonTree<Json> single(Json{{key, element}});
      Reader(*single, prefix_, problem_).field(key, texts.emplace_back());
    }
  }
  template <std::size_t N>
  void optional(const char* key, std::vector<std::array<double, N>>& rows) {
    if (!object_.contains(key)) return;
    if (!object_[key].is_array()) return fail(key, "is not an array of rows");
    for (const Json& element : object_[key]) {
      const JsonTree<Json> single(Json{{key, element}});
      Reader(*single, prefix_, problem_).field(key, rows.emplace_back());
    }
  }
  void flag(const char* key, bool& isSet) {
    if (object_.contains(key)) field(key, isSet);
  }
  template <class Visit>
  void optionalObject(const char* key, Visit visit) {
    if (object_.contains(key)) object(key, visit);
  }

 private:
  using Json = nlohmann::json;

  Reader(const Json& object, std::string prefix, std::string& problem)
      : object_(object), prefix_(std::move(prefix)), problem_(problem) {}

  void fail(const char* key, std::string_view what) {
    if (problem_.empty()) problem_ = fmt::format("{}{} {}", prefix_, key, what);
  }
  template <class IsRight>
  const Json* find(const char* key, std::string_view type, const IsRight& isRight) {
    const auto found = object_.find(key);
    if (found == object_.end()) {
      fail(key, "is missing");
      return nullptr;
    }
    if (!isRight(*found)) {
      fail(key, fmt::format("is not {}", type));
      return nullptr;
    }
    return &*found;
  }

  const Json& object_;
  std::string prefix_;
  std::string& problem_;
};

}  // namespace arete::json_fields
