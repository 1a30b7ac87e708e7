// Triangle meshes in files: STL (text and binary) and Wavefront OBJ in, binary STL out.
//
//   const TriangleMesh wheel = read_mesh("wheel.obj", 1e-3, {.closed = true});  // drawn in millimetres
//   write_stl("wheel.stl", wheel, 1e-3);
#pragma once

#include <filesystem>

#include "dem/surface/triangle_mesh.hpp"

namespace soilbin::dem {

/// Reads .stl, text or binary, or .obj (by assimp, which keeps single precision: 6e-8 of a coordinate). `unit` is the
/// length of the file's unit [m]: 1e-3 for millimetres. Polygons become triangles; points and lines are left out; the
/// normals in the file are not looked at. Axes are taken as they are: x forward, y along the axle, z up.
/// `options.name` is replaced by the file's. Throws InputError, naming the file and, in text STL, the line, where it
/// can't be read, is cut short, or TriangleMesh refuses what is in it.
TriangleMesh read_mesh(const std::filesystem::path& file, double unit, MeshOptions options = {});

/// What such a file holds before anything is checked of its surface, in the file's unit: for who is to find that unit,
/// or to mend it. No other file is opened, whatever this one names. Throws InputError where it can't be read, is larger
/// than largest_mesh or is cut short.
MeshSoup read_triangles(const std::filesystem::path& file);
inline constexpr std::size_t largest_mesh = 1'000'000'000;  ///< [bytes]

/// Writes binary STL, atomically; coordinates in single precision, in lengths of `unit` [m]. std::runtime_error where
/// the system refuses.
void write_stl(const std::filesystem::path& file, const TriangleMesh& mesh, double unit);

}  // namespace soilbin::dem
