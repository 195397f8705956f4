#include "validation/reference/NormalAt.h"

#include "validation/reference/Slots.h"

namespace tessera::reference {

namespace {

glm::dvec3 unitOr(const glm::dvec3& vector, const glm::dvec3& fallback) {
    const double length = glm::length(vector);
    return length > 0.0 ? vector / length : fallback;
}

/// The texel's direction in the frame of tangent, bitangent and normal. What the vertices hold is interpolated as it
/// is; only the sums are made unit, and the bitangent is perpendicular to both whatever the angle between them.
glm::dvec3 fromTangentSpace(const Hit& hit, const glm::dvec3& texel, const glm::dvec3& vertexNormal) {
    const glm::dvec4 tangentOS = hit.at<glm::dvec4>(*hit.object->tangentsOS);
    const glm::dvec3 tangent = unitOr(glm::dmat3(hit.object->relFromObject) * glm::dvec3(tangentOS), glm::dvec3(0.0));
    const glm::dvec3 bitangent = glm::cross(vertexNormal, tangent) * (tangentOS.w * hit.object->handedness);
    const double scale = hit.object->material->normalScale;
    return scale * texel.x * tangent + scale * texel.y * bitangent + texel.z * vertexNormal;
}

} // namespace

glm::dvec3 normalAt(const Hit& hit, const std::vector<scenes::Image>& images) {
    const Object& object = *hit.object;
    const glm::dvec3 vertexNormal =
        unitOr(object.normalFromObject * hit.at<glm::dvec3>(object.mesh->normalsOS), glm::dvec3(0.0, 0.0, 1.0));
    glm::dvec3 normal = vertexNormal;
    if (object.material->texture(scenes::TextureSlot::Normal).image != scenes::kNone) {
        const glm::dvec3 texel = 2.0 * glm::dvec3(texelOf(scenes::TextureSlot::Normal, hit, images)) - 1.0;
        normal =
            unitOr(object.tangentsOS ? fromTangentSpace(hit, texel, vertexNormal) : object.normalFromObject * texel,
                   vertexNormal);
    }
    return object.material->doubleSided && !hit.frontFacing ? -normal : normal;
}

} // namespace tessera::reference
