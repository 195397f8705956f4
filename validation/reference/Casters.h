#pragma once
#include <vector>

#include "validation/reference/Hit.h"
#include "validation/reference/LightAt.h"
#include "validation/reference/Textures.h"
#include "validation/reference/Trees.h"

namespace tessera::reference {

/// A shadow ray from a point to the light's position, or past all casters. Relative to the casters' centre.
struct Segment {
    glm::dvec3 from{0.0}, along{0.0};
};

/// The shadow casters (scenes/Shadows.h). Embree finds candidates in single precision; each is intersected again in
/// double. May be used by several threads.
class Casters {
public:
    /// The objects must outlive it. Throws as makeTree().
    Casters(const scenes::Scene& scene, const Objects& objects);

    bool empty() const { return !tree_; }
    /// The origin of segments.
    const glm::dvec3& centreRWS() const { return anchor_.centreRWS; }
    /// Radius of a ball around the centre that holds all casters.
    double radiusMetres() const { return radiusMetres_; }

    struct Met {
        bool isHidden = false;
        bool isUndecided = false;      ///< rounding may select another texel of a mask there
        std::vector<double> crossings; ///< of the passed material, in fractions of the segment; negative: enters there
    };
    /// Finds casters between the segment's ends. `own` is the hit where it begins, whose triangle is no caster, or null
    /// if it begins above a surface. Objects of the material `passed` hide nothing; their crossings are reported.
    Met meet(const Segment& segment, const Hit* own, const scenes::Material* passed = nullptr) const;

    /// Rounding tolerance of a position. A program holds point and light in fp32 relative to one origin, casters to
    /// another: twice eight roundings of both. It may take a triangle's plane for the point's own within as much again.
    double toleranceMetres(const glm::dvec3& placeRWS) const;

    /// The same for the other end of a shadow ray: the light's position, or (not placed) the end of a ray with a
    /// rounded direction. A direction is rounded as a position is.
    double toleranceMetres(bool isPlaced, const ShiningLight& light, double pointMetres, double wayMetres) const {
        return isPlaced ? toleranceMetres(light.positionRWS) : pointMetres + kPositionRounding * wayMetres;
    }

private:
    Textures textures_; ///< shadows have no footprint, so level 0 is read
    Anchor anchor_;     ///< Embree's origin: fp32 is finest near the visible points
    double radiusMetres_ = 0.0;
    double originMetres_ = 0.0; ///< from the anchor to the product's caster origin, the corners' median per axis
    /// Rounding of drawn positions, beyond that by their distance from both origins.
    double roundingMetres_ = 0.0;
    Device device_;
    Tree tree_; ///< null without casters
};

} // namespace tessera::reference
