// SPDX-License-Identifier: GPL-3.0-or-later
// The colours that a shader finds, and its light, against the processor's, byte by byte.
#include "viewer/gl/color_maps_on_gpu.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <iostream>
#include <limits>
#include <string>

#include "datasets/random.h"
#include "viewer/color/color_tables.h"
#include "viewer/color/light.h"
#include "viewer/color_oracle.h"
#include "viewer/drawn_mesh.h"
#include "viewer/gl/gl_program.h"

namespace arete {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();

constexpr const char* kMain = R"(
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Asked { float asked[]; };
layout(std430, binding = 1) writeonly buffer Found { uint found[]; };
layout(location = 0) uniform uint map;
void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i < asked.length()) found[i] = packUnorm4x8(colorOf(map, asked[i]));
}
)";

GlProgram compiled(const std::string& text) {
  const GLuint shader = glCreateShader(GL_COMPUTE_SHADER);
  const char* source = text.c_str();
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GlProgram program(glCreateProgram());
  glAttachShader(program, shader);
  glLinkProgram(program);
  glDeleteShader(shader);
  GLint isLinked = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &isLinked);
  std::array<char, 2000> log{};
  glGetProgramInfoLog(program, GLsizei(log.size()), nullptr, log.data());
  EXPECT_TRUE(isLinked) << log.data();
  return program;
}

template <class T>
std::vector<T> run(GLuint program, const std::vector<float>& asked, std::size_t count) {
  const GlBuffer from = makeBuffer(std::span(asked)), to = makeBuffer(count * sizeof(T));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, from);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, to);
  glUseProgram(program);
  glDispatchCompute(GLuint((count + 63) / 64), 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::vector<T> found(count);
  glGetNamedBufferSubData(to, 0, GLsizeiptr(count * sizeof(T)), found.data());
  return found;
}

Rgba unpacked(std::uint32_t c) {
  return {std::uint8_t(c), std::uint8_t(c >> 8), std::uint8_t(c >> 16), std::uint8_t(c >> 24)};
}

TEST(ColorMapsOnGpu, GiveTheBytesOfTheProcessor) {
  ARETE_NEEDS_OPENGL(context);
  std::vector<ColorMap> maps;
  for (const ColorTable& table : colorTables()) maps.push_back(table.map);
  maps.push_back(heightColors(-120, 4200, 0));
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    Random random(seed);
    const auto byte = [&] { return std::uint8_t(random.next() % 256); };
    std::vector<ColorStop> stops;
    for (std::uint64_t i = 0, n = 1 + random.next() % 20; i < n; ++i)
      stops.push_back({std::round(random.between(-50, 50)), {byte(), byte(), byte(), byte()}});
    if (seed % 3 == 0) stops.push_back({-kInfinite, {byte(), byte(), byte(), byte()}});
    if (seed % 5 == 0) stops.push_back({kInfinite, {byte(), byte(), byte(), byte()}});
    if (seed % 7 == 0) stops.push_back({3e38, {byte(), byte(), byte(), byte()}});
    ColorMapOptions options;
    options.between = ColorsBetween(seed % 4);
    if (seed % 2 == 0) options.outside = Rgba{byte(), byte(), byte(), byte()};
    options.nodata = {byte(), byte(), byte(), byte()};
    maps.push_back(ColorMap::make(stops, options).value());
  }
  const ColorMapsOnGpu onGpu(maps);
  const std::string head = "#version 450 core\n";
  const GlProgram program = compiled(head + std::string(shaderText("color_map.glsl")) + kMain);
  onGpu.bind();
  for (std::size_t m = 0; m < maps.size(); ++m) {
    const ColorMap& map = maps[m];
    std::vector<float> asked = {kInfinite, -kInfinite, std::nanf(""), 0.0f, -0.0f, 1e38f, -1e38f};
    Random random(m + 77);
    const double extent = map.high() - map.low();
    for (int i = 0; i < 3000; ++i)
      asked.push_back(float(random.between(map.low() - 0.1 * extent - 1, map.high() + 0.1 * extent + 1)));
    for (const ColorStop& stop : map.stops()) {
      const auto v = float(stop.value);
      asked.insert(asked.end(), {v, std::nextafter(v, -kInfinite), std::nextafter(v, kInfinite)});
    }
    glProgramUniform1ui(program, 0, onGpu.place(m));
    const auto found = run<std::uint32_t>(program, asked, asked.size());
    for (std::size_t i = 0; i < asked.size(); ++i)
      ASSERT_EQ(unpacked(found[i]), map.at(double(asked[i]))) << "map " << m << " at " << asked[i];
  }
}

TEST(ColorMapsOnGpu, AreLitAsTheProcessorLights) {
  ARETE_NEEDS_OPENGL(context);
  const GlProgram program = compiled("#version 450 core\n" + std::string(shaderText("light.glsl")) + R"(
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Asked { float asked[]; };
layout(std430, binding = 1) writeonly buffer Found { uint found[]; };
void main() {
  uint i = gl_GlobalInvocationID.x;
  vec3 c = vec3(asked[4u * i], asked[4u * i + 1u], asked[4u * i + 2u]) / 255.0;
  found[i] = packUnorm4x8(vec4(srgbOf(litLinear(linearOf(c), vec3(asked[4u * i + 3u]))), 1.0));
})");
  Random random(5);
  std::vector<float> asked;
  for (int i = 0; i < 4096; ++i) {
    for (int c = 0; c < 3; ++c) asked.push_back(float(random.next() % 256));
    asked.push_back(float(i % 8 == 0 ? 1 : random.between(0, 3)));
  }
  const auto found = run<std::uint32_t>(program, asked, 4096);
  for (std::size_t i = 0; i < 4096; ++i) {
    const Rgb c{std::uint8_t(asked[4 * i]), std::uint8_t(asked[4 * i + 1]), std::uint8_t(asked[4 * i + 2])};
    const double k = double(asked[4 * i + 3]);
    const Rgb expected = lit(c, {k, k, k}), got = unpacked(found[i]).opaque();
    for (const auto& [e, g] : {std::pair(expected.r, got.r), {expected.g, got.g}, {expected.b, got.b}})
      ASSERT_LE(std::abs(int(e) - int(g)), k == 1 ? 0 : 1) << "under " << k;
  }
}

TEST(ColorMapsOnGpu, KeepLevelGroundAsItIsAndClipNoCliff) {
  ARETE_NEEDS_OPENGL(context);
  const GlProgram program = compiled("#version 450 core\n" + std::string(shaderText("light.glsl")) + R"(
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Asked { float asked[]; };
layout(std430, binding = 1) writeonly buffer Found { uint found[]; };
void main() {
  uint i = gl_GlobalInvocationID.x;
  float up = asked[2u * i], slope = asked[2u * i + 1u];
  vec3 sun = vec3(-cos(up), 0.0, sin(up)), normal = normalize(vec3(-slope, 0.0, 1.0));
  found[i] = packUnorm4x8(vec4(srgbOf(litLinear(linearOf(vec3(247.0, 236.0, 196.0) / 255.0), lightOnGround(normal, sun))), 1.0));
})");
  std::vector<float> asked;
  for (int elevation = 2; elevation <= 90; elevation += 4)
    for (const float slope : {0.0f, 0.3f, 1.0f, 5.0f, 50.0f, -0.3f, -2.0f}) {
      asked.push_back(float(elevation) * 0.0174533f);
      asked.push_back(slope);
    }
  const auto found = run<std::uint32_t>(program, asked, asked.size() / 2);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Rgb c = unpacked(found[i]).opaque();
    if (asked[2 * i + 1] == 0) {
      EXPECT_EQ(c, (Rgb{247, 236, 196})) << "sun at " << asked[2 * i];
    } else {
      EXPECT_LT(std::max({c.r, c.g, c.b}), 255)
          << "sun at " << asked[2 * i] << ", slope " << asked[2 * i + 1];
    }
  }
}

}  // namespace
}  // namespace arete
