#pragma once
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "scenes/Scene.h"
#include "validation/reference/CameraRays.h"

namespace tessera::reference {

/// The origin of fp32 positions: the middle of the scene from a far eye, the middle of the visible part under parallel
/// rays, else the eye. So precision is best at the visible points.
struct Anchor {
    glm::dvec3 centreRWS{0.0};
    double radiusMetres = 0.0;      ///< of a ball around the centre that holds all visible points; 0 at the eye
    double otherOriginMetres = 0.0; ///< upper bound of the distance to the product's origin, on the view axis
};

/// Relative rounding error of a position: four fp32 operations on sqrt(3) times the magnitudes it is summed from, and a
/// rotation of the axes, some eight roundings.
inline constexpr double kPositionRounding = 8.0 * 0x1p-24;

/// A mesh that is drawn with a material at a node. RWS: world axes, the eye as the origin.
struct Object {
    const scenes::Mesh* mesh = nullptr;
    const scenes::Material* material = nullptr;
    bool castsShadow = true;
    scenes::SubsurfaceMethod subsurface = scenes::SubsurfaceMethod::None;
    double bodyRadiusMetres = 0.0; ///< scenes::Subsurface::bodyRadiusMetres, or its default
    std::uint32_t number = 0;      ///< among all mesh instances of the scene, in document order
    glm::dmat4 rwsFromObject{1.0};
    glm::dmat3 normalFromObject{1.0};                    ///< cofactor matrix times the determinant's sign
    double handedness = 1.0;                             ///< -1 where the transform mirrors
    const std::vector<glm::dvec4>* tangentsOS = nullptr; ///< per index of the mesh, where the material needs them
    Anchor anchor;                                       ///< the same for all objects

    glm::dvec3 cornerRWS(std::uint32_t triangle, int corner) const {
        const std::uint32_t vertex = mesh->indices[3 * std::size_t(triangle) + std::size_t(corner)];
        return glm::dvec3(rwsFromObject * glm::dvec4(glm::dvec3(mesh->positionsOS[vertex]), 1.0));
    }

    /// The magnitudes that a corner's position is summed from, which scale its rounding: the distance to the object,
    /// and the root of the sum of squares of the three products within it, whose sum is at most sqrt(3) times that.
    double cornerReach(std::uint32_t triangle, int corner) const {
        const std::uint32_t vertex = mesh->indices[3 * std::size_t(triangle) + std::size_t(corner)];
        glm::dvec3 products;
        for (int axis = 0; axis < 3; ++axis)
            products[axis] = glm::length(glm::dvec3(rwsFromObject[axis])) * double(mesh->positionsOS[vertex][axis]);
        return glm::length(glm::dvec3(rwsFromObject[3]) - anchor.centreRWS) + anchor.otherOriginMetres +
               glm::length(products);
    }
};

/// All drawn objects of a scene, relative to an eye. The scene must outlive the object.
class Objects {
public:
    /// `besideRWS`: boxes around other visible things, which the anchor includes.
    Objects(const scenes::Scene& scene, const CameraRays& rays, scenes::SubsurfaceRequest subsurface = {},
            const std::vector<scenes::Box3>& besideRWS = {});
    /// Only the objects whose mesh's box the ray meets: all that it can hit.
    Objects(const scenes::Scene& scene, const CameraRays& rays, const Ray& only);

    const std::vector<Object>& opaque() const { return opaque_; } ///< alpha-masked ones too
    /// In the order in which they are blended: far to near by the depth of their mesh's box centre, ties by number.
    const std::vector<Object>& transparent() const { return transparent_; }
    const Anchor& anchor() const { return anchor_; }
    /// The largest fp32 rounding error of any corner.
    double roundingMetres() const { return roundingMetres_; }
    /// The largest rounding error beyond kPositionRounding times the corner's distance from a place.
    double roundingBeyondMetres(const glm::dvec3& placeRWS) const;

private:
    Objects(const scenes::Scene& scene, const CameraRays& rays, scenes::SubsurfaceRequest subsurface,
            const std::vector<scenes::Box3>& besideRWS, const Ray* only);
    void add(const scenes::Scene& scene, const scenes::MeshInstance& instance, const glm::dmat4& worldFromNode,
             const CameraRays& rays, scenes::SubsurfaceRequest subsurface, const Ray* only, std::uint32_t number);
    void setBodyRadii();
    const std::vector<glm::dvec4>& tangentsOf(const scenes::Mesh& mesh, const scenes::Material& material);

    Anchor anchor_;
    double roundingMetres_ = 0.0;
    std::vector<Object> opaque_, transparent_;
    std::map<std::pair<const scenes::Mesh*, const scenes::Material*>, std::unique_ptr<std::vector<glm::dvec4>>>
        tangents_;
};

} // namespace tessera::reference
