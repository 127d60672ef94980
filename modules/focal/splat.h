#pragma once

#include <optional>
#include <span>
#include <vector>

#include <pharos/guiding/record/path_record.h>

#include "focal_density.h"

namespace pharos::focal {

/// Which part of a segment's line counts as met by the path.
enum class SplatExtent {
  line,             ///< all of it, also before its origin and behind its end (the paper, section 4)
  roughness_gated,  ///< the segment alone, but all of the line where its end is nearly specular and
                    ///< an image may lie behind it (the authors' code)
};
/// How much a cell gets of a contribution before narrowing.
enum class SplatWeight {
  length,  ///< the length within the cell over the region's diagonal (the paper, eq. 10)
  share,   ///< the share of the length that is splatted (the authors' code): a contribution counts
           ///< the same however long it is, once for each sign
};

/// A step of a path that a guide could have sampled, and what came of it.
struct Segment {
  Point3 origin;
  Vec3 direction;          ///< unit
  float length = 0;        ///< to its end; infinite where it left the scene
  float contribution = 0;  ///< f/p of all that came along it, mean of the channels; > 0
  float unguided_pdf = 0;  ///< of the BSDF or phase function [1/sr]
  float guided_pdf = 0;    ///< of all guides [1/sr]; 0: not known
  float unguided_fraction = 1;
  bool whole_line = false;  ///< meets points anywhere on its line, not just up to its end
};

/// What extract_segments() needs to know.
struct ExtentRule {
  SplatExtent extent = SplatExtent::line;
  float roughness = 0.3f;  ///< ends below this are nearly specular, for `roughness_gated`
};

/// Appends the segments of a path that found light.
void extract_segments(const PathView& path, const ExtentRule& rule, std::vector<Rgb>& incident,
                      std::vector<Segment>& segments);

/// Mass collected in the cells of both octrees.
struct FocalSums {
  explicit FocalSums(const FocalDensity& density)
      : converging(8 * density.converging.nodes().size()),
        diverging(8 * density.diverging.nodes().size()) {}

  void add(const FocalSums& other);
  double total() const;

  std::vector<double> converging, diverging;  ///< of child c of node i at [8 i + c]
};

/// Splats lengths within cells times contributions (eq. 10). Lengths are relative to `unit`
/// [scene units], or to all of the length that goes into an octree where `unit` is 0.
void splat_lengths(std::span<const Segment> segments, const FocalDensity& density, double unit,
                   FocalSums& sums);

/// Splats contributions in proportion to how likely each cell would have sampled the segment
/// (iterative narrowing with MIS compensation, eq. 11, 12 and 14; without compensation this guide
/// counts as the only technique). Other guides beside this one are techniques too.
void splat_narrowed(std::span<const Segment> segments, const FocalDensity& density,
                    bool mis_compensation, FocalSums& sums);

}  // namespace pharos::focal
