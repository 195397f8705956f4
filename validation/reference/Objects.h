#pragma once
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "scenes/Scene.h"
#include "validation/reference/CameraRays.h"

namespace tessera::reference {

/// Where positions in single precision have their origin: the middle of the scene from a far eye, the middle of what
/// the picture shows under parallel rays, else the eye. The digits are where the pixels look.
struct Anchor {
    glm::dvec3 centreRWS{0.0};
    double radiusMetres = 0.0;      ///< around the centre, which holds all that pixels see; 0 at the eye
    double otherOriginMetres = 0.0; ///< the product's origin, on the view axis beside all this, is at most so far away
};

/// What rounding leaves of a position: four operations in fp32 of sqrt(3) times what it is added up from, and a turn of
/// the axes, some eight roundings.
inline constexpr double kPositionRounding = 8.0 * 0x1p-24;

/// A mesh as it is drawn with a material at a node. RWS: world axes, the eye as the origin.
struct Object {
    const scenes::Mesh* mesh = nullptr;
    const scenes::Material* material = nullptr;
    bool castsShadow = true;
    scenes::SubsurfaceMethod subsurface = scenes::SubsurfaceMethod::None;
    double bodyRadiusMetres = 0.0; ///< scenes::Subsurface::bodyRadiusMetres, or what it stands for
    std::uint32_t number = 0;      ///< among all mesh instances of the scene, in document order
    glm::dmat4 rwsFromObject{1.0};
    glm::dmat3 normalFromObject{1.0};                    ///< cofactor matrix times the determinant's sign
    double handedness = 1.0;                             ///< -1 where the transform mirrors
    const std::vector<glm::dvec4>* tangentsOS = nullptr; ///< by index of the mesh, where the material needs them
    Anchor anchor;                                       ///< of all objects

    glm::dvec3 cornerRWS(std::uint32_t triangle, int corner) const {
        const std::uint32_t vertex = mesh->indices[3 * std::size_t(triangle) + std::size_t(corner)];
        return glm::dvec3(rwsFromObject * glm::dvec4(glm::dvec3(mesh->positionsOS[vertex]), 1.0));
    }

    /// The magnitudes that a corner's position is added up from, which rounding goes with: of the way to the object,
    /// and of the three products within it, whose sum is at most sqrt(3) times the root of their squares' sum.
    double cornerReach(std::uint32_t triangle, int corner) const {
        const std::uint32_t vertex = mesh->indices[3 * std::size_t(triangle) + std::size_t(corner)];
        glm::dvec3 products;
        for (int axis = 0; axis < 3; ++axis)
            products[axis] = glm::length(glm::dvec3(rwsFromObject[axis])) * double(mesh->positionsOS[vertex][axis]);
        return glm::length(glm::dvec3(rwsFromObject[3]) - anchor.centreRWS) + anchor.otherOriginMetres +
               glm::length(products);
    }
};

/// All that a scene draws, seen from an eye. The scene must outlive the object.
class Objects {
public:
    /// `besideRWS`: boxes around what else pixels show, which counts for the anchor.
    Objects(const scenes::Scene& scene, const CameraRays& rays, scenes::SubsurfaceRequest subsurface = {},
            const std::vector<scenes::Box3>& besideRWS = {});
    /// Only those whose mesh's box the ray meets: all that it can hit, and no more is prepared.
    Objects(const scenes::Scene& scene, const CameraRays& rays, const Ray& only);

    const std::vector<Object>& opaque() const { return opaque_; } ///< alpha-masked ones too
    /// In the order in which they are blended: far to near by the depth of their mesh's box centre, ties by number.
    const std::vector<Object>& transparent() const { return transparent_; }
    const Anchor& anchor() const { return anchor_; }
    /// By how much rounding to fp32 moves any corner at most.
    double roundingMetres() const { return roundingMetres_; }
    /// The same beyond kPositionRounding of the distance of what is moved from a place.
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
