// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "io/files/network/http_client.h"

namespace arete {

/// How a server is asked. Empty texts and zeros state nothing; libcurl then takes what it takes by default,
/// the proxies of `https_proxy` and `no_proxy` among it.
struct CurlOptions {
  double connectSeconds = 30;  ///< to connect
  double stallSeconds = 30;    ///< with fewer bytes a second than the next number count as a lost connection
  long stallBytes = 1000;
  double totalSeconds = 0;  ///< for one request
  std::string userAgent = "Arete", referer, cookie;
  std::string userPassword, loginMethod, bearer;  ///< "name:password"; BASIC, DIGEST, NTLM, NEGOTIATE, ANY
  std::string proxy, proxyUserPassword, proxyMethod;
  std::string authorities, authoritiesFolder;  ///< certificates that are trusted: a file in PEM, a folder
  std::string certificate, key, keyPassword;   ///< of the client
  bool trustsAll = false;                      ///< certificates are not checked
  bool readsNetrc = false;
  std::vector<std::string> headers;  ///< more of them, "Name: value"
  /// The most bytes of a file that comes as a whole, from a server that gives no parts of files.
  std::uint64_t mostWhole = std::uint64_t{1} << 28;
  int connections = 4;  ///< at once
};

/// Sends requests for one file through libcurl. The address is http or https: what it redirects to as well
/// (at most ten times, and never from https to http), and nothing is compressed. A file that comes as a whole
/// although a part was asked for is read if the part begins at 0 and the file has at most `mostWhole` bytes;
/// otherwise the request is broken off at its first bytes. Cancellation ends a request within about 0.1
/// seconds. After a fork() the child has connections of its own.
std::shared_ptr<HttpClient> curlHttpClient(std::string address, CurlOptions options);

}  // namespace arete
