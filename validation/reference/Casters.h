#pragma once
#include <vector>

#include "validation/reference/Hit.h"
#include "validation/reference/LightAt.h"
#include "validation/reference/Textures.h"
#include "validation/reference/Trees.h"

namespace tessera::reference {

/// From a point to where the light is, or past all casters. Relative to the casters' centre.
struct Segment {
    glm::dvec3 from{0.0}, along{0.0};
};

/// What casts shadows (scenes/Shadows.h). Embree finds the candidates in single precision; each is met again in double.
/// May be used by several threads.
class Casters {
public:
    /// The objects must outlive it. Throws as makeTree().
    Casters(const scenes::Scene& scene, const Objects& objects);

    bool empty() const { return !tree_; }
    /// Segments begin relative to it.
    const glm::dvec3& centreRWS() const { return anchor_.centreRWS; }
    /// Around the centre, all casters.
    double radiusMetres() const { return radiusMetres_; }

    struct Met {
        bool isHidden = false;
        bool isUndecided = false;      ///< a mask may have another texel there
        std::vector<double> crossings; ///< of what is passed, as shares of the segment; minus those where it goes in
    };
    /// Between the segment's ends. `own` is null where it begins above a surface, else the triangle there counts as no
    /// caster. What has the material `passed` hides nothing, and its crossings are told.
    Met meet(const Segment& segment, const Hit* own, const scenes::Material* passed = nullptr) const;

    /// A program holds the point and the light to single precision relative to an origin of its own, and the casters to
    /// another: twice eight roundings of both. It may call a triangle's plane the point's own within as much again.
    double leewayMetres(const glm::dvec3& placeRWS) const;

    /// The same of the other end of a way to a light: its place, or (not placed) what the way there is turned by. A
    /// direction is rounded as a position is.
    double leewayMetres(bool isPlaced, const ShiningLight& light, double pointMetres, double wayMetres) const {
        return isPlaced ? leewayMetres(light.positionRWS) : pointMetres + kPositionRounding * wayMetres;
    }

private:
    Textures textures_;         ///< a shadow has no size in pixels, so level 0 counts
    Anchor anchor_;             ///< Embree's origin: the digits are where the pixels look
    double radiusMetres_ = 0.0; ///< as radiusMetres()
    double originMetres_ = 0.0; ///< from it to the product's origin of casters, their corners' median on each axis
    /// By how much rounding may move what is drawn, beyond that of its distance from both.
    double roundingMetres_ = 0.0;
    Device device_;
    Tree tree_; ///< null without casters
};

} // namespace tessera::reference
