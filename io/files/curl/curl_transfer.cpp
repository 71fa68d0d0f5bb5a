// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bytes of an error's page or of a redirection are not kept. Headers belong to the last
// answer: each status line begins them anew.
#include "io/files/curl/curl_transfer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace arete {
namespace {

constexpr long kMostRedirections = 10;
constexpr std::size_t kMostHeaderBytes = std::size_t{1} << 20, kMostIgnoredBytes = std::size_t{1} << 20;
constexpr int kOk = 200, kPartial = 206, kFirstError = 300;

/// Bytes that an address cannot have as they are get their codes, as browsers do.
std::string encodedAddress(const std::string& address) {
  std::string encoded;
  for (const char c : address) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte <= ' ' || byte >= 0x7f)
      encoded += fmt::format("%{:02X}", byte);
    else
      encoded += c;
  }
  return encoded;
}

bool beginsWithScheme(std::string_view address, std::string_view scheme) {
  return address.size() >= scheme.size() &&
         std::ranges::equal(address.substr(0, scheme.size()), scheme,
                            [](unsigned char a, unsigned char b) { return std::tolower(a) == b; });
}

long loginMethods(const std::string& name) {
  if (name == "BASIC") return CURLAUTH_BASIC;
  if (name == "DIGEST") return CURLAUTH_DIGEST;
  if (name == "NTLM") return CURLAUTH_NTLM;
  if (name == "NEGOTIATE") return CURLAUTH_NEGOTIATE;
  return static_cast<long>(CURLAUTH_ANY);
}

bool isLasting(CURLcode code) {
  switch (code) {
    case CURLE_COULDNT_RESOLVE_HOST:
    case CURLE_COULDNT_RESOLVE_PROXY:
    case CURLE_COULDNT_CONNECT:
    case CURLE_URL_MALFORMAT:
    case CURLE_UNSUPPORTED_PROTOCOL:
    case CURLE_PEER_FAILED_VERIFICATION:
    case CURLE_SSL_CACERT_BADFILE:
    case CURLE_SSL_CERTPROBLEM:
    case CURLE_SSL_ISSUER_ERROR:
    case CURLE_TOO_MANY_REDIRECTS:
    case CURLE_LOGIN_DENIED:
      return true;
    default:
      return false;
  }
}

std::string problemOf(CURLcode code, std::string_view said) {
  switch (code) {
    case CURLE_PARTIAL_FILE:
    case CURLE_GOT_NOTHING:
    case CURLE_RECV_ERROR:
    case CURLE_SEND_ERROR:
      return "the connection was lost";
    case CURLE_TOO_MANY_REDIRECTS:
      return fmt::format("the server redirects more than {} times", kMostRedirections);
    case CURLE_PEER_FAILED_VERIFICATION:
      return fmt::format("the server's certificate is not trusted: {}", said);
    default:
      return said.empty() ? std::string(curl_easy_strerror(code)) : std::string(said);
  }
}

}  // namespace

CurlTransfer::CurlTransfer(const std::string& address, const CurlOptions& options, const HttpRange& range)
    : options_(options), range_(range), handle_(curl_easy_init()) {
  if (!handle_) return;
  setAddress(encodedAddress(address));
  set(CURLOPT_ERRORBUFFER, said_.data());
  set(CURLOPT_NOSIGNAL, 1L);
  set(CURLOPT_QUICK_EXIT, 1L);
  set(CURLOPT_RANGE, fmt::format("{}-{}", range.first, range.last).c_str());
  set(CURLOPT_CONNECTTIMEOUT_MS, static_cast<long>(1000 * options.connectSeconds));
  set(CURLOPT_LOW_SPEED_LIMIT, options.stallBytes);
  set(CURLOPT_LOW_SPEED_TIME, std::max(1L, static_cast<long>(options.stallSeconds)));
  if (options.totalSeconds > 0) set(CURLOPT_TIMEOUT_MS, static_cast<long>(1000 * options.totalSeconds));
  setLogins();
  setHeaders();
  set(CURLOPT_HEADERFUNCTION, &onHeader);
  set(CURLOPT_HEADERDATA, static_cast<void*>(this));
  set(CURLOPT_WRITEFUNCTION, &onBytes);
  set(CURLOPT_WRITEDATA, static_cast<void*>(this));
}

void CurlTransfer::setAddress(const std::string& address) {
  const char* const allowed = beginsWithScheme(address, "https:") ? "https" : "http,https";
  setText(CURLOPT_URL, address);
  set(CURLOPT_PROTOCOLS_STR, "http,https");
  set(CURLOPT_REDIR_PROTOCOLS_STR, allowed);
  set(CURLOPT_FOLLOWLOCATION, 1L);
  set(CURLOPT_MAXREDIRS, kMostRedirections);
}

void CurlTransfer::setLogins() {
  const CurlOptions& o = options_;
  setText(CURLOPT_USERAGENT, o.userAgent);
  setText(CURLOPT_REFERER, o.referer);
  setText(CURLOPT_COOKIE, o.cookie);
  setText(CURLOPT_USERPWD, o.userPassword);
  if (!o.loginMethod.empty()) set(CURLOPT_HTTPAUTH, loginMethods(o.loginMethod));
  if (!o.bearer.empty()) {
    set(CURLOPT_HTTPAUTH, static_cast<long>(CURLAUTH_BEARER));
    setText(CURLOPT_XOAUTH2_BEARER, o.bearer);
  }
  setText(CURLOPT_PROXY, o.proxy);
  setText(CURLOPT_PROXYUSERPWD, o.proxyUserPassword);
  if (!o.proxyMethod.empty()) set(CURLOPT_PROXYAUTH, loginMethods(o.proxyMethod));
  setText(CURLOPT_CAINFO, o.authorities);
  setText(CURLOPT_CAPATH, o.authoritiesFolder);
  setText(CURLOPT_SSLCERT, o.certificate);
  setText(CURLOPT_SSLKEY, o.key);
  setText(CURLOPT_KEYPASSWD, o.keyPassword);
  if (o.trustsAll) {
    set(CURLOPT_SSL_VERIFYPEER, 0L);
    set(CURLOPT_SSL_VERIFYHOST, 0L);
  }
  if (o.readsNetrc) set(CURLOPT_NETRC, static_cast<long>(CURL_NETRC_OPTIONAL));
}

void CurlTransfer::setHeaders() {
  curl_slist* list = curl_slist_append(nullptr, "Accept-Encoding: identity");
  for (const std::string& header : options_.headers)
    if (curl_slist* longer = curl_slist_append(list, header.c_str()); longer != nullptr) list = longer;
  headers_.reset(list);
  set(CURLOPT_HTTPHEADER, list);
}

std::size_t CurlTransfer::onHeader(const char* text, std::size_t size, std::size_t count, void* transfer) {
  return static_cast<CurlTransfer*>(transfer)->takeHeader({text, size * count});
}

std::size_t CurlTransfer::onBytes(const char* bytes, std::size_t size, std::size_t count, void* transfer) {
  return static_cast<CurlTransfer*>(transfer)->takeBytes({bytes, size * count});
}

std::size_t CurlTransfer::refuse(std::string problem) {
  refusal_ = std::move(problem);
  return 0;
}

long CurlTransfer::status() const {
  long status = 0;
  curl_easy_getinfo(handle_.get(), CURLINFO_RESPONSE_CODE, &status);
  return status;
}

std::size_t CurlTransfer::takeHeader(std::string_view line) {
  headerBytes_ += line.size();
  if (headerBytes_ > kMostHeaderBytes) return refuse("the server sends headers without an end");
  if (line.starts_with("HTTP/")) {
    reply_ = {};
    return line.size();
  }
  const std::size_t colon = line.find(':');
  if (colon == line.npos) return line.size();
  std::string_view value = line.substr(colon + 1);
  const auto isSpace = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
  while (!value.empty() && isSpace(value.front())) value.remove_prefix(1);
  while (!value.empty() && isSpace(value.back())) value.remove_suffix(1);
  std::string name(line.substr(0, colon));
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  if (name == "etag") reply_.tag = value;
  if (name == "last-modified") reply_.date = value;
  if (name == "content-range") reply_.range = value;
  if (name == "content-length") reply_.length = value;
  if (name == "content-encoding") reply_.encoding = value;
  return line.size();
}

std::size_t CurlTransfer::takeBytes(std::string_view bytes) {
  const long code = status();
  if (code >= kFirstError) {
    ignoredBytes_ += bytes.size();
    return ignoredBytes_ > kMostIgnoredBytes ? 0 : bytes.size();
  }
  const std::uint64_t there = reply_.bytes.size() + bytes.size();
  if (code == kPartial && there > range_.last - range_.first + 1)
    return refuse(fmt::format("the server sent more than the {} bytes that were asked for",
                              range_.last - range_.first + 1));
  if (code != kPartial) {
    if (range_.first > 0) return refuse("the server sent the whole file instead of a part of it");
    const std::uint64_t stated = std::strtoull(reply_.length.c_str(), nullptr, 10);
    if (std::max(stated, there) > options_.mostWhole) {
      reply_.isLasting = true;
      return refuse(fmt::format(
          "the server gives no parts of files, and this one has more than the {} bytes that are read whole",
          options_.mostWhole));
    }
  }
  const auto* begin = reinterpret_cast<const std::byte*>(bytes.data());
  reply_.bytes.insert(reply_.bytes.end(), begin, begin + bytes.size());
  return bytes.size();
}

HttpReply CurlTransfer::reply(CURLcode code) {
  HttpReply reply = std::move(reply_);
  const long answered = handle_ ? status() : 0;
  const auto fail = [&](std::string problem, bool lasts) {
    reply.problem = std::move(problem);
    reply.isLasting = reply.isLasting || lasts;
    reply.bytes.clear();
    return std::move(reply);
  };
  if (!handle_) return fail("libcurl cannot be used", true);
  if (!refusal_.empty()) return fail(refusal_, false);
  // The page of an error may be cut short.
  if (answered >= kFirstError && (code == CURLE_OK || code == CURLE_WRITE_ERROR)) {
    reply.status = static_cast<int>(answered);
    curl_off_t seconds = 0;
    if (curl_easy_getinfo(handle_.get(), CURLINFO_RETRY_AFTER, &seconds) == CURLE_OK)
      reply.retryAfter = static_cast<double>(seconds);
    return fail(fmt::format("the server answers {}", answered), false);
  }
  if (code != CURLE_OK) return fail(problemOf(code, said_.data()), isLasting(code));
  if (answered == kPartial && reply.range.empty()) reply.range = "none";
  if (answered != kPartial) reply.range.clear();
  if (answered != kPartial && answered != kOk)
    return fail(fmt::format("the server answers {}", answered), true);
  return reply;
}

}  // namespace arete
