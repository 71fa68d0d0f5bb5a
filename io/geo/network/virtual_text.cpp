// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which elements name files is a list, since other ones may have addresses as well (of a CRS, of a note in
// the metadata). A name may be the text of another VRT. Each file that a VRT names is looked into once: the
// first bytes of a file, not its extension, make it a VRT, and files may name one another in circles.
#include "io/geo/network/virtual_text.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_minixml.h>
#include <cpl_string.h>
#include <cpl_vsi.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <span>
#include <utility>

#include "io/geo/network/network_path.h"
#include "io/geo/network/served_files.h"

namespace arete {
namespace {

constexpr std::size_t kHeadBytes = 1024;  // in which GDAL looks as well
constexpr int kDeepestTexts = 64;

struct TreeCloser {
  void operator()(CPLXMLNode* tree) const { CPLDestroyXMLNode(tree); }
};
struct VirtualFileCloser {
  void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};

bool isVirtualText(std::string_view head) {
  return head.find("<VRTDataset") != head.npos || head.find("<OGRVRTDataSource") != head.npos;
}

bool namesFile(const CPLXMLNode& element) {
  constexpr std::array<const char*, 7> kNames = {"SourceFilename", "SourceDataset", "SrcDataSource",
                                                 "DEMPath",        "X_DATASET",     "Y_DATASET",
                                                 "OVERVIEW_FILE"};
  const char* name = element.pszValue;
  if (EQUAL(name, "MDI")) name = CPLGetXMLValue(&element, "key", "");
  return CPLGetXMLNode(&element, "relativeToVRT") != nullptr ||
         std::ranges::any_of(kNames, [&](const char* known) { return EQUAL(name, known); });
}

/// What is known of files while one VRT is looked into.
struct Known {
  std::map<std::string, bool> leadsToAddress;  ///< false also while the file is looked into
  int depth = 0;
};

/// The name of a file under our prefix, if it is a VRT that leads to an address; otherwise its own.
std::string servedFile(const std::string& path, Known& known);

/// The names in one VRT.
class VirtualText {
 public:
  VirtualText(std::string path, Known& known) : path_(std::move(path)), known_(known) {}

  /// @return Nothing if no name leads to an address.
  std::optional<std::string> served(const std::string& text) {
    const CPLErrorStateBackuper kept;
    const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
    const std::unique_ptr<CPLXMLNode, TreeCloser> tree(CPLParseXMLString(text.c_str()));
    if (tree) visit(tree.get());
    if (!leadsToAddress_) return std::nullopt;
    char* rewritten = CPLSerializeXMLTree(tree.get());
    std::string result = rewritten;
    CPLFree(rewritten);
    return result;
  }

 private:
  void visit(CPLXMLNode* node) {
    for (; node; node = node->psNext) {
      if (node->eType != CXT_Element) continue;
      if (namesFile(*node)) rename(*node);
      visit(node->psChild);
    }
  }

  void rename(CPLXMLNode& element) {
    CPLXMLNode* content = element.psChild;
    while (content && content->eType != CXT_Text) content = content->psNext;
    if (!content) return;
    const std::string name = content->pszValue;
    const auto set = [&](const std::string& other) {
      CPLFree(content->pszValue);
      content->pszValue = CPLStrdup(other.c_str());
    };
    if (isVirtualText(name)) {
      if (const auto inner = VirtualText("", known_).served(name)) {
        leadsToAddress_ = true;
        set(*inner);
      }
      return;
    }
    if (isServedAddress(servedPath(name))) {
      leadsToAddress_ = true;
      set(servedPath(name));
      return;
    }
    const bool isRelative = CPLTestBool(CPLGetXMLValue(&element, "relativeToVRT", "0"));
    // What is beside a file of the network, GDAL finds there.
    if (isRelative && isUnderPrefix(path_) && beginsWithAddress(behindPrefix(path_))) return;
    // A name that begins otherwise ("NETCDF:...") is GDAL's to understand.
    if (isRelative && name.find(':') != name.npos) return;
    const std::string whole = isRelative ? CPLProjectRelativeFilename(folder().c_str(), name.c_str()) : name;
    const std::string served = servedFile(whole, known_);
    if (served != whole) leadsToAddress_ = true;
    if (!isRelative && served == whole) return;
    set(served);
    CPLSetXMLValue(&element, "#relativeToVRT", "0");
  }

  static bool isUnderPrefix(const std::string& path) {
    return !servedName().empty() && path.starts_with(servedName());
  }
  static std::string behindPrefix(const std::string& path) { return path.substr(servedName().size() + 1); }

  /// The folder of the VRT, where it is not under our prefix.
  std::string folder() const {
    return CPLGetPath((isUnderPrefix(path_) ? behindPrefix(path_) : path_).c_str());
  }

  std::string path_;
  Known& known_;
  bool leadsToAddress_ = false;
};

/// The text of a file that is a VRT; empty for others.
std::string virtualTextOf(const std::string& path) {
  VSIStatBufL status;
  if (VSIStatExL(path.c_str(), &status, VSI_STAT_EXISTS_FLAG | VSI_STAT_NATURE_FLAG) != 0 ||
      !VSI_ISREG(status.st_mode))
    return {};  // opening a pipe may block
  const std::unique_ptr<VSILFILE, VirtualFileCloser> file(VSIFOpenL(path.c_str(), "rb"));
  if (!file) return {};
  std::string text(kHeadBytes, ' ');
  text.resize(VSIFReadL(text.data(), 1, text.size(), file.get()));
  if (!isVirtualText(text)) return {};
  VSIFSeekL(file.get(), 0, SEEK_END);
  text.resize(std::size_t(VSIFTellL(file.get())));
  VSIFSeekL(file.get(), 0, SEEK_SET);
  text.resize(VSIFReadL(text.data(), 1, text.size(), file.get()));
  return text;
}

std::string servedFile(const std::string& path, Known& known) {
  if (servedName().empty() || path.starts_with(servedName()) || path.starts_with("/vsistdin")) return path;
  const std::string served = servedName() + "/" + path;
  if (const auto found = known.leadsToAddress.find(path); found != known.leadsToAddress.end())
    return found->second ? served : path;
  if (known.depth >= kDeepestTexts) return path;
  known.leadsToAddress[path] = false;
  const std::string text = virtualTextOf(path);
  if (text.empty()) return path;
  ++known.depth;
  const bool leads = VirtualText(path, known).served(text).has_value();
  --known.depth;
  known.leadsToAddress[path] = leads;
  return leads ? served : path;
}

}  // namespace

std::optional<std::string> servedVirtualText(const ByteSource& source, const std::string& path) {
  std::string text(std::size_t(std::min<std::uint64_t>(kHeadBytes, source.size())), ' ');
  const auto read = [&] {
    return source.read(0, std::as_writable_bytes(std::span(text.data(), text.size()))).has_value();
  };
  if (!read() || !isVirtualText(text)) return std::nullopt;
  text.resize(std::size_t(source.size()));
  if (!read()) return std::nullopt;
  Known known;
  return VirtualText(path, known).served(text);
}

std::string servedDatasetPath(const std::string& path) {
  constexpr std::string_view kVirtual = "vrt://";
  const std::string served = servedPath(path);
  Known known;
  if (isVirtualText(served))  // the text itself, not the name of a file
    return VirtualText("", known).served(served).value_or(served);
  if (!served.starts_with(kVirtual)) return servedFile(served, known);
  const std::size_t options = std::min(served.find('?'), served.size());
  const std::string file = served.substr(kVirtual.size(), options - kVirtual.size());
  return std::string(kVirtual) + servedFile(file, known) + served.substr(options);
}

}  // namespace arete
