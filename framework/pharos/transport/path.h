#pragma once

#include <array>
#include <cstdint>

#include <pharos/guiding/pipeline/guiding_frame.h>
#include <pharos/sampling/sampler.h>
#include <pharos/transport/path_vertex.h>
#include <pharos/transport/scatter_step.h>

namespace pharos {

/// A path in flight, at a vertex that it has reached. It holds everything on which the rest of the
/// path depends. It is a value: a copy continues with bit-identical results, at any time and among
/// any other paths. Many paths can therefore be advanced in batches, and a path is split by copying
/// it.
struct Path {
  explicit Path(const SampleStream& numbers) : stream(numbers) {}

  SampleStream stream;  ///< random numbers of the whole path
  Transport transport = Transport::radiance;
  /// Whether MIS weights compare this path with paths from the other end. Guides are then asked
  /// without information that depends on the end: the number of the vertex, the previous event, and
  /// their memory.
  bool from_both_ends = false;
  std::uint16_t first_bounce = 0;  ///< number of the first vertex in the dimensions of `stream`
  std::uint16_t bounce = 0;        ///< number of the current vertex; 0 on the lens or on the light
  std::uint32_t branch = 0;        ///< key of the branch, for records
  std::uint32_t record = kNoVertex;  ///< index of the current vertex in the record of the path

  Rgb throughput{1};         ///< f/p of the path up to the current vertex
  Vec3 towards_previous;     ///< unit; the normal on the lens; not set on a light
  StepDensity arrival;       ///< densities of the step that led here
  float medium_density = 1;  ///< the medium's factor in `arrival`; see ResolvedVertex
  float segment_length = 0;  ///< length of the step that led here [scene units]
  bool arrived_discretely = true;

  float first_throughput = 1;   ///< largest component after the first step, for Russian roulette
  float film_weight = 1;        ///< part of the throughput; see TerminationQuery
  float solid_angle_scale = 1;  ///< undoes the compression of radiance by refraction so far
  float branches = 1;           ///< as TerminationQuery::branches

  PathMemories memories{};  ///< what guides remember along the path
  /// The previous and the current vertex as guides see them. Not maintained if there is neither a
  /// guide nor a recorder.
  GuidingVertex previous, current;

  /// The current and the previous vertex. They alternate, so that a step copies no vertices.
  std::array<PathVertex, 2> vertices;
  int at = 0;

  const PathVertex& here() const { return vertices[at]; }
  const PathVertex& before() const { return vertices[1 - at]; }
  /// Returns the random numbers of the current vertex.
  VertexStream numbers() const {
    return {stream, static_cast<std::uint16_t>(first_bounce + bounce)};
  }
};

}  // namespace pharos
