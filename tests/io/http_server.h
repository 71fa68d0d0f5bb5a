// SPDX-License-Identifier: GPL-3.0-or-later
//
// A small HTTP server on this machine that misbehaves as its caller states.
#pragma once

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace arete::test {

/// What the server does with one request.
struct HttpFault {
  int status = 0;          ///< an error to answer; 0: none
  std::string headers;     ///< more of them, each with its line end
  bool isDropped = false;  ///< half of the bytes, and then the connection is closed
  bool isShort = false;    ///< half of the bytes, with a length that says so
  bool knowsNoRanges = false;
  bool isStalled = false;  ///< nothing is sent until the server ends
  bool drips = false;      ///< the bytes come one by one, ten a second, until the server ends
  int more = 0;            ///< bytes behind those that were asked for
  int shift = 0;           ///< the bytes by which the range begins later
  std::string tag = "\"one\"";
  std::string content;  ///< instead of the file's
};

/// Serves texts by name. Each request asks `faultOf` with the name and the number of the request for that
/// name, from 1.
class HttpServer {
 public:
  using Faults = std::function<HttpFault(const std::string& name, int number)>;

  explicit HttpServer(std::map<std::string, std::string> files, Faults faultOf = {})
      : files_(std::move(files)), faultOf_(std::move(faultOf)), socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof(address);
    if (::bind(socket_, reinterpret_cast<sockaddr*>(&address), length) != 0 || ::listen(socket_, 16) != 0 ||
        ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &length) != 0)
      std::abort();
    port_ = ntohs(address.sin_port);
    acceptor_ = std::thread([this] { accept(); });
  }
  ~HttpServer() {
    isEnding_ = true;
    ::shutdown(socket_, SHUT_RDWR);
    ::close(socket_);
    acceptor_.join();
    {
      const std::lock_guard lock(mutex_);
      for (const int open : open_) ::shutdown(open, SHUT_RDWR);
    }
    for (std::thread& thread : threads_) thread.join();
  }
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  std::string address(const std::string& name) const {
    return fmt::format("http://127.0.0.1:{}/{}", port_, name);
  }
  /// The last request, with its headers.
  std::string lastRequest() {
    const std::lock_guard lock(mutex_);
    return lastRequest_;
  }
  int requests(const std::string& name) {
    const std::lock_guard lock(mutex_);
    return counts_[name];
  }

 private:
  void accept() {
    while (!isEnding_) {
      const int connection = ::accept(socket_, nullptr, nullptr);
      if (connection < 0) continue;
      const std::lock_guard lock(mutex_);
      open_.push_back(connection);
      threads_.emplace_back([this, connection] { serve(connection); });
    }
  }

  void serve(int connection) {
    std::string received;
    while (!isEnding_) {
      const std::size_t end = received.find("\r\n\r\n");
      if (end == received.npos) {
        char buffer[4096];
        const ssize_t got = ::recv(connection, buffer, sizeof(buffer), 0);
        if (got <= 0) break;
        received.append(buffer, std::size_t(got));
        continue;
      }
      const std::string request = received.substr(0, end + 2);
      received.erase(0, end + 4);
      if (!answer(connection, request)) break;
    }
    const std::lock_guard lock(mutex_);
    std::erase(open_, connection);
    ::close(connection);
  }

  /// @return Whether the connection stays.
  bool answer(int connection, const std::string& request) {
    const std::size_t slash = request.find('/');
    const std::string name = request.substr(slash + 1, request.find(' ', slash) - slash - 1);
    const auto found = files_.find(name);
    HttpFault fault;
    {
      const std::lock_guard lock(mutex_);
      lastRequest_ = request;
      const int number = ++counts_[name];
      if (faultOf_ && found != files_.end()) fault = faultOf_(name, number);
    }
    if (found == files_.end()) fault.status = 404;
    if (fault.isStalled) {
      while (!isEnding_) std::this_thread::sleep_for(std::chrono::milliseconds(10));
      return false;
    }
    if (fault.status != 0)
      return send(connection, fmt::format("HTTP/1.1 {} Fault\r\nContent-Length: 0\r\n{}\r\n", fault.status,
                                          fault.headers));
    const std::string& whole = fault.content.empty() ? found->second : fault.content;
    std::string head = "HTTP/1.1 200 OK\r\n", body = whole;
    if (const std::size_t range = request.find("Range: bytes=");
        range != request.npos && !fault.knowsNoRanges) {
      char* rest = nullptr;
      const std::size_t first =
          std::strtoull(request.c_str() + range + 13, &rest, 10) + static_cast<std::size_t>(fault.shift);
      const std::size_t last = std::min<std::size_t>(std::strtoull(rest + 1, nullptr, 10), whole.size() - 1);
      if (first >= whole.size()) return send(connection, "HTTP/1.1 416 Fault\r\nContent-Length: 0\r\n\r\n");
      body = whole.substr(first, last + 1 - first);
      head =
          fmt::format("HTTP/1.1 206 Partial\r\nContent-Range: bytes {}-{}/{}\r\n", first, last, whole.size());
    }
    body.append(static_cast<std::size_t>(fault.more), 'x');
    const std::size_t stated = fault.isShort ? body.size() / 2 : body.size();
    head += fmt::format("ETag: {}\r\nContent-Length: {}\r\n{}\r\n", fault.tag, stated, fault.headers);
    if (request.starts_with("HEAD")) return send(connection, head);
    if (fault.isShort || fault.isDropped) body.resize(body.size() / 2);
    if (fault.drips) {
      bool isOpen = send(connection, head);
      for (std::size_t i = 0; i < body.size() && isOpen && !isEnding_; ++i) {
        isOpen = send(connection, body.substr(i, 1));
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
      }
      return isOpen;
    }
    return send(connection, head + body) && !fault.isDropped;
  }

  static bool send(int connection, const std::string& text) {
    for (std::size_t sent = 0; sent < text.size();) {
      const ssize_t count = ::send(connection, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
      if (count <= 0) return false;
      sent += std::size_t(count);
    }
    return true;
  }

  std::map<std::string, std::string> files_;
  Faults faultOf_;
  int socket_;
  unsigned port_ = 0;
  std::atomic<bool> isEnding_ = false;
  std::mutex mutex_;
  std::map<std::string, int> counts_;
  std::string lastRequest_;
  std::vector<int> open_;
  std::vector<std::thread> threads_;
  std::thread acceptor_;
};

}  // namespace arete::test
