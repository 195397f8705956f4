// The split sum between its exact cases: known answers that the reference's wide tolerances cannot check, and shader
// faults that only these answers detect.
#include <iterator>

#include "shaders/shared/environment.h"
#include "shaders/shared/models.h"
#include "tests/image/EnvironmentTest.h"
#include "tests/image/GlassTest.h"
#include "tests/support/ShaderMutant.h"

namespace tessera {
namespace {

using engine::Technique;
using frame::EnvironmentLight;
using namespace test;

/// Each error is relative to its limit.
class EnvironmentLobes : public EnvironmentTest {
public:
    double errorOfMirrorBlend(const shader::SourceTree& shaders);
    double errorOfBounces(const shader::SourceTree& shaders);
    double errorOfBrushing(const shader::SourceTree& shaders);
    double errorOfStreak(const shader::SourceTree& shaders);
    double errorOfLean(const shader::SourceTree& shaders);

protected:
    /// Sets these alphas along and across the tangent: alpha is the square of roughness, and the larger one lies
    /// strength^2 of the way from it to 1 (KHR_materials_anisotropy).
    static void brush(scenes::Material& material, double along, double across) {
        material.perceptualRoughness = float(std::sqrt(across));
        material.anisotropyStrength = float(std::sqrt((along - across) / (1.0 - across)));
    }
    /// A quad so far away that all pixels share one view direction.
    static scenes::Scene flatQuad(const scenes::Material& material, double cosView = 1.0) {
        scenes::Scene scene = quadScene(material);
        lookAtCosine(scene.cameras[0], cosView, 0.05);
        return scene;
    }
    /// Red of its middle; forward stores no surface, so alpha is not quantised.
    double shown(const scenes::Scene& scene, const shader::SourceTree& shaders, bool compensates = false) {
        frame::FrameSettings settings = ofSize(2, 2);
        settings.environment.compensates = compensates;
        return double(drawn(scene, settings, Technique::Forward, shaders)[0]);
    }
};

/// Below the first level, (0.01 - alpha) / 0.009 of a lobe is a mirror. Viewed straight on, all pixels look at the
/// sun's texel: a mirror shows it, and the first level half as bright at most.
double EnvironmentLobes::errorOfMirrorBlend(const shader::SourceTree& shaders) {
    constexpr double kSun = 100.0;
    scenes::Scene scene = flatQuad({});
    // Odd sizes: the centre of a texel lies along +z if the map is turned by half a turn.
    scene.environment =
        environmentOf(255, 127, [](int x, int y) { return glm::dvec3(x == 127 && y == 63 ? kSun : 0.0); });
    scene.environment->rotationDegrees = 180.0f;
    const auto ofAlpha = [&](double alpha) {
        scene.materials[0].perceptualRoughness = float(std::sqrt(alpha));
        return shown(scene, shaders);
    };
    const double mirror = ofAlpha(ALPHA_MIN), least = ofAlpha(ENVIRONMENT_LEAST_ALPHA);
    constexpr double kAllowed = 1e-3 * kSun; // angles in fp32 are good to a thousandth of a texel
    double worst = std::max(std::abs(mirror - kSun), 2.0 * kAllowed * std::max(least / mirror - 0.5, 0.0));
    for (const double share : {0.2, 0.5, 0.8}) {
        const double wanted = share * mirror + (1.0 - share) * least;
        worst = std::max(worst, std::abs(ofAlpha(ENVIRONMENT_LEAST_ALPHA - 0.009 * share) - wanted));
    }
    return worst / kAllowed;
}

/// A grey metal under uniform light: single reflection, F0 A + B of the published table (shading.md section 6), times
/// multiple scattering, 1 + F' lost / (1 - F' lost), with the mean Fresnel factor F' (Fdez-Aguera 2019).
double EnvironmentLobes::errorOfBounces(const shader::SourceTree& shaders) {
    constexpr double kStraight = 0.5, kMean = kStraight + (1.0 - kStraight) / 21.0;
    constexpr double kRoughness[] = {0.5, 0.75, 1.0}, kCosines[] = {0.1, 0.5, 1.0};
    constexpr double kA[3][3] = {{.7519, .8349, .9158}, {.7958, .6547, .6268}, {.7363, .4477, .3067}};
    constexpr double kB[3][3] = {{.1397, .0223, .0}, {.0526, .0085, .0}, {.0239, .0030, .0}};
    double worst = 0.0;
    for (int r = 0; r < 3; ++r)
        for (int m = 0; m < 3; ++m) {
            scenes::Scene scene = flatQuad({}, kCosines[m]);
            scene.materials[0].baseColor = glm::vec4(glm::vec3(float(kStraight)), 1.0f);
            scene.materials[0].perceptualRoughness = float(kRoughness[r]);
            scene.environment = evenEnvironment(1.0);
            const double once = kStraight * kA[r][m] + kB[r][m], lost = 1.0 - kA[r][m] - kB[r][m];
            const double wanted = once * (1.0 + kMean * lost / (1.0 - kMean * lost));
            worst = std::max(worst, std::abs(shown(scene, shaders, true) - wanted));
        }
    return worst / 1.5e-3; // 1e-3 for the lobe's table, half of it for multiple scattering
}

/// Mean of x^2 - y^2 over the light directions of a lobe viewed straight on, x along the tangent. Integrates
/// microfacets of all slopes by their density, times height-correlated masking with the alpha along the light (Heitz
/// 2014).
double stretchOfLobe(double along, double across) {
    constexpr int kRings = 400, kTurns = 96;
    double sum = 0.0, weights = 0.0;
    for (int i = 0; i < kRings; ++i)
        for (int j = 0; j < kTurns; ++j) {
            const double below = (i + 0.5) / kRings, radius = std::sqrt(below / (1.0 - below));
            const double turn = 2.0 * std::numbers::pi * (j + 0.5) / kTurns;
            const glm::dvec3 half =
                glm::normalize(glm::dvec3(along * radius * std::cos(turn), across * radius * std::sin(turn), 1.0));
            const glm::dvec3 light(2.0 * half.z * half.x, 2.0 * half.z * half.y, 2.0 * half.z * half.z - 1.0);
            if (!(light.z > 0.0)) continue;
            const double slope2 =
                (along * along * light.x * light.x + across * across * light.y * light.y) / (light.z * light.z);
            const double weight = 2.0 / (1.0 + std::sqrt(1.0 + slope2));
            weights += weight;
            sum += weight * (light.x * light.x - light.y * light.y);
        }
    return sum / weights;
}

/// Under radiance 1 + x^2 - y^2 a lobe that is long along x gains, and with swapped axes would lose the same. The split
/// sum weights its taps by the cosine instead of masking, and so finds 0.8 of that; taps as wide as can be 0.27.
double EnvironmentLobes::errorOfBrushing(const shader::SourceTree& shaders) {
    constexpr double kAlong = 0.7, kAcross = 0.16, kFound = 0.8, kAllowed = 0.2;
    scenes::Scene scene = flatQuad({});
    brush(scene.materials[0], kAlong, kAcross);
    scene.environment = evenEnvironment(1.0);
    const double even = shown(scene, shaders);
    scene.environment = environmentOf(kSkyWidth, kSkyHeight, [](int x, int y) {
        const glm::dvec3 towards = scenes::directionInMap({(x + 0.5) / kSkyWidth, (y + 0.5) / kSkyHeight});
        return glm::dvec3(1.0 + towards.x * towards.x - towards.y * towards.y);
    });
    const double found = (shown(scene, shaders) / even - 1.0) / stretchOfLobe(kAlong, kAcross);
    return std::abs(found - kFound) / kAllowed;
}

/// A lamp of 5 x 5 texels, 7 degrees wide, reflected as a streak by brushed metal: the largest relative dip between two
/// brighter places. Taps as wide as their gaps leave 0.14, as interpolated levels keep the peak of the sharper one;
/// taps as narrow as the shorter axis are dots, and leave 0.94.
double EnvironmentLobes::errorOfStreak(const shader::SourceTree& shaders) {
    constexpr double kAllowed = 0.4;
    constexpr int kStreakPixels = 64;
    constexpr TiltedPlane kPlane{0.35, 50.0, 1.4, kStreakPixels};
    scenes::Material metal;
    brush(metal, 0.4, 0.01);
    scenes::Scene scene = kPlane.sceneOf(metal);
    // In the direction of the normal, which is mirrored where the plane faces the viewer.
    const glm::ivec2 lamp(scenes::placeInMap(kPlane.normal()) * glm::dvec2(kSkyWidth, kSkyHeight));
    scene.environment = skyOf([&](int x, int y) {
        const int across = std::min(std::abs(x - lamp.x % kSkyWidth), kSkyWidth - std::abs(x - lamp.x % kSkyWidth));
        return across <= 2 && std::abs(y - lamp.y) <= 2 ? 100.0 : 0.0;
    });
    int row = 0;
    for (int y = 0; y < kStreakPixels; ++y)
        if (glm::dot(kPlane.toViewer(kStreakPixels / 2, y), kPlane.normal()) >
            glm::dot(kPlane.toViewer(kStreakPixels / 2, row), kPlane.normal()))
            row = y;
    frame::FrameSettings settings = ofSize(kStreakPixels, kStreakPixels);
    const std::vector<float> radiance = drawn(scene, settings, Technique::Forward, shaders);
    std::vector<double> streak;
    for (int x = 0; x < kStreakPixels; ++x)
        streak.push_back(double(radiance[std::size_t(4 * (row * kStreakPixels + x))]));
    double deepest = 0.0;
    for (auto at = streak.begin(); at != streak.end(); ++at) {
        const double beside = std::min(*std::max_element(streak.begin(), at + 1), *std::max_element(at, streak.end()));
        if (beside > 0.0) deepest = std::max(deepest, 1.0 - *at / beside);
    }
    return deepest / kAllowed;
}

/// Mean cosine to the axis of the light gathered by a lobe viewed straight on, weighted by that cosine (Karis 2013):
/// integrates over microfacet tilts up to 45 degrees.
double meanCosineOfLobe(double alpha) {
    constexpr int kSteps = 4000;
    double weights = 0.0, sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double lean = (i + 0.5) * 0.25 * std::numbers::pi / kSteps, c2 = std::cos(lean) * std::cos(lean);
        const double spread = c2 * (alpha * alpha - 1.0) + 1.0;
        const double weight = std::sin(2.0 * lean) * std::cos(2.0 * lean) / (spread * spread);
        weights += weight;
        sum += weight * std::cos(2.0 * lean);
    }
    return sum / weights;
}

/// Under radiance 1 + x / 2 a lobe gathers 1 plus half its axis's x times its mean cosine. The axis lies s (sqrt(s) +
/// alpha) of the way from the normal to the viewer's mirror direction, s = 1 - alpha (Lagarde and de Rousiers 2014).
double EnvironmentLobes::errorOfLean(const shader::SourceTree& shaders) {
    constexpr double kCosine = 0.6, kSine = 0.8, kAllowed = 0.01;
    scenes::Scene scene = flatQuad({}, kCosine);
    double worst = 0.0;
    for (const double alpha : {0.2, 0.45, 0.6, 0.8}) {
        scene.materials[0].perceptualRoughness = float(std::sqrt(alpha));
        scene.environment = evenEnvironment(1.0);
        const double even = shown(scene, shaders);
        scene.environment = environmentOf(kSkyWidth, kSkyHeight, [](int x, int y) {
            return glm::dvec3(1.0 + 0.5 * scenes::directionInMap({(x + 0.5) / kSkyWidth, (y + 0.5) / kSkyHeight}).x);
        });
        const double smooth = 1.0 - alpha, share = smooth * (std::sqrt(smooth) + alpha);
        const double axisX = -share * kSine, axisZ = 1.0 - share + share * kCosine;
        const double wanted = meanCosineOfLobe(alpha) * axisX / std::hypot(axisX, axisZ);
        worst = std::max(worst, std::abs(2.0 * (shown(scene, shaders) / even - 1.0) - wanted));
    }
    return worst / kAllowed;
}

TEST_F(EnvironmentLobes, belowTheFirstLevelAreMirrorsByTheShareThatTheDocumentSays) {
    EXPECT_LE(errorOfMirrorBlend({}), 1.0);
}
TEST_F(EnvironmentLobes, ofGreyMetalsGetBackWhatFdezAgueraSays) {
    EXPECT_LE(errorOfBounces({}), 1.0);
}
TEST_F(EnvironmentLobes, ofBrushedMetalsAreLongAlongTheLargerAlpha) {
    EXPECT_LE(errorOfBrushing({}), 1.0);
}
TEST_F(EnvironmentLobes, ofBrushedMetalsShowALampAsAStreakWithoutDots) {
    EXPECT_LE(errorOfStreak({}), 1.0);
}
TEST_F(EnvironmentLobes, ofMetalsLeanFromTheNormalAsLagardeAndDeRousiersSay) {
    EXPECT_LE(errorOfLean({}), 1.0);
}
struct LobeFault {
    const char* fault;
    const char* file; ///< below shaders/
    const char* from;
    const char* to;
    double (EnvironmentLobes::*errorOf)(const shader::SourceTree& shaders); ///< the measure that must detect it
};

constexpr LobeFault kLobeFaults[] = {
    {"the share of a mirror squared", "lib/reflectance/mirrors.glsl", "(ENVIRONMENT_LEAST_ALPHA - ALPHA_MIN), 0.0);",
     "(ENVIRONMENT_LEAST_ALPHA - ALPHA_MIN), 0.0);\n    share *= share;", &EnvironmentLobes::errorOfMirrorBlend},
    {"bounces without their Fresnel factor", "lib/reflectance/lobes.glsl", "once * mean * lost /", "once * lost /",
     &EnvironmentLobes::errorOfBounces},
    {"a brushed lobe across its axis", "lib/environment/environment_filtered.glsl",
     "surface.alphaBitangent ? surface.tangentLS : across", "surface.alphaBitangent ? across : surface.tangentLS",
     &EnvironmentLobes::errorOfBrushing},
    {"taps as wide as can be", "lib/environment/environment_filtered.glsl", "min(max(narrow, gap / 1.28), 1.0)", "1.0",
     &EnvironmentLobes::errorOfBrushing},
    {"taps as narrow as the shorter axis", "lib/environment/environment_filtered.glsl", "max(narrow, gap / 1.28)",
     "narrow", &EnvironmentLobes::errorOfStreak},
    {"rough lobes around the normal", "lib/environment/environment_filtered.glsl", "share = smoothness *",
     "share = alpha > 0.5 ? 0.0 : smoothness *", &EnvironmentLobes::errorOfLean},
};

TEST_F(EnvironmentLobes, everyFaultIsSeenByItsKnownAnswer) {
    for (const LobeFault& fault : kLobeFaults) {
        const ShaderMutant shaders(fault.file, fault.from, fault.to);
        const double error = (this->*fault.errorOf)(shaders.tree());
        fmt::print("{:38} {:.1f} times what is allowed\n", fault.fault, error);
        EXPECT_FALSE(error <= 1.5) << fault.fault; // NaN counts as detected
    }
}

// Environment shaders with one fault each: techniques share them and agree; the reference is independent and disagrees.

/// A white metal under a uniform sky shows the sky, even at grazing angles.
TEST_F(EnvironmentLobes, metalSeenAlmostEdgeOnStillShowsTheSky) {
    const ShaderMutant shaders;
    for (const EnvironmentLight light : {EnvironmentLight::SplitSum, EnvironmentLight::Sampled}) {
        for (const double cosine : {0.05, 0.005}) {
            scenes::Scene scene = flatQuad({});
            lookAtCosine(scene.cameras[0], cosine, 1e-4);
            scene.materials[0].baseColor = glm::vec4(1.0f);
            scene.materials[0].perceptualRoughness = 0.1f;
            scene.environment = evenEnvironment(1.0);
            frame::FrameSettings settings = ofSize(2, 2);
            settings.environment.light = light;
            const float seen = drawn(scene, settings, Technique::Forward, shaders.tree())[0];
            EXPECT_NEAR(seen, 1.0f, 0.1f) << "cosine " << cosine;
        }
    }
}

struct EnvironmentFault {
    const char* fault;
    EnvironmentLight light;
    float roughness;  ///< of a metal; below 0: matte
    const char* file; ///< below shaders/
    const char* from;
    const char* to;
};

constexpr float kMatteBall = -1.0f;
constexpr EnvironmentFault kEnvironmentFaults[] = {
    {"rotated the wrong way", EnvironmentLight::SplitSum, kMatteBall, "lib/environment/environment_constants.glsl",
     "mat3(environment.mapFromLS) * directionLS", "directionLS * mat3(environment.mapFromLS)"},
    {"samples rotated the wrong way", EnvironmentLight::Sampled, kMatteBall,
     "lib/environment/environment_constants.glsl", "direction * mat3(environment.mapFromLS)",
     "mat3(environment.mapFromLS) * direction"},
    {"the wrong level", EnvironmentLight::SplitSum, 1.0f, "shared/environment.h", "* levelsADoubling;",
     "* 0.5 * levelsADoubling;"},
    {"a lobe without its table", EnvironmentLight::SplitSum, 1.0f, "lib/reflectance/even_light.glsl",
     "seen.f0 * lobe.x + seen.fresnelRise * lobe.y", "seen.f0 + seen.fresnelRise * lobe.y"},
    {"a density without its cosine", EnvironmentLight::Sampled, kMatteBall, "lib/reflectance/lobe_samples.glsl",
     "density = max(dot(seen.surface.normalLS, toLight), 0.0) * kInversePi", "density = kInversePi"},
    {"the density of the map left out", EnvironmentLight::Sampled, kMatteBall,
     "lib/environment/environment_samples.glsl", "mapDensity + surfaceDensity(seen, toLight)",
     "surfaceDensity(seen, toLight)"},
    {"the density of the lobe left out", EnvironmentLight::Sampled, 0.5f, "lib/reflectance/lobe_samples.glsl",
     "density += visibleDensity(lobeDistribution(seen, h), seen.nv, seen.viewerLength)", "density += 0.0"},
};

class EnvironmentFaults : public EnvironmentTest {
protected:
    /// relMSE against the reference of a ball under a rotated lamp of 25 texels.
    double errorOf(const EnvironmentFault& fault, const shader::SourceTree& shaders) {
        scenes::Scene scene = ballUnderSky(fault.roughness < 0.0f ? lambert() : metalOf(fault.roughness));
        scene.environment = environmentOf(64, 32, [](int x, int y) {
            return glm::dvec3(std::abs(x - 30) <= 2 && std::abs(y - 12) <= 2 ? 40.0 : 0.2);
        });
        scene.environment->rotationDegrees = 50.0f;
        frame::FrameSettings settings = ofSize(24, 24);
        settings.environment.light = fault.light;
        settings.environment.samples = 256;
        return EnvironmentTest::errorOf(drawn(scene, settings, Technique::Deferred, shaders),
                                        strictReference(scene, settings))
            .relMse;
    }
};

TEST_SWEEP(EnvironmentFaults, areSeenByTheReference) {
    for (const EnvironmentFault& fault :
         everyNth(std::vector(std::begin(kEnvironmentFaults), std::end(kEnvironmentFaults)), 2)) {
        SCOPED_TRACE(fault.fault);
        const ShaderMutant shaders;
        const double plain = errorOf(fault, shaders.tree());
        shaders.replace(fault.file, fault.from, fault.to);
        const double faulty = errorOf(fault, shaders.tree());
        fmt::print("{:34} relMSE {:.1e}, without it {:.1e}\n", fault.fault, faulty, plain);
        EXPECT_LE(plain, 0.15); // the shapes of the split sum's lobes
        // NaN counts as detected.
        EXPECT_FALSE(faulty <= 2.0 * plain + 1e-2);
    }
}

} // namespace
} // namespace tessera
