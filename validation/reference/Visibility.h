#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "validation/reference/Hit.h"
#include "validation/reference/Textures.h"

namespace tessera::reference {

/// Which triangles a pixel's ray sees. Embree finds the candidates in single precision; every one is met again in
/// double and kept when the camera's depths hold it, its material shows that side, and its alpha mask has no hole
/// there. All functions may be called from several threads.
class Visibility {
public:
    /// The objects must outlive it. Throws std::runtime_error when Embree fails, as for lack of memory.
    Visibility(const Objects& objects, const CameraRays& rays, const Textures& textures);
    ~Visibility();

    /// The nearest opaque or alpha-masked surface.
    std::optional<Hit> nearestOpaque(const Ray& ray) const;

    /// The same along any other ray, from its origin on, however near or far from the camera.
    std::optional<Hit> nearestOpaqueAhead(const Ray& ray) const;

    /// Where a ray inside a body leaves the object: the nearest of its triangles ahead that show the ray their back.
    std::optional<Hit> farSideAhead(const Ray& ray, const Object& object) const;

    /// Transparent surfaces along any other ray, from a depth on, not behind another, the farthest first.
    std::vector<Hit> transparentAhead(const Ray& ray, double fromMetres, double depthMetres) const;

    /// Every opaque or alpha-masked surface not behind `depthMetres`, the nearest first; masks have no holes.
    std::vector<Hit> opaqueBefore(const Ray& ray, double depthMetres) const;

    /// Transparent surfaces not behind `depthMetres`, in the order in which they are blended.
    std::vector<Hit> transparentBefore(const Ray& ray, double depthMetres) const;

private:
    struct Trees;
    std::unique_ptr<Trees> trees_;
};

} // namespace tessera::reference
