#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <pharos/transport/path_loop.h>
#include <pharos/transport/recorder.h>

namespace pharos {

/// The contributions of one path from a light. They are kept until all of them are known to be
/// finite.
class Splats {
 public:
  explicit Splats(std::size_t most) { all_.reserve(most); }
  void add(Vec2 film, Rgb contribution) { all_.push_back({film, contribution}); }

  bool are_finite() const {
    return std::all_of(all_.begin(), all_.end(),
                       [](const Splat& splat) { return is_finite(splat.contribution); });
  }

  /// Adds the contributions to the film, and counts the path if one of them carries light. If one
  /// of them is NaN or infinite, the path is rejected and none is added.
  void deposit(const PathKey& key, WorkResult& result) {
    const bool finite = are_finite();
    if (!finite) reject(key, result);
    bool is_lit = false;
    for (const auto& [film, contribution] : all_) {
      if (!finite || is_black(contribution)) continue;
      result.film.add_splat(film, contribution);
      is_lit = true;
    }
    if (is_lit) ++result.counters.lit_paths;
    all_.clear();
  }

 private:
  struct Splat {
    Vec2 film;
    Rgb contribution;
  };
  std::vector<Splat> all_;
};

/// A recorder that also collects contributions. A path with a NaN or infinite contribution counts
/// as black in the record, too.
template <class Recorder>
class SplatRecorder : public Recorder {
 public:
  template <class... Args>
  explicit SplatRecorder(std::size_t most, Args&&... args)
      : Recorder(std::forward<Args>(args)...), splats_(most) {}

  void contribute(Vec2 film, Rgb contribution) { splats_.add(film, contribution); }

  void deposit(const PathKey& key, WorkResult& result) {
    if (Recorder::kRecords && !splats_.are_finite()) result.log.blacken_last_path();
    splats_.deposit(key, result);
  }

 private:
  Splats splats_;
};

/// A recorder that describes a path from a light as text.
class LightPathTeller : public SilentRecorder {
 public:
  static constexpr bool kRecords = true;
  explicit LightPathTeller(const RenderTarget& target)
      : pixels_(static_cast<float>(target.window.area())) {}
  void arrive(const Path& path);
  void contribute(Vec2 film, Rgb contribution);
  PathTrace trace() const { return {total_ / pixels_, text_}; }

 private:
  float pixels_;
  std::string text_;
  int number_ = 0;
  Rgb total_;
};

}  // namespace pharos
