// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pages of nodes are tested first, then the blocks of the pages that may have members, then the nodes of
// those blocks, as the CPU does (engine/cut/saturated_cut.cpp). Members are bits. How many triangles the
// front has is known from the members alone, each adds two, or one on a border; so before anything is written
// it is known whether it fits. Then the root's triangles and the members' stars are written, those that no
// member removes, into the half of the index buffer that is not drawn, and the draw command is set to it.
//
//   begin -> pages -> nodes -> plan -> roots, stars -> publish -> [list -> step x n] -> draw
#include "viewer/gl/compute_front.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

#include "viewer/gl/gl_program.h"

namespace arete {
namespace {

/// shaders/front_state.glsl.
struct State {
  std::array<std::uint32_t, 5> draw{};
  std::array<std::uint32_t, 3> pages{16, 0, 1}, blocks{}, roots{}, moving{};
  std::uint32_t blockCount = 0, triangles = 0, emitted = 0, movingCount = 0, half = 0, isComplete = 1,
                capacity = 0;
  std::uint32_t rootTriangles = 0, rootVertices = 0, nodes = 0, movingCapacity = 0;
};
constexpr GLuint kStateBinding = 7;

template <std::size_t N>
void bind(const std::array<GLuint, N>& buffers) {
  for (std::size_t i = 0; i < N; ++i)
    if (buffers[i] != 0) glBindBufferBase(GL_SHADER_STORAGE_BUFFER, GLuint(i), buffers[i]);
}

void dispatch(GLuint program, GLuint x) {
  glUseProgram(program);
  glDispatchCompute(x, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void dispatchBy(GLuint program, std::size_t offset) {
  glUseProgram(program);
  glDispatchComputeIndirect(GLintptr(offset));
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

}  // namespace

Result<ComputeFront> ComputeFront::create(const TerrainOnGpu& t, std::uint32_t mostTriangles) {
  if (!t.refusal.empty()) return failure(ErrorCode::unsupported, t.refusal, "compute shaders");
  ComputeFront f;
  const auto program = [](GlProgram& into, std::initializer_list<std::string_view> files) -> Status {
    ARETE_TRY(GlProgram made, makeProgram({{GL_COMPUTE_SHADER, files}}));
    into = std::move(made);
    return {};
  };
  for (const Status& ok :
       {program(f.begin_, {"front_state.glsl", "front_begin.comp.glsl"}),
        program(f.pages_, {"frame.glsl", "ball_test.glsl", "front_state.glsl", "front_pages.comp.glsl"}),
        program(f.nodes_, {"frame.glsl", "ball_test.glsl", "front_state.glsl", "front_nodes.comp.glsl"}),
        program(f.plan_, {"front_state.glsl", "front_plan.comp.glsl"}),
        program(f.roots_, {"front_state.glsl", "front_write.glsl", "front_roots.comp.glsl"}),
        program(f.stars_,
                {"front_state.glsl", "listed_node.glsl", "front_write.glsl", "front_stars.comp.glsl"}),
        program(f.publish_, {"front_state.glsl", "front_publish.comp.glsl"}),
        program(f.list_, {"frame.glsl", "ball_test.glsl", "front_state.glsl", "listed_node.glsl",
                          "morph_list.comp.glsl"}),
        program(f.step_, {"front_state.glsl", "morph_step.comp.glsl"})})
    if (!ok) return tl::unexpected(ok.error());

  f.fit(t, mostTriangles);
  return f;
}

void ComputeFront::fit(const TerrainOnGpu& t, std::uint32_t mostTriangles) {
  // Two halves of the index buffer are kept, one drawn while the other is written: 12 bytes of corners and 4
  // bytes of id for each triangle, twice.
  const std::uint32_t before = capacity_;
  capacity_ = std::max(mostTriangles, t.rootTriangles);
  memberWords_ = std::max(1u, 2 * t.blocks);
  State state;
  state.capacity = capacity_;
  state.rootTriangles = t.rootTriangles;
  state.rootVertices = t.rootVertices;
  state.nodes = t.nodeCount;
  state.draw = {3 * t.rootTriangles, 1, 0, 0, 0};
  state.movingCapacity = std::min(capacity_, t.nodeCount);
  state_ = makeBuffer(sizeof state, &state);
  pageList_ = makeBuffer(std::size_t(4) * t.pages);
  blockList_ = makeBuffer(std::size_t(4) * t.blocks);
  members_ = makeBuffer(std::size_t(4) * memberWords_);
  if (before != capacity_) {
    indices_ = makeBuffer(std::size_t(24) * capacity_);
    ids_ = makeBuffer(std::size_t(8) * capacity_);
  }
  moving_ = makeBuffer(std::size_t(16) * state.movingCapacity);
  // A cut that has no room leaves the front before it, which is never empty: the root's triangles are written
  // into the half that is drawn first, and their ids are 0, 1, 2 ...
  if (t.rootTriangles > 0) {
    std::vector<std::uint32_t> ids(t.rootTriangles);
    std::iota(ids.begin(), ids.end(), 0u);
    glCopyNamedBufferSubData(t.roots, indices_, 0, 0, GLsizeiptr(12) * t.rootTriangles);
    glNamedBufferSubData(ids_, 0, GLsizeiptr(4) * t.rootTriangles, ids.data());
  }
  for (Copy& copy : copies_) {
    if (copy.fence) glDeleteSync(copy.fence);
    copy = {makeBuffer(sizeof state), nullptr};
  }
  late_ = {};
}

// Each stage reads what the one before has written, so every dispatch ends with a barrier. Later stages take
// their size from the state, which the CPU never reads in between.
void ComputeFront::cut(const TerrainOnGpu& t, bool isMorphing, int morphSteps) {
  glClearNamedBufferData(members_, GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kStateBinding, state_);
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, state_);
  dispatch(begin_, 1);

  bind<7>({t.blockBalls, t.blockErrors, pageList_, t.nodeBalls, t.nodes, members_, blockList_});
  glProgramUniform1ui(pages_, 0, t.blocks);
  glProgramUniform1ui(pages_, 1, t.pages);
  glProgramUniform1ui(nodes_, 0, t.blocks);
  if (t.pages > 0) {
    dispatch(pages_, (t.pages + 63) / 64);
    dispatchBy(nodes_, offsetof(State, pages));
  }
  dispatch(plan_, 1);
  bind<7>({t.roots, t.removers, members_, indices_, ids_, t.nodes, blockList_});
  dispatchBy(roots_, offsetof(State, roots));
  bind<1>({t.links});
  dispatchBy(stars_, offsetof(State, blocks));
  // Without geomorphing the two steps for moving vertices, before and after the publication, are left out.
  if (isMorphing && t.nodeCount > 0) {
    bind<7>({t.nodeBalls, t.nodes, members_, t.morphs, t.rises, moving_, blockList_});
    dispatchBy(list_, offsetof(State, blocks));
  }
  dispatch(publish_, 1);
  if (isMorphing && t.nodeCount > 0)
    for (int i = 0; i < morphSteps; ++i) dispatchBy(step_, offsetof(State, moving));
  glMemoryBarrier(GL_ELEMENT_ARRAY_BARRIER_BIT | GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_COMMAND_BARRIER_BIT |
                  GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);

  // The state is copied with a fence, a few frames behind: the CPU reads counts without waiting for the
  // device.
  Copy& copy = copies_[std::size_t(nextCopy_)];
  nextCopy_ = (nextCopy_ + 1) % kLate;
  if (copy.fence) glDeleteSync(copy.fence);
  glCopyNamedBufferSubData(state_, copy.buffer, 0, 0, sizeof(State));
  copy.fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

namespace {

ComputeFront::Counts countsIn(GLuint buffer) {
  State state;
  glGetNamedBufferSubData(buffer, 0, sizeof state, &state);
  return {state.triangles, state.draw[0] / 3, std::min(state.movingCount, state.movingCapacity),
          state.isComplete == 1};
}

}  // namespace

ComputeFront::Counts ComputeFront::counts() const {
  return countsIn(state_);
}

ComputeFront::Counts ComputeFront::lateCounts() {
  // The oldest copy first; newer ones take its place as far as they are there.
  for (int i = 0; i < kLate; ++i) {
    Copy& copy = copies_[std::size_t((nextCopy_ + i) % kLate)];
    if (!copy.fence || glClientWaitSync(copy.fence, 0, 0) == GL_TIMEOUT_EXPIRED) continue;
    glDeleteSync(copy.fence);
    copy.fence = nullptr;
    late_ = countsIn(copy.buffer);
  }
  return late_;
}

DrawnFront ComputeFront::front() const {
  return {indices_, ids_, state_, 0, late_.drawn};
}

std::vector<std::uint32_t> ComputeFront::members() const {
  std::vector<std::uint32_t> words(memberWords_);
  glGetNamedBufferSubData(members_, 0, GLsizeiptr(4 * words.size()), words.data());
  return words;
}

}  // namespace arete
