#pragma once

#include <span>

#include <pharos/scene/scene.h>

namespace pharos::bench {

/// The triangles of a scene in a separate Embree scene. It is built in the same way as the Embree
/// scenes of Pharos and queried without any additional code.
class RawEmbree {
 public:
  explicit RawEmbree(const Scene& scene);
  ~RawEmbree();
  RawEmbree(const RawEmbree&) = delete;
  RawEmbree& operator=(const RawEmbree&) = delete;

  /// Finds the nearest hits of all rays. Returns the number of rays that hit something.
  std::size_t intersect_all(std::span<const Ray> rays) const;

 private:
  struct Handles;
  Handles* handles_;
};

}  // namespace pharos::bench
