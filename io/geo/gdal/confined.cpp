// SPDX-License-Identifier: GPL-3.0-or-later
//
// Three fences, since each has holes that another closes. Drivers: only those of a list remain, all of which
// read through GDAL's virtual file systems. Files: a handler in front of the one for local files looks at
// each path; GDAL's other file systems (archives, parts of files) reach local files through it. Network: the
// handlers of all remote file systems are replaced by one that opens nothing, and GDAL's own requests fail.
#include "io/geo/gdal/confined.h"

#include <cpl_conv.h>
#include <cpl_http.h>
#include <cpl_vsi_virtual.h>
#include <fmt/format.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <set>
#include <string_view>
#include <system_error>

#include "engine/base/caught_failure.h"
#include "io/geo/gdal/support.h"
#include "io/geo/network/served_files.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

std::atomic<bool> isConfined = false;

constexpr std::array<std::string_view, 37> kDrivers = {
    "AAIGrid",        "BMP",          "BT",         "COG",     "CSV",           "DTED", "DXF",  "EHdr",
    "ENVI",           "ERS",          "FlatGeobuf", "GeoJSON", "GeoJSONSeq",    "GIF",  "GPKG", "GPX",
    "GRASSASCIIGrid", "GS7BG",        "GSAG",       "GSBG",    "GTiff",         "HFA",  "IDA",  "JP2OpenJPEG",
    "JPEG",           "MapInfo File", "MEM",        "Memory",  "PNG",           "RST",  "SAGA", "SRTMHGT",
    "Terragen",       "USGSDEM",      "WEBP",       "XYZ",     "ESRI Shapefile"};

fs::path canonicalOf(const fs::path& path) {
  std::error_code error;
  fs::path found = fs::weakly_canonical(fs::absolute(path, error), error);
  return error ? fs::path() : found;
}

fs::path folderOf(const fs::path& path) {
  std::error_code error;
  return canonicalOf(fs::absolute(path, error).parent_path());
}

/// What may be read and written.
class Fence {
 public:
  explicit Fence(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      const fs::path file = localFileOf(name);
      if (!file.has_filename()) continue;
      const fs::path folder = folderOf(file);
      named_.emplace_back(folder, file.stem().string());
      folders_.insert(folder);
    }
    for (const char* key : {"GDAL_DATA", "PROJ_LIB", "PROJ_DATA"})
      if (const char* folder = CPLGetConfigOption(key, nullptr)) data_.push_back(canonicalOf(folder));
    if (const char* found = CPLFindFile("gdal", "gcs.csv"))
      data_.push_back(folderOf(found));
    else if (const char* other = CPLFindFile("gdal", "gdalvrt.xsd"))
      data_.push_back(folderOf(other));
    for (const char* folder : {"/usr/share/gdal", "/usr/share/proj"}) data_.push_back(canonicalOf(folder));
  }

  bool mayRead(const char* path) const {
    const fs::path file = canonicalOf(path);
    if (file.empty()) return false;
    if (std::ranges::any_of(data_, [&](const fs::path& folder) { return isBelow(file, folder); }))
      return true;
    // Links within the folder lead to files with a name of the same kind; links out of it lead elsewhere.
    return std::ranges::any_of(named_, [&](const auto& named) {
      const std::string name = file.filename().string();
      return file.parent_path() == named.first &&
             (name.starts_with(named.second) || name.starts_with("." + named.second));
    });
  }
  bool mayWrite(const char* path) const {
    return mayRead(path) && folders_.contains(canonicalOf(path).parent_path());
  }

 private:
  static bool isBelow(const fs::path& file, const fs::path& folder) {
    return !folder.empty() && std::ranges::mismatch(folder, file).in1 == folder.end();
  }

  std::vector<std::pair<fs::path, std::string>> named_;  // folder, name without extension
  std::set<fs::path> folders_;
  std::vector<fs::path> data_;
};

std::shared_ptr<const Fence> theFence;  // set once, before isConfined

/// Stands before the handler of local files.
class FencedFiles : public VSIFilesystemHandler {
 public:
  FencedFiles(VSIFilesystemHandler* files, const Fence& fence) : files_(files), fence_(fence) {}

  VSIVirtualHandle* Open(const char* path, const char* access, bool setsError,
                         CSLConstList options) override {
    const bool writes = std::strpbrk(access, "wa+") != nullptr;
    if (!(writes ? fence_.mayWrite(path) : fence_.mayRead(path))) {
      errno = EACCES;
      return nullptr;
    }
    return files_->Open(path, access, setsError, options);
  }
  int Stat(const char* path, VSIStatBufL* status, int flags) override {
    if (fence_.mayRead(path) || isFolder(path)) return files_->Stat(path, status, flags);
    errno = ENOENT;
    return -1;
  }
  int Unlink(const char* path) override { return fence_.mayWrite(path) ? files_->Unlink(path) : refuse(); }
  int Rename(const char* from, const char* to) override {
    return fence_.mayWrite(from) && fence_.mayWrite(to) ? files_->Rename(from, to) : refuse();
  }
  char** ReadDirEx(const char* path, int most) override { return files_->ReadDirEx(path, most); }
  char** SiblingFiles(const char* path) override { return files_->SiblingFiles(path); }
  int IsCaseSensitive(const char* path) override { return files_->IsCaseSensitive(path); }
  GIntBig GetDiskFreeSpace(const char* path) override { return files_->GetDiskFreeSpace(path); }
  int SupportsSparseFiles(const char* path) override { return files_->SupportsSparseFiles(path); }

 private:
  static int refuse() {
    errno = EACCES;
    return -1;
  }
  static bool isFolder(const char* path) {
    std::error_code ignored;
    return fs::is_directory(path, ignored);
  }

  VSIFilesystemHandler* files_;
  const Fence& fence_;
};

/// In place of a remote file system.
class NoFiles : public VSIFilesystemHandler {
 public:
  VSIVirtualHandle* Open(const char*, const char*, bool, CSLConstList) override {
    errno = EACCES;
    return nullptr;
  }
  int Stat(const char*, VSIStatBufL*, int) override {
    errno = ENOENT;
    return -1;
  }
};

CPLHTTPResult* refuseRequest(const char*, CSLConstList, GDALProgressFunc, void*, CPLHTTPFetchWriteFunc, void*,
                             void*) {
  auto* result = static_cast<CPLHTTPResult*>(CPLCalloc(1, sizeof(CPLHTTPResult)));
  result->nStatus = 1;
  result->pszErrBuf = CPLStrdup("there is no network");
  return result;
}

void removeDrivers() {
  GDALDriverManager* drivers = GetGDALDriverManager();
  for (int i = drivers->GetDriverCount(); i-- > 0;) {
    GDALDriver* driver = drivers->GetDriver(i);
    if (std::ranges::find(kDrivers, driver->GetDescription()) != kDrivers.end()) continue;
    drivers->DeregisterDriver(driver);
    GDALDestroyDriver(driver);  // which is no longer the manager's
  }
}

void removeNetwork() {
  constexpr std::array<std::string_view, 6> kLocal = {"/vsimem/", "/vsizip/",     "/vsigzip/",
                                                      "/vsitar/", "/vsisubfile/", "/vsistdin/"};
  // What is replaced is no longer the manager's; several prefixes may share one.
  std::set<VSIFilesystemHandler*> replaced;
  char** prefixes = VSIFileManager::GetPrefixes();
  for (char** prefix = prefixes; prefix && *prefix; ++prefix)
    if (std::string_view(*prefix).size() > 0 && std::ranges::find(kLocal, *prefix) == kLocal.end() &&
        !std::string_view(*prefix).starts_with("/vsicrypt")) {
      replaced.insert(VSIFileManager::GetHandler(*prefix));
      VSIFileManager::InstallHandler(*prefix, new NoFiles);
    }
  // GDAL does not list this form of an address, which has the handler of "/vsicurl/".
  if (constexpr const char* kWithOptions = "/vsicurl?";
      VSIFileManager::GetHandler(kWithOptions) != VSIFileManager::GetHandler(""))
    VSIFileManager::InstallHandler(kWithOptions, new NoFiles);
  replaced.erase(VSIFileManager::GetHandler(""));  // of files
  for (char** prefix = prefixes; prefix && *prefix; ++prefix)
    replaced.erase(VSIFileManager::GetHandler(*prefix));
  CSLDestroy(prefixes);
  for (VSIFilesystemHandler* handler : replaced) delete handler;
  CPLHTTPSetFetchCallback(&refuseRequest, nullptr);
  OSRSetPROJEnableNetwork(false);
  ::setenv("PROJ_NETWORK", "OFF", 1);
}

}  // namespace

std::string localFileOf(const std::string& name) {
  if (!name.starts_with("/vsi")) return name;
  std::error_code ignored;
  for (std::size_t begin = name.find('/', 1); begin != name.npos; begin = name.find('/', begin + 1))
    for (std::size_t end = name.find('/', begin + 1);; end = name.find('/', end + 1)) {
      for (const std::size_t from : {begin, begin + 1})
        if (const std::string part = name.substr(from, end == name.npos ? end : end - from);
            fs::is_regular_file(part, ignored))
          return part;
      if (end == name.npos) break;
    }
  return {};
}

Status confineGdal(const std::vector<std::string>& names) try {
  registerGdal();
  for (const std::string& name : names) {
    const fs::path file = localFileOf(name);
    std::error_code ignored;
    if (!fs::is_symlink(fs::symlink_status(file, ignored))) continue;
    if (const fs::path to = canonicalOf(file); to.parent_path() != folderOf(file))
      return failure(ErrorCode::unreadable, fmt::format("is a link to {}, out of its folder", to.string()),
                     name);
  }
  forbidServedFiles();
  theFence = std::make_shared<const Fence>(names);
  removeDrivers();
  removeNetwork();
  VSIFileManager::InstallHandler("", new FencedFiles(VSIFileManager::GetHandler(""), *theFence));
  isConfined = true;
  return {};
} catch (...) {
  return caughtFailure();
}

bool gdalIsConfined() noexcept {
  return isConfined;
}

bool mayRead(const std::filesystem::path& file) {
  return !isConfined || theFence->mayRead(file.c_str());
}

}  // namespace arete
