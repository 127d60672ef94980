#include "splat.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <pharos/guiding/toolkit/guidable_steps.h>

namespace pharos::focal {
namespace {

/// The range of distances along a segment's line that receives mass: up to `ahead` in front of the
/// origin and down to `behind` behind the origin.
struct Reach {
  explicit Reach(const Segment& s)
      : ahead(s.whole_line ? kInfinity : s.length), behind(s.whole_line ? -kInfinity : 0.0f) {}
  double ahead, behind;
};

/// Adds `amount(node, level, t0, length)` to the leaves of every node that a side of the line
/// crosses within (begin, end). For each child, `t0` is where the line enters it, and `length` is
/// its length there, or 0 if the line misses it [Octree::unit() of the level]. The amounts of inner
/// children must be 0.
template <Side side, class Amount>
void add_to_leaves(const Octree& octree, const Line& line, double begin, double end,
                   std::vector<double>& sums, Amount&& amount) {
  if (!(begin < end)) return;
  const auto visit = [&](std::uint32_t i, const Octree::CrossedNode& node, const Spans& spans,
                         unsigned level) {
    const double unit = Octree::unit(level);
    const Lanes t0 = larger(spans.begin, Lanes::all(begin / unit));
    const Lanes t1 = smaller(spans.end, Lanes::all(end / unit));
    add_mirrored(amount(node, level, t0, larger(t1 - t0, Lanes{})), line.mirror,
                 &sums[8 * std::size_t{i}]);
  };
  octree.traverse<side>(line, visit);
}

/// Returns the length of the line within the box between two distances.
double length_within(const Line& line, double begin, double end) {
  for (int axis = 0; axis < 3; ++axis) {
    begin = std::max(begin, line.entry[axis]);
    end = std::min(end, line.entry[axis] + line.width[axis]);
  }
  return std::max(end - begin, 0.0);
}

/// Splats `contribution` along the line between two distances, weighted by length divided by
/// `unit`. If `unit` is 0, the divisor is the whole splatted length.
template <Side side>
void splat_length(const Octree& octree, const Line& line, double begin, double end,
                  double contribution, double unit, std::vector<double>& sums) {
  if (unit == 0) unit = length_within(line, begin, end);
  if (!(unit > 0)) return;
  const double scale = contribution / unit;
  add_to_leaves<side>(
      octree, line, begin, end, sums,
      [scale](const Octree::CrossedNode& node, unsigned level, const Lanes&, const Lanes& length) {
        return Lanes::all(scale * Octree::unit(level)) * length * node.leaves();
      });
}

void splat_length(const Segment& segment, const FocalDensity& density, double unit,
                  FocalSums& sums) {
  const Line line(density.converging.box(), segment.origin, segment.direction);
  const Reach reach(segment);
  splat_length<Side::ahead>(density.converging, line, 0, reach.ahead, segment.contribution, unit,
                            sums.converging);
  splat_length<Side::behind>(density.diverging, line, reach.behind, 0, segment.contribution, unit,
                             sums.diverging);
}

/// The densities with which a segment could have been drawn [1/sr], and the share of unguided
/// samples.
struct SegmentDensity {
  double own = 0;  ///< of this guide
  double guided = 0, unguided = 0;
  double unguided_share = 0;
};

SegmentDensity density_of(const Segment& segment, const FocalDensity& density,
                          bool mis_compensation) {
  const double own = density.directional_density(segment.origin, segment.direction);
  if (!mis_compensation) return {.own = own, .guided = own};
  return {.own = own,
          .guided = segment.guided_pdf > 0 ? segment.guided_pdf : own,
          .unguided = segment.unguided_pdf,
          .unguided_share = segment.unguided_share};
}

/// Splats the part of a contribution that is due to the guides.
void splat_narrowed(const Segment& segment, const FocalDensity& density, const SegmentDensity& of,
                    FocalSums& sums) {
  const double guided_share = 1 - of.unguided_share;
  const double pdf = of.unguided_share * of.unguided + guided_share * of.guided;
  if (!(of.own > 0) || !(pdf > 0)) return;
  const double scale =
      guided_share * double{segment.contribution} / pdf / (3 * density.converging.box().volume());
  const Line line(density.converging.box(), segment.origin, segment.direction);
  const Reach reach(segment);
  // The integral of density t^2 over the length. In units of the level, a leaf's density is its
  // mass divided by the volume of the box.
  const auto amount = [scale](const Octree::CrossedNode& node, unsigned, const Lanes& t0,
                              const Lanes& length) {
    const Lanes t1 = t0 + length;
    return Lanes::all(scale) * node.masses() * length * (t0 * (t0 + t1) + t1 * t1);
  };
  add_to_leaves<Side::ahead>(density.converging, line, 0, reach.ahead, sums.converging, amount);
  add_to_leaves<Side::behind>(density.diverging, line, reach.behind, 0, sums.diverging, amount);
}

bool meets_whole_line(const RecordedVertex& end, const ExtentRule& rule) {
  if (rule.extent == SplatExtent::line) return true;
  return end.kind == VertexKind::surface && end.roughness < rule.roughness;
}

/// Returns unguided sampling, and all guides combined into one technique.
std::pair<Technique, Technique> techniques_of(const PathView& path, const RecordedVertex& vertex) {
  const std::span<const Technique> all = path.techniques(vertex);
  if (all.empty()) return {{.share = 1}, {}};
  Technique guided;
  for (const Technique& t : all.subspan(1)) guided.share += t.share;
  for (const Technique& t : all.subspan(1)) {
    if (t.share > 0) guided.density += t.share / guided.share * t.density;
  }
  return {all[0], guided};
}

}  // namespace

void extract_segments(const PathView& path, const ExtentRule& rule, std::vector<Rgb>& incident,
                      std::vector<Segment>& segments) {
  for_each_guidable_step(path, incident, [&](const GuidableStep& step) {
    const float contribution = mean(step.from.throughput * step.reflected);
    if (!(contribution > 0) || !std::isfinite(contribution)) return;
    const bool escapes = step.to.kind == VertexKind::environment;
    // Recorded densities contain the medium's factor, and densities of focal points do not.
    const float medium = step.from.medium_density;
    const auto [unguided, guided] = techniques_of(path, step.from);
    segments.push_back(
        {.origin = step.from.position,
         .direction = step.from.direction,
         .length = escapes ? kInfinity : length(step.to.position - step.from.position),
         .contribution = contribution,
         .unguided_pdf = unguided.density / medium,
         .guided_pdf = guided.density / medium,
         .unguided_share = unguided.share,
         .whole_line = meets_whole_line(step.to, rule)});
  });
}

void Segment::archive(Archive& archive) {
  archive(origin, direction, contribution, unguided_pdf, guided_pdf, unguided_share, whole_line);
  archive.unchecked(length);
  archive.expect(length >= 0, "a segment of a path");
}

void FocalSums::add(const FocalSums& other) {
  for (std::size_t i = 0; i < converging.size(); ++i) converging[i] += other.converging[i];
  for (std::size_t i = 0; i < diverging.size(); ++i) diverging[i] += other.diverging[i];
}

double FocalSums::total() const {
  return std::accumulate(converging.begin(), converging.end(), 0.0) +
         std::accumulate(diverging.begin(), diverging.end(), 0.0);
}

void splat_lengths(std::span<const Segment> segments, const FocalDensity& density, double unit,
                   FocalSums& sums) {
  for (const Segment& segment : segments) splat_length(segment, density, unit, sums);
}

void splat_narrowed(std::span<const Segment> segments, const FocalDensity& density,
                    bool mis_compensation, FocalSums& sums) {
  for (const Segment& segment : segments) {
    splat_narrowed(segment, density, density_of(segment, density, mis_compensation), sums);
  }
}

void splat_again(std::span<const Segment> segments, const FocalDensity& density,
                 bool mis_compensation, double least_share, FocalSums& sums) {
  for (const Segment& segment : segments) {
    SegmentDensity of = density_of(segment, density, mis_compensation);
    of.unguided_share = std::min(of.unguided_share, 1 - least_share);
    of.guided = std::max(of.guided, of.own);
    splat_narrowed(segment, density, of, sums);
  }
}

}  // namespace pharos::focal
