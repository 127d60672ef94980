#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <pharos/core/rgb.h>
#include <pharos/core/vec.h>
#include <pharos/scene/events.h>

namespace pharos {

inline constexpr std::uint32_t kNoVertex = ~std::uint32_t{0};

/// One vertex of a recorded path: how it was reached and how the path went on from it. Where a path
/// branches, the vertex is recorded once for each step taken from it, all with the same parent.
struct RecordedVertex {
  Point3 position;  ///< for the environment a stand-in outside the scene, along the ray
  Vec3 normal;      ///< geometric; zero in media and for the environment
  Vec3 shading_normal;
  VertexKind kind = VertexKind::surface;
  Event event = Event::none;  ///< what the path did here; none where it ended
  float roughness = 1;
  float eta = 1;                     ///< relative index of refraction of the surface
  std::uint32_t parent = kNoVertex;  ///< index of the previous vertex within the path

  Rgb throughput;    ///< f/p of everything before this vertex, sensor weight included
  Rgb local_weight;  ///< f/p of the step from here; black when the step was a zero sample

  Vec3 direction;  ///< unit, of the step from here; zero when none was taken
  Measure measure = Measure::solid_angle;  ///< of the densities of the step
  float unguided_pdf = 0;                  ///< of the BSDF or phase function (with the medium)
  float guided_pdf = 0;                    ///< of the guide
  float unguided_fraction = 1;             ///< in force at this vertex
  Rgb transmittance{1};      ///< of the medium along the step [1]; part of local_weight
  float medium_density = 1;  ///< the medium's factor in both densities: of stopping there [1/m], or
                             ///< the probability of getting there [1]
  std::uint32_t region = 0;  ///< of the guiding distribution, where there was one
  bool guidable = false;     ///< a guide was or could have been asked here
  float reverse_pdf = 0;     ///< of the step back to `parent`, on request

  Rgb emission;        ///< radiance leaving here towards `parent`, times its MIS weight
  Rgb full_emission;   ///< the same without MIS weight
  Rgb joint_emission;  ///< the same times its MIS weight among paths from both ends

  /// The density that the step was drawn with.
  float pdf() const {
    return unguided_fraction * unguided_pdf + (1 - unguided_fraction) * guided_pdf;
  }
};

/// Light found from a vertex by next event estimation. Of paths from lights: the lens found from a
/// vertex.
struct RecordedLightSample {
  std::uint32_t vertex = 0;   ///< index within the path of the vertex it was found from
  RecordedVertex light;       ///< the light's end as a full vertex; parent = `vertex`
  Vec3 direction;             ///< unit, from the vertex
  Rgb contribution;           ///< f/p of the connection times its MIS weight, without throughput
  Rgb joint_contribution;     ///< the same, times that among paths from both ends
  float mis_weight = 1;       ///< among paths from the same end
  float light_pdf = 0;        ///< of the light sample [1/sr]; the choice of light included
  float scattering_pdf = 0;   ///< of reaching it by scattering, guide included [1/sr]
  Event event = Event::none;  ///< what the connection is at the vertex
  bool discrete = false;      ///< no step can meet the light: it has no extent
};

/// One recorded path. Spans are valid as long as the log. What a path stands for is its part of the
/// mean over all pixels, whichever end it begins at: throughputs begin with 1 at the lens, and with
/// power at a light.
struct PathView {
  std::span<const RecordedVertex> vertices;  ///< [0] lies on the lens (or on the light)
  std::span<const RecordedLightSample> light_samples;
  Vec2 film;  ///< film position [pixels]; not told of paths from lights
  Transport transport = Transport::radiance;
};

/// What learners need integrators to record beyond the basics.
struct RecordNeeds {
  bool light_samples = false;  ///< next event estimates
  bool reverse_pdfs = false;
  bool light_paths = false;  ///< paths begun at lights
};

/// The recorded paths of one work unit, in order of their keys; paths of value zero included.
/// Written by one task; holds its memory when cleared.
class PathLog {
 public:
  std::size_t size() const { return paths_.size(); }
  PathView operator[](std::size_t i) const;

  void begin_path(Vec2 film, Transport transport);
  /// Adds a vertex to the path begun last; returns its index within the path.
  std::uint32_t add(const RecordedVertex& vertex);
  void add(const RecordedLightSample& sample) { light_samples_.push_back(sample); }
  /// Makes the path begun last one of value zero: its light was NaN or infinite.
  void blacken_last_path();
  /// Where the path begun last lies on the film [pixels], once that is known.
  void set_film(Vec2 film) { paths_.back().film = film; }
  /// A vertex of the path begun last, to complete it.
  RecordedVertex& vertex(std::uint32_t index) {
    return vertices_[paths_.back().first_vertex + index];
  }
  void clear();

 private:
  struct Head {
    std::size_t first_vertex, first_light_sample;
    Vec2 film;
    Transport transport;
  };
  std::vector<Head> paths_;
  std::vector<RecordedVertex> vertices_;
  std::vector<RecordedLightSample> light_samples_;
};

/// What MIS weights add up to one over.
enum class WeightedAmong {
  own_end,   ///< the ways of paths from the same end
  both_ends  ///< the ways of all paths, from the sensor and from lights
};

/// For each vertex i of a path an estimate of the radiance that arrives there along the step the
/// path took: the emission met (MIS-weighted), next event estimates at later vertices, and all
/// that follows. Next event estimates at i itself are not part of it. Black where no step was
/// taken. The full-path contribution through the step is throughput * local_weight * this. Of paths
/// from lights it is importance in place of radiance.
void estimate_incident_radiance(const PathView& path, std::vector<Rgb>& out,
                                WeightedAmong among = WeightedAmong::own_end);

}  // namespace pharos
