// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

namespace arete::widget {

// What panels are made of, with Dear ImGui. Precondition of all: an ImGui context is current and a frame has
// begun.

/// The height of a letter.
float em();

/// A column of sections at the left or right edge of the picture.
void beginColumn(const char* name, bool isRight);
void endColumn();
/// @return whether the section is open.
bool section(const char* name, bool isOpen = true);

void line(const std::string& text);
void dim(const std::string& text);
/// A name, and what it is, in line with the others.
void row(const char* name, const std::string& value);
/// A slider over a double.
///
/// @return whether it was moved.
bool slider(const char* name, double& value, double low, double high, const char* format,
            bool isLogarithmic = false);
/// Shown while the mouse is over the last widget.
void tip(const char* text);
/// In the middle of the lower edge.
void showMessage(const std::string& text);

/// "12 345".
std::string grouped(std::uint64_t value);
std::string megabytes(std::uint64_t bytes);

}  // namespace arete::widget
