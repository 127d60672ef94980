#pragma once

#include <string>

#include <pharos/tests/fixtures.h>

namespace pharos::bench {

/// Returns the entry `scene: FILE` of a config, for a scene of the repository given by the name of
/// its folder.
std::string scene_entry(const std::string& name);

/// Returns the config of a guided render with a budget of `seconds`, 240 x 160 pixels, for a scene
/// as in scene_entry(). `learner` and `guider` are settings on one line.
std::string learning_config(const std::string& scene, const std::string& learner,
                            const std::string& guider, double seconds);

/// A field of spheres, lit by a lamp and a sky. The mesh file exists as long as this object.
class SphereField {
 public:
  /// A field of 300,000 triangles.
  SphereField() : SphereField(220, 19) {}
  /// A field of spheres with 4 * `rings` * (`rings` - 1) triangles each.
  SphereField(int spheres, int rings);
  /// Returns the entry `scene: …` of a config.
  std::string entry() const;
  std::size_t triangles() const { return triangles_; }

 private:
  test::TemporaryFolder folder_;
  std::size_t triangles_;
};

}  // namespace pharos::bench
