#pragma once

#include <string>

#include <pharos/tests/fixtures.h>

namespace pharos::bench {

/// Returns the entry `scene: FILE` of a config, for a scene of the repository given by the name of
/// its folder.
std::string scene_entry(const std::string& name);

/// A scene of 300,000 triangles: a field of spheres, lit by a lamp and a sky. The mesh file exists
/// as long as this object.
class SphereField {
 public:
  SphereField();
  /// Returns the entry `scene: …` of a config.
  std::string entry() const;

 private:
  test::TemporaryFolder folder_;
};

}  // namespace pharos::bench
