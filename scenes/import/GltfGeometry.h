#pragma once
#include <compare>
#include <optional>

#include "scenes/import/GltfContext.h"

namespace tessera::scenes::gltf {

/// What of a primitive is read beside its rest.
struct Deforms {
    bool byTargets = false;
    bool byJoints = false;
    auto operator<=>(const Deforms&) const = default;
};

/// The triangles of primitive `primitive` of glTF mesh `mesh`, or nothing (with a warning) when it draws none or has no
/// positions. Strips and fans become triangles, points and lines those of solids that have no size yet
/// (GltfThinSolids.h); missing normals become flat ones, for which vertices are unshared. Throws InputError naming the
/// mesh and the accessor.
std::optional<Shape> importPrimitive(Context& context, int mesh, int primitive, Deforms deforms = {});

} // namespace tessera::scenes::gltf
