// SPDX-License-Identifier: GPL-3.0-or-later
//
// The file is in memory, and a format scans each line where it lies. A line is not cut off beforehand,
// because a line of an OBJ may continue in the next one.
#include "io/formats/common/text_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/files/text_scan.h"
#include "io/formats/common/comments.h"
#include "io/formats/common/finite.h"

namespace arete {
namespace {

constexpr std::size_t kLinesPerCancelCheck = 1 << 16;
constexpr std::size_t kMostKeywords = 8;

}  // namespace

MeshTextReader::MeshTextReader(const FileBytes& file, std::string path, const RunContext& context)
    : begin_(file.begin()), at_(file.begin()), end_(file.end()), path_(std::move(path)), context_(context) {}

// A format may leave the position behind several lines, so lines are counted for cancelling only.
Result<MeshFile> MeshTextReader::read() {
  for (std::size_t line = 0; at_ < end_; ++line) {
    if (line % kLinesPerCancelCheck == 0) {
      context_.report("reading the mesh", double(at_ - begin_) / double(end_ - begin_));
      if (context_.cancelled()) return failure(ErrorCode::interrupted, "reading was interrupted", path_);
    }
    ARETE_CHECK(readLine());
    if (at_ < end_) ++at_;
  }
  if (isOurs_ && !hasEnd_)
    return failure(ErrorCode::corrupt, "is truncated: its last line, \"# end\", is missing", path_);
  ARETE_CHECK(finish());
  if (const Status ok = faces_.finish(mesh_, context_); !ok)
    return failure(ok.error().code, ok.error().message, path_);
  leaveOutUnusedNumbers(mesh_);
  return std::move(mesh_);
}

// Comments of Arete hold what the format has no field for. A file that begins as ours must end as ours, so
// that a truncated one is noticed.
void MeshTextReader::takeComment(std::string_view comment) {
  while (!comment.empty() && text::isBlank(comment.back())) comment.remove_suffix(1);
  if (!comment.empty() && comment.front() == ' ') comment.remove_prefix(1);
  isOurs_ = isOurs_ || comment == kMeshTextGenerator;
  hasEnd_ = hasEnd_ || comment == kMeshTextEnd;
  const auto take = [&](std::string_view key, std::string& value) {
    if (comment.size() > key.size() && comment.starts_with(key)) value = comment.substr(key.size());
  };
  take("crs ", mesh_.crsWkt);
  take("vertical_unit ", mesh_.verticalUnit);
  if (comment.starts_with(kMetresAboutKey))
    mesh_.metresAbout = readPlaceNumbers(comment.substr(kMetresAboutKey.size()));
}

bool MeshTextReader::isKeyword(std::string_view word) {
  return std::ranges::all_of(word, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
}

/// A few keywords are counted by name and the rest together, so that a damaged file makes no long warning.
void MeshTextReader::leaveOut(std::string_view keyword) {
  if (const auto known = leftOut_.find(keyword); known != leftOut_.end())
    ++known->second;
  else if (leftOut_.size() < kMostKeywords)
    leftOut_.emplace(keyword, 1);
  else
    ++leftOutOthers_;
}

void MeshTextReader::warnOfLeftOut(std::string_view lines) {
  if (leftOut_.empty()) return;
  std::string list;
  for (const auto& [keyword, count] : leftOut_)
    list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", text::quotedToken(keyword), count);
  if (leftOutOthers_ > 0) list += fmt::format(" and {} more", leftOutOthers_);
  mesh_.warnings.push_back({WarningCode::omitted, fmt::format("its {} {} are left out", lines, list)});
}

// The number of the line is counted only when an error needs it.
tl::unexpected<Error> MeshTextReader::corrupt(const char* place, std::string_view what) const {
  return failure(ErrorCode::corrupt, fmt::format("line {} {}", text::lineOf(begin_, place), what), path_);
}

tl::unexpected<Error> MeshTextReader::unsupported(std::string message) const {
  return failure(ErrorCode::unsupported, std::move(message), path_);
}

}  // namespace arete
