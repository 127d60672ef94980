#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <pharos/core/vec.h>

namespace CLI {
class App;
}

namespace pharos {

/// Where a slice lies: coordinate `axis` is `value` [scene units].
struct SliceOption {
  int axis;
  float value;
};

/// What a picture's colors mean.
struct RangeOption {
  float low, high;
};

/// What is typed after `pharos inspect`.
struct InspectOptions {
  std::filesystem::path model;
  std::string slice, direction, ellipsoids, range;  ///< as typed; empty: not given
  bool cloud = false;
  std::filesystem::path output, scene;
  int size = 1024;  ///< longer edge of the picture [pixels]
  int threads = 0;

  void add_to(CLI::App& command);
  bool wants_picture() const {
    return cloud || !slice.empty() || !direction.empty() || !ellipsoids.empty();
  }
  bool wants_exr() const { return output.extension() == ".exr"; }
};

/// Throws InputError naming the option when options do not fit together, or when the picture cannot
/// be written.
void check_options(const InspectOptions& options);

/// AXIS=VALUE. Throws InputError naming the option.
SliceOption parse_slice(const std::string& text);
/// X,Y,Z as typed after `option`. Throws InputError naming it.
Point3 parse_point(const char* option, const std::string& text);
/// LOW,HIGH; empty when it was not given. Throws InputError naming the option unless
/// 0 < LOW < HIGH.
std::optional<RangeOption> parse_range(const std::string& text);

}  // namespace pharos
