#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <pharos/core/vec.h>

namespace CLI {
class App;
}

namespace pharos {

/// The position of a slice: coordinate `axis` is `value` [scene units].
struct SliceOption {
  int axis;
  float value;
};

/// The range of densities that a picture's colors represent.
struct RangeOption {
  float low, high;
};

/// The arguments of `pharos inspect`.
struct InspectOptions {
  std::filesystem::path model;
  std::string slice, direction, ellipsoids, range;  ///< as typed; empty if not given
  bool cloud = false;
  bool shares = false;       ///< of a slice
  std::uint16_t bounce = 1;  ///< number of the vertices whose shares are shown
  std::size_t index = 0;     ///< of the model in the file
  std::filesystem::path output, scene;
  int size = 1024;  ///< longer edge of the picture [pixels]
  int threads = 0;

  void add_to(CLI::App& command);
  bool wants_picture() const {
    return cloud || !slice.empty() || !direction.empty() || !ellipsoids.empty();
  }
  bool wants_exr() const { return output.extension() == ".exr"; }
};

/// Throws InputError with the name of the option if options contradict each other or the picture
/// cannot be written.
void check_options(const InspectOptions& options);

/// Parses AXIS=VALUE. Throws InputError with the name of the option.
SliceOption parse_slice(const std::string& text);
/// Parses X,Y,Z as typed after `option`. Throws InputError with the name of the option.
Point3 parse_point(const char* option, const std::string& text);
/// Parses LOW,HIGH. Returns nothing if the option was not given. Throws InputError with the name of
/// the option unless 0 < LOW < HIGH.
std::optional<RangeOption> parse_range(const std::string& text);

}  // namespace pharos
