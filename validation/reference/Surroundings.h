#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "validation/reference/Facets.h"
#include "validation/reference/Sampling.h"
#include "validation/reference/Settings.h"

namespace tessera::reference {

/// Environment lighting, by Monte Carlo integration in double precision. Directions are sampled by the map's texels and
/// by the surface (Sampling.h). May be used by several threads.
class Surroundings {
public:
    /// The scene must outlive it.
    Surroundings(const scenes::Scene& scene, const Settings& settings);

    bool lights() const { return lights_; } ///< whether there is any light that surfaces reflect
    /// Whether transmissive bodies show it, however dark it is.
    bool showsThroughBodies() const { return showsThroughBodies_; }
    bool isSeen() const { return isSeen_; } ///< visible where nothing is drawn
    /// Radiance from a unit direction, world axes.
    glm::dvec3 radianceOf(const glm::dvec3& direction) const;

    /// Environment light that a surface reflects; `onlyLobes` leaves out light that enters the surface.
    Estimate on(const SurfacePoint& point, const glm::dvec3& toViewer, bool specular, bool onlyLobes,
                std::uint32_t seed) const {
        return on(point, toViewer, specular, onlyLobes, seed, paths_);
    }
    /// The same with `paths` directions of each strategy.
    Estimate on(const SurfacePoint& point, const glm::dvec3& toViewer, bool specular, bool onlyLobes,
                std::uint32_t seed, int paths) const;

    /// Mean environment radiance along these paths; occluded directions count as 0.
    using IsHidden = std::function<bool(const glm::dvec3& originRWS, const glm::dvec3& direction)>;
    glm::dvec3 through(std::span<const Scatter> ways, std::uint32_t seed, const IsHidden& isHidden) const;

    /// Irradiance of a surface with this normal, interpolated between directions three degrees apart.
    glm::dvec3 irradiance(const glm::dvec3& normal) const;

private:
    class ByMap;
    /// A direction with the density of the map's texels.
    glm::dvec3 ofMap(const glm::dvec2& random) const;
    double mapDensity(const glm::dvec3& direction) const;
    glm::dvec3 texel(int column, int row) const;
    /// The map's texel coordinates of a direction, from the left and from the top.
    glm::dvec2 placeOf(const glm::dvec3& direction) const;
    void makeDensities();
    void makeIrradiances();

    const scenes::Image* map_ = nullptr;
    double intensity_ = 0.0, turnRadians_ = 0.0;
    bool lights_ = false, showsThroughBodies_ = false, isSeen_ = false, compensates_ = false;
    int paths_ = 0;
    std::vector<double> rowsSummed_, columnsSummed_; ///< cumulative fractions of rows, and of the columns of each row
    std::vector<double> densities_;                  ///< by texel, 1/sr
    std::vector<glm::dvec3> irradiances_;            ///< by direction
};

} // namespace tessera::reference
