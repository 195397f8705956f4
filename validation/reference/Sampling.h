#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "validation/reference/MaterialAt.h"

/// Monte Carlo integration over directions.
namespace tessera::reference {

/// Orthonormal axes.
struct Frame {
    glm::dvec3 x, y, z;
    glm::dvec3 out(const glm::dvec3& local) const { return local.x * x + local.y * y + local.z * z; }
    glm::dvec3 in(const glm::dvec3& world) const {
        return {glm::dot(world, x), glm::dot(world, y), glm::dot(world, z)};
    }
};

/// A frame with z along the normal, and x along the tangent if that is not zero.
Frame frameOf(const glm::dvec3& normal, const glm::dvec3& tangent = glm::dvec3(0.0));

/// A distribution of unit directions.
class Strategy {
public:
    virtual ~Strategy() = default;
    /// `random`: two numbers from 0 to 1.
    virtual glm::dvec3 direction(const glm::dvec2& random) const = 0;
    virtual double density(const glm::dvec3& direction) const = 0; ///< 1/sr
};

/// Cosine-weighted directions around the normal.
class ByCosine : public Strategy {
public:
    explicit ByCosine(const glm::dvec3& normal) : frame_(frameOf(normal)) {}
    glm::dvec3 direction(const glm::dvec2& random) const override;
    double density(const glm::dvec3& direction) const override;

private:
    Frame frame_;
};

/// Directions by GGX half vectors, whether the viewer sees such microfacets or not. Source: Walter et al. 2007,
/// equations 35 to 38.
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

/// Directions by half vectors whose density is a power of their cosine.
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

/// The sampling strategies of a surface: the cosine, and each of its lobes.
std::vector<std::unique_ptr<Strategy>> strategiesOf(const SurfacePoint& point, const glm::dvec3& toViewer,
                                                    bool specular);

struct Estimate {
    glm::dvec3 light{0.0};    ///< radiance towards the viewer
    glm::dvec3 variance{0.0}; ///< the square of the standard error of `light`

    /// The estimate for light scaled by a factor.
    Estimate times(const glm::dvec3& factor) const { return {factor * light, factor * factor * variance}; }
    Estimate times(double factor) const { return times(glm::dvec3(factor)); }
    Estimate& operator+=(const Estimate& other) {
        light += other.light;
        variance += other.variance;
        return *this;
    }
};

/// Integrates `light` over directions, in sr, by `paths` directions of each strategy, weighted by the power heuristic.
/// The variance follows from the differences of independent parts of the samples. Source: Veach 1997, "Robust Monte
/// Carlo Methods for Light Transport Simulation", section 9.2.
Estimate sampled(std::span<const Strategy* const> strategies, int paths, std::uint32_t seed,
                 const std::function<glm::dvec3(const glm::dvec3& direction)>& light);

} // namespace tessera::reference
