#include "octree_file.h"

#include <cmath>
#include <cstring>
#include <istream>
#include <ostream>

#include <pharos/core/error.h>

namespace pharos::focal {
namespace {

constexpr char kMagic[8] = {'o', 'c', 't', 'r', 'e', 'e', '0', '1'};
constexpr std::uint32_t kMostNodes = 1u << 24;

template <class T>
void write(std::ostream& out, const T& value) {
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class T>
T read(std::istream& in) {
  T value;
  in.read(reinterpret_cast<char*>(&value), sizeof value);
  if (!in) throw InputError("the focal model is cut off");
  return value;
}

/// Elements come a piece at a time, so that a wrong count costs no memory.
template <class T>
std::vector<T> read_array(std::istream& in, std::size_t count) {
  std::vector<T> values;
  while (values.size() < count) values.push_back(read<T>(in));
  return values;
}

/// Throws unless children follow their parents breadth-first, each once, and densities are sound.
void check_nodes(const std::vector<Octree::Node>& nodes) {
  std::uint32_t next = 1;
  std::vector<int> levels(nodes.size(), 1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (unsigned c = 0; c < 8; ++c) {
      if (nodes[i].is_leaf(c)) {
        if (!std::isfinite(nodes[i].density(c))) throw InputError("the focal model is damaged");
        continue;
      }
      if (nodes[i].index(c) != next || next >= nodes.size() || levels[i] >= Octree::kMostLevels) {
        throw InputError("the focal model is damaged");
      }
      levels[next++] = levels[i] + 1;
    }
  }
  if (next != nodes.size()) throw InputError("the focal model is damaged");
}

}  // namespace

void write_octree(const Octree& octree, std::ostream& out) {
  out.write(kMagic, sizeof kMagic);
  write(out, octree.box());
  write(out, static_cast<std::uint32_t>(octree.nodes().size()));
  for (const Octree::Node& node : octree.nodes()) write(out, node.children);
}

Octree read_octree(std::istream& in) {
  char magic[sizeof kMagic] = {};
  in.read(magic, sizeof magic);
  if (std::memcmp(magic, kMagic, sizeof magic) != 0) {
    throw InputError("the file holds another kind of model than a focal one");
  }
  const Box box = read<Box>(in);
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(box.low[axis]) || !(box.size[axis] > 0) || !std::isfinite(box.size[axis])) {
      throw InputError("the focal model is damaged");
    }
  }
  const auto count = read<std::uint32_t>(in);
  if (count == 0 || count > kMostNodes) throw InputError("the focal model is damaged");
  std::vector<Octree::Node> nodes = read_array<Octree::Node>(in, count);
  check_nodes(nodes);
  return {box, std::move(nodes)};
}

template <class Number>
void write_numbers(const std::vector<Number>& numbers, std::ostream& out) {
  for (const Number number : numbers) write(out, number);
}

template <class Number>
std::vector<Number> read_numbers(std::istream& in, std::size_t count) {
  return read_array<Number>(in, count);
}

template void write_numbers(const std::vector<float>&, std::ostream&);
template void write_numbers(const std::vector<double>&, std::ostream&);
template std::vector<float> read_numbers(std::istream&, std::size_t);
template std::vector<double> read_numbers(std::istream&, std::size_t);

}  // namespace pharos::focal
