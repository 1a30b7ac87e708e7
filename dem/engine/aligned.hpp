#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace soilbin::dem {

/// Gives memory on cache lines, so that packs load without straddling two.
template <class T>
struct CacheLines {
  using value_type = T;
  CacheLines() = default;
  template <class U>
  CacheLines(const CacheLines<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), std::align_val_t(64))); }
  void deallocate(T* at, std::size_t) { ::operator delete(at, std::align_val_t(64)); }
  bool operator==(const CacheLines&) const { return true; }
};

template <class T>
using AlignedVector = std::vector<T, CacheLines<T>>;

}  // namespace soilbin::dem
