#include <cmath>

#include <pharos/transport/segment.h>

namespace pharos {
namespace {

/// Returns where a step ends on one leg of a segment in a medium if no surface is in the way.
DistanceSample stop_on_leg(const Medium& medium, const Ray& ray, Rgb shares,
                           const ScatterStep& step, float traveled, std::uint16_t leg,
                           const VertexStream& numbers) {
  switch (step.reach) {
    case Proposal::Reach::medium:
      return medium.sample(ray, shares, numbers.get_1d(Purpose::distance_choice, leg),
                           numbers.get_1d(Purpose::distance, leg));
    case Proposal::Reach::distance:
      return {.t = step.distance - traveled, .scattered = step.distance < kInfinity};
    default:
      return {};
  }
}

}  // namespace

bool SegmentTracer::trace_through(Ray ray, const Medium* medium, const ScatterStep& step,
                                  Rgb throughput, const VertexStream& numbers, Segment& segment,
                                  SurfacePoint& end) const {
  const Ray whole = ray;
  for (std::uint16_t leg = 0;; ++leg) {
    ++counters_.rays;
    Rgb shares;
    DistanceSample stop;
    if (medium != nullptr) {
      shares = channel_shares(throughput * segment.passage.transmittance);
      stop = stop_on_leg(*medium, ray, shares, step, segment.length, leg, numbers);
      // The ray need not look farther, which saves much time in dense media.
      if (stop.scattered) ray.t_max = stop.t;
    }
    const float hit = scene_.intersect(ray, end);
    if (stop.scattered && std::isinf(hit)) {
      const MediumLeg passed = medium->leg(ray, shares, stop.t);
      segment.passage.transmittance *= passed.transmittance;
      segment.passage.medium_density *= passed.scatter_pdf;
      segment.kind = VertexKind::volume;
      end = {};
      end.position = ray.at(stop.t);
    } else {
      ray.t_max = hit;
      if (medium != nullptr) add_leg(*medium, ray, shares, segment.passage);
    }
    segment.length += ray.t_max;
    segment.medium = medium;
    if (segment.kind == VertexKind::volume) return true;
    // There is nothing to scatter at the position of the proposed vertex.
    if (step.reach == Proposal::Reach::distance && step.distance <= segment.length) return false;
    if (std::isinf(ray.t_max)) {
      arrive_at_environment(whole, segment, end);
      break;
    }
    if (!scene_.is_boundary(end)) break;
    medium = scene_.medium_after(end, ray.direction, medium);
    ray.origin = end.origin_towards(ray.direction);
    ray.t_max = kInfinity;
  }
  return step.reach != Proposal::Reach::distance;
}

bool SegmentTracer::pass_through(Ray ray, const Medium* medium, Rgb throughput,
                                 Passage& passage) const {
  const Point3 goal = ray.at(ray.t_max);
  const bool is_near = std::isfinite(ray.t_max);
  for (;;) {
    SurfacePoint at;
    ++counters_.rays;
    const float t = scene_.intersect(ray, at);
    const bool arrives = std::isinf(t);
    if (!arrives && !scene_.is_boundary(at)) return false;
    if (!arrives) ray.t_max = t;
    if (medium != nullptr) {
      add_leg(*medium, ray, channel_shares(throughput * passage.transmittance), passage);
    }
    if (arrives) return true;
    medium = scene_.medium_after(at, ray.direction, medium);
    ray.origin = at.origin_towards(ray.direction);
    // The ray is aimed again at its goal, so that it does not reach beyond. The goal may lie before
    // a surface by no more than the boundary's own error.
    const Vec3 rest = goal - ray.origin;
    ray.t_max = is_near ? length(rest) : kInfinity;
    if (is_near && !(dot(rest, ray.direction) > 0)) return true;
    if (is_near) ray.direction = rest / ray.t_max;
  }
}

}  // namespace pharos
