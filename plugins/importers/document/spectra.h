#pragma once

#include "document.h"
#include "element.h"
#include "folders.h"

namespace pharos::mitsuba {

/// The color that a tag `rgb`, `srgb`, `spectrum` or `blackbody` says, for an emitter or anything
/// else: see color_matching.h. The `intent` of dialect 0.x is checked, and has no effect in RGB.
///
/// `rgb` is linear, also as `#rrggbb`; `srgb` is not. A `spectrum` is one number, three (linear
/// RGB), pairs `wavelength:value` [nm] with rising wavelengths, 0 outside them, or a text file of
/// such pairs, one a line, which takes from the budget.
Spectrum read_spectrum(const Element& element, bool of_emitter, const Folders& folders,
                       ReadingBudget& budget);

}  // namespace pharos::mitsuba
