#pragma once

#include "document.h"
#include "element.h"
#include "folders.h"

namespace pharos::mitsuba {

/// Returns the color given by a tag `rgb`, `srgb`, `spectrum` or `blackbody`, for an emitter or
/// anything else; see color_matching.h. The `intent` of dialect 0.x is checked and has no effect in
/// RGB.
///
/// `rgb` is linear, also as `#rrggbb`; `srgb` is not linear. A `spectrum` is one number, three
/// numbers (linear RGB), pairs `wavelength:value` [nm] with increasing wavelengths, which is 0
/// outside them, or a text file with one such pair per line, which takes from the budget.
Spectrum read_spectrum(const Element& element, bool of_emitter, const Folders& folders,
                       importing::ReadingBudget& budget);

}  // namespace pharos::mitsuba
