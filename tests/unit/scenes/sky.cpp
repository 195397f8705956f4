// The built-in sky compared with its air's optical depths, paths traced through that air, and a published sky.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "scenes/Environment.h"
#include "scenes/builtin/Environments.h"

namespace tessera::scenes {
namespace {

double radiansOf(double degrees) {
    return degrees * std::numbers::pi / 180.0;
}

/// The map, and its sun: irradiance and direction summed over the bright texels.
class BuiltinSky : public testing::Test {
protected:
    static void SetUpTestSuite() {
        const Image map = builtin::makeSky();
        width_ = map.width;
        height_ = map.height;
        texels_.resize(std::size_t(width_) * std::size_t(height_));
        std::memcpy(texels_.data(), map.texels.data(), map.texels.size());
        constexpr float kBrighterThanSky = 10.0f; // a texel with a hundredth of the sun's disk has 600
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x) {
                if (at(x, y).g < kBrighterThanSky) continue;
                const double top = std::numbers::pi * y / height_, bottom = std::numbers::pi * (y + 1) / height_;
                const double solidAngle = 2.0 * std::numbers::pi / width_ * (std::cos(top) - std::cos(bottom));
                const glm::dvec3 light = solidAngle * glm::dvec3(at(x, y));
                sunIrradiance_ += light;
                toSun_ += light.g * directionInMap({(x + 0.5) / width_, (y + 0.5) / height_});
            }
        toSun_ = glm::normalize(toSun_);
    }
    static void TearDownTestSuite() {
        texels_ = {};
        sunIrradiance_ = toSun_ = glm::dvec3(0.0);
    }

    /// Radiance of a texel; the azimuth is measured from the sun.
    static glm::dvec3 radiance(double zenithDegrees, double azimuthDegrees) {
        const double azimuth = std::atan2(toSun_.z, toSun_.x) + radiansOf(azimuthDegrees);
        const double fromTop = radiansOf(zenithDegrees), level = std::sin(fromTop);
        const glm::dvec2 place = placeInMap({level * std::cos(azimuth), std::cos(fromTop), level * std::sin(azimuth)});
        return at(std::min(int(place.x * width_), width_ - 1), std::min(int(place.y * height_), height_ - 1));
    }
    static const glm::vec4& at(int x, int y) { return texels_[std::size_t(y) * std::size_t(width_) + std::size_t(x)]; }

    inline static int width_ = 0, height_ = 0;
    inline static std::vector<glm::vec4> texels_;
    inline static glm::dvec3 sunIrradiance_{0.0}; ///< through the air, on a surface that faces it
    inline static glm::dvec3 toSun_{0.0};
};

constexpr double kSunElevationDegrees = 38.0;

/// Transmittance exp(-tau / sin): tau sums the scale height of each exponential layer times its extinction at the
/// ground, and the area of ozone's triangle. The eye is at 200 m, above 2.5 % of the air.
TEST_F(BuiltinSky, theSunIsAsRedAsTheAirsOpticalDepthSays) {
    EXPECT_NEAR(std::asin(toSun_.y), radiansOf(kSunElevationDegrees), 1e-3); // a sixth of a texel
    const glm::dvec3 depth = 8.0 * glm::dvec3(5.802e-3, 13.558e-3, 33.1e-3) + 1.2 * 4.44e-3 +
                             15.0 * glm::dvec3(0.650e-3, 1.881e-3, 0.085e-3);
    EXPECT_NEAR(depth.r, 0.0615, 1e-4);
    EXPECT_NEAR(depth.g, 0.1420, 1e-4);
    EXPECT_NEAR(depth.b, 0.2714, 1e-4);
    const glm::dvec3 left = glm::exp(-depth / std::sin(radiansOf(kSunElevationDegrees))); // 0.905, 0.794, 0.643
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(sunIrradiance_[c] / sunIrradiance_.g, left[c] / left.g, 0.01) << c;
        // 4 above the air; the disk's texels are sampled at 16 x 16 points each, an error of 0.6 %.
        EXPECT_NEAR(sunIrradiance_[c], 4.0 * left[c], 0.03 * 4.0) << c;
    }
}

struct TracedSky {
    double zenithDegrees, azimuthDegrees; ///< from the sun
    glm::dvec3 radiance;
};

/// By sky_truth.py, which traces paths through all orders of scattering in the same air.
constexpr TracedSky kTracedSkies[] = {
    {0.0, 0.0, {0.02016, 0.04386, 0.10292}},    {30.0, 0.0, {0.03645, 0.06890, 0.14812}},
    {30.0, 180.0, {0.01851, 0.04128, 0.09978}}, {60.0, 90.0, {0.03322, 0.07202, 0.16381}},
    {80.0, 90.0, {0.08126, 0.15909, 0.29470}},  {60.0, 180.0, {0.03390, 0.07355, 0.16828}},
    {60.0, 0.0, {0.12270, 0.17076, 0.28552}},   {80.0, 180.0, {0.10342, 0.20095, 0.35932}}};

/// All orders but the first are taken as isotropic light (Hillaire 2020), which loses most where there is most of it:
/// in blue, towards the horizon. Without them 29 % of red and 41 % of blue are missing at the zenith; a haze with g =
/// 0.76 or 0.84 is off by 12 % beside the sun.
TEST_F(BuiltinSky, showsWhatPathsTracedThroughItsAirShow) {
    constexpr double kMostLost[] = {0.04, 0.065, 0.09}; // measured as 0.025, 0.052 and 0.073
    constexpr double kMostGained = 0.025;               // measured as 0.01; noise of paths 0.005, of texels 0.01
    for (const TracedSky& one : kTracedSkies) {
        const glm::dvec3 shown = radiance(one.zenithDegrees, one.azimuthDegrees);
        for (int c = 0; c < 3; ++c) {
            const double error = shown[c] / one.radiance[c] - 1.0;
            EXPECT_TRUE(error >= -kMostLost[c] && error <= kMostGained)
                << error << " at " << one.zenithDegrees << " degrees from the zenith, " << one.azimuthDegrees
                << " from the sun's azimuth, channel " << c;
        }
    }
}

/// At 5 degrees below the horizontal the ground is 2.3 km from the eye at 200 m. Air scatters by 1 % per km of red and
/// 4 % per km of blue light, so that it hides little.
TEST_F(BuiltinSky, theGroundBeginsAtTheHorizon) {
    const glm::dvec3 near = radiance(120.0, 90.0), far = radiance(95.0, 90.0);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(far[c] / near[c], 1.0, 0.06) << c;
}

/// Luminance (kcd/m2) and chromaticity of a clear sky at the least turbidity that its authors fitted. Source: Preetham,
/// Shirley and Smits 1999, "A Practical Analytic Model for Daylight", appendix A.2.
class PreethamSky {
public:
    explicit PreethamSky(double sunZenith) : sunZenith_(sunZenith) {}

    glm::dvec3 luminanceAndChromaticity(double zenith, double azimuth) const {
        const double toSun = std::acos(std::cos(zenith) * std::cos(sunZenith_) +
                                       std::sin(zenith) * std::sin(sunZenith_) * std::cos(azimuth));
        glm::dvec3 result = atZenith();
        for (int i = 0; i < 3; ++i) result[i] *= perez(i, zenith, toSun) / perez(i, 0.0, sunZenith_);
        return result;
    }

private:
    static constexpr double kTurbidity = 2.0;

    glm::dvec3 atZenith() const {
        const double t = sunZenith_, chi = (4.0 / 9.0 - kTurbidity / 120.0) * (std::numbers::pi - 2.0 * t);
        const glm::dvec4 powers(t * t * t, t * t, t, 1.0);
        const auto sum = [&](const glm::dvec4& square, const glm::dvec4& linear, const glm::dvec4& constant) {
            return glm::dot(kTurbidity * kTurbidity * square + kTurbidity * linear + constant, powers);
        };
        return {(4.0453 * kTurbidity - 4.9710) * std::tan(chi) - 0.2155 * kTurbidity + 2.4192,
                sum({0.00166, -0.00375, 0.00209, 0.0}, {-0.02903, 0.06377, -0.03202, 0.00394},
                    {0.11693, -0.21196, 0.06052, 0.25886}),
                sum({0.00275, -0.00610, 0.00317, 0.0}, {-0.04214, 0.08970, -0.04153, 0.00516},
                    {0.15346, -0.26756, 0.06670, 0.26688})};
    }
    /// Perez function of Y, x or y. Source: Perez and others 1993.
    static double perez(int quantity, double zenith, double toSun) {
        constexpr double kByTurbidity[3][5] = {{0.1787, -0.3554, -0.0227, 0.1206, -0.0670},
                                               {-0.0193, -0.0665, -0.0004, -0.0641, -0.0033},
                                               {-0.0167, -0.0950, -0.0079, -0.0441, -0.0109}};
        constexpr double kConstant[3][5] = {{-1.4630, 0.4275, 5.3251, -2.5771, 0.3703},
                                            {-0.2592, 0.0008, 0.2125, -0.8989, 0.0452},
                                            {-0.2608, 0.0092, 0.2102, -1.6537, 0.0529}};
        double number[5];
        for (int i = 0; i < 5; ++i) number[i] = kByTurbidity[quantity][i] * kTurbidity + kConstant[quantity][i];
        return (1.0 + number[0] * std::exp(number[1] / std::cos(zenith))) *
               (1.0 + number[2] * std::exp(number[3] * toSun) + number[4] * std::cos(toSun) * std::cos(toSun));
    }
    double sunZenith_;
};

/// CIE XYZ of linear sRGB (IEC 61966-2-1).
glm::dvec3 tristimulusOf(const glm::dvec3& rgb) {
    return {glm::dot(rgb, {0.4124, 0.3576, 0.1805}), glm::dot(rgb, {0.2126, 0.7152, 0.0722}),
            glm::dot(rgb, {0.0193, 0.1192, 0.9505})};
}

/// Compares directions away from the sun, where haze matters little. The built-in sky has a twentieth of the haze of
/// that turbidity, and is up to 40 % darker around the sun.
TEST_F(BuiltinSky, isNearAPublishedClearSkyAwayFromTheSun) {
    const PreethamSky published(radiansOf(90.0 - kSunElevationDegrees));
    const glm::dvec3 zenith = tristimulusOf(radiance(0.0, 0.0)), wanted = published.luminanceAndChromaticity(0.0, 0.0);
    const double sum = zenith.x + zenith.y + zenith.z;
    // The built-in sky has three wavelengths, as red, green and blue, and a white sun.
    EXPECT_NEAR(zenith.x / sum, wanted.y, 0.015);
    EXPECT_NEAR(zenith.y / sum, wanted.z, 0.015);
    for (const glm::dvec2& place : {glm::dvec2(30.0, 180.0), glm::dvec2(60.0, 90.0), glm::dvec2(80.0, 90.0)}) {
        const double own = tristimulusOf(radiance(place.x, place.y)).y / zenith.y;
        const double other = published.luminanceAndChromaticity(radiansOf(place.x), radiansOf(place.y)).x / wanted.x;
        EXPECT_NEAR(own / other, 1.0, 0.2) << place.x << " degrees from the zenith: " << own; // measured as 0.11
    }
}

} // namespace
} // namespace tessera::scenes
