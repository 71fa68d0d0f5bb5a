// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <curl/curl.h>

#include <array>
#include <memory>
#include <string>
#include <string_view>

#include "io/files/curl/curl_client.h"

namespace arete {

/// One request that libcurl sends, and what has come of it. Stays at its place: libcurl points to it.
class CurlTransfer {
 public:
  /// @param address and `options` outlive the object.
  CurlTransfer(const std::string& address, const CurlOptions& options, const HttpRange& range);
  CurlTransfer(const CurlTransfer&) = delete;
  CurlTransfer& operator=(const CurlTransfer&) = delete;

  CURL* handle() const { return handle_.get(); }
  /// The reply, once libcurl has ended the request with this code. Once.
  HttpReply reply(CURLcode code);

 private:
  struct Closer {
    void operator()(CURL* handle) const { curl_easy_cleanup(handle); }
    void operator()(curl_slist* list) const { curl_slist_free_all(list); }
  };
  template <class Value>
  void set(CURLoption option, Value value) {
    curl_easy_setopt(handle_.get(), option, value);
  }
  void setText(CURLoption option, const std::string& text) {
    if (!text.empty()) set(option, text.c_str());
  }
  void setAddress(const std::string& address);
  void setLogins();
  void setHeaders();
  static std::size_t onHeader(const char* text, std::size_t size, std::size_t count, void* transfer);
  static std::size_t onBytes(const char* bytes, std::size_t size, std::size_t count, void* transfer);
  std::size_t takeHeader(std::string_view line);
  std::size_t takeBytes(std::string_view bytes);
  /// Ends the request. @return 0, for libcurl
  std::size_t refuse(std::string problem);
  long status() const;

  const CurlOptions& options_;
  HttpRange range_;
  std::unique_ptr<CURL, Closer> handle_;
  std::unique_ptr<curl_slist, Closer> headers_;
  std::array<char, CURL_ERROR_SIZE> said_{};
  HttpReply reply_;
  std::string refusal_;
  std::size_t headerBytes_ = 0, ignoredBytes_ = 0;
};

}  // namespace arete
