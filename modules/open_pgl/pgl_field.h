#pragma once

#include <memory>
#include <openpgl/cpp/OpenPGL.h>
#include <string>

#include <pharos/core/bounds.h>
#include <pharos/core/vec.h>

/// What the library's fields need here beyond what its own interface offers.
namespace pharos::open_pgl {

inline pgl_point3f to_point(Point3 p) {
  return openpgl::cpp::Point3(p.x, p.y, p.z);
}
inline pgl_vec3f to_vector(Vec3 v) {
  return openpgl::cpp::Vector3(v.x, v.y, v.z);
}

/// The library's device: one for the process, as it limits the number of threads of all of it.
openpgl::cpp::Device& device();

/// A field as the library stores it in files. Throws RunError when no file can be written.
std::string bytes_of(const openpgl::cpp::Field& field);
/// The field that bytes_of() made `bytes` of. Throws InputError when the library refuses them.
std::unique_ptr<openpgl::cpp::Field> field_of(const std::string& bytes);

/// A field's bytes with their length and a checksum, since the library trusts what it loads.
void save_bytes(const std::string& bytes, std::ostream& out);
/// Throws InputError when anything else stands there or a bit of it is wrong.
std::string load_bytes(std::istream& in);

}  // namespace pharos::open_pgl
