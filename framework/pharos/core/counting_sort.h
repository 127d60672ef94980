#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <pharos/core/parallel.h>

namespace pharos {

/// Sorts `items` by their keys. Items with equal keys keep their order. `key_of(i)` returns the key
/// of `items[i]`, a number below `keys`; it is called concurrently. Returns `keys` + 1 numbers: the
/// index at which the items of each key begin, and the number of items.
template <class Item, class KeyOf>
std::vector<std::size_t> sort_by_key(std::vector<Item>& items, std::size_t keys, KeyOf&& key_of) {
  std::vector<std::uint32_t> key(items.size());
  parallel_for(items.size(), [&](std::size_t i) { key[i] = key_of(i); });
  std::vector<std::size_t> first(keys + 1, 0);
  for (const std::uint32_t k : key) ++first[k + 1];
  for (std::size_t k = 0; k < keys; ++k) first[k + 1] += first[k];
  std::vector<std::size_t> next(first.begin(), first.end() - 1);
  std::vector<Item> sorted(items.size());
  for (std::size_t i = 0; i < items.size(); ++i) sorted[next[key[i]]++] = items[i];
  items = std::move(sorted);
  return first;
}

}  // namespace pharos
