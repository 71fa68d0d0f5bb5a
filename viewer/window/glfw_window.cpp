// SPDX-License-Identifier: GPL-3.0-or-later
//
// GLFW callbacks collect events between frames; held keys and sticks are polled once per frame.
#include "viewer/window/glfw_window.h"

#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "viewer/gl/offscreen.h"

namespace arete {
namespace {

/// GLFW hands its reasons to a function without an owner.
std::string& lastReason() {
  static std::string reason;
  return reason;
}

void keepReason(int, const char* text) {
  lastReason() = text;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

constexpr double kDragPixels = 4;  // a hand that clicks is never quite still

void askForContext(int major, int minor) {
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  if (major == 0) return;
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, major);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, minor);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  // The terrain is drawn beside and copied; the window itself needs neither depth nor samples.
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
}

/// There was no context of 4.5: what there is instead.
std::string whatThereIs() {
  askForContext(0, 0);
  std::string found = "no OpenGL at all";
  if (GLFWwindow* any = glfwCreateWindow(64, 64, "arete", nullptr, nullptr)) {
    glfwMakeContextCurrent(any);
    const auto text = [](GLenum name) {
      const auto* got = reinterpret_cast<const char*>(glGetString(name));
      return std::string(got ? got : "unknown");
    };
    found = fmt::format("{} with OpenGL {}", text(GL_RENDERER), text(GL_VERSION));
    glfwMakeContextCurrent(nullptr);
    glfwDestroyWindow(any);
  }
  return found;
}

}  // namespace

struct GlfwWindow::Held {
  GLFWwindow* window = nullptr;
  std::string description;
  std::vector<std::pair<int, int>> keys;  // pressed, and with which modifiers
  std::vector<std::string> dropped;
  double wheel = 0, lastTime = 0;
  Vec2 mouse, pressed;
  bool isPressed = false, isDragged = false, wasInWindow = false;
  std::array<unsigned char, GLFW_GAMEPAD_BUTTON_LAST + 1> buttons{};

  ~Held() {
    if (window) glfwDestroyWindow(window);
    glfwTerminate();
  }
};

Result<GlfwWindow> GlfwWindow::open(const std::string& title, int width, int height, bool waitsForScreen) {
  lastReason().clear();
  glfwSetErrorCallback(keepReason);
  if (!glfwInit())
    return failure(
        ErrorCode::unsupported,
        fmt::format("no window can be opened ({}); `headless` draws without one", trimmed(lastReason())),
        "display");
  auto held = std::make_unique<Held>();
  askForContext(4, 5);
  held->window = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (!held->window)
    return failure(ErrorCode::unsupported,
                   fmt::format("OpenGL 4.5 is needed, and there is {}", whatThereIs()), "OpenGL");
  glfwMakeContextCurrent(held->window);
  ARETE_TRY(std::string found, checkOpenGl());
  held->description = std::move(found);
  glfwSwapInterval(waitsForScreen ? 1 : 0);
  glfwSetWindowUserPointer(held->window, held.get());
  glfwSetWindowSizeLimits(held->window, 320, 240, GLFW_DONT_CARE, GLFW_DONT_CARE);
  glfwSetScrollCallback(held->window, [](GLFWwindow* w, double, double notches) {
    static_cast<Held*>(glfwGetWindowUserPointer(w))->wheel += notches;
  });
  glfwSetKeyCallback(held->window, [](GLFWwindow* w, int key, int, int action, int modifiers) {
    if (action == GLFW_PRESS)
      static_cast<Held*>(glfwGetWindowUserPointer(w))->keys.emplace_back(key, modifiers);
  });
  glfwSetDropCallback(held->window, [](GLFWwindow* w, int count, const char** paths) {
    auto& dropped = static_cast<Held*>(glfwGetWindowUserPointer(w))->dropped;
    dropped.assign(paths, paths + count);
  });
  // A click between two slow frames is one all the same.
  glfwSetInputMode(held->window, GLFW_STICKY_MOUSE_BUTTONS, GLFW_TRUE);
  held->lastTime = glfwGetTime();
  return GlfwWindow(std::move(held));
}

GlfwWindow::GlfwWindow(std::unique_ptr<Held> held) : held_(std::move(held)) {}
GlfwWindow::GlfwWindow(GlfwWindow&&) noexcept = default;
GlfwWindow& GlfwWindow::operator=(GlfwWindow&&) noexcept = default;
GlfwWindow::~GlfwWindow() = default;

GLFWwindow* GlfwWindow::handle() const {
  return held_->window;
}

const std::string& GlfwWindow::description() const {
  return held_->description;
}

bool GlfwWindow::isClosing() const {
  return glfwWindowShouldClose(held_->window) != 0;
}

int GlfwWindow::widthPixels() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(held_->window, &width, &height);
  return width;
}

int GlfwWindow::heightPixels() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(held_->window, &width, &height);
  return height;
}

double GlfwWindow::pixelsPerUnit() const {
  int units = 0, height = 0;
  glfwGetWindowSize(held_->window, &units, &height);
  return units > 0 ? double(widthPixels()) / units : 1;
}

float GlfwWindow::contentScale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(held_->window, &x, &y);
  // Where positions of the mouse are in pixels letters grow; elsewhere the system makes them grow.
  return std::max(1.0f, y / float(pixelsPerUnit()));
}

void GlfwWindow::setTitle(const std::string& title) {
  glfwSetWindowTitle(held_->window, title.c_str());
}

void GlfwWindow::show() {
  glfwShowWindow(held_->window);
}

void GlfwWindow::wait(double seconds) {
  glfwWaitEventsTimeout(seconds);
}

GlfwWindow::Events GlfwWindow::poll(bool isMouseTaken, bool areKeysTaken) {
  Held& h = *held_;
  glfwPollEvents();
  Events events;
  InputState& in = events.input;
  events.dropped = std::exchange(h.dropped, {});
  const double now = glfwGetTime();
  // A window that was hidden, or a machine that slept, does not fly on.
  in.seconds = std::min(now - h.lastTime, 0.25);
  h.lastTime = now;

  Vec2 mouse;
  glfwGetCursorPos(h.window, &mouse.x, &mouse.y);
  const double scale = pixelsPerUnit();
  mouse = {mouse.x * scale, mouse.y * scale};
  const bool isFirst = !h.wasInWindow;
  h.wasInWindow = true;
  in.mouse = mouse;
  in.isOverPicture = !isMouseTaken && glfwGetWindowAttrib(h.window, GLFW_HOVERED) != 0;
  if (!isFirst) in.mouseMoved = {mouse.x - h.mouse.x, mouse.y - h.mouse.y};
  h.mouse = mouse;
  const auto button = [&](int which) { return glfwGetMouseButton(h.window, which) == GLFW_PRESS; };
  if (!isMouseTaken) {
    in.wheel = h.wheel;
    in.leftButton = button(GLFW_MOUSE_BUTTON_LEFT);
    in.middleButton = button(GLFW_MOUSE_BUTTON_MIDDLE);
    in.rightButton = button(GLFW_MOUSE_BUTTON_RIGHT);
    if (in.leftButton && !h.isPressed) {
      h.pressed = mouse;
      h.isDragged = false;
    }
    const double away = std::hypot(mouse.x - h.pressed.x, mouse.y - h.pressed.y);
    h.isDragged = h.isDragged || away > kDragPixels * scale;
    if (!in.leftButton && h.isPressed && !h.isDragged) events.click = mouse;
    h.isPressed = in.leftButton;
    // A click that trembles turns nothing.
    if (in.leftButton && !h.isDragged) in.mouseMoved = {};
  } else {
    h.isPressed = false;
  }
  h.wheel = 0;

  if (!areKeysTaken) {
    const auto held = [&](int key) { return glfwGetKey(h.window, key) == GLFW_PRESS; };
    const auto pair = [&](int more, int less) { return double(held(more)) - double(held(less)); };
    in.isFast = held(GLFW_KEY_LEFT_SHIFT) || held(GLFW_KEY_RIGHT_SHIFT);
    in.isSlow = held(GLFW_KEY_LEFT_ALT);
    if (!held(GLFW_KEY_LEFT_CONTROL) && !held(GLFW_KEY_RIGHT_CONTROL)) {
      in.ahead = pair(GLFW_KEY_W, GLFW_KEY_S);
      in.right = pair(GLFW_KEY_D, GLFW_KEY_A);
      in.up = pair(GLFW_KEY_E, GLFW_KEY_Q);
    }
    in.turnRight = pair(GLFW_KEY_RIGHT, GLFW_KEY_LEFT);
    in.turnUp = pair(GLFW_KEY_UP, GLFW_KEY_DOWN);
    for (const auto& [key, modifiers] : h.keys)
      if (const auto action = actionOfKey(key, (modifiers & GLFW_MOD_CONTROL) != 0))
        events.actions.push_back(*action);
  }
  h.keys.clear();

  GLFWgamepadstate pad;
  for (int stick = GLFW_JOYSTICK_1; stick <= GLFW_JOYSTICK_4; ++stick) {
    if (!glfwGetGamepadState(stick, &pad)) continue;
    in.gamepad = {.leftX = double(pad.axes[GLFW_GAMEPAD_AXIS_LEFT_X]),
                  .leftY = double(pad.axes[GLFW_GAMEPAD_AXIS_LEFT_Y]),
                  .rightX = double(pad.axes[GLFW_GAMEPAD_AXIS_RIGHT_X]),
                  .rightY = double(pad.axes[GLFW_GAMEPAD_AXIS_RIGHT_Y]),
                  // GLFW: -1 at rest.
                  .leftTrigger = (double(pad.axes[GLFW_GAMEPAD_AXIS_LEFT_TRIGGER]) + 1) / 2,
                  .rightTrigger = (double(pad.axes[GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER]) + 1) / 2,
                  .isFast = pad.buttons[GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER] == GLFW_PRESS};
    for (std::size_t b = 0; b < h.buttons.size(); ++b) {
      if (pad.buttons[b] == GLFW_PRESS && h.buttons[b] != GLFW_PRESS)
        if (const auto action = actionOfButton(int(b))) events.actions.push_back(*action);
      h.buttons[b] = pad.buttons[b];
    }
    break;
  }
  return events;
}

}  // namespace arete
