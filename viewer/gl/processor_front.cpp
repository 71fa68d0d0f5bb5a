// SPDX-License-Identifier: GPL-3.0-or-later
//
// The thread owns the ViewMesh. After each update it copies what changed behind a lock: the ranges of the
// index buffer, and the heights, of which the newest of each vertex counts. The drawing thread takes all of
// it at once, so that it always draws a whole front with the heights that belong to it.
#include "viewer/gl/processor_front.h"

#include <bit>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "engine/base/stopwatch.h"
#include "viewer/gl/gl_program.h"

namespace arete {
namespace {

using Corners = std::array<std::uint32_t, 3>;
using Rise = std::array<std::uint32_t, 2>;  // vertex, bits of the float

/// Changed places of the index buffer, one behind the other in `corners` and `ids`.
struct Changes {
  std::vector<ViewMesh::Places> places;
  std::vector<Corners> corners;
  std::vector<std::uint32_t> ids;
  std::vector<std::vector<Rise>> rises;  // of each update, in their order
  std::uint32_t triangles = 0;
};

}  // namespace

struct ProcessorFront::State {
  explicit State(ViewMesh viewMesh, MetricFrame rest) : mesh(std::move(viewMesh)), metric(rest) {
    pending.places = {{0, static_cast<std::uint32_t>(mesh.triangles().size())}};
    copyPlaces(pending, pending.places);
    pending.triangles = static_cast<std::uint32_t>(mesh.triangles().size());
    thread = std::thread([this] { run(); });
  }
  // The thread holds references to this state, so it ends before anything of it is destroyed.
  ~State() {
    {
      const std::lock_guard lock(mutex);
      ends = true;
    }
    wake.notify_all();
    thread.join();
  }

  void copyPlaces(Changes& into, std::span<const ViewMesh::Places> places) const {
    const auto triangles = mesh.triangles();
    const auto triangleIds = mesh.triangleIds();
    for (const ViewMesh::Places& p : places) {
      into.corners.insert(into.corners.end(), triangles.begin() + p.first,
                          triangles.begin() + p.first + p.count);
      into.ids.insert(into.ids.end(), triangleIds.begin() + p.first, triangleIds.begin() + p.first + p.count);
    }
  }

  // The mesh has exaggerated heights over its own origin; the drawn vertices keep the heights of the model,
  // and get differences to them in the model's unit.
  std::vector<Rise> risesOf(std::span<const ViewMesh::HeightChange> changes) const {
    std::vector<Rise> rises;
    rises.reserve(changes.size());
    const MetricFrame& exaggerated = mesh.mt().metric();
    for (const ViewMesh::HeightChange& c : changes) {
      const double height = (double(c.height) + mesh.origin().z) / exaggerated.scale.z + exaggerated.origin.z;
      const double rise = height - mesh.mt().vertices().height(VertexId(c.vertex));
      rises.push_back({c.vertex, std::bit_cast<std::uint32_t>(float(rise))});
    }
    return rises;
  }

  // The newest request counts: one that arrives while the mesh is updated replaces any before it. The update
  // itself runs without the lock, so that drawing never waits for it.
  void run() {
    for (;;) {
      Asked now;
      {
        std::unique_lock lock(mutex);
        wake.wait(lock, [&] { return ends || asked.has_value(); });
        if (ends) return;
        now = *std::exchange(asked, std::nullopt);
        isBusy = true;
      }
      ViewMesh::UpdateOptions options;
      options.pixels = now.pixels;
      options.geomorph = now.geomorph;
      if (now.maxTriangles > 0) options.maxTriangles = now.maxTriangles;
      using Milliseconds = std::chrono::duration<double, std::milli>;
      if (now.deadlineMilliseconds > 0)
        options.deadline = Deadline::in(Milliseconds(now.deadlineMilliseconds));
      const Stopwatch watch;
      Result<ViewMesh::Report> report = mesh.update(now.view, options);
      const double milliseconds = watch.milliseconds();

      const std::lock_guard lock(mutex);
      if (report) {
        const auto changed = mesh.changedPlaces();
        pending.places.insert(pending.places.end(), changed.begin(), changed.end());
        copyPlaces(pending, changed);
        pending.rises.push_back(risesOf(mesh.heightChanges()));
        pending.triangles = static_cast<std::uint32_t>(mesh.triangles().size());
        done = {*report, milliseconds, done.updates + 1};
        error.reset();
      } else {
        error = report.error();
      }
      isBusy = false;
      finished.notify_all();
    }
  }

  ViewMesh mesh;
  const MetricFrame metric;

  std::mutex mutex;
  std::condition_variable wake, finished;
  std::optional<Asked> asked;
  Changes pending;
  Done done;
  std::optional<Error> error;
  bool isBusy = false, ends = false;
  std::thread thread;

  GlProgram scatter;
  GlBuffer indices, ids;
  std::uint32_t room = 0, count = 0;
};

// The program is compiled on the drawing thread, since the other one has no context of OpenGL.
Result<ProcessorFront> ProcessorFront::create(const MultiTriangulation& mt, double stretch) {
  ARETE_TRY(ViewMesh mesh, ViewMesh::create(mt, {.heightScale = stretch}));
  ARETE_TRY(GlProgram scatter, makeProgram({{GL_COMPUTE_SHADER, {"scatter.comp.glsl"}}}));
  auto state = std::make_unique<State>(std::move(mesh), mt.metric());
  state->scatter = std::move(scatter);
  return ProcessorFront(std::move(state));
}

ProcessorFront::ProcessorFront(std::unique_ptr<State> state) : state_(std::move(state)) {}
ProcessorFront::ProcessorFront(ProcessorFront&&) noexcept = default;
ProcessorFront& ProcessorFront::operator=(ProcessorFront&&) noexcept = default;
ProcessorFront::~ProcessorFront() = default;

void ProcessorFront::ask(const Asked& asked) {
  {
    const std::lock_guard lock(state_->mutex);
    state_->asked = asked;
  }
  state_->wake.notify_all();
}

/// Takes the changes since the last call. Without any, the number of triangles stays as it was, so that the
/// new list of changes begins from the same front.
Result<ProcessorFront::Done> ProcessorFront::receive(TerrainOnGpu& terrain, bool waits) {
  State& s = *state_;
  Changes changes;
  Done done;
  {
    std::unique_lock lock(s.mutex);
    if (waits) s.finished.wait(lock, [&] { return !s.asked && !s.isBusy; });
    if (s.error) return tl::unexpected(*s.error);
    std::swap(changes, s.pending);
    changes.triangles = changes.places.empty() && changes.rises.empty() ? s.count : changes.triangles;
    s.pending.triangles = changes.triangles;
    done = s.done;
  }
  if (changes.triangles > s.room) {
    // Half as much again; what lies there goes along.
    const std::uint32_t room = changes.triangles + changes.triangles / 2;
    GlBuffer indices = makeBuffer(std::size_t(12) * room), ids = makeBuffer(std::size_t(4) * room);
    if (s.count > 0) {
      glCopyNamedBufferSubData(s.indices, indices, 0, 0, GLsizeiptr(12) * s.count);
      glCopyNamedBufferSubData(s.ids, ids, 0, 0, GLsizeiptr(4) * s.count);
    }
    s.indices = std::move(indices);
    s.ids = std::move(ids);
    s.room = room;
  }
  std::size_t at = 0;
  for (const ViewMesh::Places& p : changes.places) {
    // Places beyond the room were let go by a later update.
    const std::uint32_t end = std::min(p.first + p.count, s.room), count = end > p.first ? end - p.first : 0;
    if (count > 0) {
      glNamedBufferSubData(s.indices, GLintptr(12) * p.first, GLsizeiptr(12) * count, &changes.corners[at]);
      glNamedBufferSubData(s.ids, GLintptr(4) * p.first, GLsizeiptr(4) * count, &changes.ids[at]);
    }
    at += p.count;
  }
  for (const std::vector<Rise>& rises : changes.rises) {
    if (rises.empty()) continue;
    const GlBuffer list = makeBuffer(std::span<const Rise>(rises));
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, list);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, terrain.rises);
    glProgramUniform1ui(s.scatter, 0, GLuint(rises.size()));
    glUseProgram(s.scatter);
    const auto groups = GLuint((rises.size() + 63) / 64);
    glDispatchCompute(std::min(groups, 1024u), (groups + 1023) / 1024, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT);
  }
  s.count = changes.triangles;
  return done;
}

DrawnFront ProcessorFront::front() const {
  return {state_->indices, state_->ids, 0, 0, state_->count};
}

}  // namespace arete
