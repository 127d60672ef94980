#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <pharos/core/vec.h>

#include "element.h"

namespace pharos::mitsuba {

/// The words of a text that blanks and commas divide.
std::vector<std::string_view> words(std::string_view text);

/// A finite number without blanks around it; nothing when `text` is none. What is too small for a
/// double is 0.
std::optional<double> parse_number(std::string_view text);

/// The value of an attribute of an element. All throw InputError for anything else.
bool read_boolean(const Element& element, std::string_view attribute);
std::int64_t read_integer(const Element& element, std::string_view attribute);
double read_number(const Element& element, std::string_view attribute);
/// A number that is finite in float.
float read_float(const Element& element, std::string_view attribute);
/// Numbers that are finite in float, with blanks or commas between them.
std::vector<float> read_floats(const Element& element, std::string_view attribute);
/// Three numbers.
Vec3 read_triple(const Element& element, std::string_view attribute);

/// What `x`, `y` and `z` say, or `value` with three numbers or one for all.
Vec3 read_coordinates(const Element& element);
/// The same; of `x`, `y` and `z` some may be left out, which are then `otherwise`.
Vec3 read_coordinates(const Element& element, float otherwise);

}  // namespace pharos::mitsuba
