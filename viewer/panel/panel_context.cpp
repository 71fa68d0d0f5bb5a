// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/panel/panel_context.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>
#include <imgui.h>

#include <array>
#include <filesystem>
#include <system_error>
#include <vector>

#include "viewer/gl/frame_target.h"

namespace arete {
namespace {

void setStyle(float scale) {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 5;
  style.FrameRounding = 3;
  style.GrabRounding = 3;
  style.WindowPadding = {9, 8};
  style.ItemSpacing = {7, 4};
  style.WindowBorderSize = 0;
  style.Colors[ImGuiCol_WindowBg] = {0.09f, 0.10f, 0.12f, 0.86f};
  style.Colors[ImGuiCol_Header] = {0.20f, 0.30f, 0.38f, 0.80f};
  style.Colors[ImGuiCol_HeaderHovered] = {0.26f, 0.40f, 0.50f, 0.90f};
  style.Colors[ImGuiCol_FrameBg] = {0.27f, 0.30f, 0.35f, 0.90f};
  style.GrabMinSize = 7;
  style.Colors[ImGuiCol_CheckMark] = {0.95f, 0.70f, 0.25f, 1};
  style.Colors[ImGuiCol_SliderGrab] = {0.95f, 0.70f, 0.25f, 0.55f};
  style.Colors[ImGuiCol_SliderGrabActive] = {0.95f, 0.70f, 0.25f, 0.9f};
  style.Colors[ImGuiCol_PlotHistogram] = {0.95f, 0.70f, 0.25f, 1};
  style.Colors[ImGuiCol_Button] = {0.24f, 0.33f, 0.40f, 1};
  style.ScaleAllSizes(scale);
}

/// DejaVu Sans where distributions put it; ImGui's own letters elsewhere.
void addFont(ImGuiIO& io, float pixels) {
  static constexpr std::array<ImWchar, 5> kRanges = {0x20, 0x17F, 0x2010, 0x2044, 0};
  for (const char* path : {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                           "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                           "/usr/share/fonts/TTF/DejaVuSans.ttf", "/usr/share/fonts/dejavu/DejaVuSans.ttf"}) {
    std::error_code ignored;
    if (std::filesystem::exists(path, ignored) &&
        io.Fonts->AddFontFromFileTTF(path, pixels, nullptr, kRanges.data()))
      return;
  }
  ImFontConfig config;
  config.SizePixels = pixels;
  io.Fonts->AddFontDefault(&config);
}

}  // namespace

PanelContext::PanelContext(GLFWwindow* window, float scale) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // nothing is written anywhere
  setStyle(scale);
  addFont(io, 14.0f * scale);
  ImGui_ImplGlfw_InitForOpenGL(window, true);
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

PanelContext::~PanelContext() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void PanelContext::beginFrame() {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void PanelContext::drawFrame() {
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

Image windowImage(int width, int height) {
  std::vector<std::uint8_t> bytes(std::size_t(4) * std::size_t(width) * std::size_t(height));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
  glReadBuffer(GL_BACK);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
  return imageFromBottomUp(width, height, bytes);
}

}  // namespace arete
