// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/network/network_address.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <string_view>

namespace arete {
namespace {

constexpr std::array<std::string_view, 12> kRequestOptions = {
    "useragent",      "referer",        "cookie",          "header_file", "unsafessl", "timeout",
    "connecttimeout", "low_speed_time", "low_speed_limit", "proxy",       "proxyauth", "proxyuserpwd"};
constexpr std::array<std::string_view, 4> kOfListsAndHeads = {"use_head", "list_dir", "empty_dir",
                                                              "use_redirect_url_if_no_query_string_params"};

std::string unescaped(const char* text) {
  char* plain = CPLUnescapeString(text, nullptr, CPLES_URL);
  std::string result = plain;
  CPLFree(plain);
  return result;
}

}  // namespace

Result<NetworkAddress> networkAddress(const std::string& name) {
  NetworkAddress address;
  address.rules.retries = std::max(0, std::atoi(CPLGetConfigOption("GDAL_HTTP_MAX_RETRY", "4")));
  address.rules.firstDelay = std::max(0.0, CPLAtof(CPLGetConfigOption("GDAL_HTTP_RETRY_DELAY", "0.25")));
  if (!name.starts_with('?')) {
    address.url = name;
    return address;
  }
  const CPLStringList parts(CSLTokenizeString2(name.c_str() + 1, "&", 0));
  for (int i = 0; i < parts.Count(); ++i) {
    const std::string part = unescaped(parts[i]);
    const std::size_t equals = part.find('=');
    std::string key = part.substr(0, equals);
    std::ranges::transform(key, key.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    const std::string value = equals == part.npos ? "" : part.substr(equals + 1);
    if (key == "url") {
      address.url = value;
    } else if (key == "max_retry") {
      address.rules.retries = std::max(0, std::atoi(value.c_str()));
    } else if (key == "retry_delay") {
      address.rules.firstDelay = std::max(0.0, CPLAtof(value.c_str()));
    } else if (std::ranges::find(kRequestOptions, key) != kRequestOptions.end()) {
      std::ranges::transform(key, key.begin(), [](unsigned char c) { return char(std::toupper(c)); });
      address.options.emplace_back(key, value);
    } else if (std::ranges::find(kOfListsAndHeads, key) == kOfListsAndHeads.end() &&
               (key != "pc_url_signing" || CPLTestBool(value.c_str()))) {
      return failure(ErrorCode::usage, fmt::format("the option '{}' before an address is not known", key));
    }
  }
  if (address.url.empty()) return failure(ErrorCode::usage, "options without an address, url=");
  return address;
}

}  // namespace arete
