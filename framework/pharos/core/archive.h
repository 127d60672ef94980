#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <istream>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <pharos/core/bounds.h>
#include <pharos/core/error.h>
#include <pharos/core/rgb.h>
#include <pharos/core/vec.h>

namespace pharos {

static_assert(std::endian::native == std::endian::little, "archives are little-endian");

/// A binary stream that saves or loads. Types describe their saved form once, in a member function
///
///     void archive(Archive& archive) { archive(count_, values_); }
///
/// which writes to an archive that saves and reads from one that loads. Saving changes nothing in
/// the object, so that other threads may use it meanwhile. Numbers keep the form that they have in
/// memory. Loading throws InputError if the stream ends early, if a floating-point
/// number is NaN or infinite, and if an expectation fails; the object is then in an unspecified but
/// destructible state. Memory grows only as data arrive, so a damaged count costs none.
class Archive {
 public:
  explicit Archive(std::ostream& out) : out_(&out) {}
  explicit Archive(std::istream& in) : in_(&in) {}

  /// Whether objects are read; otherwise they are written.
  bool loads() const { return in_ != nullptr; }

  /// Saves or loads the values in this order: numbers, enumerations, strings, vectors of the core
  /// library and of Eigen, arrays, std::vector, std::optional, and types with a member archive().
  template <class... Ts>
  void operator()(Ts&... values) {
    (value(values), ...);
  }

  /// A floating-point number that may be infinite or NaN.
  template <class T>
  void unchecked(T& number) {
    static_assert(std::is_arithmetic_v<T>);
    bytes(&number, sizeof number);
  }

  /// A list whose elements have no default constructor: loading begins with `make()` each.
  template <class T, class Make>
  void list(std::vector<T>& values, Make&& make) {
    auto count = static_cast<std::uint64_t>(values.size());
    value(count);
    if (loads()) values.clear();
    for (std::uint64_t i = 0; i < count; ++i) {
      if (loads()) values.push_back(make());
      value(values[i]);
    }
  }

  /// A list of plain values, such as pixels, as it lies in memory. This is much faster than one
  /// number at a time. Numbers may be infinite or NaN. What goes into files has no gaps between its
  /// members, because their content is arbitrary.
  template <class T>
  void block(std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    auto count = static_cast<std::uint64_t>(values.size());
    value(count);
    if (!loads()) return bytes(values.data(), count * sizeof(T));
    values.clear();
    while (values.size() < count) {
      const std::size_t begin = values.size();
      values.resize(begin + std::min<std::uint64_t>(count - begin, kChunk / sizeof(T) + 1));
      bytes(values.data() + begin, (values.size() - begin) * sizeof(T));
    }
  }

  /// Begins a named part. Loading throws InputError unless the same name and version were saved.
  void heading(std::string_view name, std::uint32_t version);

  /// Checks what was loaded: throws InputError("`what` is damaged") if it does not hold.
  void expect(bool holds, std::string_view what) const;

 private:
  /// Blocks are loaded in parts of this size [bytes].
  static constexpr std::uint64_t kChunk = 1 << 20;

  template <class T>
  void value(T& x) {
    if constexpr (std::is_same_v<T, bool>) {
      auto byte = static_cast<std::uint8_t>(x);
      bytes(&byte, sizeof byte);
      if (loads()) x = byte != 0;
    } else if constexpr (std::is_floating_point_v<T>) {
      bytes(&x, sizeof x);
      if (loads() && !std::isfinite(x)) throw InputError("what was saved is damaged");
    } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      bytes(&x, sizeof x);
    } else if constexpr (requires { x.reshaped(); }) {  // a vector or matrix of Eigen
      for (auto& number : x.reshaped()) value(number);
    } else {
      x.archive(*this);
    }
  }
  void value(Vec2& v) { (*this)(v.x, v.y); }
  void value(Vec3& v) { (*this)(v.x, v.y, v.z); }
  void value(Rgb& c) { (*this)(c.r, c.g, c.b); }
  void value(Bounds3& b) {
    for (Point3* p : {&b.low, &b.high}) {
      for (int axis = 0; axis < 3; ++axis) unchecked((*p)[axis]);  // infinite if empty
    }
  }
  void value(std::string& text);
  template <class T, std::size_t N>
  void value(std::array<T, N>& values) {
    for (T& x : values) value(x);
  }
  template <class T, std::size_t N>
  void value(T (&values)[N]) {
    for (T& x : values) value(x);
  }
  template <class T>
  void value(std::vector<T>& values) {
    list(values, [] { return T{}; });
  }
  template <class T>
  void value(std::optional<T>& x) {
    bool has_value = x.has_value();
    value(has_value);
    if (loads()) x = has_value ? std::optional<T>(T{}) : std::nullopt;
    if (has_value) value(*x);
  }

  void bytes(void* data, std::size_t size) {
    if (loads()) {
      in_->read(static_cast<char*>(data), static_cast<std::streamsize>(size));
      if (!*in_) throw InputError("what was saved is cut off");
    } else {
      out_->write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
    }
  }

  std::ostream* out_ = nullptr;
  std::istream* in_ = nullptr;
};

/// Writes an object's saved form.
template <class T>
void save(std::ostream& out, const T& object) {
  Archive archive(out);
  // A saving archive only reads the object; archive() is not const because it loads, too.
  archive(const_cast<T&>(object));
}

/// Reads an object's saved form. Throws InputError; the object is to be discarded then.
template <class T>
void load(std::istream& in, T& object) {
  Archive archive(in);
  archive(object);
}

}  // namespace pharos
