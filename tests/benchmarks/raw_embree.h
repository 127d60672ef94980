#pragma once

#include <span>

#include <pharos/scene/scene.h>

namespace pharos::bench {

/// The triangles of a scene in an Embree scene of their own, built as Pharos builds its own and
/// asked without anything around it.
class RawEmbree {
 public:
  explicit RawEmbree(const Scene& scene);
  ~RawEmbree();
  RawEmbree(const RawEmbree&) = delete;
  RawEmbree& operator=(const RawEmbree&) = delete;

  /// Nearest hits of all rays; returns how many hit something.
  std::size_t intersect_all(std::span<const Ray> rays) const;

 private:
  struct Handles;
  Handles* handles_;
};

}  // namespace pharos::bench
