// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <span>
#include <utility>

namespace arete {

/// Owns an OpenGL name. Movable; 0 = empty. Precondition: a context is current whenever one is created, used
/// or destroyed.
template <void (*Delete)(GLuint)>
class GlName {
 public:
  GlName() = default;
  explicit GlName(GLuint name) : name_(name) {}
  GlName(GlName&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlName& operator=(GlName&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  ~GlName() {
    if (name_ != 0) Delete(name_);
  }
  operator GLuint() const { return name_; }

 private:
  GLuint name_ = 0;
};

namespace gl {
inline void deleteBuffer(GLuint n) {
  glDeleteBuffers(1, &n);
}
inline void deleteTexture(GLuint n) {
  glDeleteTextures(1, &n);
}
inline void deleteFramebuffer(GLuint n) {
  glDeleteFramebuffers(1, &n);
}
inline void deleteVertexArray(GLuint n) {
  glDeleteVertexArrays(1, &n);
}
inline void deleteProgram(GLuint n) {
  glDeleteProgram(n);
}
inline void deleteQuery(GLuint n) {
  glDeleteQueries(1, &n);
}
}  // namespace gl

using GlBuffer = GlName<gl::deleteBuffer>;
using GlTexture = GlName<gl::deleteTexture>;
using GlFramebuffer = GlName<gl::deleteFramebuffer>;
using GlVertexArray = GlName<gl::deleteVertexArray>;
using GlProgram = GlName<gl::deleteProgram>;
using GlQuery = GlName<gl::deleteQuery>;

/// Creates a buffer of at least one byte; zeros without data.
inline GlBuffer makeBuffer(std::size_t bytes, const void* data = nullptr,
                           GLbitfield flags = GL_DYNAMIC_STORAGE_BIT) {
  GLuint name = 0;
  glCreateBuffers(1, &name);
  glNamedBufferStorage(name, static_cast<GLsizeiptr>(bytes == 0 ? 4 : bytes), bytes == 0 ? nullptr : data,
                       flags);
  if (data == nullptr) glClearNamedBufferData(name, GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE, nullptr);
  return GlBuffer(name);
}
template <class T>
GlBuffer makeBuffer(std::span<const T> data, GLbitfield flags = GL_DYNAMIC_STORAGE_BIT) {
  return makeBuffer(data.size_bytes(), data.empty() ? nullptr : data.data(), flags);
}

inline GlVertexArray makeVertexArray() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  return GlVertexArray(name);
}
inline GlTexture makeTexture(GLenum target) {
  GLuint name = 0;
  glCreateTextures(target, 1, &name);
  return GlTexture(name);
}
inline GlFramebuffer makeFramebuffer() {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  return GlFramebuffer(name);
}
inline GlQuery makeQuery(GLenum target) {
  GLuint name = 0;
  glCreateQueries(target, 1, &name);
  return GlQuery(name);
}

}  // namespace arete
