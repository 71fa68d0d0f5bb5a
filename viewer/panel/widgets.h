// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace arete::widget {

// What panels are made of, with Dear ImGui. Precondition of all: an ImGui context is current and a frame has
// begun.

/// The height of a letter.
float em();

/// A column of sections at the left or right edge of the picture; in a narrow window no wider than half of
/// it.
void beginColumn(const char* name, bool isRight);
/// @return how much of the picture's width the column covers: 0 where it leaves more than half of the height
/// free.
double endColumn();
/// Whether two columns leave too little of the window to see a picture between them.
bool isNarrow();
/// @param isOpen at first.
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
/// In the middle of the lower edge, over the status.
void showMessage(const std::string& text);
/// A line at the lower edge.
void showStatus(const std::string& text);
/// A question in the middle, with the words of its two answers.
///
/// @return the answer, once it is there.
std::optional<bool> askQuestion(const std::string& text, const char* yes, const char* no);

/// "12 345".
std::string grouped(std::uint64_t value);
std::string megabytes(std::uint64_t bytes);

}  // namespace arete::widget
