// SPDX-License-Identifier: GPL-3.0-or-later
//
// The least set is unique, so the order of the walk does not matter for what it finds, only for how long it
// takes.
//
// A walk from the root, with a stack of nodes to include, accesses triangles and parents at random and waits
// for memory at each. So for a bounded criterion a sweep visits the saturated cut once, in the order of the
// nodes, parents first: it contains the least cut and a few per cent more. Visiting a member includes the
// removers of its failing triangles, which come later in the order. Visiting a node that is not yet a member
// includes it if a child is a member; otherwise it marks its children as lacking a parent, and a marked child
// includes its parents when it is visited as a member. A node that is included after it was visited goes on a
// stack and is visited again. If a node is needed that the saturated cut does not have, the walk from the
// root decides.
//
// For a uniform error the saturated cut is not needed: its nodes are those of the first bands, except for
// some of the last one. Nearly all of them are members, and are visited run by run.
#include "engine/cut/least_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/base/vector_clones.h"
#include "engine/cut/front.h"
#include "engine/cut/refine.h"
#include "engine/cut/saturated_cut.h"

namespace arete {
namespace {

constexpr std::size_t kCheckEvery = 1 << 12;

/// Whether a triangle satisfies the criterion; a uniform error is compared as a code, without the virtual
/// call.
class Test {
 public:
  Test(const MultiTriangulation& mt, const Criterion& criterion)
      : mt_(mt),
        criterion_(criterion),
        bounded_(criterion.bounded()),
        isUniform_(bounded_ != nullptr && bounded_->uniformError()),
        code_(isUniform_ ? mt.scale().floorCode(*bounded_->uniformError()) : OutwardScale::Code(0)) {}

  bool isUniform() const { return isUniform_; }
  OutwardScale::Code code() const { return code_; }

  /// Bounds for all triangles of a star by the ball around it: the codes up to which they pass, and up to
  /// which they may pass.
  struct Around {
    OutwardScale::Code passing, mayPass;
  };
  Around around(NodeId n) const {
    if (isUniform_) return {code_, code_};
    const Sphere& ball = mt_.sphere(n);
    const OutwardScale& scale = mt_.scale();
    return {scale.floorCode(bounded_->allowedError(ball)), scale.floorCode(bounded_->mostAllowed(ball))};
  }

  bool passes(std::uint32_t id, NodeId creator) const {
    if (isUniform_) return mt_.arrays().error[id] <= code_;
    return isSatisfied(mt_, criterion_, TriangleId(id), mt_.corners(TriangleId(id), creator));
  }

 private:
  const MultiTriangulation& mt_;
  const Criterion& criterion_;
  const BoundedCriterion* bounded_;
  bool isUniform_;
  OutwardScale::Code code_;
};

/// The candidates for a uniform error: the nodes before the end of its code's band. Nearly all of them are in
/// the saturated cut, so their flags are indexed by node.
class UniformCandidates {
 public:
  UniformCandidates(const MultiTriangulation& mt, OutwardScale::Code code)
      : saturated_(mt.arrays().saturatedError),
        code_(code),
        bandBegin_(mt.bandBegin(MultiTriangulation::bandOf(code))),
        end_(mt.bandEnd(MultiTriangulation::bandOf(code))) {}

  std::uint32_t count() const { return end_; }
  bool contains(std::uint32_t n) const { return n < end_; }
  std::uint32_t indexOf(std::uint32_t n) const { return n; }
  /// Whether the saturated cut contains a candidate.
  bool mayBeIn(std::uint32_t n) const { return saturated_[n] > code_; }
  /// Whether it contains all members.
  bool mayAllBeIn(const NodeSet& in) const {
    for (std::uint32_t n = bandBegin_; n < end_; ++n)
      if (in[n] != 0 && !mayBeIn(n)) return false;
    return true;
  }

  /// Calls visit(first index, end index, nodeAt(index)) for one span after the other, until it returns false.
  template <class Visit>
  bool forSpans(const Visit& visit) const {
    constexpr std::uint32_t kInSpan = MemberSet::kMostInSpan;
    for (std::uint32_t begin = 0; begin < end_; begin += kInSpan)
      if (!visit(begin, std::min(end_, begin + kInSpan), [](std::uint32_t index) { return index; }))
        return false;
    return true;
  }

  MemberSet members(NodeSet in) const {
    in.resize(end_);
    return MemberSet(in);
  }

 private:
  std::span<const OutwardScale::Code> saturated_;
  OutwardScale::Code code_;
  std::uint32_t bandBegin_, end_;
};

/// The candidates for any other bound: the saturated cut. Flags are indexed by rank.
class RankedCandidates {
 public:
  RankedCandidates(const MemberSet& set, std::uint32_t nodes)
      : set_(set), lookup_(set.lookup()), nodes_(nodes) {}

  std::uint32_t count() const { return set_.size(); }
  bool contains(std::uint32_t n) const { return lookup_.contains(n); }
  std::uint32_t indexOf(std::uint32_t n) const { return lookup_.rank(n); }
  bool mayBeIn(std::uint32_t) const { return true; }
  bool mayAllBeIn(const NodeSet&) const { return true; }

  template <class Visit>
  bool forSpans(const Visit& visit) const {
    std::array<std::uint32_t, MemberSet::kMostInSpan> members;
    for (std::uint32_t span = 0; span < set_.spans(); ++span) {
      const std::uint32_t begin = set_.before(span), end = begin + set_.list(span, members.data());
      if (!visit(begin, end, [&](std::uint32_t index) { return members[index - begin]; })) return false;
    }
    return true;
  }

  MemberSet members(const NodeSet& in) const {
    std::vector<std::uint32_t> list;
    std::uint32_t rank = 0;
    set_.visit([&](std::uint32_t n) {
      if (in[rank++] != 0) list.push_back(n);
    });
    return {list, nodes_};
  }

 private:
  const MemberSet& set_;
  const MemberSet::Lookup lookup_;
  const std::uint32_t nodes_;
};

/// Visits the candidates in the order of the nodes.
template <class Candidates>
class Sweep {
 public:
  Sweep(const MultiTriangulation& mt, const Test& test, const Candidates& candidates)
      : mt_(mt),
        a_(mt.arrays()),
        test_(test),
        candidates_(candidates),
        in_(std::size_t{candidates.count()} + 1, 0),
        lacksParent_(candidates.count(), 0) {}

  /// @return The least set; nothing if a node is needed that is no candidate (rounding, or a file whose
  /// errors break the laws), or if it was stopped.
  std::optional<MemberSet> run(const std::function<bool()>& stop) {
    for (std::uint32_t t = 0; t < mt_.rootTriangleCount(); ++t)
      if (a_.remover[t] != MultiTriangulation::kNone && !test_.passes(t, {})) include(a_.remover[t]);
    const bool isThrough = candidates_.forSpans([&](std::uint32_t begin, std::uint32_t end, auto nodeAt) {
      if (stop()) return false;
      for (std::uint32_t index = begin; index < end; ++index) {
        if constexpr (kIsUniform) index = visitRuns(index, end);
        if (index == end) break;
        current_ = index;
        visit(nodeAt(index));
        if (!late_.empty() && !visitLate(stop)) return false;
      }
      return true;
    });
    if (!isThrough || isBeyond_ || !candidates_.mayAllBeIn(in_)) return std::nullopt;
    return candidates_.members(std::move(in_));
  }

 private:
  static constexpr bool kIsUniform = std::is_same_v<Candidates, UniformCandidates>;
  static constexpr std::uint32_t kMostInRun = 64, kSlotsAtOnce = 512;

  /// Visits the candidates from an index on, up to the first that is not a member or lacks a parent.
  /// @return That one's index. Members are found run by run: a member stays one, and the slots of a run are
  /// one range, visited without branches.
  std::uint32_t visitRuns(std::uint32_t index, std::uint32_t indexEnd) {
    for (;;) {
      const std::uint32_t runEnd = memberRunEnd(index, std::min(indexEnd, index + kMostInRun));
      if (runEnd == index) return index;
      for (std::uint32_t s = a_.slotBegin[index], end = a_.slotBegin[runEnd]; s != end;) {
        const std::uint32_t next = s + std::min(end - s, kSlotsAtOnce);
        includeRemovers(s, next);
        s = next;
      }
      index = runEnd;
    }
  }

  /// The first index whose node is not a member or lacks a parent.
  std::uint32_t memberRunEnd(std::uint32_t index, std::uint32_t end) const {
    constexpr std::uint64_t kAll = 0x0101010101010101;
    for (; index + 8 <= end; index += 8) {
      std::uint64_t in, lacking;
      std::memcpy(&in, in_.data() + index, 8);
      std::memcpy(&lacking, lacksParent_.data() + index, 8);
      if ((in & ~lacking) != kAll) break;
    }
    while (index < end && in_[index] > lacksParent_[index]) ++index;
    return index;
  }

  /// Includes the removers of the failing triangles of these slots. Precondition: they are visited later.
  ARETE_VECTOR_CLONES
  void includeRemovers(std::uint32_t begin, std::uint32_t end) {
    const std::uint32_t* const removers = a_.remover.data() + mt_.rootTriangleCount() + begin;
    const OutwardScale::Code* const errors = a_.error.data() + mt_.rootTriangleCount() + begin;
    const std::uint32_t notFailing = candidates_.count(), code = test_.code(), count = end - begin;
    std::array<std::uint32_t, kSlotsAtOnce> included;
    std::uint32_t beyond = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t r = removers[i], here = std::min(r, notFailing);
      const bool fails = errors[i] > code;
      included[i] = fails ? here : notFailing;
      beyond |= fails && r >= notFailing && r != MultiTriangulation::kNone ? 1 : 0;
    }
    std::uint8_t* const in = in_.data();
    for (std::uint32_t i = 0; i < count; ++i) in[included[i]] = 1;
    isBeyond_ = isBeyond_ || beyond != 0;
  }

  void visit(std::uint32_t n) {
    if (in_[current_] == 0) {
      if (!candidates_.mayBeIn(n) || !hasChildIn(n)) return;
      in_[current_] = 1;
    }
    expand(n, current_);
  }

  /// Whether a child is a member; if none is, marks all children as lacking a parent.
  bool hasChildIn(std::uint32_t n) {
    const std::uint32_t roots = mt_.rootTriangleCount(), begin = a_.slotBegin[n], end = a_.slotBegin[n + 1];
    for (std::uint32_t s = begin; s < end; ++s) {
      const std::uint32_t r = a_.remover[roots + s];
      if (r != n && isIn(r)) return true;
    }
    for (std::uint32_t s = begin; s < end; ++s) {
      const std::uint32_t r = a_.remover[roots + s];
      if (r != n && candidates_.contains(r)) lacksParent_[candidates_.indexOf(r)] = 1;
    }
    return false;
  }

  void expand(std::uint32_t n, std::uint32_t index) {
    if (lacksParent_[index] != 0)
      for (const std::uint32_t t : mt_.floor(NodeId(n)))
        if (const NodeId parent = mt_.creator(TriangleId(t)); parent.isValid()) include(parent.index());
    const std::uint32_t roots = mt_.rootTriangleCount(), begin = a_.slotBegin[n], end = a_.slotBegin[n + 1];
    if constexpr (kIsUniform)
      if (index == current_) return includeRemovers(begin, end);
    std::optional<Test::Around> around;  // of the star
    for (std::uint32_t s = begin; s < end; ++s) {
      const std::uint32_t r = a_.remover[roots + s];
      if (r == MultiTriangulation::kNone || isIn(r)) continue;
      // The criterion allows the saturated error of a node that is no candidate, and with it all that it
      // removes.
      if (!candidates_.contains(r) && a_.error[roots + s] <= a_.saturatedError[r]) continue;
      if (!around) around = test_.around(NodeId(n));
      if (a_.error[roots + s] <= around->passing) continue;
      if (a_.error[roots + s] > around->mayPass || !test_.passes(roots + s, NodeId(n))) include(r);
    }
  }

  bool isIn(std::uint32_t n) const { return candidates_.contains(n) && in_[candidates_.indexOf(n)] != 0; }

  /// Includes the remover of a failing triangle, or a parent of a member.
  void include(std::uint32_t n) {
    if (!candidates_.contains(n)) {
      isBeyond_ = true;
      return;
    }
    const std::uint32_t index = candidates_.indexOf(n);
    if (in_[index] != 0) return;
    in_[index] = 1;
    if (index < current_) late_.push_back(n);
  }

  bool visitLate(const std::function<bool()>& stop) {
    for (std::size_t steps = 1; !late_.empty(); ++steps) {
      if (steps % kCheckEvery == 0 && stop()) return false;
      const std::uint32_t n = late_.back();
      late_.pop_back();
      expand(n, candidates_.indexOf(n));
    }
    return true;
  }

  const MultiTriangulation& mt_;
  const MtArrays& a_;
  const Test& test_;
  const Candidates& candidates_;
  NodeSet in_;                             // per candidate; the last is written for slots that do not fail
  std::vector<std::uint8_t> lacksParent_;  // per candidate
  std::uint32_t current_ = 0;              // the index of the candidate being visited
  std::vector<std::uint32_t> late_;
  bool isBeyond_ = false;
};

std::optional<MemberSet> swept(const MultiTriangulation& mt, const BoundedCriterion& criterion,
                               const std::function<bool()>& stop) {
  const Test test(mt, criterion);
  if (test.isUniform()) {
    const UniformCandidates candidates(mt, test.code());
    return Sweep(mt, test, candidates).run(stop);
  }
  const SaturatedMembers saturated = saturatedMembers(mt, criterion, std::nullopt);
  const RankedCandidates candidates(saturated.members, mt.nodeCount());
  return Sweep(mt, test, candidates).run(stop);
}

}  // namespace

std::optional<MemberSet> leastMembers(const MultiTriangulation& mt, const Criterion& criterion,
                                      const std::function<bool()>& stop) {
  if (const BoundedCriterion* bounded = criterion.bounded())
    if (auto found = swept(mt, *bounded, stop)) return found;
  // Stops at once if the sweep was stopped.
  return leastMembersByWalk(mt, criterion, stop);
}

std::optional<MemberSet> leastMembersByWalk(const MultiTriangulation& mt, const Criterion& criterion,
                                            const std::function<bool()>& stop) {
  const MtArrays& a = mt.arrays();
  const Test test(mt, criterion);
  const std::uint32_t roots = mt.rootTriangleCount();
  NodeSet in(mt.nodeCount(), 0);
  std::vector<std::uint32_t> stack;
  const auto include = [&](std::uint32_t n) {
    if (n == MultiTriangulation::kNone || in[n]) return;
    in[n] = 1;
    stack.push_back(n);
  };
  for (std::uint32_t t = 0; t < roots; ++t)
    if (a.remover[t] != MultiTriangulation::kNone && !test.passes(t, {})) include(a.remover[t]);
  for (std::size_t steps = 0; !stack.empty(); ++steps) {
    if (steps % kCheckEvery == 0 && stop()) return std::nullopt;
    const std::uint32_t n = stack.back();
    stack.pop_back();
    for (const std::uint32_t t : mt.floor(NodeId(n))) include(mt.creator(TriangleId(t)).index());
    for (std::uint32_t s = a.slotBegin[n]; s < a.slotBegin[n + 1]; ++s) {
      const std::uint32_t r = a.remover[roots + s];
      if (r != MultiTriangulation::kNone && !in[r] && !test.passes(roots + s, NodeId(n))) include(r);
    }
  }
  return MemberSet(in);
}

std::optional<MemberSet> leastMembersWithin(const MultiTriangulation& mt, double least,
                                            std::uint32_t maxTriangles, const std::function<bool()>& stop) {
  const OutwardScale& scale = mt.scale();
  const std::uint32_t leastCode = scale.floorCode(least);
  // Invariant: the set of code `fits` is small enough, that of any code below `large` is not. (A smaller
  // error has a larger set.) Both with their triangles.
  std::uint32_t fits = OutwardScale::kMaxCode, large = leastCode;
  double ofFits = mt.rootTriangleCount(), ofLarge = 0;
  std::optional<MemberSet> best = MemberSet::prefix(0);  // the set of the largest code
  const auto evaluate = [&](std::uint32_t code) {
    auto set = leastMembers(mt, UniformError(scale.decode(static_cast<OutwardScale::Code>(code))), stop);
    if (!set) return false;
    const std::uint64_t count = frontSize(mt, *set);
    if (count <= maxTriangles) {
      fits = code;
      ofFits = static_cast<double>(count);
      best = std::move(set);
    } else {
      large = code + 1;
      ofLarge = static_cast<double>(count);
    }
    return true;
  };

  // Starts at the first band at whose end the nodes suffice for the budget, which is nearly always too fine,
  // and continues with finer bands until the set is too large.
  std::uint32_t band = MultiTriangulation::kBands - 1;
  while (band > 0 && 2 * std::uint64_t{mt.bandEnd(band)} < maxTriangles) --band;
  for (std::uint32_t code = std::max(leastCode, band << MultiTriangulation::kBandShift);;) {
    if (!evaluate(code)) return std::nullopt;
    if (fits != code || code == leastCode) break;
    code -= std::min(code - leastCode, 1u << MultiTriangulation::kBandShift);
  }
  // The number of triangles is about a power of the error, and codes are logarithms: interpolates between the
  // two on a straight line, or bisects if the last step did not halve the interval.
  for (bool isHalved = true; large < fits;) {
    const std::uint32_t left = fits - large;
    const double part = std::log(maxTriangles / ofFits) / std::log(ofLarge / ofFits);
    const std::uint32_t down =
        isHalved && part > 0 && part < 1 ? static_cast<std::uint32_t>(part * left) : left / 2;
    if (!evaluate(fits - 1 - std::min(down, left - 1))) return std::nullopt;
    isHalved = 2 * (fits - large) <= left;
  }
  return best;
}

std::optional<SetOfSeverity> membersOfSeverityWithin(const MultiTriangulation& mt,
                                                     const BoundedCriterion& criterion,
                                                     std::uint32_t maxTriangles,
                                                     const std::function<bool()>& stop) {
  constexpr double kNearEnough = 0.9, kAimedAt = 0.95, kLargestStep = 1.0 / 16, kLeastPart = 0.05,
                   kWorthwhile = 1.05;
  constexpr int kMostEvaluations = 12;
  // The largest finite severity of the root: around an eye severities are infinite.
  double fits = 0, large = *criterion.severityLimit();
  for (std::uint32_t t = 0; t < mt.rootTriangleCount(); ++t) {
    const double severity = criterion.severity(mt, TriangleId(t), mt.rootTriangles()[t]);
    if (std::isfinite(severity)) fits = std::max(fits, severity);
  }
  // Triangles that the sets add to the root, at least 1.
  const double roots = mt.rootTriangleCount(), target = std::max(1.0, kAimedAt * maxTriangles - roots);
  double ofFits = 1, ofLarge = 0;  // 0: not yet evaluated
  SetOfSeverity best{MemberSet::prefix(0)};
  double limit = fits * kLargestStep;
  for (int evaluations = 0;
       evaluations < kMostEvaluations && fits > large && ofFits + roots < kNearEnough * maxTriangles;
       ++evaluations) {
    limit = std::max(limit, large);
    auto set = leastMembers(mt, *criterion.withSeverityLimit(limit), stop);
    if (!set) return std::nullopt;
    const auto count = static_cast<double>(frontSize(mt, *set)), added = std::max(1.0, count - roots);
    if (count <= maxTriangles) {
      const bool isAllThereIs = 2 * limit < fits && added < kWorthwhile * ofFits && ofLarge == 0;
      fits = limit;
      ofFits = added;
      best = {std::move(*set), limit};
      if (isAllThereIs) break;
    } else {
      large = limit;
      ofLarge = added;
    }
    // The number of triangles is about a power of the severity; the power -1 is assumed until there are two
    // values.
    const double part = std::log(target / ofFits) / std::log(ofLarge / ofFits);
    limit = ofLarge == 0 ? fits * std::clamp(ofFits / target, kLargestStep, kAimedAt)
                         : fits * std::pow(large / fits, std::clamp(part, kLeastPart, 1 - kLeastPart));
  }
  return best;
}

}  // namespace arete
