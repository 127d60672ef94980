#pragma once

#include <cstdint>

namespace pharos {

/// What a primary number is for.
enum class Purpose : std::uint8_t {
  pixel,            ///< 2D: position within the pixel
  lens,             ///< 2D: position on the lens
  light_choice,     ///< 1D: which light
  light_position,   ///< 2D: where on the light, or which direction of the environment
  bsdf_choice,      ///< 1D: which lobe or event
  bsdf_direction,   ///< 2D: direction of the BSDF or phase function
  mix_choice,       ///< 1D: guided or not
  guide_choice,     ///< 1D: which guide, component or branch
  guide_direction,  ///< 2D: within a guide
  guide_distance,   ///< 1D: within a guide
  distance_choice,  ///< 1D: which channel of a medium
  distance,         ///< 1D: how far in a medium
  roulette,         ///< 1D: whether to go on
};
inline constexpr int kPurposeCount = 13;

/// Names one primary number of a path by meaning: purpose, number of the path vertex it is asked
/// at (0 on the lens), and a branch that tells several of a kind apart (lights, numbers of a
/// guide). One word, so that it travels in a register: compilers build a struct of small members in
/// memory, at a cost beyond that of many a sampler's number.
class Dimension {
 public:
  constexpr Dimension(Purpose purpose, std::uint16_t bounce = 0, std::uint16_t branch = 0)
      : code_((std::uint64_t{bounce} << 32) | (std::uint64_t{branch} << 8) |
              static_cast<std::uint64_t>(purpose)) {}

  constexpr Purpose purpose() const { return static_cast<Purpose>(code_ & 0xff); }
  constexpr std::uint16_t bounce() const { return static_cast<std::uint16_t>(code_ >> 32); }
  constexpr std::uint16_t branch() const { return static_cast<std::uint16_t>(code_ >> 8); }
  /// A dense code, unique by value.
  constexpr std::uint64_t code() const { return code_; }
  friend constexpr bool operator==(Dimension, Dimension) = default;

 private:
  std::uint64_t code_;
};

}  // namespace pharos
