#include <pharos/guiding/record/path_record.h>

namespace pharos {

PathView PathLog::operator[](std::size_t i) const {
  const Head& head = paths_[i];
  const bool is_last = i + 1 == paths_.size();
  const std::size_t vertex_end = is_last ? vertices_.size() : paths_[i + 1].first_vertex;
  const std::size_t light_end = is_last ? light_samples_.size() : paths_[i + 1].first_light_sample;
  return {.vertices = {vertices_.data() + head.first_vertex, vertex_end - head.first_vertex},
          .light_samples = {light_samples_.data() + head.first_light_sample,
                            light_end - head.first_light_sample},
          .film = head.film,
          .transport = head.transport};
}

void PathLog::begin_path(Vec2 film, Transport transport) {
  paths_.push_back({vertices_.size(), light_samples_.size(), film, transport});
}

std::uint32_t PathLog::add(const RecordedVertex& vertex) {
  vertices_.push_back(vertex);
  return static_cast<std::uint32_t>(vertices_.size() - 1 - paths_.back().first_vertex);
}

void PathLog::blacken_last_path() {
  for (std::size_t i = paths_.back().first_vertex; i < vertices_.size(); ++i) {
    vertices_[i].throughput = vertices_[i].local_weight = Rgb();
    vertices_[i].emission = vertices_[i].full_emission = vertices_[i].joint_emission = Rgb();
  }
  light_samples_.resize(paths_.back().first_light_sample);
}

void PathLog::clear() {
  paths_.clear();
  vertices_.clear();
  light_samples_.clear();
}

void estimate_incident_radiance(const PathView& path, std::vector<Rgb>& out, WeightedAmong among) {
  const bool jointly = among == WeightedAmong::both_ends;
  const std::size_t count = path.vertices.size();
  out.assign(count, Rgb());
  // Children stand after their parents, and light samples in order of their vertices: one
  // backward pass sees every vertex complete.
  std::size_t light = path.light_samples.size();
  for (std::size_t i = count; i-- > 0;) {
    const RecordedVertex& vertex = path.vertices[i];
    Rgb leaving = jointly ? vertex.joint_emission : vertex.emission;
    leaving += vertex.local_weight * out[i];
    for (; light > 0 && path.light_samples[light - 1].vertex == i; --light) {
      const RecordedLightSample& sample = path.light_samples[light - 1];
      leaving += jointly ? sample.joint_contribution : sample.contribution;
    }
    if (vertex.parent != kNoVertex) out[vertex.parent] += leaving;
  }
}

}  // namespace pharos
