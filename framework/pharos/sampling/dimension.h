#pragma once

#include <cstdint>

namespace pharos {

/// The purpose of a primary number.
enum class Purpose : std::uint8_t {
  pixel,            ///< 2D: position within the pixel
  lens,             ///< 2D: position on the lens
  light_choice,     ///< 1D: choice of a light
  light_position,   ///< 2D: position on the light, or direction of the environment
  bsdf_choice,      ///< 1D: choice of a lobe or event
  bsdf_direction,   ///< 2D: direction sampled from the BSDF or phase function
  mix_choice,       ///< 1D: choice between unguided sampling and the guides, and among the guides
  guide_choice,     ///< 1D: choice of a component or branch within a guide
  guide_direction,  ///< 2D: direction within a guide
  guide_distance,   ///< 1D: distance within a guide
  distance_choice,  ///< 1D: choice of a channel of a medium
  distance,         ///< 1D: distance in a medium
  roulette,         ///< 1D: whether the path goes on
};
inline constexpr int kPurposeCount = 13;

/// Names one primary number of a path by its meaning: the purpose, the index of the path vertex
/// that requests it (0 on the lens), and a branch that distinguishes several numbers of the same
/// purpose (lights, numbers of a guide). The name is one word, so that it is passed in a register:
/// compilers build a struct of small members in memory, which can cost more than the sampler needs
/// for the number.
class Dimension {
 public:
  constexpr Dimension(Purpose purpose, std::uint16_t bounce = 0, std::uint16_t branch = 0)
      : code_((std::uint64_t{bounce} << 32) | (std::uint64_t{branch} << 8) |
              static_cast<std::uint64_t>(purpose)) {}

  constexpr Purpose purpose() const { return static_cast<Purpose>(code_ & 0xff); }
  constexpr std::uint16_t bounce() const { return static_cast<std::uint16_t>(code_ >> 32); }
  constexpr std::uint16_t branch() const { return static_cast<std::uint16_t>(code_ >> 8); }
  /// A dense code. Different dimensions have different codes.
  constexpr std::uint64_t code() const { return code_; }
  friend constexpr bool operator==(Dimension, Dimension) = default;

 private:
  std::uint64_t code_;
};

}  // namespace pharos
