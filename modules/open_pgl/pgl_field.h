#pragma once

#include <memory>
#include <openpgl/cpp/OpenPGL.h>
#include <string>

#include <pharos/core/archive.h>
#include <pharos/core/bounds.h>
#include <pharos/core/vec.h>

/// Helpers for the library's fields beyond its own interface.
namespace pharos::open_pgl {

inline pgl_point3f to_point(Point3 p) {
  return openpgl::cpp::Point3(p.x, p.y, p.z);
}
inline pgl_vec3f to_vector(Vec3 v) {
  return openpgl::cpp::Vector3(v.x, v.y, v.z);
}

/// Returns the library's device. There is one for the process, because a device limits the number
/// of threads of the whole process.
openpgl::cpp::Device& device();

/// Returns the bytes of the file in which the library stores a field. Throws RunError if no file
/// can be written.
std::string bytes_of(const openpgl::cpp::Field& field);
/// Returns the field for bytes of bytes_of(). Throws InputError if the library refuses them.
std::unique_ptr<openpgl::cpp::Field> field_of(const std::string& bytes);

/// Saves or loads a field's bytes with a checksum, because the library does not validate what it
/// loads.
void archive_bytes(Archive& archive, std::string& bytes);

}  // namespace pharos::open_pgl
