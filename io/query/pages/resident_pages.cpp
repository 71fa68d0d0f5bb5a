// SPDX-License-Identifier: GPL-3.0-or-later
//
// A demand is a ladder of choices: around the picture, as needed, and then with errors that grow by the root
// of two from rung to rung, down to the root alone. The pages of a rung hold those of the next one. A step
// takes the finest rung whose pages fit into the budget and of which no more is to be read than the step may;
// it is found by bisection, as both fall from rung to rung. What the step may still read is spent on the rung
// above, in the order of the file, which has the pages that others depend on before them; so a step that may
// read little goes on all the same. Only when the rung is as fine as the budget allows are the pages of
// places ahead read, into room that nothing else needs.
//
// A page in memory is the beginning of it, down to some segment. Pages of the rung that is taken are marked
// as used before others are given back, so that what is drawn is never dropped for what is not.
#include "io/query/pages/resident_pages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "engine/base/caught_failure.h"
#include "io/files/file_image.h"

namespace arete {
namespace {

/// Rungs of the ladder below the needed errors: 2^50 times them, then the root.
constexpr int kCoarserRungs = 100;
/// Of the part of the beginning, which a server sends before the first picture.
constexpr std::uint64_t kMostOutlineBytes = std::uint64_t{256} << 10;

std::uint64_t bytesOf(const std::vector<PageNeed>& pages) {
  std::uint64_t sum = 0;
  for (const PageNeed& need : pages) sum += need.bytes.size();
  return sum;
}

}  // namespace

template <class Model>
class ResidentPages<Model>::Stepping {
 public:
  Stepping(ResidentPages& pages, const PageDemand& demand, std::uint64_t mostBytes, const RunContext& context)
      : p_(pages), demand_(demand), mostBytes_(mostBytes), context_(context), rungs_(kCoarserRungs + 3) {}

  Result<Step> run() {
    ++p_.now_;
    ARETE_TRY(const Choice* const needed, rung(1));
    if (!p_.partHas(needed->pages)) {
      ARETE_CHECK(takePart());
    } else {
      use(needed->pages);
      step_.coarseness = 1;
      isFinest_ = true;
    }
    if (isFinest_) ARETE_CHECK(readAhead());
    for (const PageNeed& need : needed->pages) {
      const std::uint64_t missing = p_.newBytesOf(need);
      step_.missingPages += missing > 0 ? 1 : 0;
      step_.missingBytes += missing;
    }
    step_.part = p_.part_;
    step_.residentBytes = p_.bytes_;
    step_.isDone = isFinest_ && !step_.isNew && step_.bytes == 0;
    return std::move(step_);
  }

 private:
  /// A choice of the ladder, made at its first use; 0 is around the picture, 1 as it is needed.
  Result<const Choice*> rung(std::size_t i) {
    std::optional<Choice>& choice = rungs_[i];
    if (choice) return &*choice;
    const RequiredError& required = i == 0 && demand_.around ? demand_.around : demand_.needed;
    if (i <= 1) {
      ARETE_TRY(choice, chosen(required, 1));
    } else if (i + 1 == rungs_.size()) {
      constexpr double kNothing = std::numeric_limits<double>::infinity();
      ARETE_TRY(choice, chosen([](const Box3&) { return kNothing; }, kNothing));
    } else {
      const double factor = std::exp2(0.5 * static_cast<double>(i - 1));
      ARETE_TRY(choice,
                chosen([factor, required](const Box3& box) { return factor * required(box); }, factor));
    }
    return &*choice;
  }

  Result<Choice> chosen(RequiredError required, double coarseness) {
    Choice choice{.required = std::move(required), .pages = {}, .coarseness = coarseness};
    ARETE_TRY(choice.pages, p_.file_.pagesFor(choice.required, context_));
    choice.bytes = bytesOf(choice.pages);
    for (const PageNeed& need : choice.pages) choice.newBytes += p_.newBytesOf(need);
    return choice;
  }

  /// The finest rung from `begin` on that does; the last one does in any case.
  template <class Does>
  Result<std::size_t> finest(std::size_t begin, const Does& does) {
    std::size_t end = rungs_.size() - 1;
    // Nearly always one of the first ones is it.
    for (const std::size_t first = begin; begin < std::min(first + 2, end); ++begin) {
      ARETE_TRY(const Choice* const choice, rung(begin));
      if (does(*choice)) return begin;
    }
    while (begin < end) {
      const std::size_t middle = begin + (end - begin) / 2;
      ARETE_TRY(const Choice* const choice, rung(middle));
      if (does(*choice))
        end = middle;
      else
        begin = middle + 1;
    }
    return begin;
  }

  Status takePart() {
    ARETE_TRY(const std::size_t affordable,
              finest(0, [&](const Choice& c) { return c.bytes <= p_.mostBytes_; }));
    ARETE_TRY(const std::size_t taken,
              finest(affordable, [&](const Choice& c) { return c.newBytes <= mostBytes_; }));
    ARETE_TRY(const Choice* const choice, rung(taken));
    isFinest_ = taken == affordable;
    use(choice->pages);
    ARETE_CHECK(read(choice->pages, choice->newBytes));
    if (!isFinest_) {
      ARETE_TRY(const Choice* const finer, rung(taken - 1));
      ARETE_CHECK(readSome(finer->pages));
    }
    step_.coarseness = choice->coarseness;
    if (p_.part_ && p_.partHas(choice->pages)) return {};
    ARETE_TRY(Model part, p_.file_.read({.verify = AmtVerify::none, .wanted = choice->required}, context_));
    p_.part_ = std::make_shared<const Model>(std::move(part));
    p_.partPages_ = choice->pages;
    step_.isNew = true;
    return {};
  }

  Status readAhead() {
    for (const RequiredError* required : {&demand_.around, &demand_.ahead}) {
      if (!*required || step_.bytes >= mostBytes_) continue;
      ARETE_TRY(const Choice choice, chosen(*required, 1));
      ARETE_CHECK(readSome(choice.pages));
    }
    return {};
  }

  /// Marks what is there of pages as used in this step.
  void use(const std::vector<PageNeed>& pages) {
    for (const PageNeed& need : pages) {
      const auto found = p_.resident_.find(need.page);
      if (found == p_.resident_.end()) continue;
      Resident& there = found->second;
      const std::uint64_t before = there.usedAt == p_.now_ ? there.needed : 0;
      there.needed = std::max<std::uint64_t>(before, std::min(there.bytes.size(), need.bytes.size()));
      there.usedAt = p_.now_;
    }
  }

  /// Reads what is not there of pages, together.
  Status read(const std::vector<PageNeed>& pages, std::uint64_t newBytes) {
    if (newBytes == 0) return {};
    p_.makeRoom(newBytes);
    std::vector<FileImage::Part> parts;
    for (const PageNeed& need : pages) {
      const std::uint64_t missing = p_.newBytesOf(need);
      if (missing == 0) continue;
      parts.push_back(need.bytes.last(missing));
      Resident& resident = p_.resident_[need.page];
      resident = {need.bytes, p_.now_, need.bytes.size()};
      p_.bytes_ += missing;
      step_.bytes += missing;
      ++step_.pages;
    }
    return p_.file_.container().loadParts(parts, context_);
  }

  /// Reads of pages, in their order, what this step may still read and what there is room for; one where the
  /// step has read none.
  Status readSome(const std::vector<PageNeed>& pages) {
    use(pages);
    std::vector<PageNeed> some;
    std::uint64_t bytes = 0;
    // What this step has a use for is not given back; what else there is of its pages is.
    std::uint64_t used = 0;
    for (const auto& [page, resident] : p_.resident_)
      if (resident.usedAt == p_.now_) used += resident.needed;
    for (const PageNeed& need : pages) {
      const std::uint64_t missing = p_.newBytesOf(need);
      if (missing == 0) continue;
      const bool isFirst = some.empty() && step_.bytes == 0;
      if (!isFirst && step_.bytes + bytes + missing > mostBytes_) break;
      if (used + bytes + missing > p_.mostBytes_) break;
      some.push_back(need);
      bytes += missing;
    }
    return read(some, bytes);
  }

  ResidentPages& p_;
  const PageDemand& demand_;
  const std::uint64_t mostBytes_;
  const RunContext& context_;
  std::vector<std::optional<Choice>> rungs_;
  Step step_;
  bool isFinest_ = false;  // no finer rung fits into the budget
};

template <class Model>
Result<ResidentPages<Model>> ResidentPages<Model>::open(File file, std::uint64_t mostBytes,
                                                        const RunContext& context) try {
  ResidentPages pages(std::move(file), mostBytes);
  // Nodes are counted by octaves of their errors, of which the last one may have many more.
  const std::uint64_t most = std::min(kMostOutlineBytes, mostBytes / 2);
  double error = 0;
  const RequiredError wanted = [&error](const Box3&) { return error; };
  std::vector<PageNeed> needs;
  for (std::uint64_t nodes = kOutlineNodes;; nodes /= 2) {
    error = nodes > 0 ? pages.file_.errorBeyond(nodes) : std::numeric_limits<double>::infinity();
    ARETE_TRY(needs, pages.file_.pagesFor(wanted, context));
    if (nodes == 0 || bytesOf(needs) <= most) break;
  }
  ARETE_TRY(Model outline, pages.file_.read({.wanted = wanted}, context));
  pages.outline_ = std::make_shared<const Model>(std::move(outline));
  pages.part_ = pages.outline_;
  pages.partPages_ = needs;
  for (const PageNeed& need : needs) {
    if (need.bytes.empty()) continue;
    pages.resident_[need.page] = {need.bytes, 0};
    pages.bytes_ += need.bytes.size();
  }
  return pages;
} catch (...) {
  return caughtFailure();
}

template <class Model>
auto ResidentPages<Model>::step(const PageDemand& demand, std::uint64_t mostBytes, const RunContext& context)
    -> Result<Step> try {
  return Stepping(*this, demand, mostBytes, context).run();
} catch (...) {
  return caughtFailure(file_.path());
}

template <class Model>
std::uint64_t ResidentPages<Model>::newBytesOf(const PageNeed& need) const {
  const auto found = resident_.find(need.page);
  const std::uint64_t there = found == resident_.end() ? 0 : found->second.bytes.size();
  return need.bytes.size() > there ? need.bytes.size() - there : 0;
}

// Both lists rise by page.
template <class Model>
bool ResidentPages<Model>::partHas(const std::vector<PageNeed>& pages) const {
  auto has = partPages_.begin();
  for (const PageNeed& need : pages) {
    while (has != partPages_.end() && has->page < need.page) ++has;
    if (has == partPages_.end() || has->page != need.page) return false;
    if (has->lowestBand > need.lowestBand || has->bytes.size() < need.bytes.size()) return false;
  }
  return true;
}

// The longest unused first; of those the last in the file, which others depend on least. Then, of pages that
// this step uses, what is longer than it needs to be.
template <class Model>
void ResidentPages<Model>::makeRoom(std::uint64_t bytes) {
  if (bytes_ + bytes <= mostBytes_) return;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> unused;  // step, page from the end
  std::vector<std::uint64_t> used;
  for (const auto& [page, resident] : resident_)
    if (resident.usedAt < now_)
      unused.push_back({resident.usedAt, ~page});
    else
      used.push_back(page);
  std::ranges::sort(unused);
  for (const auto& [usedAt, fromEnd] : unused) {
    if (bytes_ + bytes <= mostBytes_) return;
    shorten(~fromEnd, 0);
  }
  for (const std::uint64_t page : used) {
    if (bytes_ + bytes <= mostBytes_) return;
    shorten(page, resident_.at(page).needed);
  }
}

// The file gives back whole blocks, so that all up to the next page in memory is given back; where nothing
// stays, from the end of the page before on.
template <class Model>
void ResidentPages<Model>::shorten(std::uint64_t page, std::uint64_t kept) {
  const auto found = resident_.find(page);
  if (found == resident_.end() || found->second.bytes.size() <= kept) return;
  const auto bytes = found->second.bytes;
  const std::byte *begin = bytes.data() + kept, *end = bytes.data() + bytes.size();
  bytes_ -= bytes.size() - kept;
  if (kept == 0 && found != resident_.begin()) {
    const auto& before = std::prev(found)->second.bytes;
    begin = std::min(begin, before.data() + before.size());
  }
  if (const auto after = std::next(found); after != resident_.end())
    end = std::max(end, after->second.bytes.data());
  file_.container().owner()->forget({begin, end});
  if (kept == 0)
    resident_.erase(found);
  else
    found->second.bytes = bytes.first(kept);
}

template class ResidentPages<TerrainModel>;
template class ResidentPages<SurfaceModel>;

}  // namespace arete
