#include "sample.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <pharos/core/binary_stream.h>

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

  /// The step that was taken from vertex `i`.
  void add_step(std::uint32_t i, Rgb incident) {
    const RecordedVertex& here = path_.vertices[i];
    const Rgb value = here.throughput * here.local_weight * incident;
    if (here.parent == kNoVertex || is_black(value)) return;
    const auto next = std::find_if(path_.vertices.begin() + i + 1, path_.vertices.end(),
                                   [&](const RecordedVertex& v) { return v.parent == i; });
    if (next == path_.vertices.end()) return;
    add(here, here.event, outer(here.position, here.direction, *next), value);
  }

  /// Light, or the lens, as it was found from a vertex.
  void add_connection(const RecordedLightSample& found) {
    const RecordedVertex& here = path_.vertices[found.vertex];
    if (here.parent == kNoVertex) return;
    Outer end = outer(here.position, found.direction, found.light);
    // Which no step can meet: of use to first vertices, and to paths from there.
    if (found.discrete) end.kind = VertexKind::light;
    add(here, found.event, end, here.throughput * contribution(found));
  }

  Rgb contribution(const RecordedLightSample& found) const {
    return rule_.light_paths ? found.joint_contribution : found.contribution;
  }

 private:
  Outer outer(Point3 from, Vec3 direction, const RecordedVertex& vertex) const {
    const bool is_environment = vertex.kind == VertexKind::environment;
    return {is_environment ? rule_.environment.at(from, direction) : vertex.position, vertex.kind};
  }

  void add(const RecordedVertex& here, Event event, const Outer& next, Rgb value) {
    const RecordedVertex& parent = path_.vertices[here.parent];
    const Outer previous = outer(here.position, -parent.direction, parent);
    const bool from_sensor = path_.transport == Transport::radiance;
    const Outer& before = from_sensor ? previous : next;
    const Outer& after = from_sensor ? next : previous;
    const float weight = luminance(value);
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
  for (const RecordedLightSample& found : path.light_samples) extraction.add_connection(found);
}

void save_mode(const Mode& mode, std::ostream& out) {
  save_number(out, static_cast<std::uint8_t>(mode.before));
  save_number(out, static_cast<std::uint8_t>(mode.event));
  save_number(out, static_cast<std::uint8_t>(mode.after));
}

Mode load_mode(std::istream& in) {
  const auto before = load_number<std::uint8_t>(in), event = load_number<std::uint8_t>(in),
             after = load_number<std::uint8_t>(in);
  constexpr auto kLast = static_cast<std::uint8_t>(VertexKind::light);
  const bool is_event = std::has_single_bit(event) && contains(EventMask::all, Event{event});
  if (before > kLast || after > kLast || !is_event) {
    throw InputError("a mode of vertex triplets is damaged");
  }
  return {VertexKind{before}, Event{event}, VertexKind{after}};
}

void save_triplet(const Triplet& triplet, std::ostream& out) {
  for (const Point3 p : triplet.vertices) {
    for (int axis = 0; axis < 3; ++axis) save_number(out, p[axis]);
  }
  save_mode(triplet.mode, out);
}

Triplet load_triplet(std::istream& in) {
  Triplet triplet;
  for (Point3& p : triplet.vertices) {
    for (int axis = 0; axis < 3; ++axis) p[axis] = load_finite<float>(in);
  }
  triplet.mode = load_mode(in);
  return triplet;
}

void Sample::save(std::ostream& out) const {
  save_triplet(triplet, out);
  save_number(out, weight);
}

Sample Sample::load(std::istream& in) {
  Sample sample;
  sample.triplet = load_triplet(in);
  sample.weight = load_finite<float>(in);
  if (!(sample.weight > 0)) throw InputError("a sample of vertex triplets is damaged");
  return sample;
}

}  // namespace pharos::vertex_triplets
