#include <cmath>

#include <pharos/guiding/toolkit/image_distance.h>

namespace pharos {
namespace {

/// Returns the factor with which the distance behind `vertex` adds to the image distance that is
/// seen from `from`. It is 0 for rough surfaces.
float share_behind(const RecordedVertex& vertex, const RecordedVertex& from, float glossy) {
  const bool shows = vertex.kind == VertexKind::surface && vertex.event != Event::none &&
                     (is_discrete(vertex.event) || vertex.roughness < glossy);
  if (!shows) return 0;
  const bool refracts =
      vertex.event == Event::smooth_transmit || vertex.event == Event::discrete_transmit;
  if (!refracts) return 1;
  // The ratio of angles behind the surface to angles in front of it.
  const float in = std::abs(dot(from.direction, vertex.normal));
  const float out = std::abs(dot(vertex.direction, vertex.normal));
  const float scale = out / (in * vertex.eta);
  return std::isfinite(scale) ? scale : 0;
}

}  // namespace

void image_distances(const PathView& path, float glossy, std::vector<float>& distances) {
  distances.assign(path.vertices.size(), 0);
  for (std::size_t i = path.vertices.size(); i-- > 1;) {
    const RecordedVertex& vertex = path.vertices[i];
    if (vertex.parent == kNoVertex) continue;
    const RecordedVertex& from = path.vertices[vertex.parent];
    const bool escapes = vertex.kind == VertexKind::environment;
    const float share = share_behind(vertex, from, glossy);
    distances[vertex.parent] =
        escapes ? kInfinity
                : length(vertex.position - from.position) + (share > 0 ? share * distances[i] : 0);
  }
}

}  // namespace pharos
