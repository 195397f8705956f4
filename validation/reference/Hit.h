#pragma once
#include <cstdint>
#include <optional>

#include <glm/glm.hpp>

#include "validation/reference/Objects.h"

namespace tessera::reference {

/// Towards which end of its leeway a texture lookup goes: -1, 0 or 1 each.
struct Nudge {
    glm::ivec2 texCoord{0};
    int level = 0;
    glm::ivec2 texel{0}; ///< red and blue, green and alpha
    bool operator==(const Nudge&) const = default;
};

/// Where a ray meets a triangle, in double precision.
struct Hit {
    const Object* object = nullptr;
    std::uint32_t triangle = 0; ///< of the object's mesh
    glm::dvec3 weights{0.0};    ///< barycentric, of the triangle's corners
    double depthMetres = 0.0;   ///< ahead of the eye
    bool frontFacing = true;    ///< seen from its counter-clockwise side; a mirroring transform turns no side round
    glm::dvec3 toViewer{0.0};   ///< unit, of a hit of the camera's ray; 0 where nobody looks
    /// Change of `weights` from the pixel to the next to the right, and to the one above.
    glm::dvec3 weightsDx{0.0}, weightsDy{0.0};
    double perspective = 0.0;    ///< relative difference of those changes one pixel further
    double roundingMetres = 0.0; ///< by how much rounding to fp32 may move the triangle here
    double roundingPixels = 0.0; ///< by how much it may move the point over the picture
    double roundingLevels = 0.0; ///< and by how much turn or stretch the triangle, in levels of detail
    Nudge nudge;

    /// Whatever the mesh holds a vertex, at the point that is met.
    template <class Vector, class Stored>
    Vector at(const std::vector<Stored>& vertices) const {
        return weighted<Vector>(vertices, weights);
    }

    /// The same sum over the corners with other weights.
    template <class Vector, class Stored>
    Vector weighted(const std::vector<Stored>& vertices, const glm::dvec3& cornerWeights) const {
        Vector sum(0.0);
        for (int corner = 0; corner < 3; ++corner) {
            const std::size_t index = 3 * std::size_t(triangle) + std::size_t(corner);
            sum += cornerWeights[corner] * Vector(vertices[object->mesh->indices[index]]);
        }
        return sum;
    }

    /// Whatever belongs to each of the mesh's indices, at the point that is met.
    template <class Vector>
    Vector atCorners(const std::vector<Vector>& corners) const {
        Vector sum(0.0);
        for (int corner = 0; corner < 3; ++corner)
            sum += weights[corner] * corners[3 * std::size_t(triangle) + std::size_t(corner)];
        return sum;
    }
};

/// Where a ray meets the plane of a triangle, which may be outside it; nothing where it runs along it.
std::optional<Hit> hitOf(const Object& object, std::uint32_t triangle, const Ray& ray);

} // namespace tessera::reference
