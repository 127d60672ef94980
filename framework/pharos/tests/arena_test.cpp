#include <cstdint>

#include <doctest/doctest.h>

#include <pharos/core/arena.h>

using namespace pharos;

namespace {

struct Point {
  int x, y;
  Point(int x_, int y_) : x(x_), y(y_) {}
};

struct alignas(64) Wide {
  float values[16];
};

}  // namespace

TEST_CASE("objects keep their values side by side") {
  Arena arena(64);
  Point* points[100];
  for (int i = 0; i < 100; ++i) points[i] = arena.make<Point>(i, -i);
  for (int i = 0; i < 100; ++i) {
    CHECK(points[i]->x == i);
    CHECK(points[i]->y == -i);
  }
}

TEST_CASE("alignment holds after objects of any size") {
  Arena arena(256);
  for (int i = 0; i < 50; ++i) {
    arena.make<char>('a');
    CHECK(reinterpret_cast<std::uintptr_t>(arena.make<double>(1.0)) % alignof(double) == 0);
    CHECK(reinterpret_cast<std::uintptr_t>(arena.make<Wide>()) % alignof(Wide) == 0);
  }
}

TEST_CASE("arrays are zeroed, also in memory used before") {
  Arena arena(1024);
  int* first = arena.make_array<int>(100);
  for (int i = 0; i < 100; ++i) first[i] = 7;
  arena.reset();
  const int* second = arena.make_array<int>(100);
  CHECK(second == first);
  for (int i = 0; i < 100; ++i) CHECK(second[i] == 0);
}

TEST_CASE("objects larger than a block fit, and reset takes the same memory again") {
  Arena arena(64);
  const auto fill = [&] {
    arena.make<Point>(1, 2);
    int* large = arena.make_array<int>(1000);
    large[999] = 1;
    return std::pair<int*, Point*>(large, arena.make<Point>(3, 4));
  };
  const auto before = fill();
  arena.reset();
  const auto after = fill();
  CHECK(before == after);
  CHECK(after.first[999] == 1);
  CHECK(after.second->x == 3);
}
