#include <cstring>
#include <type_traits>

#include <pharos/guiding/record/path_record.h>

namespace pharos {

// Logs travel between processes while an image is rendered, so they are saved as they lie in
// memory.
static_assert(std::is_trivially_copyable_v<RecordedVertex> &&
              std::is_trivially_copyable_v<RecordedLightSample>);

namespace {

/// Whether the byte of a loaded flag is one that a bool may have.
bool is_sound(const bool& flag) {
  unsigned char byte = 0;
  std::memcpy(&byte, &flag, sizeof byte);
  return byte <= 1;
}

}  // namespace

PathView PathLog::operator[](std::size_t i) const {
  const Head& head = paths_[i];
  const bool is_last = i + 1 == paths_.size();
  const std::size_t vertex_end = is_last ? vertices_.size() : paths_[i + 1].first_vertex;
  const std::size_t light_end = is_last ? light_samples_.size() : paths_[i + 1].first_light_sample;
  return {.vertices = {vertices_.data() + head.first_vertex, vertex_end - head.first_vertex},
          .light_samples = {light_samples_.data() + head.first_light_sample,
                            light_end - head.first_light_sample},
          .film = head.film,
          .transport = head.transport,
          .albedo = head.albedo,
          .normal = head.normal,
          .log_techniques = techniques_};
}

bool PathLog::begin_path(Vec2 film, Transport transport) {
  has_last_path_ = vertices_.size() + light_samples_.size() < most_records_;
  if (has_last_path_) paths_.push_back({vertices_.size(), light_samples_.size(), film, transport});
  return has_last_path_;
}

std::uint32_t PathLog::add(const RecordedVertex& added) {
  const std::uint32_t index = add_after(added.parent);
  vertex(index) = added;
  return index;
}

std::uint32_t PathLog::add_after(std::uint32_t parent) {
  const auto index = static_cast<std::uint32_t>(vertices_.size() - paths_.back().first_vertex);
  if (parent != kNoVertex) {
    // Appends the record to the list of records of the same vertex. The list is short.
    std::uint32_t* link = &vertex(parent).next;
    while (*link != kNoVertex) link = &vertex(*link).twin;
    *link = index;
  }
  vertices_.emplace_back().parent = parent;
  return index;
}

void PathLog::set_techniques(std::uint32_t index, std::span<const Technique> techniques) {
  vertex(index).first_technique = static_cast<std::uint32_t>(techniques_.size());
  vertex(index).technique_count = static_cast<std::uint32_t>(techniques.size());
  techniques_.insert(techniques_.end(), techniques.begin(), techniques.end());
}

void PathLog::blacken_last_path() {
  if (!has_last_path_) return;
  for (std::size_t i = paths_.back().first_vertex; i < vertices_.size(); ++i) {
    vertices_[i].throughput = vertices_[i].local_weight = Rgb();
    vertices_[i].emission = vertices_[i].joint_emission = vertices_[i].unguided_emission = Rgb();
  }
  light_samples_.resize(paths_.back().first_light_sample);
}

void PathLog::clear() {
  paths_.clear();
  vertices_.clear();
  light_samples_.clear();
  techniques_.clear();
  has_last_path_ = false;
}

void PathLog::archive(Archive& archive) {
  archive.heading("path_log", 5);
  archive.block(paths_);
  archive.block(vertices_);
  archive.block(light_samples_);
  archive.block(techniques_);
  if (archive.loads()) has_last_path_ = !paths_.empty();
  // Refuses a damaged log whose indices lead outside it.
  const auto expect = [&](bool holds) { archive.expect(holds, "the path log"); };
  for (std::size_t i = 0; archive.loads() && i < paths_.size(); ++i) {
    const Head& head = paths_[i];
    const bool is_last = i + 1 == paths_.size();
    const std::uint64_t vertex_end = is_last ? vertices_.size() : paths_[i + 1].first_vertex;
    const std::uint64_t light_end =
        is_last ? light_samples_.size() : paths_[i + 1].first_light_sample;
    expect(head.first_vertex <= vertex_end && vertex_end <= vertices_.size() &&
           head.first_light_sample <= light_end && light_end <= light_samples_.size());
    const std::uint64_t count = vertex_end - head.first_vertex;
    for (std::uint64_t k = 0; k < count; ++k) {
      const RecordedVertex& v = vertices_[head.first_vertex + k];
      const auto follows = [&](std::uint32_t link) {
        return link == kNoVertex || (link > k && link < count);
      };
      expect(is_sound(v.guidable) && (v.parent == kNoVertex || v.parent < k) && follows(v.next) &&
             follows(v.twin) && v.first_technique <= techniques_.size() &&
             v.technique_count <= techniques_.size() - v.first_technique &&
             v.light_copies <= kMostLightCopies);
    }
    for (std::uint64_t k = head.first_light_sample; k < light_end; ++k) {
      expect(is_sound(light_samples_[k].discrete) && light_samples_[k].vertex < count);
    }
  }
}

void estimate_incident_radiance(const PathView& path, std::vector<Rgb>& out, WeightedAmong among) {
  const bool jointly = among == WeightedAmong::both_ends;
  const std::size_t count = path.vertices.size();
  out.assign(count, Rgb());
  // Children come after their parents, and light samples are in the order of their vertices. A
  // single backward pass therefore visits each vertex after everything that follows it.
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
