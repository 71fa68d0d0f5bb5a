// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/panel/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace arete::widget {
namespace {

constexpr ImGuiWindowFlags kColumn = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoTitleBar |
                                     ImGuiWindowFlags_AlwaysAutoResize;

}  // namespace

// Sizes are multiples of the font's size, so that the panel follows the scale of the screen.
float em() {
  return ImGui::GetFontSize();
}

void line(const std::string& text) {
  ImGui::TextUnformatted(text.c_str());
}

void dim(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::PushTextWrapPos(0);
  line(text);
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

// The values of all rows begin in one column, 5.2 letters from the left.
void row(const char* name, const std::string& value) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextUnformatted(name);
  ImGui::PopStyleColor();
  ImGui::SameLine(5.2f * em());
  line(value);
}

std::string grouped(std::uint64_t value) {
  const std::string digits = std::to_string(value);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ' ';
    text += digits[i];
  }
  return text;
}

std::string megabytes(std::uint64_t bytes) {
  return fmt::format("{} MB", grouped(bytes / 1'000'000));
}

bool isNarrow() {
  return ImGui::GetIO().DisplaySize.x < 60 * em();
}

bool section(const char* name, bool isOpen) {
  return ImGui::CollapsingHeader(name, isOpen ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

// The library slides floats only; the value keeps its own digits until the user moves the slider.
bool slider(const char* name, double& value, double low, double high, const char* format,
            bool isLogarithmic) {
  auto shown = float(value);
  const bool isChanged = ImGui::SliderFloat(name, &shown, float(low), float(high), format,
                                            isLogarithmic ? ImGuiSliderFlags_Logarithmic : 0);
  if (isChanged) value = double(shown);
  return isChanged;
}

void tip(const char* text) {
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(22 * em());
  ImGui::TextUnformatted(text);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

// The column stands at one side of the window, has a fixed width and is never higher than the window.
void beginColumn(const char* name, bool isRight) {
  const ImGuiIO& io = ImGui::GetIO();
  const float gap = 0.5f * em(), width = std::min(20 * em(), io.DisplaySize.x / 2 - 2 * gap);
  ImGui::SetNextWindowPos({isRight ? io.DisplaySize.x - gap : gap, gap}, ImGuiCond_Always,
                          {isRight ? 1.0f : 0.0f, 0});
  ImGui::SetNextWindowSizeConstraints({width, 0}, {width, std::max(io.DisplaySize.y - 2 * gap, 4 * em())});
  ImGui::Begin(name, nullptr, kColumn);
  ImGui::PushItemWidth(std::min(9.2f * em(), 0.46f * width));
}

double endColumn() {
  const ImGuiIO& io = ImGui::GetIO();
  const ImVec2 size = ImGui::GetWindowSize();
  ImGui::PopItemWidth();
  ImGui::End();
  return size.y > io.DisplaySize.y / 2 ? double((size.x + 0.5f * em()) / io.DisplaySize.x) : 0;
}

// A message lies at the lower left, where no scale bar is, and takes no input, so that it is never in the way
// of the mouse.
void showMessage(const std::string& text) {
  const ImGuiIO& io = ImGui::GetIO();
  ImGui::SetNextWindowPos({0.5f * em(), io.DisplaySize.y - 3 * em()}, ImGuiCond_Always, {0, 1});
  ImGui::Begin("message", nullptr, kColumn | ImGuiWindowFlags_NoInputs);
  ImGui::PushTextWrapPos(std::max(io.DisplaySize.x - 42 * em(), 24 * em()));
  line(text);
  ImGui::PopTextWrapPos();
  ImGui::End();
}

void showStatus(const std::string& text) {
  const ImGuiIO& io = ImGui::GetIO();
  ImGui::SetNextWindowPos({0.5f * em(), io.DisplaySize.y - 0.4f * em()}, ImGuiCond_Always, {0, 1});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {io.DisplaySize.x, io.DisplaySize.y});
  ImGui::Begin("status", nullptr, kColumn | ImGuiWindowFlags_NoInputs);
  line(text);
  ImGui::End();
}

std::optional<bool> askQuestion(const std::string& text, const char* yes, const char* no) {
  const ImGuiIO& io = ImGui::GetIO();
  ImGui::SetNextWindowPos({io.DisplaySize.x / 2, io.DisplaySize.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowFocus();
  ImGui::Begin("question", nullptr, kColumn);
  ImGui::PushTextWrapPos(std::min(36 * em(), io.DisplaySize.x - 3 * em()));
  line(text);
  ImGui::PopTextWrapPos();
  std::optional<bool> answer;
  if (ImGui::Button(yes)) answer = true;
  ImGui::SameLine();
  if (ImGui::Button(no)) answer = false;
  ImGui::End();
  return answer;
}

}  // namespace arete::widget
