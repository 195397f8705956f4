#pragma once
#include <cstdint>
#include <optional>

#include <glm/glm.hpp>

#include "validation/reference/Objects.h"

namespace tessera::reference {

/// The end of its tolerance that a texture lookup is moved to: -1, 0 or 1 each.
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
    bool frontFacing = true;    ///< hit on its counter-clockwise side; mirroring transforms swap no sides
    glm::dvec3 toViewer{0.0};   ///< unit, back along the ray; 0 without a viewer
    /// Change of `weights` from the pixel to the next to the right, and to the one above.
    glm::dvec3 weightsDx{0.0}, weightsDy{0.0};
    double perspective = 0.0;    ///< relative change of those differentials over a pixel
    double roundingMetres = 0.0; ///< fp32 rounding error of the triangle's position here
    double roundingPixels = 0.0; ///< the same for the point's place in the image
    double roundingLevels = 0.0; ///< the same for the triangle's rotation and scale, in levels of detail
    Nudge nudge;

    /// Interpolates a vertex attribute at the hit.
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

    /// Interpolates an attribute that is stored per index of the mesh.
    template <class Vector>
    Vector atCorners(const std::vector<Vector>& corners) const {
        Vector sum(0.0);
        for (int corner = 0; corner < 3; ++corner)
            sum += weights[corner] * corners[3 * std::size_t(triangle) + std::size_t(corner)];
        return sum;
    }
};

/// Intersects a ray with the plane of a triangle, also outside the triangle; empty if they are parallel.
std::optional<Hit> hitOf(const Object& object, std::uint32_t triangle, const Ray& ray);

} // namespace tessera::reference
