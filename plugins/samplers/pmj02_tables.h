#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <pharos/sampling/sampler.h>

/// Progressive multi-jittered (0,2) sequences in tables.
namespace pharos::pmj02 {

/// A point of the unit square as two 32-bit fractions.
struct Point {
  std::uint32_t x, y;
};

/// The largest table has 2^16 points.
inline constexpr int kMostBits = 16;

/// Doubles `points`, the first 2^k points of a sequence in which every aligned block of 2^j points
/// is a (0,j,2)-net, and keeps this property. The first k + 1 digits of every new number follow
/// from the other numbers (see pmj02.cpp). The other digits are random numbers, keyed by `seed` and
/// the number of the point. Sequences of any length from one seed therefore begin with the same
/// points.
void double_sequence(std::vector<Point>& points, std::uint64_t seed);

/// Returns the first 2^bits points of the sequence of `seed`.
std::vector<Point> sequence(int bits, std::uint64_t seed);

/// Returns the bits of the tables for a plan: enough for all samples of a pixel within the limits
/// of a table.
int table_bits(const SamplePlan& plan);

/// Makes a sampler from several sequences of 2^bits points, which follow one another in `tables`.
/// Each dimension of a pixel uses one of the sequences. It visits the points in its own order,
/// which maps prefixes of 2^k points to aligned blocks, and flips random digits, the same ones in
/// all points (Kollig and Keller 2002, "Efficient Multidimensional Sampling"). Both operations keep
/// nets nets.
std::unique_ptr<const PreparedSampler> make_sampler(std::vector<Point> tables, int bits);

}  // namespace pharos::pmj02
