#include "validation/reference/NormalAt.h"

#include <algorithm>
#include <cmath>

#include "validation/reference/Slots.h"
#include "validation/reference/TangentFrame.h"

namespace tessera::reference {

namespace {

glm::dvec3 unitOr(const glm::dvec3& vector, const glm::dvec3& fallback) {
    const double length = glm::length(vector);
    return length > 0.0 ? vector / length : fallback;
}

/// Transforms a texel's direction from tangent space. Vertex attributes are interpolated unnormalised; only the sums
/// are normalised. The bitangent is perpendicular to both for any angle between them.
glm::dvec3 fromTangentSpace(const Hit& hit, const glm::dvec3& texel, const glm::dvec3& vertexNormal) {
    const glm::dvec4 tangentOS = hit.atCorners(*hit.object->tangentsOS);
    const glm::dvec3 tangent = unitOr(glm::dmat3(hit.object->rwsFromObject) * glm::dvec3(tangentOS), glm::dvec3(0.0));
    const glm::dvec3 bitangent = glm::cross(vertexNormal, tangent) * (tangentOS.w * hit.object->handedness);
    return texel.x * tangent + texel.y * bitangent + texel.z * vertexNormal;
}

glm::dvec3 vertexNormalAt(const Hit& hit) {
    const Object& object = *hit.object;
    return unitOr(object.normalFromObject * hit.at<glm::dvec3>(object.mesh->normalsOS), glm::dvec3(0.0, 0.0, 1.0));
}

glm::dvec3 facing(const Hit& hit, const glm::dvec3& normal) {
    return hit.object->material->doubleSided && !hit.frontFacing ? -normal : normal;
}

/// Decodes a normal map's texel to its direction.
glm::dvec3 directionOf(scenes::TextureSlot slot, const Hit& hit, const Textures& textures) {
    return 2.0 * glm::dvec3(texelOf(slot, hit, textures)) - 1.0;
}

/// The cosine between the geometric normal and the viewer's direction.
double facetCosine(const Hit& hit) {
    const glm::dvec3 a = hit.object->cornerRWS(hit.triangle, 0);
    const glm::dvec3 area =
        glm::cross(hit.object->cornerRWS(hit.triangle, 1) - a, hit.object->cornerRWS(hit.triangle, 2) - a);
    return std::abs(glm::dot(glm::normalize(area), hit.toViewer));
}

/// Flips a normal to the visible side and bends it towards the viewer.
glm::dvec3 turnedTo(const Hit& hit, const glm::dvec3& normal) {
    const glm::dvec3 front = facing(hit, normal);
    if (hit.toViewer == glm::dvec3(0.0)) return front;
    return bentToViewer(front, hit.toViewer, std::min(kLeastFacing, 0.5 * facetCosine(hit)));
}

} // namespace

glm::dvec3 bentToViewer(const glm::dvec3& normal, const glm::dvec3& toViewer, double leastCosine) {
    const double cosine = glm::dot(normal, toViewer);
    if (cosine >= leastCosine) return normal;
    // In the plane of both, by components along the viewer's direction and across it.
    const glm::dvec3 across = normal - cosine * toViewer;
    return unitOr(across + leastCosine * toViewer, normal);
}

glm::dvec3 normalAt(const Hit& hit, const Textures& textures) {
    const Object& object = *hit.object;
    const scenes::Material& material = *object.material;
    const glm::dvec3 vertexNormal = vertexNormalAt(hit);
    glm::dvec3 normal = vertexNormal;
    if (material.texture(scenes::TextureSlot::Normal).image != scenes::kNone) {
        const glm::dvec3 texel = directionOf(scenes::TextureSlot::Normal, hit, textures);
        const double scale = material.normalScale;
        const bool inObjectSpace = material.normalMapSpace == scenes::NormalMapSpace::Object;
        normal = unitOr(inObjectSpace ? object.normalFromObject * texel
                                      : fromTangentSpace(hit, texel * glm::dvec3(scale, scale, 1.0), vertexNormal),
                        vertexNormal);
    }
    return turnedTo(hit, normal);
}

glm::dvec3 coatNormalAt(const Hit& hit, const Textures& textures) {
    const scenes::Material& material = *hit.object->material;
    const glm::dvec3 vertexNormal = vertexNormalAt(hit);
    if (material.texture(scenes::TextureSlot::ClearcoatNormal).image == scenes::kNone)
        return turnedTo(hit, vertexNormal);
    const glm::dvec3 texel = directionOf(scenes::TextureSlot::ClearcoatNormal, hit, textures);
    const double scale = material.clearcoatNormalScale;
    const glm::dvec2 leaning = alongTangents(material, scenes::TextureSlot::ClearcoatNormal, scale * glm::dvec2(texel));
    const glm::dvec3 mapped = fromTangentSpace(hit, {leaning, texel.z}, vertexNormal);
    return turnedTo(hit, unitOr(mapped, vertexNormal));
}

glm::dvec3 tangentAt(const Hit& hit, const glm::dvec3& normal, const glm::dvec2& direction) {
    const glm::dvec3 turned = fromTangentSpace(hit, {direction, 0.0}, vertexNormalAt(hit));
    const glm::dvec3 flat = turned - glm::dot(normal, turned) * normal;
    const glm::dvec3 other = std::abs(normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    return unitOr(flat, glm::normalize(glm::cross(normal, other)));
}

} // namespace tessera::reference
