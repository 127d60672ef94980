#pragma once

#include <string>

#include <pharos/tests/fixtures.h>

namespace pharos::bench {

/// `scene: FILE` for a scene that comes along, by the name of its folder.
std::string scene_entry(const std::string& name);

/// 300,000 triangles: a field of spheres, lit by a lamp and a sky. Lives as long as its mesh is
/// needed.
class SphereField {
 public:
  SphereField();
  /// `scene: …` of a config.
  std::string entry() const;

 private:
  test::TemporaryFolder folder_;
};

}  // namespace pharos::bench
