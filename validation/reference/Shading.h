#pragma once
#include <optional>
#include <span>
#include <vector>

#include "validation/reference/Diffusion.h"
#include "validation/reference/HookAt.h"
#include "validation/reference/Sight.h"

namespace tessera::reference {

/// Light that a body transmits, before absorption.
struct BodyLight {
    glm::dvec3 radiance{0.0}; ///< at the hits of its rays, by channel
    /// By channel, the path length inside; empty if no far side is found: then the body's thickness counts.
    std::optional<double> wayMetres[3];
};

/// Cached light of a surface. Nudges and shadow choices reuse it, as they change it too little to compute it again.
struct SurfaceMemo {
    std::vector<std::optional<Occlusion::Answer>> shadows; ///< by light
    std::vector<std::optional<Occlusion::Passage>> passages;
    std::vector<std::optional<Estimate>> areaLights; ///< unshadowed
    std::optional<Diffusion::Answer> diffused;
    std::optional<Estimate> surroundings;
    std::optional<BodyLight> throughBody;
};

/// What a ray meets, with its cached light.
struct Shown {
    Ray ray;
    Seen seen;
    std::uint32_t seed = 0;           ///< random seed of Diffusion and Surroundings
    HookPoints* hookPoints = nullptr; ///< null where no hook changes surfaces
    std::vector<SurfaceMemo> memos;   ///< by surface, the opaque one first; grows as surfaces are lit
    /// Environment paths per surface along a ray that a body bent; 0: a camera ray.
    int throughBodyPaths = 0;
    int glassLeft = 0; ///< what is left of Settings::glassDepth along such a ray

    bool hasUndecidedShadows() const;
};

/// Shades what rays meet. May be used by several threads.
class Shading {
public:
    /// All must outlive it. Throws as Occlusion and Diffusion.
    Shading(const scenes::Scene& scene, const Settings& settings, const Sight& sight);

    /// Which shadows to shade with: the exact ones, or all or none of those that rounding decides.
    enum class Shadows { Exact, Most, Least };

    struct Lit {
        glm::dvec3 radiance{0.0};
        double opacity = 1.0;
        glm::dvec3 passed{0.0};       ///< fraction of the radiance behind it that it transmits where it covers
        glm::dvec3 passedMore{0.0};   ///< transmitted besides, by Settings::leastRoughTransmittance
        glm::dvec3 radianceMore{0.0}; ///< radiance besides, likewise
        Noise noise = {};             ///< as Rendered::shadowNoise
        Estimate areaLights = {};     ///< as Rendered::areaLights
    };
    Lit shade(Shown& shown, const Nudge& nudge = {}, Shadows shadows = Shadows::Exact) const;

private:
    Lit litSurface(Shown& shown, std::size_t surface, const Nudge& nudge, Shadows shadows) const;
    SurfacePoint nudged(Hit hit, const Nudge& nudge, HookPoints* hookPoints) const;
    void addPassing(const Shown& shown, const Hit& hit, const SurfacePoint& point, const glm::dvec3& toViewer,
                    SurfaceMemo& memo, Lit& lit) const;
    /// How many further bodies and sheets may be met by rays that this surface bends.
    int glassLeft(const Shown& shown) const {
        return shown.throughBodyPaths > 0 ? shown.glassLeft : settings_.glassDepth;
    }
    BodyLight throughBody(const SurfacePoint& point, const Shown& shown, const Hit& entry, const glm::dvec3& toViewer,
                          bool showsScene) const;
    glm::dvec3 sceneAround(const Shown& shown, const Hit& entry, std::span<const Scatter> ways) const;
    bool hasBackFaces(const Hit& entry) const;
    Seen aheadOf(const Shown& shown, const Hit& entry, const Ray& bent) const;
    glm::dvec3 passedOnBy(const Hit& hit, const SurfacePoint& point, const glm::dvec3& positionRWS,
                          const glm::dvec3& toViewer, Shadows shadows, SurfaceMemo& memo) const;
    Occlusion::Answer shadowOf(std::size_t light, const Hit& hit, const SurfacePoint& point,
                               const glm::dvec3& positionRWS, const glm::dvec3& toViewer, SurfaceMemo& memo) const;
    glm::dvec3 lightOn(const SurfacePoint& point, const ShiningLight& light, const glm::dvec3& positionRWS,
                       const glm::dvec3& toViewer) const;
    Estimate areaLightOn(std::size_t light, const Nudge& nudge, bool isThroughBody, const SurfacePoint& point,
                         const glm::dvec3& positionRWS, const glm::dvec3& toViewer, SurfaceMemo& memo) const;

    const scenes::Scene& scene_;
    const Settings& settings_;
    const Sight& sight_;
    std::span<const ShiningLight> lights_;
    Surroundings surroundings_;
    Occlusion occlusion_;
    Diffusion diffusion_;
    std::vector<bool> closedBodies_; ///< per material; empty unless the settings need it
};

} // namespace tessera::reference
