#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include <tbb/parallel_for.h>

#include "scenes/Environment.h"
#include "scenes/builtin/Environments.h"
#include "scenes/builtin/Pictures.h"

/// Single scattering of light in the air, with the constants of Bruneton and Neyret 2008, "Precomputed Atmospheric
/// Scattering", and Hillaire 2020, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique", plus the
/// latter's sum of all higher orders. Lengths in kilometres.
namespace tessera::scenes::builtin {
namespace {

using std::numbers::pi;
constexpr double kGroundRadius = 6360.0, kAirRadius = 6460.0, kEyeHeight = 0.2;
const glm::dvec3 kRayleighScattering(5.802e-3, 13.558e-3, 33.1e-3); // 1/km at the ground
constexpr double kRayleighHeight = 8.0;
constexpr double kMieScattering = 3.996e-3, kMieExtinction = 4.44e-3, kMieHeight = 1.2, kMieAsymmetry = 0.8;
const glm::dvec3 kOzoneAbsorption(0.650e-3, 1.881e-3, 0.085e-3); // in the middle of its layer
constexpr double kOzoneHeight = 25.0, kOzoneHalfWidth = 15.0;
const glm::dvec3 kGroundAlbedo(0.28, 0.27, 0.25);

constexpr double kSunElevation = 38.0 * pi / 180.0, kSunRadius = 0.004675; // radians
constexpr double kSunIrradiance = 4.0; // above the air: a sunlit white wall has a radiance near 1
/// Towards the sun: front left of a camera that looks along -(1, 0.7, 1).
glm::dvec3 toSun() {
    const glm::dvec2 level = std::cos(kSunElevation) * glm::normalize(glm::dvec2(0.35, 1.0));
    return {level.x, std::sin(kSunElevation), level.y};
}

struct Air {
    glm::dvec3 rayleigh, scattering, extinction; // 1/km
    double mie;
};
Air airAt(double height) {
    const double thin = std::exp(-height / kRayleighHeight), haze = std::exp(-height / kMieHeight);
    const double ozone = std::max(0.0, 1.0 - std::abs(height - kOzoneHeight) / kOzoneHalfWidth);
    Air air;
    air.rayleigh = kRayleighScattering * thin;
    air.mie = kMieScattering * haze;
    air.scattering = air.rayleigh + air.mie;
    air.extinction = air.rayleigh + glm::dvec3(kMieExtinction * haze) + kOzoneAbsorption * ozone;
    return air;
}

/// Distance to a sphere from a point at `radius` from the planet's centre, along a ray at `cosine` to the zenith.
double toSphere(double radius, double cosine, double sphere) {
    const double discriminant = radius * radius * (cosine * cosine - 1.0) + sphere * sphere;
    return std::max(0.0, -radius * cosine + std::sqrt(std::max(discriminant, 0.0)));
}
bool meetsGround(double radius, double cosine) {
    return cosine < 0.0 && radius * radius * (cosine * cosine - 1.0) + kGroundRadius * kGroundRadius >= 0.0;
}
double toGround(double radius, double cosine) {
    const double discriminant = radius * radius * (cosine * cosine - 1.0) + kGroundRadius * kGroundRadius;
    return std::max(0.0, -radius * cosine - std::sqrt(std::max(discriminant, 0.0)));
}

/// Transmittance of sunlight to a point; 0 in the planet's shadow.
glm::dvec3 sunlight(double radius, double cosine) {
    if (meetsGround(radius, cosine)) return glm::dvec3(0.0);
    constexpr int kSteps = 40;
    const double length = toSphere(radius, cosine, kAirRadius);
    glm::dvec3 depth(0.0);
    for (int i = 0; i < kSteps; ++i) {
        // Finer near the ground, where the air is dense.
        const double begin = std::pow(double(i) / kSteps, 2.0), end = std::pow((i + 1.0) / kSteps, 2.0);
        const double at = 0.5 * (begin + end) * length;
        const double r = std::sqrt(radius * radius + at * at + 2.0 * radius * at * cosine);
        depth += airAt(r - kGroundRadius).extinction * ((end - begin) * length);
    }
    return glm::exp(-depth);
}

/// A table over height and the sun's cosine to the zenith, from `low` to `high`, looked up bilinearly.
class Table {
public:
    template <typename Function>
    Table(double low, double high, const Function& value)
        : low_(low), columns_(std::max(2, int(std::ceil((high - low) / kStep)) + 1)),
          values_(std::size_t(kRows) * std::size_t(columns_)) {
        tbb::parallel_for(0, kRows, [&](int row) {
            for (int column = 0; column < columns_; ++column)
                values_[std::size_t(row) * std::size_t(columns_) + std::size_t(column)] =
                    value(kGroundRadius + heightOf(row / (kRows - 1.0)), std::min(low + kStep * column, 1.0));
        });
    }
    glm::dvec3 at(double radius, double cosine) const {
        const double height = std::clamp((radius - kGroundRadius) / (kAirRadius - kGroundRadius), 0.0, 1.0);
        const glm::dvec2 place((cosine - low_) / kStep, (kRows - 1.0) * std::sqrt(height));
        const glm::dvec2 last(columns_ - 2.0, kRows - 2.0);
        const glm::dvec2 cell = glm::clamp(glm::floor(place), glm::dvec2(0.0), last);
        const glm::dvec2 share = glm::clamp(place - cell, 0.0, 1.0);
        const auto value = [&](int x, int y) {
            const std::size_t row = std::size_t(cell.y) + std::size_t(y), column = std::size_t(cell.x) + std::size_t(x);
            return values_[row * std::size_t(columns_) + column];
        };
        return glm::mix(glm::mix(value(0, 0), value(1, 0), share.x), glm::mix(value(0, 1), value(1, 1), share.x),
                        share.y);
    }

private:
    static constexpr int kRows = 64;
    static constexpr double kStep = 2.0 / 63.0;
    static double heightOf(double share) { return share * share * (kAirRadius - kGroundRadius); }
    double low_;
    int columns_;
    std::vector<glm::dvec3> values_;
};

/// Calls `visit(radius, cosine of the sun there, length)` for steps of a ray through the air; the length is weighted by
/// the transmittance to the eye.
template <typename Visitor>
void alongRay(const glm::dvec3& direction, double radius, const glm::dvec3& sun, int steps, const Visitor& visit) {
    const double cosine = direction.y;
    const double length = meetsGround(radius, cosine) ? toGround(radius, cosine) : toSphere(radius, cosine, kAirRadius);
    glm::dvec3 share(1.0);
    for (int i = 0; i < steps; ++i) {
        const double begin = std::pow(double(i) / steps, 2.0) * length, end = std::pow((i + 1.0) / steps, 2.0) * length;
        const glm::dvec3 place = glm::dvec3(0.0, radius, 0.0) + 0.5 * (begin + end) * direction;
        const double r = glm::length(place);
        const glm::dvec3 extinction = airAt(r - kGroundRadius).extinction;
        const glm::dvec3 through = glm::exp(-extinction * (end - begin));
        visit(r, glm::dot(place, sun) / r, share * (1.0 - through) / extinction);
        share *= through;
    }
}

/// Light scattered twice or more, as isotropic, for a sun of irradiance 1. Source: Hillaire 2020, section 5.5.
glm::dvec3 scatteredAgain(double radius, double cosine, const Table& sunlit) {
    constexpr int kSide = 8, kSteps = 20;
    const glm::dvec3 sun(std::sqrt(std::max(0.0, 1.0 - cosine * cosine)), cosine, 0.0);
    glm::dvec3 second(0.0), kept(0.0);
    for (int i = 0; i < kSide * kSide; ++i) {
        const double up = 1.0 - 2.0 * (i / kSide + 0.5) / kSide, turn = 2.0 * pi * (i % kSide + 0.5) / kSide;
        const double level = std::sqrt(1.0 - up * up);
        const glm::dvec3 direction(level * std::cos(turn), up, level * std::sin(turn));
        glm::dvec3 share(1.0);
        alongRay(direction, radius, sun, kSteps, [&](double r, double sunCosine, const glm::dvec3& length) {
            const Air air = airAt(r - kGroundRadius);
            second += air.scattering * length * sunlit.at(r, sunCosine) / (4.0 * pi);
            kept += air.scattering * length;
            share -= air.extinction * length;
        });
        if (meetsGround(radius, up)) {
            const glm::dvec3 place = glm::dvec3(0.0, radius, 0.0) + toGround(radius, up) * direction;
            const double groundCosine = glm::dot(glm::normalize(place), sun);
            second += share * kGroundAlbedo / pi * std::max(groundCosine, 0.0) * sunlit.at(kGroundRadius, groundCosine);
        }
    }
    constexpr double kDirections = kSide * kSide;
    return second / kDirections / (1.0 - kept / kDirections);
}

class Sky {
public:
    Sky()
        : sun_(toSun()), sunlit_(-1.0, 1.0, sunlight),
          again_(std::sin(kSunElevation - kFarthest), std::sin(kSunElevation + kFarthest),
                 [this](double radius, double cosine) { return scatteredAgain(radius, cosine, sunlit_); }) {
        groundRadiance_ = kGroundAlbedo / pi * groundIrradiance();
    }

    /// In-scattered light towards the eye without the phase functions, and the transmittance (`share`).
    struct Airlight {
        glm::dvec3 rayleigh{0.0}, mie{0.0}, again{0.0}, share{1.0};
    };
    /// Airlight of all directions of an elevation, interpolated from few, since it hardly changes with the azimuth.
    class Ring {
    public:
        Ring(const Sky& sky, double upward) : sky_(sky) {
            for (int i = 0; i < int(lights_.size()); ++i)
                lights_[std::size_t(i)] = sky.airlight(sky.ringDirection(upward, i / kCells * 2.0 - 1.0));
        }
        /// Radiance in a direction of this elevation, without the sun's disk.
        glm::dvec3 radiance(const glm::dvec3& direction) const {
            const double sunward = sky_.sunwardOf(direction);
            const double place = 0.5 * (sunward + 1.0) * kCells,
                         cell = std::clamp(std::floor(place), 0.0, kCells - 1.0);
            const Airlight &a = lights_[std::size_t(cell)], &b = lights_[std::size_t(cell) + 1];
            const double share = place - cell;
            return sky_.radianceOf({glm::mix(a.rayleigh, b.rayleigh, share), glm::mix(a.mie, b.mie, share),
                                    glm::mix(a.again, b.again, share), glm::mix(a.share, b.share, share)},
                                   direction);
        }

    private:
        static constexpr double kCells = 16.0;
        const Sky& sky_;
        std::array<Airlight, std::size_t(kCells) + 1> lights_;
    };
    /// Radiance of the sun's disk, seen from the ground.
    glm::dvec3 sunRadiance() const {
        const double solidAngle = 2.0 * pi * (1.0 - std::cos(kSunRadius));
        return kSunIrradiance / solidAngle * sunlight(kEye, sun_.y);
    }
    const glm::dvec3& sun() const { return sun_; }

private:
    static constexpr double kEye = kGroundRadius + kEyeHeight;
    /// Bound on how far the zenith turns along a ray through the air: a level ray leaves it after 10 degrees.
    static constexpr double kFarthest = 15.0 * pi / 180.0;

    /// Cosine of a direction's azimuth from the sun's.
    double sunwardOf(const glm::dvec3& direction) const {
        const glm::dvec2 level(direction.x, direction.z);
        const double length = glm::length(level);
        return length > 0.0
                   ? std::clamp(glm::dot(level / length, glm::normalize(glm::dvec2(sun_.x, sun_.z))), -1.0, 1.0)
                   : 0.0;
    }
    glm::dvec3 ringDirection(double upward, double sunward) const {
        const glm::dvec2 ahead = glm::normalize(glm::dvec2(sun_.x, sun_.z)), aside(-ahead.y, ahead.x);
        const glm::dvec2 level = std::sqrt(std::max(1.0 - upward * upward, 0.0)) *
                                 (sunward * ahead + std::sqrt(std::max(1.0 - sunward * sunward, 0.0)) * aside);
        return {level.x, upward, level.y};
    }

    glm::dvec3 radianceOf(const Airlight& light, const glm::dvec3& direction) const {
        const glm::dvec3 scattered = scatteredTo(light, direction);
        return meetsGround(kEye, direction.y) ? scattered + light.share * groundRadiance_ : scattered;
    }
    glm::dvec3 scatteredTo(const Airlight& light, const glm::dvec3& direction) const {
        const double cosine = glm::dot(direction, sun_), g = kMieAsymmetry;
        const double rayleighPhase = 3.0 / (16.0 * pi) * (1.0 + cosine * cosine);
        // Source: Cornette and Shanks 1992, "Physically reasonable analytic expression for the single-scattering phase
        // function".
        const double miePhase = 3.0 / (8.0 * pi) * ((1.0 - g * g) * (1.0 + cosine * cosine)) /
                                ((2.0 + g * g) * std::pow(1.0 + g * g - 2.0 * g * cosine, 1.5));
        return kSunIrradiance * (light.rayleigh * rayleighPhase + light.mie * miePhase + light.again);
    }

    Airlight airlight(const glm::dvec3& direction) const {
        constexpr int kSteps = 48;
        Airlight light;
        alongRay(direction, kEye, sun_, kSteps, [&](double r, double sunCosine, const glm::dvec3& length) {
            const Air air = airAt(r - kGroundRadius);
            const glm::dvec3 sunlit = length * sunlit_.at(r, sunCosine);
            light.rayleigh += air.rayleigh * sunlit;
            light.mie += air.mie * sunlit;
            light.again += length * air.scattering * again_.at(r, sunCosine);
            light.share -= air.extinction * length;
        });
        return light;
    }

    /// Irradiance of level ground by the sun and the sky.
    glm::dvec3 groundIrradiance() const {
        glm::dvec3 irradiance = kSunIrradiance * sun_.y * sunlight(kEye, sun_.y);
        constexpr int kRows = 16, kColumns = 32;
        for (int i = 0; i < kRows * kColumns; ++i) {
            // Uniform in the square of the sine: all samples contribute equally to the irradiance.
            const double sine2 = (i / kColumns + 0.5) / kRows, turn = 2.0 * pi * (i % kColumns + 0.5) / kColumns;
            const double level = std::sqrt(sine2);
            const glm::dvec3 direction(level * std::cos(turn), std::sqrt(1.0 - sine2), level * std::sin(turn));
            irradiance += pi / (kRows * kColumns) * scatteredTo(airlight(direction), direction);
        }
        return irradiance;
    }

    glm::dvec3 sun_;
    Table sunlit_, again_;
    glm::dvec3 groundRadiance_{0.0};
};

/// Fraction of a texel that the sun's disk covers.
double sunShare(int x, int y, const glm::dvec3& sun) {
    constexpr int kSide = 16;
    int inside = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
        const glm::dvec3 direction =
            directionInMap({(x + (i % kSide + 0.5) / kSide) / kMapWidth, (y + (i / kSide + 0.5) / kSide) / kMapHeight});
        if (glm::length(glm::cross(direction, sun)) < std::sin(kSunRadius) && glm::dot(direction, sun) > 0.0) ++inside;
    }
    return double(inside) / (kSide * kSide);
}

} // namespace

Image makeSky(const std::function<void(double)>& progress) {
    const Sky sky;
    const glm::dvec3 sunRadiance = sky.sunRadiance();
    std::vector<std::optional<Sky::Ring>> rings(kMapHeight);
    tbb::parallel_for(0, kMapHeight, [&](int y) {
        if (progress) progress(0.0); // may throw to cancel
        rings[std::size_t(y)].emplace(sky, directionInMap({0.5, (y + 0.5) / kMapHeight}).y);
    });
    const auto radiance = [&](int x, int y) {
        const glm::dvec3 direction = directionInMap({(x + 0.5) / kMapWidth, (y + 0.5) / kMapHeight});
        const bool isNearSun = glm::dot(direction, sky.sun()) > 0.99;
        return rings[std::size_t(y)]->radiance(direction) +
               (isNearSun ? sunShare(x, y, sky.sun()) * sunRadiance : glm::dvec3(0.0));
    };
    return drawRadiance("sky", kMapWidth, kMapHeight, radiance, progress);
}

} // namespace tessera::scenes::builtin
