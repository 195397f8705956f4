#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "validation/reference/Hit.h"
#include "validation/reference/Textures.h"

namespace tessera::reference {

/// The triangles along a pixel's ray. Embree finds candidates in single precision; each is intersected again in double
/// and kept if it lies within the camera's depths, its material shows that side, and its alpha mask has no hole there.
/// All functions may be called from several threads.
class Visibility {
public:
    /// The objects must outlive it. Throws std::runtime_error when Embree fails, as for lack of memory.
    Visibility(const Objects& objects, const CameraRays& rays, const Textures& textures);
    ~Visibility();

    /// The nearest opaque or alpha-masked surface.
    std::optional<Hit> nearestOpaque(const Ray& ray) const;

    /// The same along any other ray from its origin on, at any distance from the camera.
    std::optional<Hit> nearestOpaqueAhead(const Ray& ray) const;

    /// The exit of a ray from the inside of a body: the nearest back face of the object ahead.
    std::optional<Hit> farSideAhead(const Ray& ray, const Object& object) const;

    /// Transparent surfaces along any other ray, from `fromMetres` to `depthMetres`, the farthest first.
    std::vector<Hit> transparentAhead(const Ray& ray, double fromMetres, double depthMetres) const;

    /// Every opaque or alpha-masked surface not behind `depthMetres`, the nearest first; holes of masks are ignored.
    std::vector<Hit> opaqueBefore(const Ray& ray, double depthMetres) const;

    /// Transparent surfaces not behind `depthMetres`, in the order in which they are blended.
    std::vector<Hit> transparentBefore(const Ray& ray, double depthMetres) const;

private:
    struct Trees;
    std::unique_ptr<Trees> trees_;
};

} // namespace tessera::reference
