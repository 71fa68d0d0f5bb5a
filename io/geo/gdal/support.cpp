// SPDX-License-Identifier: GPL-3.0-or-later
//
// GDAL keeps a stack of error handlers per thread, each with a user pointer; GdalErrors pushes one that
// stores the messages in its object. The explanation of a failed open checks in turn: does the path exist, is
// it a file, is it empty, is it readable. Only then it quotes GDAL.
#include "io/geo/gdal/support.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_vsi.h>
#include <dlfcn.h>
#include <execinfo.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <mutex>

#include "engine/base/counted.h"
#include "io/files/text_scan.h"
#include "io/files/watched_files.h"
#include "io/geo/gdal/confined.h"
#include "io/geo/gdal/message_text.h"
#include "io/geo/gdal/unclaimed_messages.h"
#include "io/geo/network/netcdf_copy.h"
#include "io/geo/network/network_path.h"
#include "io/geo/network/network_reading.h"
#include "io/geo/network/served_files.h"
#include "io/geo/network/virtual_text.h"

namespace arete {
namespace {

constexpr std::size_t kWarningsKept = 5;

/// What to do with a compressed file or an archive, by its name; empty for other names.
std::string archiveHint(const std::string& path, std::string_view kind) {
  if (isVirtualPath(path)) return {};
  const std::string name = text::lowered(path);
  const auto endsIn = [&](std::initializer_list<const char*> extensions) {
    return std::any_of(extensions.begin(), extensions.end(),
                       [&](const char* extension) { return name.ends_with(extension); });
  };
  if (endsIn({".zip"})) return fmt::format("is an archive: name the {} in it, /vsizip/{}/NAME", kind, path);
  if (endsIn({".tar", ".tgz", ".tar.gz"}))
    return fmt::format("is an archive: name the {} in it, /vsitar/{}/NAME", kind, path);
  if (endsIn({".gz"}))
    return fmt::format("is compressed: /vsigzip/{} reads it, and gunzip unpacks it for other programs", path);
  if (endsIn({".bz2", ".xz", ".zst", ".7z", ".rar", ".z", ".lzma", ".tbz", ".txz"}))
    return fmt::format("is compressed or an archive: unpack it and name the {} in it", kind);
  return {};
}

/// HDF5 writes its errors to stderr unless that is turned off, thread by thread. It comes with GDAL, so it is
/// looked up where it is.
void silenceHdf5() {
  thread_local bool isSilent = false;
  if (isSilent) return;
  isSilent = true;
  using SetAuto = int (*)(std::int64_t stack, void* function, void* data);
  if (void* found = dlsym(RTLD_DEFAULT, "H5Eset_auto2"))
    reinterpret_cast<SetAuto>(found)(0, nullptr, nullptr);
}

}  // namespace

void registerGdal() {
  static std::once_flag once;
  std::call_once(once, [] {
    // What leaves this by an exception passes through C, for which the system loads what it needs to unwind:
    // without memory it would end the process.
    void* here = nullptr;
    ::backtrace(&here, 1);
    const GdalErrors quiet;  // of a damaged plugin
    GDALAllRegister();
    servedName();
  });
}

GdalErrors::GdalErrors() {
  CPLPushErrorHandlerEx(&GdalErrors::collect, this);
}

GdalErrors::~GdalErrors() {
  CPLPopErrorHandler();
  CPLErrorReset();
}

void GdalErrors::collect(CPLErr severity, CPLErrorNum number, const char* message) {
  if (severity == CE_Fatal) reportFatalGdalError(message);
  auto* self = static_cast<GdalErrors*>(CPLGetErrorHandlerUserData());
  if (severity >= CE_Warning) self->messages_.push_back({severity, number, gdalMessageText(message)});
}

bool GdalErrors::anyFailure() const {
  return std::ranges::any_of(messages_, [](const Message& m) { return m.severity >= CE_Failure; });
}

std::string GdalErrors::firstFailure() const {
  for (const Message& message : messages_)
    if (message.severity >= CE_Failure) return message.text;
  return {};
}

std::string GdalErrors::firstFileFailure() const {
  for (const Message& message : messages_)
    if (message.severity >= CE_Failure && message.number == CPLE_FileIO) return message.text;
  return {};
}

std::string GdalErrors::firstMessage() const {
  return messages_.empty() ? std::string() : messages_.front().text;
}

void GdalErrors::moveTo(Warnings& warnings) {
  std::vector<std::string> distinct;
  for (const Message& message : messages_) {
    std::string line = "GDAL: " + message.text;
    if (std::ranges::find(distinct, line) == distinct.end() &&
        std::ranges::find(warnings, line, &Warning::sentence) == warnings.end())
      distinct.push_back(std::move(line));
  }
  for (std::size_t i = 0; i < std::min(kWarningsKept, distinct.size()); ++i)
    warnings.push_back({WarningCode::library, std::move(distinct[i])});
  if (distinct.size() > kWarningsKept)
    warnings.push_back(
        {WarningCode::library, fmt::format("GDAL: and {}", counted(distinct.size() - kWarningsKept,
                                                                   "more message", "more messages"))});
  messages_.clear();
}

void GdalDatasetCloser::operator()(GDALDataset* dataset) const {
  const std::string description = dataset->GetDescription();
  GDALClose(GDALDataset::ToHandle(dataset));
  removeNetworkCopy(description);
}

GdalDatasetPtr openGdal(const std::string& path, unsigned flags, const std::vector<std::string>& options) {
  registerGdal();
  silenceHdf5();
  if (findPipeProblem(path)) return nullptr;
  watchInputFile(path);
  std::string served = servedDatasetPath(path);
  if ((flags & GDAL_OF_RASTER) != 0) served = pathWithoutNetcdf(served);
  const CPLConfigOptionSetter noSchema("GML_DOWNLOAD_WFS_SCHEMA", "NO", true);
  CPLStringList list;
  for (const std::string& option : options) list.AddString(option.c_str());
  return GdalDatasetPtr(GDALDataset::Open(served.c_str(), flags | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                                          nullptr, list.List()));
}

std::optional<Error> findPipeProblem(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  const mode_t mode = status.st_mode;
  if (!S_ISFIFO(mode) && !S_ISCHR(mode) && !S_ISBLK(mode) && !S_ISSOCK(mode)) return std::nullopt;
  return Error{ErrorCode::unreadable, "is a pipe or a device, not a file; /vsistdin/ reads standard input",
               path};
}

std::optional<Error> findInputProblem(const std::string& path) {
  if (path.empty()) return Error{ErrorCode::usage, "the name of the input file is empty", {}};
  if (auto problem = findPipeProblem(path)) return problem;
  const std::string served = servedPath(path);
  VSIStatBufL status;
  if (VSIStatL(served.c_str(), &status) != 0) return std::nullopt;
  // A file geodatabase is a folder.
  if (VSI_ISDIR(status.st_mode) && text::lowerExtension(path) == "gdb") return std::nullopt;
  if (VSI_ISDIR(status.st_mode) && path.starts_with("/vsizip/"))
    return Error{ErrorCode::usage, "is an archive, or a folder in one: append / and the name of a file in it",
                 path};
  if (VSI_ISDIR(status.st_mode)) return Error{ErrorCode::unreadable, "is a folder, not a file", path};
  if (VSI_ISREG(status.st_mode) && status.st_size == 0) return Error{ErrorCode::unreadable, "is empty", path};
  if (VSILFILE* file = VSIFOpenL(served.c_str(), "rb")) {
    VSIFCloseL(file);
    return std::nullopt;
  }
  const std::string reason = std::strerror(errno);
  if (const auto problem = networkProblem(served))
    return Error{problem->code, "cannot be read: " + problem->message, path};
  return Error{ErrorCode::unreadable, fmt::format("cannot be opened: {}", reason), path};
}

Error explainOpenFailure(const std::string& given, std::string_view kind, const GdalErrors& errors) {
  const std::string path = networkPathOf(given), served = servedPath(given);
  if (const auto problem = networkProblem(served))
    return {problem->code, "cannot be read: " + problem->message, given};
  if (auto problem = findInputProblem(path)) return *problem;
  VSIStatBufL status;
  const bool there = VSIStatL(served.c_str(), &status) == 0;
  const std::string said = errors.firstFailure();
  const bool connectionString = path.find(':') != std::string::npos && !said.empty();
  if (!there && !isVirtualPath(path) && !connectionString)
    return {ErrorCode::notFound, "there is no such file", path};
  if (!there && isVirtualPath(path))
    return {ErrorCode::notFound, said.empty() ? "there is no such file" : "cannot be opened: " + said, path};
  if (GDALIdentifyDriverEx(served.c_str(), GDAL_OF_RASTER | GDAL_OF_VECTOR, nullptr, nullptr) &&
      !said.empty())
    return {ErrorCode::corrupt, fmt::format("cannot be read as a {}: {}", kind, said), path};
  if (const std::string hint = archiveHint(path, kind); !hint.empty())
    return {ErrorCode::unsupported, hint, path};
  return {ErrorCode::unsupported,
          fmt::format("is not a {} in any format {}", kind,
                      gdalIsConfined() ? "that is read without looking at other files" : "GDAL knows"),
          path};
}

bool isTextDriver(GDALDriverH driver) {
  return driver != nullptr && EQUAL(GDALGetDriverShortName(driver), "XYZ");
}

bool isVirtualPath(std::string_view path) {
  return path.substr(0, 4) == "/vsi";
}

}  // namespace arete
