#pragma once
#include "validation/reference/LightAt.h"

/// The images of area lights (scenes/LightTexture.h), texel by texel and in double precision.
namespace tessera::reference {

/// Radiance factors of a flat light's surface along directions from a point; 1 where the light has no image.
class LightSurface {
public:
    /// `toMiddle` leads from the point to the light's middle; the light must outlive the object.
    LightSurface(const ShiningLight& shining, const glm::dvec3& toMiddle);

    bool isEven() const { return !light_.texture; }
    /// Where a direction from the point meets the light's plane, in texels from the top left corner of its image.
    glm::dvec2 texelsAt(const glm::dvec3& direction) const;
    glm::dvec3 factorAt(const glm::dvec3& direction) const;

private:
    const scenes::Light& light_;
    glm::dvec3 toMiddle_, along_, across_;
    glm::dvec2 halfMetres_;
};

/// The mean factor over the surface of a light.
glm::dvec3 meanFactor(const scenes::Light& light);

} // namespace tessera::reference
