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

/// Of a table: 2^16 points.
inline constexpr int kMostBits = 16;

/// Doubles `points`, the first 2^k of a sequence whose every aligned block of 2^j is a
/// (0,j,2)-net, so that this still holds. The k + 1 first digits of every new number follow from
/// the others' (see pmj02.cpp); the rest is taken from the numbers that `seed` and the point's
/// number name. Thus sequences of any length from one seed have the same beginning.
void double_sequence(std::vector<Point>& points, std::uint64_t seed);

/// The first 2^bits points of the sequence of `seed`.
std::vector<Point> sequence(int bits, std::uint64_t seed);

/// Bits of the tables that serve a plan: enough for all samples of a pixel within reason.
int table_bits(const SamplePlan& plan);

/// A sampler over several sequences of 2^bits points, one after the other in `tables`. Each
/// dimension of a pixel takes one of them, in an order of its own that maps prefixes of 2^k to
/// aligned blocks, and flips digits at random, the same ones in all points (Kollig and Keller 2002,
/// "Efficient Multidimensional Sampling"): both keep nets nets.
std::unique_ptr<const PreparedSampler> make_sampler(std::vector<Point> tables, int bits);

}  // namespace pharos::pmj02
