// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <initializer_list>
#include <string_view>

#include "engine/base/result.h"
#include "viewer/gl/gl_objects.h"

namespace arete {

/// The text of a file of viewer/gl/shaders; empty if it does not exist.
std::string_view shaderText(std::string_view name);

/// One stage of a program: files of viewer/gl/shaders, put together in this order.
struct ShaderStage {
  GLenum kind;  ///< GL_VERTEX_SHADER, ...
  std::initializer_list<std::string_view> files;
  std::string_view definitions = {};  ///< lines before them
};

/// Compiles and links. Errors: unsupported, with the driver's message, naming the last file of the stage.
Result<GlProgram> makeProgram(std::initializer_list<ShaderStage> stages);

}  // namespace arete
