#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "octree.h"

namespace pharos::focal {

/// The file form of octrees and of numbers beside them: little-endian as in memory.
void write_octree(const Octree& octree, std::ostream& out);
/// What write_octree() wrote. Throws InputError when it is cut off or no octree.
Octree read_octree(std::istream& in);

template <class Number>
void write_numbers(const std::vector<Number>& numbers, std::ostream& out);
/// `count` numbers that write_numbers() wrote. Throws InputError when there are fewer.
template <class Number>
std::vector<Number> read_numbers(std::istream& in, std::size_t count);

}  // namespace pharos::focal
