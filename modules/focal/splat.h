#pragma once

#include <optional>
#include <span>
#include <vector>

#include <pharos/guiding/record/path_record.h>

#include "focal_density.h"

namespace pharos::focal {

/// The part of a segment's line at which the path is considered to meet points.
enum class SplatExtent {
  line,  ///< the whole line, including the parts before its origin and behind its end (the paper,
         ///< section 4)
  roughness_gated,  ///< only the segment; but the whole line if the segment's end is nearly
                    ///< specular, so an image may lie behind it (the authors' code)
};
/// The weight of a contribution in a cell before narrowing.
enum class SplatWeight {
  length,  ///< the length within the cell divided by the region's diagonal (the paper, eq. 10)
  share,   ///< the share of the splatted length (the authors' code): a contribution counts the same
           ///< for any length, once for each of both octrees
};

/// A path segment that a guide could have sampled, and its contribution.
struct Segment {
  Point3 origin;
  Vec3 direction;            ///< unit
  float length = 0;          ///< distance to its end [scene units]; infinite if it left the scene
  float contribution = 0;    ///< f/p of all light along the segment, mean of the channels; > 0
  float unguided_pdf = 0;    ///< density of the BSDF or phase function [1/sr]; 0: not known
  float guided_pdf = 0;      ///< density of all guides [1/sr]; 0: not known
  float unguided_share = 1;  ///< share of unguided samples
  bool whole_line = false;   ///< the path adds mass to the whole line, not only up to the end

  void archive(Archive& archive);
};

/// The rule by which extract_segments() sets Segment::whole_line.
struct ExtentRule {
  SplatExtent extent = SplatExtent::line;
  float roughness = 0.3f;  ///< for `roughness_gated`: smoother ends are nearly specular
};

/// Appends the segments of a path that carried light. `incident` is scratch memory.
void extract_segments(const PathView& path, const ExtentRule& rule, std::vector<Rgb>& incident,
                      std::vector<Segment>& segments);

/// The mass collected in the cells of both octrees.
struct FocalSums {
  explicit FocalSums(const FocalDensity& density)
      : converging(8 * density.converging.nodes().size()),
        diverging(8 * density.diverging.nodes().size()) {}

  void add(const FocalSums& other);
  double total() const;

  std::vector<double> converging, diverging;  ///< mass of child c of node i at index [8 i + c]
};

/// Splats lengths within cells times contributions (eq. 10). Lengths are relative to `unit` [scene
/// units]. If `unit` is 0, they are relative to the whole length that is splatted into an octree.
void splat_lengths(std::span<const Segment> segments, const FocalDensity& density, double unit,
                   FocalSums& sums);

/// Splats contributions in proportion to the probability with which each cell would have sampled
/// the segment (iterative narrowing with MIS compensation, eq. 11, 12 and 14). Without MIS
/// compensation, this guide counts as the only technique. With it, other guides are techniques as
/// well.
void splat_narrowed(std::span<const Segment> segments, const FocalDensity& density,
                    bool mis_compensation, FocalSums& sums);

/// The same for segments that an earlier, wider state of the density has guided, or no guide at
/// all. With MIS compensation, the share of the guides is taken as at least `least_share`, and
/// their density as the larger one of the recorded density and the one of `density`.
void splat_again(std::span<const Segment> segments, const FocalDensity& density,
                 bool mis_compensation, double least_share, FocalSums& sums);

}  // namespace pharos::focal
