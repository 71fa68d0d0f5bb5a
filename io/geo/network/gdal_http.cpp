// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/network/gdal_http.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_http.h>
#include <cpl_string.h>
#include <fmt/format.h>

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

namespace arete {
namespace {

constexpr const char* kMostBytes = "2147483647";
constexpr const char* kStallSeconds = "30";
constexpr int kCurlCannotResolve = 6, kCurlCannotConnect = 7;

thread_local const std::atomic<bool>* tCancel = nullptr;

struct ResultCloser {
  void operator()(CPLHTTPResult* result) const { CPLHTTPDestroyResult(result); }
};
using ResultPtr = std::unique_ptr<CPLHTTPResult, ResultCloser>;

/// A request of GDAL on a thread of its own: GDAL asks whether to go on only once an answer has begun, so a
/// server that says nothing can only be left waiting. The thread then ends by itself when its time is over;
/// it shares nothing with the others but this object.
struct Job {
  std::string url;
  CPLStringList options, threadOptions;
  std::atomic<bool> isAbandoned = false;
  std::mutex mutex;
  std::condition_variable isDone;
  bool done = false;
  ResultPtr result;

  static int keepGoing(double, const char*, void* job) {
    return static_cast<Job*>(job)->isAbandoned ? FALSE : TRUE;
  }
  void run() {
    CPLSetThreadLocalConfigOptions(threadOptions.List());
    CPLPushErrorHandler(CPLQuietErrorHandler);
    ResultPtr fetched(CPLHTTPFetchEx(url.c_str(), options.List(), keepGoing, this, nullptr, nullptr));
    CPLPopErrorHandler();
    const std::lock_guard lock(mutex);
    result = std::move(fetched);
    done = true;
    isDone.notify_one();
  }
};

/// @return Null if GDAL reads nothing over the network, or the request was cut off.
ResultPtr fetchInTime(const std::string& url, const CPLStringList& options) {
  auto job = std::make_shared<Job>();
  job->url = url;
  job->options = options;
  job->threadOptions = CPLStringList(CPLGetThreadLocalConfigOptions());
  std::thread([job] { job->run(); }).detach();
  std::unique_lock lock(job->mutex);
  while (!job->isDone.wait_for(lock, std::chrono::milliseconds(20), [&] { return job->done; }))
    if (requestsAreCancelled()) {
      job->isAbandoned = true;
      return nullptr;
    }
  return std::move(job->result);
}

class GdalHttpClient final : public HttpClient {
 public:
  explicit GdalHttpClient(NetworkAddress address) : address_(std::move(address)) {}

  HttpReply get(std::uint64_t first, std::uint64_t last) override {
    const ResultPtr result = fetchInTime(address_.url, optionsFor(first, last));
    HttpReply reply;
    if (!result) {
      reply.problem =
          requestsAreCancelled() ? "reading was stopped" : "this GDAL reads nothing over the network";
      return reply;
    }
    const CPLStringList headers(result->papszHeaders, false);
    const std::string_view said = result->pszErrBuf ? result->pszErrBuf : "";
    constexpr std::string_view kStatus = "HTTP error code : ";
    if (const std::size_t status = said.find(kStatus); status != said.npos) {
      reply.status = std::atoi(said.data() + status + kStatus.size());
      reply.problem = fmt::format("the server answers {}", reply.status);
      if (const char* seconds = headers.FetchNameValue("Retry-After")) reply.retryAfter = CPLAtof(seconds);
      return reply;
    }
    if (result->nStatus != 0 || !said.empty()) {
      reply.problem = said.empty() ? "the connection was lost" : std::string(said);
      reply.isLasting = result->nStatus == kCurlCannotResolve || result->nStatus == kCurlCannotConnect;
      return reply;
    }
    const auto* bytes = reinterpret_cast<const std::byte*>(result->pabyData);
    reply.bytes.assign(bytes, bytes + result->nDataLen);
    const auto header = [&](const char* name) -> std::string {
      const char* value = headers.FetchNameValue(name);
      while (value && *value == ' ') ++value;
      return value ? value : "";
    };
    reply.tag = header("ETag");
    reply.date = header("Last-Modified");
    reply.range = header("Content-Range");
    reply.length = header("Content-Length");
    reply.encoding = header("Content-Encoding");
    return reply;
  }

  bool wait(double seconds) override {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    while (Clock::now() < end) {
      if (isCancelled()) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return !isCancelled();
  }

  bool isCancelled() const override { return requestsAreCancelled(); }

 private:
  CPLStringList optionsFor(std::uint64_t first, std::uint64_t last) const {
    CPLStringList options;
    const char* own = CPLGetConfigOption("GDAL_HTTP_HEADERS", "");
    const std::string headers = fmt::format("{}{}Range: bytes={}-{}\r\nAccept-Encoding: identity", own,
                                            *own ? "\r\n" : "", first, last);
    options.SetNameValue("HEADERS", headers.c_str());
    options.SetNameValue("MAX_RETRY", "0");  // they are counted where answers are checked
    options.SetNameValue("MAX_FILE_SIZE", kMostBytes);
    if (!CPLGetConfigOption("GDAL_HTTP_LOW_SPEED_TIME", nullptr)) {
      options.SetNameValue("LOW_SPEED_TIME", kStallSeconds);
      options.SetNameValue("LOW_SPEED_LIMIT", "1");
    }
    if (!CPLGetConfigOption("GDAL_HTTP_CONNECTTIMEOUT", nullptr))
      options.SetNameValue("CONNECTTIMEOUT", kStallSeconds);
    for (const auto& [name, value] : address_.options) options.SetNameValue(name.c_str(), value.c_str());
    return options;
  }

  NetworkAddress address_;
};

}  // namespace

std::shared_ptr<HttpClient> gdalHttpClient(NetworkAddress address) {
  return std::make_shared<GdalHttpClient>(std::move(address));
}

const std::atomic<bool>* requestCancel() {
  return tCancel;
}

void setRequestCancel(const std::atomic<bool>* cancel) {
  tCancel = cancel;
}

bool requestsAreCancelled() {
  return tCancel != nullptr && tCancel->load(std::memory_order_relaxed);
}

}  // namespace arete
