// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tries the EGL displays of displays(), then GLFW with a hidden window. The first context with OpenGL 4.5 is
// used.
#include "viewer/gl/offscreen.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <array>
#include <functional>
#include <vector>

namespace arete {
namespace {

const char* text(GLenum name) {
  const auto* found = reinterpret_cast<const char*>(glGetString(name));
  return found ? found : "unknown";
}

/// Current, or nothing of it left.
bool makeCurrent(EGLDisplay display, EGLContext& context) {
  EGLint major = 0, minor = 0;
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, &major, &minor)) return false;
  constexpr std::array<EGLint, 5> wanted = {EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE,
                                            EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  eglChooseConfig(display, wanted.data(), &config, 1, &count);
  constexpr std::array<EGLint, 7> version = {EGL_CONTEXT_MAJOR_VERSION,
                                             4,
                                             EGL_CONTEXT_MINOR_VERSION,
                                             5,
                                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                             EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                             EGL_NONE};
  if (eglBindAPI(EGL_OPENGL_API))
    context = eglCreateContext(display, count > 0 ? config : nullptr, EGL_NO_CONTEXT, version.data());
  if (context != EGL_NO_CONTEXT && eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
    return true;
  if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
  context = EGL_NO_CONTEXT;
  eglTerminate(display);
  return false;
}

std::vector<std::function<EGLDisplay()>> displays() {
  std::vector<std::function<EGLDisplay()>> found;
  const auto hasClient = [](const char* extension) {
    return epoxy_has_egl_extension(EGL_NO_DISPLAY, extension);
  };
  if (!hasClient("EGL_EXT_platform_base")) return found;
  if (hasClient("EGL_EXT_platform_device") && hasClient("EGL_EXT_device_enumeration")) {
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (eglQueryDevicesEXT(EGLint(devices.size()), devices.data(), &count))
      for (EGLint i = 0; i < count; ++i)
        found.emplace_back([device = devices[std::size_t(i)]] {
          return eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
        });
  }
  if (hasClient("EGL_MESA_platform_surfaceless"))
    found.emplace_back(
        [] { return eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr); });
  return found;
}

}  // namespace

struct OffscreenContext::Held {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  GLFWwindow* window = nullptr;
  std::string description;

  // The context goes before the display or the library that it belongs to.
  ~Held() {
    if (context != EGL_NO_CONTEXT) {
      eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
      eglDestroyContext(display, context);
      eglTerminate(display);
    }
    if (window) {
      glfwDestroyWindow(window);
      glfwTerminate();
    }
  }
};

// A display that opens has not yet a context of version 4.5, so the next one is tried until one has. A hidden
// window is the last resort, on machines whose EGL has no devices.
Result<OffscreenContext> OffscreenContext::create() {
  auto held = std::make_unique<Held>();
  for (const auto& open : displays()) {
    held->display = open();
    if (makeCurrent(held->display, held->context)) break;
  }
  if (held->context == EGL_NO_CONTEXT && glfwInit()) {
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    held->window = glfwCreateWindow(64, 64, "arete", nullptr, nullptr);
    if (held->window)
      glfwMakeContextCurrent(held->window);
    else
      glfwTerminate();
  }
  if (held->context == EGL_NO_CONTEXT && !held->window)
    return failure(
        ErrorCode::unsupported,
        "no OpenGL 4.5 context can be had: neither an EGL device nor a display offers one; Mesa's software "
        "renderer does (Debian: libegl1, libgl1-mesa-dri)",
        "OpenGL");
  ARETE_TRY(std::string found, checkOpenGl());
  held->description = std::move(found);
  return OffscreenContext(std::move(held));
}

OffscreenContext::OffscreenContext(std::unique_ptr<Held> held) : held_(std::move(held)) {}
OffscreenContext::OffscreenContext(OffscreenContext&&) noexcept = default;
OffscreenContext& OffscreenContext::operator=(OffscreenContext&&) noexcept = default;
OffscreenContext::~OffscreenContext() = default;

const std::string& OffscreenContext::description() const {
  return held_->description;
}

// The version is checked once a context is there, since a driver may give an older one than was wanted.
Result<std::string> checkOpenGl() {
  const int version = epoxy_gl_version();
  if (!epoxy_is_desktop_gl() || version < 45)
    return failure(ErrorCode::unsupported,
                   fmt::format("OpenGL 4.5 is needed, and {} offers {}", text(GL_RENDERER), text(GL_VERSION)),
                   "OpenGL");
  return fmt::format("{}, OpenGL {}", text(GL_RENDERER), text(GL_VERSION));
}

}  // namespace arete
