// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/network/curl_options.h"

#include <cpl_conv.h>
#include <cpl_string.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>
#include <string>

namespace arete {
namespace {

/// The options of one address, and where it states none, the ones of GDAL.
class StatedOptions {
 public:
  explicit StatedOptions(const NetworkAddress& address) : address_(address) {}

  std::string text(const std::string& name) const {
    for (const auto& [key, value] : address_.options)
      if (key == name) return value;
    return CPLGetConfigOption(("GDAL_HTTP_" + name).c_str(), "");
  }
  double number(const std::string& name, double otherwise) const {
    const std::string stated = text(name);
    return stated.empty() ? otherwise : std::max(0.0, CPLAtof(stated.c_str()));
  }
  bool isOn(const std::string& name) const {
    const std::string stated = text(name);
    return !stated.empty() && CPLTestBool(stated.c_str());
  }

 private:
  const NetworkAddress& address_;
};

std::string firstSet(std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (const char* value = CPLGetConfigOption(name, nullptr); value != nullptr && *value != '\0')
      return value;
  return {};
}

/// The lines of a text, or of a file, that are headers.
void addHeaders(std::istream& lines, std::vector<std::string>& headers) {
  for (std::string line; std::getline(lines, line);) {
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (line.find(':') != line.npos && line.front() != '#') headers.push_back(line);
  }
}

}  // namespace

CurlOptions curlOptionsOf(const NetworkAddress& address) {
  const StatedOptions stated(address);
  CurlOptions o;
  o.connectSeconds = stated.number("CONNECTTIMEOUT", o.connectSeconds);
  o.stallSeconds = stated.number("LOW_SPEED_TIME", o.stallSeconds);
  o.stallBytes = static_cast<long>(stated.number("LOW_SPEED_LIMIT", double(o.stallBytes)));
  o.totalSeconds = stated.number("TIMEOUT", 0);
  if (const std::string agent = stated.text("USERAGENT"); !agent.empty()) o.userAgent = agent;
  o.referer = stated.text("REFERER");
  o.cookie = stated.text("COOKIE");
  o.userPassword = stated.text("USERPWD");
  o.loginMethod = stated.text("AUTH");
  if (o.loginMethod == "BEARER") {
    o.bearer = stated.text("BEARER");
    o.loginMethod.clear();
  }
  const bool isSecure = EQUALN(address.url.c_str(), "https", 5);
  o.proxy = stated.text("PROXY");
  if (isSecure)
    if (const std::string proxy = firstSet({"GDAL_HTTPS_PROXY"}); !proxy.empty()) o.proxy = proxy;
  o.proxyUserPassword = stated.text("PROXYUSERPWD");
  o.proxyMethod = stated.text("PROXYAUTH");
  if (o.proxyMethod.empty()) o.proxyMethod = firstSet({"GDAL_PROXY_AUTH"});
  o.authorities = firstSet({"GDAL_CURL_CA_BUNDLE", "CURL_CA_BUNDLE", "SSL_CERT_FILE"});
  o.authoritiesFolder = stated.text("CAPATH");
  o.certificate = stated.text("SSLCERT");
  o.key = stated.text("SSLKEY");
  o.keyPassword = stated.text("KEYPASSWD");
  o.trustsAll = stated.isOn("UNSAFESSL");
  o.readsNetrc = stated.text("NETRC").empty() || stated.isOn("NETRC");
  std::istringstream headers(firstSet({"GDAL_HTTP_HEADERS"}));
  addHeaders(headers, o.headers);
  if (const std::string path = stated.text("HEADER_FILE"); !path.empty()) {
    std::ifstream file(path);
    addHeaders(file, o.headers);
  }
  return o;
}

}  // namespace arete
