#include "sample.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace pharos::vertex_triplets {
namespace {

/// An outer vertex of a triplet.
struct Outer {
  Point3 position;
  VertexKind kind;
};

/// Collects the samples of one path.
class Extraction {
 public:
  Extraction(const PathView& path, const SampleRule& rule, std::vector<Sample>& samples)
      : path_(path), rule_(rule), samples_(samples) {}

  /// Adds the step that was taken from vertex `i`.
  void add_step(std::uint32_t i, Rgb incident) {
    const RecordedVertex& here = path_.vertices[i];
    if (here.parent == kNoVertex) return;
    const Rgb value = prefix(here) * here.local_weight * incident;
    if (is_black(value)) return;
    if (here.next == kNoVertex) return;
    const RecordedVertex& next = path_.vertices[here.next];
    add(here, here.event, outer(here.position, here.direction, next.position, next.kind), value);
  }

  /// Adds a connection from a vertex to a light or to the lens.
  void add_connection(const RecordedLightSample& found) {
    const RecordedVertex& here = path_.vertices[found.vertex];
    if (here.parent == kNoVertex) return;
    Outer end = outer(here.position, found.direction, found.position, found.kind);
    // No step can hit such an end. The sample is still of use to first vertices, and to paths that
    // start at this end.
    if (found.discrete) end.kind = VertexKind::light;
    add(here, found.event, end, prefix(here) * contribution(found));
  }

  Rgb contribution(const RecordedLightSample& found) const {
    return rule_.light_paths ? found.joint_contribution : found.contribution;
  }

 private:
  /// Returns the factor of the path up to a vertex in the weights of samples at this vertex.
  Rgb prefix(const RecordedVertex& here) const {
    const bool is_first = path_.vertices[here.parent].kind == VertexKind::sensor;
    return rule_.suffixes && !is_first ? Rgb(1) : here.throughput;
  }

  Outer outer(Point3 from, Vec3 direction, Point3 position, VertexKind kind) const {
    const bool is_environment = kind == VertexKind::environment;
    return {is_environment ? rule_.environment.at(from, direction) : position, kind};
  }

  void add(const RecordedVertex& here, Event event, const Outer& next, Rgb value) {
    const RecordedVertex& parent = path_.vertices[here.parent];
    const Outer previous = outer(here.position, -parent.direction, parent.position, parent.kind);
    const bool from_sensor = path_.transport == Transport::radiance;
    const Outer& before = from_sensor ? previous : next;
    const Outer& after = from_sensor ? next : previous;
    const float weight = rule_.scale * luminance(value);
    if (!(weight > 0) || !std::isfinite(weight)) return;
    samples_.push_back(
        {{{before.position, here.position, after.position}, {before.kind, event, after.kind}},
         weight});
  }

  const PathView& path_;
  const SampleRule& rule_;
  std::vector<Sample>& samples_;
};

}  // namespace

void extract_samples(const PathView& path, const SampleRule& rule, std::vector<Rgb>& incident,
                     std::vector<Sample>& samples) {
  if (path.transport == Transport::importance && !rule.light_paths) return;
  estimate_incident_radiance(path, incident,
                             rule.light_paths ? WeightedAmong::both_ends : WeightedAmong::own_end);
  Extraction extraction(path, rule, samples);
  for (std::uint32_t i = 1; i < path.vertices.size(); ++i) extraction.add_step(i, incident[i]);
  if (!rule.light_samples && path.transport == Transport::radiance) return;
  for (const RecordedLightSample& found : path.light_samples) extraction.add_connection(found);
}

void Mode::archive(Archive& archive) {
  archive(before, event, after);
  const bool is_event =
      std::has_single_bit(static_cast<std::uint8_t>(event)) && contains(EventMask::all, event);
  archive.expect(before <= VertexKind::light && after <= VertexKind::light && is_event,
                 "a mode of vertex triplets");
}

void Sample::archive(Archive& archive) {
  archive(triplet, weight);
  archive.expect(weight > 0, "a sample of vertex triplets");
}

}  // namespace pharos::vertex_triplets
