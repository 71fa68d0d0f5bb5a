// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/network/network_path.h"

#include <cpl_port.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "io/geo/network/served_files.h"

namespace arete {
namespace {

constexpr std::string_view kOfGdal = "/vsicurl";
constexpr std::string_view kStreaming = "_streaming";

bool isWebAddress(std::string_view text) {
  return beginsWithAddress(text) && EQUALN(text.data(), "http", 4);
}

/// Whether what stands behind "/vsicurl" or our prefix leads to an address.
bool leadsToAddress(std::string_view rest) {
  return rest.starts_with('?') || (rest.starts_with('/') && beginsWithAddress(rest.substr(1)));
}

}  // namespace

bool beginsWithAddress(std::string_view name) {
  constexpr std::array<std::string_view, 4> kSchemes = {"http://", "https://", "ftp://", "file://"};
  return std::ranges::any_of(kSchemes, [&](std::string_view scheme) {
    return name.size() >= scheme.size() && EQUALN(name.data(), scheme.data(), scheme.size());
  });
}

std::string networkPathOf(const std::string& path) {
  constexpr std::string_view kVirtual = "vrt://";
  if (path.starts_with(kVirtual) && isWebAddress(path.substr(kVirtual.size())))
    return std::string(kVirtual) + networkPathOf(path.substr(kVirtual.size()));
  return isWebAddress(path) ? std::string(kOfGdal) + "/" + path : path;
}

std::string servedPath(const std::string& path) {
  std::string served = networkPathOf(path);
  const std::string& own = servedName();
  if (own.empty()) return served;
  for (std::size_t at = served.find(kOfGdal); at != served.npos; at = served.find(kOfGdal, at + 1)) {
    std::size_t end = at + kOfGdal.size();
    if (std::string_view(served).substr(end).starts_with(kStreaming)) end += kStreaming.size();
    const std::string_view rest = std::string_view(served).substr(end);
    if (leadsToAddress(rest)) served.replace(at, end - at, own);
  }
  return served;
}

bool isServedAddress(const std::string& path) {
  const std::string& own = servedName();
  if (own.empty()) return false;
  for (std::size_t at = path.find(own); at != path.npos; at = path.find(own, at + 1)) {
    if (leadsToAddress(std::string_view(path).substr(at + own.size()))) return true;
  }
  return false;
}

std::string withoutServing(std::string text) {
  const std::string& own = servedName();
  if (own.empty()) return text;
  for (std::size_t at = text.find(own); at != text.npos; at = text.find(own, at)) {
    const std::string_view rest = std::string_view(text).substr(at + own.size());
    if (leadsToAddress(rest)) {
      text.replace(at, own.size(), kOfGdal);
      at += kOfGdal.size();
    } else if (rest.starts_with('/')) {
      text.erase(at, own.size() + 1);
    } else {
      at += own.size();
    }
  }
  return text;
}

}  // namespace arete
