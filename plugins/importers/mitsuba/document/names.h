#pragma once

#include <array>
#include <string>
#include <string_view>

#include "document.h"

namespace pharos::mitsuba {

/// Returns the dialect of a version such as "0.6.0" or "3.5.2". Throws InputError (not located) if
/// the text is not a version or the version is not known.
Dialect dialect_of(std::string_view version);

/// Returns `name` as Mitsuba 2 and 3 rewrite names in scenes of dialect 0.x. An upper-case letter
/// after a lower-case letter begins a new word; this letter and the upper-case letters right after
/// it become lower case ("toWorld" becomes "to_world", "intIOR" becomes "int_ior", "sigmaT" becomes
/// "sigma_t").
std::string snake_case(std::string_view name);

/// Returns `text` with its ASCII letters in lower case.
std::string lower_case(std::string_view text);

/// Tags of objects, except the outermost `scene`.
inline constexpr std::array<std::string_view, 16> kObjectTags{
    "shape",   "bsdf",   "emitter", "sensor", "texture",    "film",  "sampler",   "integrator",
    "rfilter", "medium", "phase",   "volume", "subsurface", "field", "luminaire", "camera"};

/// Tags of plain values.
inline constexpr std::array<std::string_view, 12> kValueTags{
    "boolean",   "integer",   "float", "string", "point",    "vector",
    "transform", "animation", "rgb",   "srgb",   "spectrum", "blackbody"};

/// Tags with other purposes: they name objects, files and values.
inline constexpr std::array<std::string_view, 5> kOtherTags{"ref", "include", "alias", "default",
                                                            "path"};

/// Tags of the steps of a `transform`.
inline constexpr std::array<std::string_view, 6> kTransformTags{"translate", "rotate", "scale",
                                                                "lookat",    "lookAt", "matrix"};

/// Tags that another program, Rainbow, added to copies of Mitsuba's scenes. They state how to run
/// it and what not to read. The importer ignores them.
inline constexpr std::array<std::string_view, 2> kForeignTags{"mode", "hide"};

/// Returns whether `tag` is among `tags`.
template <std::size_t n>
bool is_among(std::string_view tag, const std::array<std::string_view, n>& tags) {
  for (const std::string_view known : tags) {
    if (known == tag) return true;
  }
  return false;
}

}  // namespace pharos::mitsuba
