#include "records.h"

#include <limits>

#include <pharos/core/warp.h>

#include "cells.h"

namespace pharos::practical_path_guiding {
namespace {

double value_of(const GuidableStep& step, GuidingTarget target, double pixel) {
  if (target == GuidingTarget::radiance) return double{mean(step.radiance)} / step.pdf;
  const double x = target == GuidingTarget::product
                       ? mean(step.reflected)
                       : mean(step.from.throughput * step.reflected) / pixel;
  // x is an integrand divided by the density p. The record estimates the integral of the squared
  // integrand: (x p)^2 / p = x^2 p.
  return x * x * step.pdf;
}

}  // namespace

void extract_records(const PathView& path, GuidingTarget target, LightHits hits,
                     const PixelEstimates& pixels, std::vector<Rgb>& incident,
                     std::vector<Record>& records) {
  const double pixel = target == GuidingTarget::relative ? pixels.at(path.film) : 1;
  for_each_guidable_step(path, hits, incident, [&](const GuidableStep& step) {
    const double value = value_of(step, target, pixel);
    // An infinite value would stay in the sums forever.
    if (!(value >= 0) || !(value < std::numeric_limits<float>::max())) return;
    records.push_back({.position = step.from.position,
                       .direction = warp::square_from_sphere(step.from.direction),
                       .facing = facing_of(step.from.normal),
                       .value = static_cast<float>(value),
                       .steps = step.from.continuation});
  });
}

void Record::archive(Archive& archive) {
  archive(position, direction, facing, value, steps);
  const auto is_unit = [](float v) { return v >= 0 && v < 1; };
  archive.expect(
      is_unit(direction.x) && is_unit(direction.y) && facing < kFacings && value >= 0 && steps > 0,
      "a record of the directional trees");
}

}  // namespace pharos::practical_path_guiding
