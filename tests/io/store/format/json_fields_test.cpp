// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/format/json_fields.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <optional>
#include <string>

namespace arete::json_fields {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

enum class Colour { red, green, blue };
constexpr std::array<Choice<Colour>, 3> kColours = {
    {{Colour::red, "red"}, {Colour::green, "green"}, {Colour::blue, "blue"}}};

struct Thing {
  bool isOn = false;
  double size = 0;
  std::uint64_t many = 0;
  std::uint32_t few = 0;
  std::string name;
  std::array<double, 2> row = {};
  Vec3 place;
  Colour colour = Colour::red;
  double inner = 0;
  std::optional<double> weight;
  std::string note;
  std::optional<std::uint32_t> band;
};

template <class Visitor, class Value>
void visitFields(Visitor& visitor, Value& thing) {
  visitor.field("isOn", thing.isOn);
  visitor.field("size", thing.size);
  visitor.field("many", thing.many);
  visitor.field("few", thing.few);
  visitor.field("name", thing.name);
  visitor.field("row", thing.row);
  visitor.field("place", thing.place);
  visitor.choice("colour", thing.colour, kColours);
  visitor.object("more", [&](auto& more) { more.field("inner", thing.inner); });
  visitor.optional("weight", thing.weight);
  visitor.optional("note", thing.note);
  visitor.optionalObject("reading", [&](auto& reading) { reading.optional("band", thing.band); });
}

std::string written(const Thing& thing) {
  ordered_json object = ordered_json::object();
  Writer writer(object);
  visitFields(writer, thing);
  return object.dump();
}

/// The first problem; empty if there is none.
std::string problemOf(const std::string& text, Thing& thing) {
  std::string problem;
  const json object = json::parse(text);
  Reader reader(object, problem);
  visitFields(reader, thing);
  return problem;
}

const std::string kPlain =
    R"({"isOn":true,"size":0.1,"many":5000000000,"few":7,"name":"a","row":[1.0,-0.0],"place":[1.0,2.0,3.0],)"
    R"("colour":"blue","more":{"inner":4.5}})";

TEST(JsonFields, AreWrittenInTheOrderOfTheDeclarationAndReadBackToTheSameText) {
  Thing thing;
  EXPECT_EQ(problemOf(kPlain, thing), "");
  EXPECT_EQ(written(thing), kPlain);
  EXPECT_EQ(thing.many, 5000000000u);
  EXPECT_EQ(thing.colour, Colour::blue);
  EXPECT_EQ(thing.inner, 4.5);
  EXPECT_FALSE(thing.weight);
}

TEST(JsonFields, ThatAreOptionalAreWrittenOnlyWhereTheyHaveAValue) {
  Thing thing;
  thing.weight = 2;
  thing.note = "n";
  thing.band = 3;
  const std::string text = written(thing);
  EXPECT_NE(text.find(R"("weight":2.0,"note":"n","reading":{"band":3}})"), std::string::npos) << text;
  Thing back;
  EXPECT_EQ(problemOf(text, back), "");
  EXPECT_EQ(back.weight, 2);
  EXPECT_EQ(back.note, "n");
  EXPECT_EQ(back.band, 3u);
  thing.weight = std::numeric_limits<double>::infinity();
  EXPECT_EQ(written(thing).find("weight"), std::string::npos);
}

TEST(JsonFields, KeepTextsThatAreNotUtf8) {
  Thing thing;
  thing.name = "caf\xe9";
  EXPECT_NE(written(thing).find(R"("name":{"hex":"636166e9"})"), std::string::npos);
  Thing back;
  EXPECT_EQ(problemOf(written(thing), back), "");
  EXPECT_EQ(back.name, thing.name);
  EXPECT_FALSE(bytesOfHex("6"));
  EXPECT_FALSE(bytesOfHex("6G"));
  EXPECT_EQ(bytesOfHex(""), "");
}

TEST(JsonFields, NameTheFirstFieldWithAProblem) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = kPlain;
    text.replace(text.find(from), from.size(), to);
    Thing thing;
    return problemOf(text, thing);
  };
  EXPECT_EQ(with(R"("isOn":true)", R"("isOn":1)"), "isOn is not true or false");
  EXPECT_EQ(with(R"("isOn":true,)", ""), "isOn is missing");
  EXPECT_EQ(with("0.1", R"("0.1")"), "size is not a number");
  EXPECT_EQ(with("5000000000", "-5"), "many is not a whole number");
  EXPECT_EQ(with(R"("few":7)", R"("few":4294967296)"), "few is 4294967296, beyond 32 bits");
  EXPECT_EQ(with(R"("a")", "[]"), "name is not a text");
  EXPECT_EQ(with(R"("a")", R"({"hex":"4"})"), "name is not hexadecimal text");
  EXPECT_EQ(with("[1.0,-0.0]", "[1.0]"), "row is not an array of 2 numbers");
  EXPECT_EQ(with("[1.0,2.0,3.0]", R"([1,2,"3"])"), "place is not an array of 3 numbers");
  EXPECT_EQ(with(R"("blue")", R"("pink")"), "colour is not red, green or blue");
  EXPECT_EQ(with(R"({"inner":4.5})", "4.5"), "more is not an object");
  EXPECT_EQ(with("4.5", "true"), "more.inner is not a number");
  EXPECT_EQ(with(R"("few":7,"name":"a")", R"("few":"7","name":7)"), "few is not a whole number");
}

TEST(JsonFields, KeepTheirValueWhereTheyHaveAProblem) {
  Thing thing;
  thing.few = 9;
  thing.colour = Colour::green;
  EXPECT_NE(problemOf("{}", thing), "");
  EXPECT_EQ(thing.few, 9u);
  EXPECT_EQ(thing.colour, Colour::green);
}

}  // namespace
}  // namespace arete::json_fields
