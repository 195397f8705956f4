#pragma once
#include <optional>

#include "scenes/import/GltfContext.h"

namespace tessera::scenes::gltf {

/// The triangles of primitive `primitive` of glTF mesh `mesh`, or nothing (with a warning) when it draws points or
/// lines or has no positions. Strips and fans become triangles; missing normals become flat ones, for which vertices
/// are unshared. Throws InputError naming the mesh and the accessor.
std::optional<Mesh> importPrimitive(Context& context, int mesh, int primitive);

} // namespace tessera::scenes::gltf
