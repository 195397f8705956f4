#pragma once
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "validation/reference/Layers.h"
#include "validation/reference/SeenLights.h"
#include "validation/reference/Visibility.h"

namespace tessera::reference {

/// The surfaces and the light that a ray meets.
struct Seen {
    std::optional<Hit> opaque;            ///< empty where a light hides it
    std::optional<SeenLights::Met> light; ///< in front of everything opaque
    std::vector<Hit> transparent;         ///< in the order in which they are blended
};

/// Primary visibility: the surfaces and lights that camera rays meet, and those that rounding lets a program see
/// instead. All functions may be called from several threads.
class Sight {
public:
    /// The scene must outlive it. Throws as Visibility.
    Sight(const scenes::Scene& scene, const Settings& settings);

    const CameraRays& rays() const { return rays_; }
    std::span<const ShiningLight> lights() const { return lights_; }
    const Objects& objects() const { return objects_; }
    const Textures& textures() const { return textures_; }
    /// Whether ahead() may meet anything.
    bool hasOpaque() const { return !objects_.opaque().empty() || seenLights_.areThere(); }

    /// The surfaces of a ray, without lights.
    Seen surfacesOf(const Ray& ray) const;
    /// The surfaces that lights do not hide, and the light.
    Seen withLight(const Ray& ray, const Seen& surfaces) const;
    /// The opaque surface or light that any other ray meets from its origin on, at any distance from the camera.
    Seen ahead(const Ray& ray) const;
    /// The same with the transparent surfaces in front, the farthest first, except those closer than `fromMetres`.
    Seen aheadThroughGlass(const Ray& ray, double fromMetres) const;
    /// Where a ray inside a body leaves the object.
    std::optional<Hit> farSideAhead(const Ray& ray, const Object& object) const {
        return visibility_.farSideAhead(ray, object);
    }
    /// Triangles along a ray, without lights.
    Layers layersOf(const Ray& ray) const;

    /// Other lights that may be visible at a pixel, where rounding decides: near an outline, or near another surface.
    std::vector<Seen> otherLights(const glm::dvec2& placePixels, const Seen& surfaces, const Seen& own) const;
    /// Other surfaces that coincide with the opaque one.
    std::vector<Hit> coincidentWith(const Ray& ray, const Seen& seen) const;
    /// Whether a surface's texture lookups may return other values.
    bool isUndecided(const Seen& seen) const;

private:
    std::vector<Hit> candidates(const Ray& ray) const;
    std::pair<double, double> opacitiesOf(Hit hit) const;
    void addOthers(const Ray& ray, const std::optional<Hit>& nearest, Layers& found) const;

    CameraRays rays_;
    std::vector<ShiningLight> lights_;
    SeenLights seenLights_;
    Objects objects_;
    Textures textures_;
    Visibility visibility_;
};

} // namespace tessera::reference
