// SPDX-License-Identifier: GPL-3.0-or-later
//
// Several requests are one loop of libcurl's "multi" interface on the calling thread, which also looks for a
// cancellation 20 times a second. The multi handle keeps connections open between the calls.
#include "io/files/curl/curl_client.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "io/files/curl/curl_transfer.h"

namespace arete {
namespace {

constexpr int kPollMilliseconds = 50;

struct MultiCloser {
  void operator()(CURLM* multi) const { curl_multi_cleanup(multi); }
};

bool isCurlReady() {
  static const bool isReady = curl_global_init(CURL_GLOBAL_DEFAULT) == CURLE_OK;
  return isReady;
}

class CurlClient final : public HttpClient {
 public:
  CurlClient(std::string address, CurlOptions options)
      : address_(std::move(address)), options_(std::move(options)) {}
  ~CurlClient() override {
    if (process_ != ::getpid()) static_cast<void>(multi_.release());
  }

  HttpReply get(std::uint64_t first, std::uint64_t last) override {
    const HttpRange range{first, last};
    return std::move(getAll({&range, 1}).front());
  }

  std::vector<HttpReply> getAll(std::span<const HttpRange> ranges) override {
    const std::lock_guard lock(mutex_);
    std::vector<HttpReply> replies(ranges.size());
    if (!prepare()) {
      for (HttpReply& reply : replies) {
        reply.problem = "libcurl cannot be used";
        reply.isLasting = true;
      }
      return replies;
    }
    Running running(ranges.size());
    std::size_t begun = 0, ended = 0;
    while (ended < ranges.size() && !isCancelled()) {
      while (begun < ranges.size() && begun - ended < static_cast<std::size_t>(options_.connections)) {
        running[begun].emplace(address_, options_, ranges[begun]);
        if (!running[begun]->handle() ||
            curl_multi_add_handle(multi_.get(), running[begun]->handle()) != CURLM_OK) {
          replies[begun] = running[begun]->reply(CURLE_FAILED_INIT);
          running[begun].reset();
          ++ended;
        }
        ++begun;
      }
      int still = 0;
      curl_multi_perform(multi_.get(), &still);
      ended += takeEnded(running, replies);
      if (ended < ranges.size() && still > 0)
        curl_multi_poll(multi_.get(), nullptr, 0, kPollMilliseconds, nullptr);
    }
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      if (i < begun && !running[i]) continue;
      if (running[i]) curl_multi_remove_handle(multi_.get(), running[i]->handle());
      replies[i].problem = "reading was stopped";
      replies[i].isLasting = true;
    }
    return replies;
  }

  void cancelBy(const std::atomic<bool>* cancel) override { cancel_ = cancel; }

  bool wait(double seconds) override {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    while (Clock::now() < end && !isCancelled())
      std::this_thread::sleep_for(std::chrono::milliseconds(kPollMilliseconds / 2));
    return !isCancelled();
  }

  bool isCancelled() const override {
    const std::atomic<bool>* const cancel = cancel_;
    return cancel != nullptr && cancel->load(std::memory_order_relaxed);
  }

 private:
  using Running = std::vector<std::optional<CurlTransfer>>;

  bool prepare() {
    if (!isCurlReady()) return false;
    if (multi_ && process_ == ::getpid()) return true;
    // Two processes must not read from one connection: what the other one has is left to it.
    static_cast<void>(multi_.release());
    process_ = ::getpid();
    multi_.reset(curl_multi_init());
    return multi_ != nullptr;
  }

  /// @return how many have ended
  std::size_t takeEnded(Running& running, std::vector<HttpReply>& replies) {
    std::size_t ended = 0;
    int queued = 0;
    while (CURLMsg* const message = curl_multi_info_read(multi_.get(), &queued)) {
      if (message->msg != CURLMSG_DONE) continue;
      CURL* const handle = message->easy_handle;
      const CURLcode code = message->data.result;
      for (std::size_t i = 0; i < running.size(); ++i) {
        if (!running[i] || running[i]->handle() != handle) continue;
        curl_multi_remove_handle(multi_.get(), handle);
        replies[i] = running[i]->reply(code);
        running[i].reset();
        ++ended;
        break;
      }
    }
    return ended;
  }

  std::string address_;
  CurlOptions options_;
  std::atomic<const std::atomic<bool>*> cancel_ = nullptr;
  std::mutex mutex_;
  std::unique_ptr<CURLM, MultiCloser> multi_;
  pid_t process_ = 0;
};

}  // namespace

std::shared_ptr<HttpClient> curlHttpClient(std::string address, CurlOptions options) {
  return std::make_shared<CurlClient>(std::move(address), std::move(options));
}

}  // namespace arete
