// SPDX-License-Identifier: GPL-3.0-or-later
//
// The shaders are compiled into the program as text (see CMakeLists.txt); a stage is a list of files.
#include "viewer/gl/gl_program.h"

#include <fmt/format.h>

#include <string>

namespace arete {
namespace {

std::string trimmed(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\0' || text.back() == ' ')) text.pop_back();
  return text;
}

}  // namespace

Result<GlProgram> makeProgram(std::initializer_list<ShaderStage> stages) {
  GlProgram program(glCreateProgram());
  for (const ShaderStage& stage : stages) {
    std::string source = fmt::format("#version 450 core\n{}", stage.definitions);
    std::string_view last;
    for (const std::string_view file : stage.files) {
      source += fmt::format("#line 1\n{}\n", shaderText(file));
      last = file;
    }
    const GLuint shader = glCreateShader(stage.kind);
    const char* text = source.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint isCompiled = 0, length = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &isCompiled);
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 0)), '\0');
    if (length > 0) glGetShaderInfoLog(shader, length, nullptr, log.data());
    glAttachShader(program, shader);
    glDeleteShader(shader);
    if (!isCompiled)
      return failure(ErrorCode::unsupported, "the graphics driver does not compile it: " + trimmed(log),
                     "shader " + std::string(last));
  }
  glLinkProgram(program);
  GLint isLinked = 0, length = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &isLinked);
  if (!isLinked) {
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 0)), '\0');
    if (length > 0) glGetProgramInfoLog(program, length, nullptr, log.data());
    return failure(ErrorCode::unsupported, "the graphics driver does not link it: " + trimmed(log),
                   "shader " + std::string(*(stages.end() - 1)->files.begin()));
  }
  return program;
}

}  // namespace arete
