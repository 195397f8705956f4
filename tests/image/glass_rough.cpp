// How far rough glass spreads light: a half ball, which light passes once, and a closed ball, which it passes twice,
// before a sky and before a wall, against Walter's integral.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tests/image/GlassBehindTest.h"
#include "tests/support/Random.h"

namespace tessera {
namespace {

using frame::EnvironmentLight;
using frame::Refraction;
using scenes::Scene;
using namespace test;

constexpr double kBallMetres = 0.5; ///< radius
constexpr int kTexelsAcross = 32;   ///< of the sky, 11 degrees each
constexpr double kWallHalfMetres = 4.0;
/// Texels of the wall are as wide as those of the sky, seen from the ball.
constexpr int kWallTexels = 20;

/// Light along a ray.
using LightAlongRay = std::function<double(const glm::dvec3& origin, const glm::dvec3& direction)>;

/// What a facet lets pass of a ray at its cosine; ior is that beyond over that of its own side.
double passedByFacet(double ior, double cosine) {
    const double angle = std::acos(std::min(cosine, 1.0)), bent = std::asin(std::min(std::sin(angle) / ior, 1.0));
    if (std::sin(angle) >= ior) return 0.0;
    if (angle < 1e-6) return 4.0 * ior / ((1.0 + ior) * (1.0 + ior));
    const double crossed = std::sin(angle - bent) / std::sin(angle + bent);
    const double along = std::tan(angle - bent) / std::tan(angle + bent);
    return 1.0 - 0.5 * (crossed * crossed + along * along);
}

double maskedGgx(double alpha, double cosine) {
    return 2.0 * cosine / (cosine + std::sqrt(alpha * alpha + (1.0 - alpha * alpha) * cosine * cosine));
}

/// A facet that is seen from `toViewer`, of GGX around z. Source: Heitz 2018, "Sampling the GGX Distribution of Visible
/// Normals".
glm::dvec3 seenFacet(double alpha, const glm::dvec3& toViewer, double u, double v) {
    const glm::dvec3 stretched = glm::normalize(glm::dvec3(alpha * toViewer.x, alpha * toViewer.y, toViewer.z));
    const double across = std::hypot(stretched.x, stretched.y);
    const glm::dvec3 first =
        across > 0.0 ? glm::dvec3(-stretched.y, stretched.x, 0.0) / across : glm::dvec3(1.0, 0.0, 0.0);
    const double radius = std::sqrt(u), turn = 2.0 * std::numbers::pi * v, x = radius * std::cos(turn);
    const double share = 0.5 * (1.0 + stretched.z);
    const double y = (1.0 - share) * std::sqrt(1.0 - x * x) + share * radius * std::sin(turn);
    const glm::dvec3 facet =
        x * first + y * glm::cross(stretched, first) + std::sqrt(std::max(1.0 - x * x - y * y, 0.0)) * stretched;
    return glm::normalize(glm::dvec3(alpha * facet.x, alpha * facet.y, std::max(facet.z, 1e-9)));
}

struct BentByFacet {
    glm::dvec3 direction{0.0};
    double weight = 0.0; ///< transmitted or reflected fraction of the ray; 0: none
};

/// By a facet of a rough side: Walter et al. 2007, equations 21 and 40, of facets that are seen.
BentByFacet bentByFacet(double alpha, double ior, const glm::dvec3& normal, const glm::dvec3& toViewer, double u,
                        double v) {
    const glm::dvec3 right = glm::normalize(
        glm::cross(normal, std::abs(normal.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0)));
    const glm::dvec3 up = glm::cross(normal, right);
    const glm::dvec3 local =
        seenFacet(alpha, {glm::dot(toViewer, right), glm::dot(toViewer, up), glm::dot(toViewer, normal)}, u, v);
    const glm::dvec3 facet = local.x * right + local.y * up + local.z * normal;
    const double cosine = glm::dot(facet, toViewer);
    if (cosine <= 0.0) return {};
    const std::optional<glm::dvec3> bent = bentDirection(toViewer, ior, facet);
    if (!bent || glm::dot(*bent, normal) >= 0.0) return {};
    return {*bent, passedByFacet(ior, cosine) * maskedGgx(alpha, -glm::dot(*bent, normal))};
}

/// The mean light that rays of the viewer, which come along -z, find through the front of a ball around the origin, or
/// through front and back. In double precision, over facets that are spread evenly.
double throughBall(const glm::dvec2& place, double ior, double alpha, bool isClosed, int samples,
                   const LightAlongRay& light) {
    const double height = std::sqrt(kBallMetres * kBallMetres - glm::dot(place, place));
    const glm::dvec3 entry(place, height), toViewer(0.0, 0.0, 1.0);
    double sum = 0.0, weights = 0.0;
    const auto golden = [](int i, double step, double begin) { return std::fmod(i * step + begin, 1.0); };
    for (int i = 0; i < samples; ++i) {
        const double begin = std::fmod(std::abs(17.3 * place.x + 31.7 * place.y), 1.0);
        const BentByFacet inside = bentByFacet(alpha, ior, entry / kBallMetres, toViewer, (i + 0.5) / samples,
                                               golden(i, 0.6180339887498949, begin));
        if (!(inside.weight > 0.0)) continue;
        if (!isClosed) {
            sum += inside.weight * light(entry, inside.direction);
            weights += inside.weight;
            continue;
        }
        const glm::dvec3 exit = entry - 2.0 * glm::dot(entry, inside.direction) * inside.direction;
        const BentByFacet outside =
            bentByFacet(alpha, 1.0 / ior, -exit / kBallMetres, -inside.direction, golden(i, 0.7548776662466927, begin),
                        golden(i, 0.5698402909980532, begin));
        const double weight = inside.weight * outside.weight;
        if (!(weight > 0.0)) continue;
        sum += weight * light(exit, outside.direction);
        weights += weight;
    }
    return sum / weights;
}

Scene ballScene(const scenes::Material& glass, double halfHeightMetres) {
    Scene scene = quadScene(glass);
    scene.meshes[0] = {};
    scenes::builtin::appendSphere(scene.meshes[0], {}, kBallMetres, 192, 96);
    scene.nodes[0].parentFromNode = glm::dmat4(1.0);
    scene.cameras[0].projection = scenes::Projection::Orthographic;
    scene.cameras[0].halfHeightMetres = halfHeightMetres;
    scene.cameras[0].farMetres = 20.0;
    return scene;
}

class GlassRough : public GlassTest {
protected:
    struct Found {
        double mean, worst;
        int judged;
    };
    /// Relative errors of the pixels of the ball that `isJudged`.
    template <typename IsJudged>
    static Found errorOf(const std::vector<float>& shown, int side, double halfHeightMetres, double ior,
                         double roughness, bool isClosed, int samples, const LightAlongRay& light, IsJudged isJudged) {
        Found found{};
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const glm::dvec2 place =
                    halfHeightMetres * glm::dvec2(2.0 * x + 1.0 - side, side - 2.0 * y - 1.0) / double(side);
                if (glm::length(place) > 0.95 * kBallMetres || !isJudged(place)) continue;
                const double wanted = throughBall(place, ior, roughness * roughness, isClosed, samples, light);
                const double error = std::abs(shown[std::size_t(4 * (y * side + x))] / wanted - 1.0);
                found.mean += error;
                found.worst = std::max(found.worst, error);
                ++found.judged;
            }
        found.mean /= found.judged;
        return found;
    }
    void expectSpreadAsWalters(std::vector<double> iors, int side, int samples, bool beforeWall);
};
using GlassRoughSlow = GlassRough;

/// Mean errors are at most 3 % at a roughness of 0.2, and 6 % at 0.4.
void GlassRough::expectSpreadAsWalters(std::vector<double> iors, int side, int samples, bool beforeWall) {
    Random random(61);
    std::vector<double> texels(std::size_t(kTexelsAcross * kTexelsAcross));
    for (double& texel : texels) texel = random.between(0.1, 1.1);
    const auto texel = [&](int x, int y) { return texels[std::size_t(y * kTexelsAcross + x)]; };
    for (const bool isClosed : {false, true})
        for (const double roughness : {0.2, 0.4})
            for (const double ior : iors) {
                frame::FrameSettings settings = ofSide(side);
                settings.filter = frame::TextureFilter::Exact;
                if (!isClosed) settings.refraction = Refraction::OneSide;
                const double most = roughness < 0.3 ? 0.03 : 0.06;
                const auto expect = [&](const Found& found, std::string_view before) {
                    fmt::print("{} before {}, roughness {}, index {}: mean error {:.4f}, worst {:.3f}, {} pixels\n",
                               isClosed ? "ball" : "half ball", before, roughness, ior, found.mean, found.worst,
                               found.judged);
                    EXPECT_LE(found.mean, most) << isClosed << ", " << before << ", " << roughness << ", " << ior;
                };
                if (!beforeWall) {
                    Scene scene = ballScene(bareGlass(ior, roughness), 1.02 * kBallMetres);
                    scene.environment = environmentOf(kTexelsAcross, kTexelsAcross / 2,
                                                      [&](int x, int y) { return glm::dvec3(texel(x, y)); });
                    const LightAlongRay sky = [&](const glm::dvec3&, const glm::dvec3& direction) {
                        const glm::dvec2 place =
                            scenes::placeInMap(direction) * glm::dvec2(kTexelsAcross, kTexelsAcross / 2) - 0.5;
                        const glm::dvec2 corner = glm::floor(place), share = place - corner;
                        const auto at = [&](int i, int j) {
                            return texel((int(corner.x) + i + kTexelsAcross) % kTexelsAcross,
                                         std::clamp(int(corner.y) + j, 0, kTexelsAcross / 2 - 1));
                        };
                        return std::lerp(std::lerp(at(0, 0), at(1, 0), share.x), std::lerp(at(0, 1), at(1, 1), share.x),
                                         share.y);
                    };
                    settings.environment.samples = 256;
                    for (const EnvironmentLight light : {EnvironmentLight::SplitSum, EnvironmentLight::Sampled}) {
                        settings.environment.light = light;
                        expect(errorOf(drawn(scene, settings), side, 1.02 * kBallMetres, ior, roughness, isClosed,
                                       samples, sky, [](const glm::dvec2&) { return true; }),
                               infoOf(light).name);
                    }
                    continue;
                }
                // The picture shows 2 m of the wall to either side.
                constexpr double kHalfHeightMetres = 2.0;
                std::vector<glm::vec4> rows;
                for (int y = 0; y < kWallTexels; ++y)
                    for (int x = 0; x < kWallTexels; ++x) rows.emplace_back(glm::vec3(float(texel(x, y))), 1.0f);
                scenes::Image image;
                image.name = "wall";
                image.width = image.height = kWallTexels;
                image.format = scenes::TexelFormat::Rgba32Float;
                const auto* const bytes = reinterpret_cast<const std::byte*>(rows.data());
                image.texels.assign(bytes, bytes + rows.size() * sizeof(glm::vec4));
                Scene wall = wallScene(std::move(image), kWallHalfMetres);
                wall.background = glm::vec3(0.6f);
                scenes::Sampler& sampler = wall.materials[0].texture(scenes::TextureSlot::BaseColor).sampler;
                sampler.magnification = sampler.minification = scenes::Filter::Linear;
                wall.cameras[0].halfHeightMetres = kHalfHeightMetres;
                Scene covered = wall;
                covered.materials.push_back(bareGlass(ior, roughness));
                scenes::builtin::appendSphere(covered.meshes.emplace_back(), {}, kBallMetres, 192, 96);
                covered.nodes.emplace_back().instances.push_back({1, 1});
                // All of the wall, finer.
                constexpr int kWholeSide = 320;
                wall.cameras[0].halfHeightMetres = kWallHalfMetres;
                frame::FrameSettings wholeSettings = settings;
                wholeSettings.sizePixels = {kWholeSide, kWholeSide};
                const std::vector<float> whole = drawn(wall, wholeSettings);
                const auto metAt = [](const glm::dvec3& origin, const glm::dvec3& direction) {
                    return glm::dvec2(origin) - (origin.z + kBehindWallMetres) / direction.z * glm::dvec2(direction);
                };
                const LightAlongRay behind = [&](const glm::dvec3& origin, const glm::dvec3& direction) {
                    if (direction.z >= 0.0) return 0.6;
                    const glm::dvec2 met = metAt(origin, direction);
                    if (std::max(std::abs(met.x), std::abs(met.y)) > kWallHalfMetres) return 0.6;
                    const glm::dvec2 place =
                        0.5 * (glm::dvec2(met.x, -met.y) / kWallHalfMetres + 1.0) * double(kWholeSide) - 0.5;
                    const glm::dvec2 corner = glm::floor(place), share = place - corner;
                    const auto at = [&](int i, int j) {
                        const int column = std::clamp(int(corner.x) + i, 0, kWholeSide - 1),
                                  row = std::clamp(int(corner.y) + j, 0, kWholeSide - 1);
                        return double(whole[std::size_t(4 * (row * kWholeSide + column))]);
                    };
                    return std::lerp(std::lerp(at(0, 0), at(1, 0), share.x), std::lerp(at(0, 1), at(1, 1), share.x),
                                     share.y);
                };
                // Where the middle of the lobe meets what the picture shows, and half a texel around.
                const auto isSeen = [&](const glm::dvec2& place) {
                    const double met = throughBall(place, ior, 1e-4, isClosed, 1,
                                                   [&](const glm::dvec3& origin, const glm::dvec3& way) {
                                                       if (way.z >= 0.0) return 1e9;
                                                       const glm::dvec2 at = metAt(origin, way);
                                                       return std::max(std::abs(at.x), std::abs(at.y));
                                                   });
                    return met < kHalfHeightMetres - 0.4;
                };
                expect(errorOf(drawn(covered, settings), side, kHalfHeightMetres, ior, roughness, isClosed, samples,
                               behind, isSeen),
                       "a wall");
            }
}

TEST_F(GlassRough, spreadsTheSkyAsWaltersIntegral) {
    expectSpreadAsWalters({1.5}, 20, 1024, false);
}
TEST_F(GlassRough, spreadsAWallAsWaltersIntegral) {
    expectSpreadAsWalters({1.5}, 64, 1024, true);
}
TEST_F(GlassRoughSlow, spreadsTheSkyAsWaltersIntegral) {
    expectSpreadAsWalters({1.1, 1.3, 1.5, 1.8, 2.1, 2.4}, 48, 4096, false);
}
TEST_F(GlassRoughSlow, spreadsAWallAsWaltersIntegral) {
    expectSpreadAsWalters({1.1, 1.3, 1.5, 1.8, 2.1, 2.4}, 128, 4096, true);
}

} // namespace
} // namespace tessera
