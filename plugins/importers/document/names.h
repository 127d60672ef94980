#pragma once

#include <array>
#include <string>
#include <string_view>

#include "document.h"

namespace pharos::mitsuba {

/// The dialect that a version such as "0.6.0" or "3.5.2" belongs to. Throws InputError (not
/// located) for what is no version or one that is not known.
Dialect dialect_of(std::string_view version);

/// `name` as Mitsuba 2 and 3 rewrite names of scenes of dialect 0.x: an upper-case letter that
/// follows a lower-case one begins a new word, and it and those right after it become lower case
/// ("toWorld" reads as "to_world", "intIOR" as "int_ior", "sigmaT" as "sigma_t").
std::string snake_case(std::string_view name);

/// `text` with the letters of ASCII in lower case.
std::string lower_case(std::string_view text);

/// Tags of objects, apart from the outermost `scene`.
inline constexpr std::array<std::string_view, 16> kObjectTags{
    "shape",   "bsdf",   "emitter", "sensor", "texture",    "film",  "sampler",   "integrator",
    "rfilter", "medium", "phase",   "volume", "subsurface", "field", "luminaire", "camera"};

/// Tags of plain values.
inline constexpr std::array<std::string_view, 12> kValueTags{
    "boolean",   "integer",   "float", "string", "point",    "vector",
    "transform", "animation", "rgb",   "srgb",   "spectrum", "blackbody"};

/// Tags that do something else: name objects, files and values.
inline constexpr std::array<std::string_view, 5> kOtherTags{"ref", "include", "alias", "default",
                                                            "path"};

/// Tags of the steps of a `transform`.
inline constexpr std::array<std::string_view, 6> kTransformTags{"translate", "rotate", "scale",
                                                                "lookat",    "lookAt", "matrix"};

/// Tags that another program, Rainbow, added to copies of Mitsuba's scenes: how to run it, and what
/// not to read. They are left out.
inline constexpr std::array<std::string_view, 2> kForeignTags{"mode", "hide"};

/// Whether `tag` is among `tags`.
template <std::size_t n>
bool is_among(std::string_view tag, const std::array<std::string_view, n>& tags) {
  for (const std::string_view known : tags) {
    if (known == tag) return true;
  }
  return false;
}

}  // namespace pharos::mitsuba
