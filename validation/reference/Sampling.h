#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "validation/reference/MaterialAt.h"

/// Monte Carlo integration over directions.
namespace tessera::reference {

/// Axes at right angles, all unit.
struct Frame {
    glm::dvec3 x, y, z;
    glm::dvec3 out(const glm::dvec3& local) const { return local.x * x + local.y * y + local.z * z; }
    glm::dvec3 in(const glm::dvec3& world) const {
        return {glm::dot(world, x), glm::dot(world, y), glm::dot(world, z)};
    }
};

/// With z along the normal, and x along the tangent if that is not zero.
Frame frameOf(const glm::dvec3& normal, const glm::dvec3& tangent = glm::dvec3(0.0));

/// A distribution of unit directions.
class Strategy {
public:
    virtual ~Strategy() = default;
    /// Of two numbers from 0 to 1.
    virtual glm::dvec3 direction(const glm::dvec2& random) const = 0;
    virtual double density(const glm::dvec3& direction) const = 0; ///< 1/sr
};

/// By the cosine to the normal.
class ByCosine : public Strategy {
public:
    explicit ByCosine(const glm::dvec3& normal) : frame_(frameOf(normal)) {}
    glm::dvec3 direction(const glm::dvec2& random) const override;
    double density(const glm::dvec3& direction) const override;

private:
    Frame frame_;
};

/// Half vectors by GGX, whether the viewer sees such microfacets or not. Source: Walter et al. 2007, equations 35
/// to 38.
class ByMicrofacets : public Strategy {
public:
    ByMicrofacets(const glm::dvec2& alpha, const glm::dvec3& normal, const glm::dvec3& tangent,
                  const glm::dvec3& toViewer)
        : frame_(frameOf(normal, tangent)), alpha_(alpha), toViewer_(toViewer) {}
    glm::dvec3 direction(const glm::dvec2& random) const override;
    double density(const glm::dvec3& direction) const override;

private:
    Frame frame_;
    glm::dvec2 alpha_;
    glm::dvec3 toViewer_;
};

/// Half vectors by a power of their cosine.
class ByPower : public Strategy {
public:
    ByPower(double exponent, const glm::dvec3& normal, const glm::dvec3& toViewer)
        : frame_(frameOf(normal)), exponent_(exponent), toViewer_(toViewer) {}
    glm::dvec3 direction(const glm::dvec2& random) const override;
    double density(const glm::dvec3& direction) const override;

private:
    Frame frame_;
    double exponent_;
    glm::dvec3 toViewer_;
};

/// The cosine, and each lobe of a surface.
std::vector<std::unique_ptr<Strategy>> strategiesOf(const SurfacePoint& point, const glm::dvec3& toViewer,
                                                    bool specular);

struct Estimate {
    glm::dvec3 light{0.0};    ///< radiance towards the viewer
    glm::dvec3 variance{0.0}; ///< of it: the square of its standard error

    /// Of so many times as much light.
    Estimate times(const glm::dvec3& factor) const { return {factor * light, factor * factor * variance}; }
    Estimate times(double factor) const { return times(glm::dvec3(factor)); }
    Estimate& operator+=(const Estimate& other) {
        light += other.light;
        variance += other.variance;
        return *this;
    }
};

/// The integral of `light`, by direction and sr, from `paths` directions of each strategy, weighted by the power
/// heuristic; its variance is from how far independent parts of the samples differ. Source: Veach 1997, "Robust Monte
/// Carlo Methods for Light Transport Simulation", section 9.2.
Estimate sampled(std::span<const Strategy* const> strategies, int paths, std::uint32_t seed,
                 const std::function<glm::dvec3(const glm::dvec3& direction)>& light);

} // namespace tessera::reference
