// SPDX-License-Identifier: GPL-3.0-or-later
//
// The least set is unique, so the order of the walk does not matter for what it finds, only for how long it
// takes.
//
// A walk from the root, a stack of nodes to include, goes wherever their triangles and parents lie: it waits
// for memory at each. So where the criterion has a bound the walk goes once through the saturated cut, which
// holds the least one but for a few per cent, in the order of the nodes, parents first. A node that is in by
// its turn has the removers of its failing triangles included, whose turn comes. One that is not yet in by
// its turn has to be in when a child is; else its children are told that a parent is missing, and ask for it
// by their turn if they are in then. Whoever is included after its turn waits on a stack for an extra one.
// Should a node have to be in that the saturated cut does not hold, the walk has the last word.
#include "engine/least_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/front.h"
#include "engine/refine.h"
#include "engine/saturated_cut.h"
#include "engine/vector_clones.h"

namespace arete {
namespace {

constexpr std::uint32_t kNone = MultiTriangulation::kNone;
constexpr std::size_t kCheckEvery = 1 << 12;

/// Whether a triangle satisfies the criterion; a uniform error is compared as a code, without the virtual
/// call.
class Test {
 public:
  Test(const MultiTriangulation& mt, const Criterion& criterion)
      : mt_(mt),
        criterion_(criterion),
        isUniform_(!std::isnan(criterion.uniformError())),
        code_(isUniform_ ? mt.arrays().scale.floorCode(criterion.uniformError()) : OutwardScale::Code(0)) {}

  bool isUniform() const { return isUniform_; }
  OutwardScale::Code code() const { return code_; }

  bool passes(std::uint32_t id, NodeId creator) const {
    if (isUniform_) return mt_.arrays().error[id] <= code_;
    return isSatisfied(mt_, criterion_, TriangleId(id), mt_.corners(TriangleId(id), creator));
  }

 private:
  const MultiTriangulation& mt_;
  const Criterion& criterion_;
  bool isUniform_;
  OutwardScale::Code code_;
};

/// Through the saturated cut, in its order.
class Sweep {
 public:
  Sweep(const MultiTriangulation& mt, const Criterion& criterion, const MemberSet& candidates)
      : mt_(mt),
        a_(mt.arrays()),
        test_(mt, criterion),
        candidates_(candidates),
        lookup_(candidates.lookup()),
        in_(std::size_t{candidates.size()} + 1, 0),
        lacksParent_(candidates.size(), 0) {}

  /// Whether a node had to be in that is no candidate: rounding, or a file whose errors break the laws.
  bool isBeyond() const { return isBeyond_; }

  /// False when it was stopped.
  bool run(const std::function<bool()>& stop) {
    for (std::uint32_t t = 0; t < mt_.rootTriangleCount(); ++t)
      if (a_.remover[t] != kNone && !test_.passes(t, {})) include(a_.remover[t]);
    std::array<std::uint32_t, MemberSet::kMostInPiece> members;
    for (std::uint32_t piece = 0; piece < candidates_.pieces(); ++piece) {
      if (stop()) return false;
      const std::uint32_t count = candidates_.list(piece, members.data());
      const std::uint32_t before = candidates_.before(piece);
      for (std::uint32_t i = 0; i < count; ++i) {
        if (test_.isUniform()) i += takeOrdinary(members.data() + i, count - i, before + i);
        if (i == count) break;
        turn_ = before + i;
        take(members[i]);
        if (!late_.empty() && !takeLate(stop)) return false;
      }
    }
    return true;
  }

  MemberSet members(std::uint32_t nodes) const {
    std::vector<std::uint32_t> in;
    std::uint32_t rank = 0;
    candidates_.visit([&](std::uint32_t n) {
      if (in_[rank++] != 0) in.push_back(n);
    });
    return {in, nodes};
  }

 private:
  static constexpr std::uint32_t kFew = 6;

  /// The turns of some members, up to the first that is not in or lacks a parent; returns how many these are.
  /// Few slots of a node more or less pass, and how many there are cannot be foreseen: all are looked at in
  /// one way, the first six there or not, and those that pass include one who is nobody.
  ARETE_VECTOR_CLONES
  std::uint32_t takeOrdinary(const std::uint32_t* members, std::uint32_t count, std::uint32_t turn) {
    const MemberSet::Lookup lookup = lookup_;
    const std::uint32_t* const slotBegin = a_.slotBegin.data();
    const std::uint32_t* const removers = a_.remover.data() + mt_.rootTriangleCount();
    const OutwardScale::Code* const errors = a_.error.data() + mt_.rootTriangleCount();
    std::uint8_t* const in = in_.data();
    const std::uint8_t* const lacksParent = lacksParent_.data();
    const std::uint32_t nobody = candidates_.size(), code = test_.code();
    const auto slots = static_cast<std::uint32_t>(a_.link.size());
    std::uint32_t beyond = 0, i = 0;
    for (; i < count && in[turn + i] > lacksParent[turn + i]; ++i) {
      const std::uint32_t begin = slotBegin[members[i]], end = slotBegin[members[i] + 1];
      if (slots - begin < kFew) [[unlikely]]
        break;
      const auto look = [&](std::uint32_t s) __attribute__((always_inline)) {
        const std::uint32_t r = removers[s];
        const std::uint32_t fails = static_cast<std::uint32_t>(errors[s] > code) &
                                    static_cast<std::uint32_t>(s < end) &
                                    static_cast<std::uint32_t>(r != kNone);
        const std::uint32_t rank = lookup.rankOr(r, nobody);
        beyond |= fails & static_cast<std::uint32_t>(rank == nobody);
        in[fails != 0 ? rank : nobody] = 1;
      };
      for (std::uint32_t k = 0; k < kFew; ++k) look(begin + k);
      for (std::uint32_t s = begin + kFew; s < end; ++s) look(s);
    }
    isBeyond_ = isBeyond_ || beyond != 0;
    return i;
  }

  void take(std::uint32_t n) {
    if (in_[turn_] == 0) {
      if (!hasChildIn(n)) return;
      in_[turn_] = 1;
    }
    expand(n, turn_);
  }

  /// Whether a child is in; where none is, all of them are told that this parent is not.
  bool hasChildIn(std::uint32_t n) {
    const std::uint32_t roots = mt_.rootTriangleCount(), begin = a_.slotBegin[n], end = a_.slotBegin[n + 1];
    for (std::uint32_t s = begin; s < end; ++s) {
      const std::uint32_t r = a_.remover[roots + s];
      if (r != n && isIn(r)) return true;
    }
    for (std::uint32_t s = begin; s < end; ++s) {
      const std::uint32_t r = a_.remover[roots + s];
      if (r != n && lookup_.contains(r)) lacksParent_[lookup_.rank(r)] = 1;
    }
    return false;
  }

  void expand(std::uint32_t n, std::uint32_t rank) {
    if (lacksParent_[rank] != 0)
      for (const std::uint32_t t : mt_.floor(NodeId(n)))
        if (const NodeId parent = mt_.creator(TriangleId(t)); parent.isValid()) include(parent.index());
    const std::uint32_t roots = mt_.rootTriangleCount(), end = a_.slotBegin[n + 1];
    for (std::uint32_t s = a_.slotBegin[n]; s < end; ++s) {
      const std::uint32_t r = a_.remover[roots + s];
      if (r == kNone || isIn(r)) continue;
      // Who is no candidate is allowed its saturated error, and with it every triangle that it removes.
      if (!lookup_.contains(r) && a_.error[roots + s] <= a_.saturatedError[r]) continue;
      if (!test_.passes(roots + s, NodeId(n))) include(r);
    }
  }

  bool isIn(std::uint32_t n) const { return lookup_.contains(n) && in_[lookup_.rank(n)] != 0; }

  /// A remover of what fails, or a parent of one that is in.
  void include(std::uint32_t n) {
    if (!lookup_.contains(n)) {
      isBeyond_ = true;
      return;
    }
    const std::uint32_t rank = lookup_.rank(n);
    if (in_[rank] != 0) return;
    in_[rank] = 1;
    if (rank < turn_) late_.push_back(n);
  }

  bool takeLate(const std::function<bool()>& stop) {
    for (std::size_t steps = 1; !late_.empty(); ++steps) {
      if (steps % kCheckEvery == 0 && stop()) return false;
      const std::uint32_t n = late_.back();
      late_.pop_back();
      expand(n, lookup_.rank(n));
    }
    return true;
  }

  const MultiTriangulation& mt_;
  const MtArrays& a_;
  const Test test_;
  const MemberSet& candidates_;
  const MemberSet::Lookup lookup_;
  std::vector<std::uint8_t> in_;           // by rank, and of nobody
  std::vector<std::uint8_t> lacksParent_;  // by rank
  std::uint32_t turn_ = 0;                 // the rank of the one whose turn it is
  std::vector<std::uint32_t> late_;
  bool isBeyond_ = false;
};

}  // namespace

std::optional<MemberSet> leastMembers(const MultiTriangulation& mt, const Criterion& criterion,
                                      const std::function<bool()>& stop) {
  if (criterion.isMonotone()) {
    const SaturatedMembers saturated = saturatedMembers(mt, criterion, std::nullopt);
    Sweep sweep(mt, criterion, saturated.members);
    if (!sweep.run(stop)) return std::nullopt;
    if (!sweep.isBeyond()) return sweep.members(mt.nodeCount());
  }
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
    if (n == kNone || in[n]) return;
    in[n] = 1;
    stack.push_back(n);
  };
  for (std::uint32_t t = 0; t < roots; ++t)
    if (a.remover[t] != kNone && !test.passes(t, {})) include(a.remover[t]);
  for (std::size_t steps = 0; !stack.empty(); ++steps) {
    if (steps % kCheckEvery == 0 && stop()) return std::nullopt;
    const std::uint32_t n = stack.back();
    stack.pop_back();
    for (const std::uint32_t t : mt.floor(NodeId(n))) include(mt.creator(TriangleId(t)).index());
    for (std::uint32_t s = a.slotBegin[n]; s < a.slotBegin[n + 1]; ++s) {
      const std::uint32_t r = a.remover[roots + s];
      if (r != kNone && !in[r] && !test.passes(roots + s, NodeId(n))) include(r);
    }
  }
  return MemberSet(in);
}

std::optional<MemberSet> leastMembersWithin(const MultiTriangulation& mt, double least,
                                            std::uint32_t maxTriangles, const std::function<bool()>& stop) {
  const OutwardScale& scale = mt.arrays().scale;
  const std::uint32_t leastCode = scale.floorCode(least);
  // What is known: the set of code `fits` is small enough, that of any code below `large` is not. (A smaller
  // error has a larger set.) Both with their triangles.
  std::uint32_t fits = OutwardScale::kMaxCode, large = leastCode;
  double ofFits = mt.rootTriangleCount(), ofLarge = 0;
  std::optional<MemberSet> best = MemberSet::prefix(0);  // no error is beyond the scale
  const auto look = [&](std::uint32_t code) {
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

  // From the first band at whose end there are nodes for as many triangles, which is nearly always too much,
  // down to one where it is.
  std::uint32_t band = MultiTriangulation::kBands - 1;
  while (band > 0 && 2 * std::uint64_t{mt.bandEnd(band)} < maxTriangles) --band;
  for (std::uint32_t code = std::max(leastCode, band << MultiTriangulation::kBandShift);;) {
    if (!look(code)) return std::nullopt;
    if (fits != code || code == leastCode) break;
    code -= std::min(code - leastCode, 1u << MultiTriangulation::kBandShift);
  }
  // Triangles grow about as a power of the error, and codes are logarithms: between the two by a straight
  // line, in the middle where that did not halve what is left.
  for (bool isHalved = true; large < fits;) {
    const std::uint32_t left = fits - large;
    const double part = std::log(maxTriangles / ofFits) / std::log(ofLarge / ofFits);
    const std::uint32_t down =
        isHalved && part > 0 && part < 1 ? static_cast<std::uint32_t>(part * left) : left / 2;
    if (!look(fits - 1 - std::min(down, left - 1))) return std::nullopt;
    isHalved = 2 * (fits - large) <= left;
  }
  return best;
}

}  // namespace arete
