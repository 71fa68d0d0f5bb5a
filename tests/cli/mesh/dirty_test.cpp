// SPDX-License-Identifier: GPL-3.0-or-later
//
// Dirty meshes: each command ends with a sentence or a result. tests/fuzz/commands_test.cpp runs the same
// commands over the kept inputs of the fuzzers.
#include <cmath>
#include <functional>
#include <numbers>

#include "cli/mesh_fixture.h"

namespace arete::cli_test {
namespace {

struct Dirty {
  const char* name;
  std::function<std::string()> text;
  std::vector<int> codes;  ///< allowed
};

std::string header(std::string_view format, std::uint64_t vertices, std::uint64_t faces) {
  return fmt::format(
      "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      format, vertices, faces);
}

const std::vector<Dirty>& dirty() {
  static const std::vector<Dirty> all = {
      {"duplicates.obj",
       [] {
         std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
         for (int i = 0; i < 1'000'000; ++i) text += "f 1 2 3\n";
         return text;
       },
       {0}},
      {"fan.obj",
       [] {  // 20 000 faces at one edge
         std::string text = "v 0 0 0\nv 0 0 1\n";
         for (int i = 0; i < 20'000; ++i) text += fmt::format("v {} {} 0\n", i + 1, i * i % 977);
         for (int i = 0; i < 20'000; ++i) text += fmt::format("f 1 2 {}\n", i + 3);
         return text;
       },
       {0}},
      {"fans.obj",
       [] {  // as many fans at one vertex
         std::string text = "v 0 0 0\n";
         for (int i = 0; i < 50'000; ++i) {
           const double angle = 2 * std::numbers::pi * i / 50'000;
           text += fmt::format("v {} {} 0\nv {} {} 1\n", std::cos(angle), std::sin(angle), std::cos(angle),
                               std::sin(angle));
         }
         for (int i = 0; i < 50'000; ++i) text += fmt::format("f 1 {} {}\n", 2 * i + 2, 2 * i + 3);
         return text;
       },
       {0}},
      {"flat.obj",
       [] {
         std::string text = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 5 0 0\n";
         for (int i = 0; i < 1000; ++i) text += "f 1 2 3\nf 2 3 4\n";
         return text;
       },
       {0, 4}},
      {"point.obj", [] { return std::string("v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\nf 1 1 1\n"); }, {0, 4}},
      {"nan.ply", [] { return header("ascii", 3, 1) + "0 0 0\n1 0 0\nnan 1 0\n3 0 1 2\n"; }, {4}},
      {"inf.ply", [] { return header("ascii", 3, 1) + "0 0 0\n1 0 0\n1e999 1 0\n3 0 1 2\n"; }, {4}},
      {"wide.obj",
       [] { return std::string("v -1.7e308 0 0\nv 1.7e308 0 0\nv 0 1.7e308 1e-308\nf 1 2 3\n"); },
       {0, 4}},
      {"empty.ply", [] { return std::string(); }, {4}},
      {"empty.stl", [] { return std::string(); }, {3, 4}},
      {"claims.ply", [] { return header("binary_little_endian", 30'000'000, 60'000'000) + "x"; }, {4}},
      {"claims.stl",
       [] {
         std::string text(84, '\0');
         text[80] = '\x00';
         text[81] = '\x87';
         text[82] = '\x93';
         text[83] = '\x03';  // 60 million
         return text;
       },
       {3, 4}},
      {"none.obj", [] { return std::string("v 0 0 0\nv 1 0 0\n"); }, {0, 3, 4}},
      {"noise.glb", [] { return std::string(4000, '\x7f'); }, {3, 4}},
  };
  return all;
}

class DirtyMeshes : public Meshes, public ::testing::WithParamInterface<std::size_t> {};

TEST_P(DirtyMeshes, GiveASentenceOrAResult) {
  const Dirty& mesh = dirty()[GetParam()];
  write(mesh.name, mesh.text());
  for (std::vector<std::string> command :
       {std::vector<std::string>{"mesh", "info", mesh.name, "--no-self-intersections"},
        {"mesh", "repair", mesh.name, "-o", "out.ply", "--weld", "1e-6%", "--fill-holes", "5",
         "--split-sheets"},
        {"mesh", "crop", mesh.name, "-o", "out.ply", "--box", ",,,,,0.5"},
        {"convert", mesh.name, "-o", "out.stl", "--up", "y", "--unit", "mm"}}) {
    const Outcome outcome = run(command);
    const bool isCrop = command[1] == "crop";
    EXPECT_TRUE(std::ranges::find(mesh.codes, outcome.code) != mesh.codes.end() ||
                (isCrop && outcome.code == 2))
        << command[1] << " " << mesh.name << ": " << outcome.code << " " << outcome.err;
    if (outcome.code != 0) {
      EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Every, DirtyMeshes, ::testing::Range(std::size_t(0), dirty().size()),
                         [](const auto& mesh) {
                           std::string name = dirty()[mesh.param].name;
                           std::ranges::replace(name, '.', '_');
                           return name;
                         });

}  // namespace
}  // namespace arete::cli_test
