#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <pharos/core/archive.h>
#include <pharos/core/rgb.h>
#include <pharos/core/vec.h>
#include <pharos/scene/events.h>

namespace pharos {

inline constexpr std::uint32_t kNoVertex = ~std::uint32_t{0};
/// The value of RecordedVertex::mixing_key if no guide took part.
inline constexpr std::uint32_t kNoMixing = ~std::uint32_t{0};

/// A sampling technique that could have drawn a step.
struct Technique {
  float share = 0;  ///< share of the samples at the vertex [1]
  /// Density of the step, in the measure of its event and next vertex, including the medium's
  /// factor.
  float density = 0;
};

/// Lights are sampled at most this often at a vertex, so that each copy has a number of 16 bits.
inline constexpr std::uint32_t kMostLightCopies = 0xffff;

/// A vertex of a recorded path, together with the step that leaves it. If a path branches at a
/// vertex, the vertex is recorded once for each step from there, each time with the same parent.
struct RecordedVertex {
  Point3 position;  ///< for the environment a stand-in outside the scene, along the ray
  Vec3 normal;      ///< geometric; zero in media and for the environment
  VertexKind kind = VertexKind::surface;
  Event event = Event::none;  ///< event of the step from here; none if the path ended
  bool guidable = false;      ///< a guide was or could have been asked here
  float roughness = 1;
  float eta = 1;                     ///< relative index of refraction of the surface
  std::uint32_t parent = kNoVertex;  ///< index of the previous vertex within the path
  /// Index of the vertex that the step led to; kNoVertex if it led to none. PathLog::add() sets it.
  std::uint32_t next = kNoVertex;
  /// Index of the next record of the same vertex, if the path branched. PathLog::add() sets it.
  std::uint32_t twin = kNoVertex;

  Rgb throughput;    ///< f/p of the path up to this vertex, including the sensor weight
  Rgb local_weight;  ///< f/p of the step, times `continuation`; black for a zero sample

  Vec3 direction;  ///< unit, of the step; zero if none was taken
  float pdf = 0;   ///< density with which the step was drawn, including the medium's factor
  /// The factor that compensates for Russian roulette (1 over the probability of survival) or
  /// splitting (1 over the expected number of branches). 0 if roulette has ended the path here. It
  /// is not part of `pdf`.
  float continuation = 1;
  std::uint32_t branch = 0;  ///< key of the branch; branches draw different random numbers
  /// Number of light samples that were taken here, those that found nothing included. 0 in later
  /// records of the same vertex.
  std::uint32_t light_samples = 0;
  /// How often lights were sampled here. Each time, there may be a light sample of every light. 0
  /// in later records of the same vertex.
  std::uint32_t light_copies = 0;
  std::uint32_t mixing_key = kNoMixing;  ///< the key that MixingShares::at() returned here
  Rgb transmittance{1};  ///< transmittance of the medium along the step [1]; part of local_weight
  /// The medium's factor in all densities of the step: the density [1/m] of stopping at the next
  /// vertex, or the probability [1] of reaching it.
  float medium_density = 1;

  Rgb emission;           ///< radiance leaving here towards `parent`, times its MIS weight
  Rgb joint_emission;     ///< the same with the MIS weight among paths from both ends
  Rgb unguided_emission;  ///< the same with the MIS weight that it would have without guides

  /// The range of the techniques in the log; see PathView::techniques(). PathLog sets it.
  std::uint32_t first_technique = 0, technique_count = 0;
};

/// A next event estimate: a connection from a vertex to a point on a light, or to the lens on paths
/// from lights.
struct RecordedLightSample {
  std::uint32_t vertex = 0;  ///< index within the path of the vertex where the connection starts
  Point3 position;           ///< of the point on the light or lens; for the environment a stand-in
  VertexKind kind = VertexKind::surface;  ///< of the point on the light or lens
  Event event = Event::none;              ///< event of the connection at the vertex
  bool discrete = false;                  ///< the light has no extent, so no step can hit it
  /// Number of the copy, below RecordedVertex::light_copies: lights may be sampled several times.
  std::uint16_t copy = 0;
  /// The factor that compensates for splitting and roulette of light samples: 1 over their expected
  /// number of copies. It is part of `contribution`.
  float continuation = 1;
  Vec3 direction;          ///< unit, from the vertex
  Rgb contribution;        ///< f/p of the connection times its MIS weight, without throughput
  Rgb joint_contribution;  ///< the same with the MIS weight among paths from both ends
  float mis_weight = 1;    ///< MIS weight among paths from the same end
  float unguided_mis_weight = 1;  ///< the same without guides
};

/// One recorded path. Its spans are valid as long as the log. The path estimates its part of the
/// mean over all pixels, at whichever end it begins. The throughput therefore begins with 1 at the
/// lens and with a power at a light.
struct PathView {
  std::span<const RecordedVertex> vertices;            ///< [0] lies on the lens (or on the light)
  std::span<const RecordedLightSample> light_samples;  ///< in the order of their vertices
  Vec2 film;  ///< film position [pixels]; unknown for paths from lights
  Transport transport = Transport::radiance;
  Rgb albedo;   ///< reflectance of the first surface that the sensor sees [1]; black: there is none
  Vec3 normal;  ///< shading normal there; zero: there is none
  std::span<const Technique> log_techniques = {};  ///< techniques of all paths of the log

  /// Returns the techniques that could have drawn the step from `vertex`: [0] is unguided sampling,
  /// [1 + i] is method i. RecordedVertex::pdf is the sum of their shares times densities. Methods
  /// that knew nothing have the share 0. The result is empty if no step was taken, and consists of
  /// unguided sampling alone if no guide took part.
  std::span<const Technique> techniques(const RecordedVertex& vertex) const {
    return log_techniques.subspan(vertex.first_technique, vertex.technique_count);
  }
};

/// The records beyond the basic ones that a learner needs or an integrator makes.
struct RecordNeeds {
  bool light_samples = false;  ///< next event estimates
  bool light_paths = false;    ///< paths that begin at lights
};

/// The recorded paths of one work unit, in the order of their keys, including paths of value zero.
/// A single task writes the log. The log keeps its memory when it is cleared.
class PathLog {
 public:
  std::size_t size() const { return paths_.size(); }
  PathView operator[](std::size_t i) const;

  /// Limits the memory of the log: once it has `most` vertices and light samples, no further path
  /// is recorded. The last recorded path may exceed the limit. clear() keeps the limit.
  void set_most_records(std::size_t most) { most_records_ = most; }
  /// Begins a path. Returns false if the log is full. The path is left out then, and nothing may be
  /// added before the next path begins. Whether a path is left out depends on the paths before it
  /// alone, so the mean over the paths of a pixel that are not left out is unbiased.
  bool begin_path(Vec2 film, Transport transport);
  /// Adds a vertex to the last path, after its parent. Returns the index of the vertex within the
  /// path.
  std::uint32_t add(const RecordedVertex& vertex);
  /// Adds a vertex after `parent` (kNoVertex: none), to be completed by vertex().
  std::uint32_t add_after(std::uint32_t parent);
  void add(const RecordedLightSample& sample) { light_samples_.push_back(sample); }
  /// Records the techniques that could have drawn the step from a vertex of the last path; see
  /// PathView::techniques().
  void set_techniques(std::uint32_t vertex, std::span<const Technique> techniques);
  /// Sets the value of the last path to zero, because it was NaN or infinite. Nothing happens if
  /// the path was left out.
  void blacken_last_path();
  /// Sets the film position [pixels] of the last path, once it is known.
  void set_film(Vec2 film) { paths_.back().film = film; }
  /// Sets the features of the last path at the first surface that the sensor sees; see PathView.
  void set_features(Rgb albedo, Vec3 normal) {
    paths_.back().albedo = albedo;
    paths_.back().normal = normal;
  }
  /// Returns a vertex of the last path, to be completed.
  RecordedVertex& vertex(std::uint32_t index) {
    return vertices_[paths_.back().first_vertex + index];
  }
  void clear();
  /// Saves or loads the whole log, in a form that only this build of the program can read.
  void archive(Archive& archive);

 private:
  struct Head {
    std::uint64_t first_vertex = 0, first_light_sample = 0;
    Vec2 film;
    Transport transport = Transport::radiance;
    Rgb albedo;
    Vec3 normal;
  };
  std::vector<Head> paths_;
  std::vector<RecordedVertex> vertices_;
  std::vector<RecordedLightSample> light_samples_;
  std::vector<Technique> techniques_;
  std::size_t most_records_ = std::numeric_limits<std::size_t>::max();
  bool has_last_path_ = false;  ///< the path that began last is not left out
};

/// The set of sampling techniques over which MIS weights sum to one.
enum class WeightedAmong {
  own_end,   ///< techniques of paths from the same end
  both_ends  ///< techniques of all paths, from the sensor and from lights
};

/// Estimates, for each vertex of a path, the radiance that arrives there along the step that the
/// path took. The estimate sums MIS-weighted emission and next event estimates of all later
/// vertices; next event estimates at the vertex itself are not part of it. It is black if no step
/// was taken. The contribution of the whole path through the step is throughput * local_weight *
/// this estimate. For paths from lights the estimate is importance instead of radiance.
void estimate_incident_radiance(const PathView& path, std::vector<Rgb>& out,
                                WeightedAmong among = WeightedAmong::own_end);

}  // namespace pharos
