#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <pharos/core/vec.h>

#include "../../shared/numbers.h"
#include "element.h"

namespace pharos::mitsuba {

using importing::parse_number, importing::words;

/// These functions return the value of an attribute of an element. They throw InputError if the
/// text has another format.
bool read_boolean(const Element& element, std::string_view attribute);
std::int64_t read_integer(const Element& element, std::string_view attribute);
double read_number(const Element& element, std::string_view attribute);
/// Returns a number that is finite as a float.
float read_float(const Element& element, std::string_view attribute);
/// Returns numbers that are finite as floats, separated by blanks or commas.
std::vector<float> read_floats(const Element& element, std::string_view attribute);
/// Returns three numbers.
Vec3 read_triple(const Element& element, std::string_view attribute);

/// Returns the coordinates from `x`, `y` and `z`, or from `value` with three numbers or one number
/// for all.
Vec3 read_coordinates(const Element& element);
/// The same. Some of `x`, `y` and `z` may be missing and become `otherwise`.
Vec3 read_coordinates(const Element& element, float otherwise);

}  // namespace pharos::mitsuba
