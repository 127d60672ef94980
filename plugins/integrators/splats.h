#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "light_walk.h"
#include "unit_paths.h"

namespace pharos {

/// What a light path contributes, until it is known to be finite. Listens to a LightWalk.
class Splats : public SilentLightListener {
 public:
  explicit Splats(std::size_t most) { all_.reserve(most); }
  /// Before a path begins.
  void begin() {}
  void contribute(Vec2 film, Rgb contribution) { all_.push_back({film, contribution}); }

  /// Whether all are finite.
  bool are_finite() const {
    return std::all_of(all_.begin(), all_.end(),
                       [](const Splat& splat) { return is_finite(splat.contribution); });
  }

  /// Puts them on the film; nothing of a path of NaN or infinity.
  void deposit(const PathKey& key, WorkResult& result) {
    const bool finite = are_finite();
    if (!finite) reject(key, result);
    for (const auto& [film, contribution] : all_) {
      if (finite && !is_black(contribution)) result.film.add_splat(film, contribution);
    }
    all_.clear();
  }

 private:
  struct Splat {
    Vec2 film;
    Rgb contribution;
  };
  std::vector<Splat> all_;
};

/// The same, and writes the path into a log. Listens to a LightWalk.
class RecordedSplats : public Splats {
 public:
  RecordedSplats(std::size_t most, PathLog& log) : Splats(most), log_(log) {}

  void begin() {
    log_.begin_path({}, Transport::importance);
    current_ = kNoVertex;
  }
  void arrive(const PathVertex& vertex, Rgb throughput) {
    const GuidingVertex described = vertex.described();
    current_ = log_.add({.position = described.position,
                         .normal = described.normal,
                         .kind = described.kind,
                         .parent = current_,
                         .throughput = throughput});
  }
  void step(const ScatterStep& step, Rgb weight) {
    RecordedVertex& here = log_.vertex(current_);
    here.event = step.event;
    here.direction = step.direction;
    here.local_weight = weight;
  }
  void connection(const LensPoint& lens, Vec3 direction, Event event, Rgb value, float weight) {
    log_.add({.vertex = current_,
              .position = lens.position,
              .kind = VertexKind::sensor,
              .event = event,
              .direction = direction,
              .contribution = value,
              .joint_contribution = weight * value});
  }
  void deposit(const PathKey& key, WorkResult& result) {
    if (!are_finite()) log_.blacken_last_path();
    Splats::deposit(key, result);
  }

 private:
  PathLog& log_;
  std::uint32_t current_ = kNoVertex;
};

/// Tells of a light path in words. Listens to a LightWalk.
class LightPathTeller : public SilentLightListener {
 public:
  void arrive(const PathVertex& vertex, Rgb throughput) {
    const VertexKind kind = vertex.kind;
    const Point3 at = vertex.position();
    const char* what = kind == VertexKind::volume        ? "volume"
                       : kind == VertexKind::environment ? "environment"
                       : kind == VertexKind::light       ? "light"
                                                         : "surface";
    text_ += fmt::format(
        "{:3} {:<11} at ({:.6g}, {:.6g}, {:.6g})  throughput ({:.6g}, {:.6g}, {:.6g})\n", number_++,
        what, at.x, at.y, at.z, throughput.r, throughput.g, throughput.b);
  }
  void contribute(Vec2 film, Rgb c) {
    total_ += c;
    text_ += fmt::format("      seen at film ({:.4f}, {:.4f}) px: ({:.6g}, {:.6g}, {:.6g})\n",
                         film.x, film.y, c.r, c.g, c.b);
  }
  PathTrace trace() const { return {total_, text_}; }

 private:
  std::string text_;
  int number_ = 0;
  Rgb total_;
};

}  // namespace pharos
