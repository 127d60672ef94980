#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <pharos/core/archive.h>
#include <pharos/core/rgb.h>
#include <pharos/core/vec.h>
#include <pharos/scene/events.h>

namespace pharos {

inline constexpr std::uint32_t kNoVertex = ~std::uint32_t{0};
/// RecordedVertex::mixing_key where no guide took part.
inline constexpr std::uint32_t kNoMixing = ~std::uint32_t{0};

/// One technique that could have drawn a step.
struct Technique {
  float share = 0;    ///< of the samples at the vertex [1]
  float density = 0;  ///< of the step, in the measure of its event and next vertex, medium included
  void archive(Archive& archive) { archive(share, density); }
};

/// A vertex of a recorded path, with the step that led on from it. If a path branches at a vertex,
/// the vertex is recorded once for each step from there, each time with the same parent.
struct RecordedVertex {
  Point3 position;  ///< for the environment a stand-in outside the scene, along the ray
  Vec3 normal;      ///< geometric; zero in media and for the environment
  VertexKind kind = VertexKind::surface;
  Event event = Event::none;  ///< of the step from here; none if the path ended
  bool guidable = false;      ///< a guide was or could have been asked here
  float roughness = 1;
  float eta = 1;                     ///< relative index of refraction of the surface
  std::uint32_t parent = kNoVertex;  ///< index of the previous vertex within the path
  /// Index of the vertex that the step led to; kNoVertex if it led to none. PathLog::add() sets it.
  std::uint32_t next = kNoVertex;
  /// Index of the next record of the same vertex, if the path branched. PathLog::add() sets it.
  std::uint32_t twin = kNoVertex;

  Rgb throughput;    ///< f/p of everything before this vertex, sensor weight included
  Rgb local_weight;  ///< f/p of the step, times `continuation`; black for a zero sample

  Vec3 direction;  ///< unit, of the step; zero if none was taken
  float pdf = 0;   ///< density that the step was drawn with, medium included
  /// Factor that makes up for Russian roulette (1 over the probability of survival) or splitting (1
  /// over the number of branches); it is no part of `pdf`.
  float continuation = 1;
  std::uint32_t branch = 0;  ///< key of the branch; branches draw different random numbers
  std::uint32_t mixing_key = kNoMixing;  ///< that MixingShares::at() returned here
  Rgb transmittance{1};                  ///< of the medium along the step [1]; part of local_weight
  float medium_density = 1;  ///< the medium's factor in all densities of the step: of stopping
                             ///< there [1/m], or the probability of getting there [1]

  Rgb emission;        ///< radiance leaving here towards `parent`, times its MIS weight
  Rgb joint_emission;  ///< the same with the MIS weight among paths from both ends

  /// Where the log keeps the techniques; see PathView::techniques(). PathLog sets it.
  std::uint32_t first_technique = 0, technique_count = 0;

  void archive(Archive& archive);
};

/// Light found from a vertex by next event estimation. In paths from lights: the lens, found from a
/// vertex.
struct RecordedLightSample {
  std::uint32_t vertex = 0;               ///< index within the path of the vertex it was found from
  Point3 position;                        ///< of the light's end; for the environment a stand-in
  VertexKind kind = VertexKind::surface;  ///< of the light's end
  Event event = Event::none;              ///< what the connection is at the vertex
  bool discrete = false;                  ///< the light has no extent: no step can hit it
  Vec3 direction;                         ///< unit, from the vertex
  Rgb contribution;        ///< f/p of the connection times its MIS weight, without throughput
  Rgb joint_contribution;  ///< the same with the MIS weight among paths from both ends
  float mis_weight = 1;    ///< among paths from the same end

  void archive(Archive& archive);
};

/// One recorded path. Spans are valid as long as the log. A path stands for its part of the mean
/// over all pixels, whichever end it begins at: throughputs begin with 1 at the lens, and with
/// power at a light.
struct PathView {
  std::span<const RecordedVertex> vertices;            ///< [0] lies on the lens (or on the light)
  std::span<const RecordedLightSample> light_samples;  ///< in the order of their vertices
  Vec2 film;  ///< film position [pixels]; unknown for paths from lights
  Transport transport = Transport::radiance;
  std::span<const Technique> log_techniques = {};  ///< of all paths of the log; see techniques()

  /// The techniques that could have drawn the vertex' step: [0] unguided sampling, [1 + i] method
  /// i. RecordedVertex::pdf is their sum of share times density. Methods that knew nothing have the
  /// share 0. Empty if no step was taken; unguided sampling alone if no guide took part.
  std::span<const Technique> techniques(const RecordedVertex& vertex) const {
    return log_techniques.subspan(vertex.first_technique, vertex.technique_count);
  }
};

/// What learners need integrators to record beyond the basics.
struct RecordNeeds {
  bool light_samples = false;  ///< next event estimates
  bool light_paths = false;    ///< paths begun at lights
};

/// The recorded paths of one work unit, in the order of their keys; paths of value zero included.
/// One task writes it. It keeps its memory when cleared.
class PathLog {
 public:
  std::size_t size() const { return paths_.size(); }
  PathView operator[](std::size_t i) const;

  void begin_path(Vec2 film, Transport transport);
  /// Adds a vertex to the path begun last, after its parent; returns its index within the path.
  std::uint32_t add(RecordedVertex vertex);
  void add(const RecordedLightSample& sample) { light_samples_.push_back(sample); }
  /// Records how a vertex' step could have been drawn, for PathView::techniques().
  void set_techniques(std::uint32_t vertex, std::span<const Technique> techniques);
  /// Makes the path begun last one of value zero: its light was NaN or infinite.
  void blacken_last_path();
  /// Where the path begun last lies on the film [pixels], once that is known.
  void set_film(Vec2 film) { paths_.back().film = film; }
  /// A vertex of the path begun last, to complete it.
  RecordedVertex& vertex(std::uint32_t index) {
    return vertices_[paths_.back().first_vertex + index];
  }
  void clear();
  /// Saves or loads the whole log.
  void archive(Archive& archive);

 private:
  struct Head {
    std::uint64_t first_vertex = 0, first_light_sample = 0;
    Vec2 film;
    Transport transport = Transport::radiance;
    void archive(Archive& archive) { archive(first_vertex, first_light_sample, film, transport); }
  };
  std::vector<Head> paths_;
  std::vector<RecordedVertex> vertices_;
  std::vector<RecordedLightSample> light_samples_;
  std::vector<Technique> techniques_;
};

/// The set of sampling techniques over which MIS weights sum to one.
enum class WeightedAmong {
  own_end,   ///< techniques of paths from the same end
  both_ends  ///< techniques of all paths, from the sensor and from lights
};

/// Estimates, for each vertex of a path, the radiance that arrives there along the step that the
/// path took: MIS-weighted emission, next event estimates at later vertices, and everything that
/// follows. Next event estimates at the vertex itself are not part of it. Black where no step was
/// taken. The contribution of the whole path through the step is throughput * local_weight * this.
/// For paths from lights it is importance in place of radiance.
void estimate_incident_radiance(const PathView& path, std::vector<Rgb>& out,
                                WeightedAmong among = WeightedAmong::own_end);

}  // namespace pharos
