// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reports as text. A table knows nothing of what it shows: its rows and columns are the variants and names
// that occur, in the order in which they were measured.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "bench/figure.h"

namespace arete::bench {
namespace {

std::string grouped(std::string digits) {
  for (std::size_t i = digits.size(); i > 3;) digits.insert(i -= 3, 1, ' ');
  return digits;
}

/// Four significant digits; whole numbers whole, in groups of three.
std::string numberText(double value) {
  if (value == std::floor(value) && std::abs(value) < 1e15) return grouped(fmt::format("{:.0f}", value));
  if (std::abs(value) >= 1000) return grouped(fmt::format("{:.0f}", value));
  return fmt::format("{:.4g}", value);
}

template <class T>
void addOnce(std::vector<T>& list, const T& value) {
  if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
}

/// Cells of equal width in each column; the first two columns hold text, the others numbers.
std::string tableText(const std::vector<std::vector<std::string>>& rows, bool markdown) {
  std::vector<std::size_t> width(rows.front().size(), 3);
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) width[c] = std::max(width[c], row[c].size());
  std::string text;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t c = 0; c < rows[r].size(); ++c) {
      const std::string padding(width[c] - rows[r][c].size(), ' ');
      text += markdown ? "| " : c == 0 ? "" : "  ";
      text += c < 2 ? rows[r][c] + padding : padding + rows[r][c];
      if (markdown) text += " ";
    }
    text += markdown ? "|\n" : "\n";
    if (r > 0 || !markdown) continue;
    for (std::size_t c = 0; c < width.size(); ++c)
      text += fmt::format("|{}{}", std::string(width[c] + 1, '-'), c < 2 ? '-' : ':');
    text += "|\n";
  }
  return text;
}

std::string stageTable(const Figures& figures, const std::string& stage) {
  std::vector<std::pair<std::string, std::string>> rowKeys;
  std::vector<std::pair<std::string, std::string>> columns;  // name, unit
  for (const Figure& f : figures) {
    if (f.stage != stage) continue;
    addOnce(rowKeys, {f.dem, f.variant});
    addOnce(columns, {f.name, f.unit});
  }
  std::vector<std::vector<std::string>> rows = {{"DEM", stage}};
  for (const auto& [name, unit] : columns)
    rows[0].push_back(unit.empty() ? name : fmt::format("{}, {}", name, unit));
  for (const auto& key : rowKeys) {
    auto& row = rows.emplace_back(std::vector<std::string>{key.first, key.second});
    row.resize(2 + columns.size());
    for (const Figure& f : figures) {
      if (f.stage != stage || f.dem != key.first || f.variant != key.second) continue;
      const auto column = std::find(columns.begin(), columns.end(), std::pair(f.name, f.unit));
      row[2 + std::size_t(column - columns.begin())] = numberText(f.value);
    }
  }
  return tableText(rows, true);
}

struct Mean {
  std::string stage, name;
  double logarithms = 0;
  int count = 0;
};

}  // namespace

std::string toMarkdown(const Report& report) {
  std::string text =
      fmt::format("{}, {} cores, {:.0f} GiB; {}; {}, medians of up to {} runs, load at the start {:.2f}.\n",
                  report.processor, report.cores, report.memoryBytes / double(1 << 30), report.program,
                  report.date, report.repeats, report.loadAtStart);
  std::vector<std::string> stages;
  for (const Figure& f : report.figures) addOnce(stages, f.stage);
  for (const std::string& stage : stages)
    text += fmt::format("\n### {}\n\n{}", stage, stageTable(report.figures, stage));
  return text;
}

std::string compareReports(const Report& base, const Report& head) {
  std::string text;
  if (base.processor != head.processor || base.cores != head.cores)
    text += fmt::format("Different machines: {} ({} cores) and {} ({} cores).\n", base.processor, base.cores,
                        head.processor, head.cores);
  std::vector<std::vector<std::string>> rows = {{"figure", "unit", "base", "head", "head / base", "verdict"}};
  std::vector<Mean> means;
  for (const Figure& h : head.figures) {
    if (h.better == Better::neither || !(h.value > 0)) continue;
    const auto b = std::find_if(base.figures.begin(), base.figures.end(),
                                [&](const Figure& f) { return f.isSameAs(h) && f.unit == h.unit; });
    if (b == base.figures.end() || !(b->value > 0)) continue;
    const double ratio = h.value / b->value;
    const bool isChanged = std::abs(std::log(ratio)) > std::log(1.05);
    const bool isBetter = (ratio < 1) == (h.better == Better::lower);
    rows.push_back({fmt::format("{} / {} / {} / {}", h.dem, h.stage, h.variant, h.name), h.unit,
                    numberText(b->value), numberText(h.value), fmt::format("{:.3f}", ratio),
                    isChanged ? (isBetter ? "better" : "WORSE") : "same"});
    auto mean = std::find_if(means.begin(), means.end(),
                             [&](const Mean& m) { return m.stage == h.stage && m.name == h.name; });
    if (mean == means.end()) mean = means.insert(means.end(), {h.stage, h.name, 0, 0});
    mean->logarithms += std::log(ratio);
    ++mean->count;
  }
  if (means.empty()) return text + "The reports have no figure in common.\n";
  text += tableText(rows, false) + "\n";
  std::vector<std::vector<std::string>> meanRows = {{"geometric means", "", "figures", "head / base"}};
  for (const Mean& m : means)
    meanRows.push_back({fmt::format("{} / {}", m.stage, m.name), "", std::to_string(m.count),
                        fmt::format("{:.3f}", std::exp(m.logarithms / m.count))});
  return text + tableText(meanRows, false);
}

}  // namespace arete::bench
