#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>

#include "unit_paths.h"

namespace pharos {

/// What a light path contributes, until it is known to be finite. Listens to a LightWalk.
class Splats {
 public:
  explicit Splats(std::size_t most) { all_.reserve(most); }
  void arrive(VertexKind, Point3, Rgb) {}
  void contribute(Vec2 film, Rgb contribution) { all_.push_back({film, contribution}); }

  /// Puts them on the film; nothing of a path of NaN or infinity.
  void deposit(const PathKey& key, WorkResult& result) {
    bool finite = true;
    for (const auto& [film, contribution] : all_) finite = finite && is_finite(contribution);
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

/// Tells of a light path in words. Listens to a LightWalk.
class LightPathTeller {
 public:
  void arrive(VertexKind kind, Point3 at, Rgb throughput) {
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
