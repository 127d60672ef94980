#pragma once

#include <array>
#include <string>

#include <pharos/core/bounds.h>
#include <pharos/experiments/pictures/learned_file.h>

namespace pharos {

/// The roughness values for which `pharos inspect` shows shares: one of each class of surfaces that
/// the policy `simplex` tells apart.
inline constexpr std::array kShownRoughness{0.05f, 0.25f, 1.0f};

/// Returns the coordinates with six digits, in brackets.
std::string point_text(Point3 p);

/// Prints the facts about all models, and the mean shares of their methods in `bounds`, if the
/// bounds are not empty.
void print_facts(const LearnedFile& file, Bounds3 bounds);

}  // namespace pharos
