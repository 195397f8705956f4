#include "tests/image/ImageTest.h"
#include "tests/image/Textbook.h"

namespace tessera {
namespace {

using engine::Technique;
using scenes::Material;
using scenes::MaterialModel;
using namespace test;

constexpr glm::ivec2 kSize = {192, 128};

/// The debug views D, G and F of `head`, against an independent evaluation at each pixel by the material, the shading
/// normal and the distance that the engine shows.
class SpecularViews : public ImageTest {
protected:
    SpecularViews() {
        scenes::LoadOptions options;
        options.useAssets = false; // the generated bust, whose alpha and ior no texture changes
        scene_ = scenes::loadScene("head", options);
    }
    std::vector<float> show(engine::Renderer& renderer, frame::DebugView view, Technique technique, int light) {
        frame::FrameSettings settings = withView(ofSize(kSize), view);
        settings.soloLight = light;
        return renderer.render(technique, settings).radiance;
    }
    const Material* materialAt(const float* ids) const {
        int place = int(ids[0]) - 1;
        for (const scenes::Node& node : scene_.nodes)
            for (const scenes::MeshInstance& instance : node.instances)
                if (place-- == 0) return &scene_.materials[std::size_t(instance.material)];
        return nullptr;
    }
    scenes::Scene scene_;
};

/// The point of a pixel's ray after `metres` along the view axis; pixels in rows from the top.
glm::dvec3 pointAt(const scenes::Camera& camera, std::size_t pixel, double metres) {
    const double x = double(pixel % std::size_t(kSize.x)) + 0.5, y = double(pixel / std::size_t(kSize.x)) + 0.5;
    const double tangent = std::tan(0.5 * camera.fovYRadians);
    const glm::dvec3 rayVS((2.0 * x - kSize.x) / kSize.y * tangent, (1.0 - 2.0 * y / kSize.y) * tangent, -1.0);
    return glm::dvec3(camera.worldFromCamera * glm::dvec4(metres * rayVS, 1.0));
}

struct Terms {
    double d = 0.0, g = 0.0;
    glm::dvec3 f{0.0};
};

/// Textbook formulas. Zero where the light does not reach the surface's front; D and G are also zero where a normal map
/// turns the front away from the eye, since there is no highlight.
Terms textbookTerms(const Material& m, const glm::dvec3& n, const glm::dvec3& l, const glm::dvec3& v) {
    using namespace textbook;
    Terms terms;
    const double nl = glm::dot(n, l), nv = glm::dot(n, v);
    if (m.model == MaterialModel::Lambert || nl <= 0.0) return terms;
    const glm::dvec3 h = glm::normalize(l + v);
    const double nh = glm::dot(n, h), lh = glm::dot(l, h);
    if (m.model == MaterialModel::Microfacet) {
        terms.d = distribution(m.alpha, nh) * chi(nv);
        terms.g = smith(m.alpha, nl) * smith(m.alpha, nv) * chi(nv);
        terms.f = glm::dvec3(fresnel(m.ior, lh));
        return terms;
    }
    const double alpha = squared(m.perceptualRoughness);
    terms.d = distribution(alpha, nh) * chi(nv);
    terms.g = correlatedMasking(alpha, nl, nv) * chi(nv);
    const glm::dvec3 f0 = glm::mix(glm::dvec3(0.04), glm::dvec3(m.baseColor), double(m.metallic));
    terms.f = f0 + (glm::dvec3(1.0) - f0) * std::pow(1.0 - lh, 5);
    return terms;
}

/// With both, whose views are equal (Parity), or with `deferred`.
TEST_SWEEP(SpecularViews, dGAndFOfHeadEqualTheirFormulasAndFIsExactlyZeroWhereTheLightIsNotSeen) {
    engine::Renderer renderer(context(), scene_);
    const scenes::Camera& camera = scene_.cameras[0];
    constexpr Technique kBoth[] = {Technique::Forward, Technique::Deferred};
    for (const Technique technique : inTurn(kBoth, 1))
        for (int light = 0; light < int(scene_.lights.size()); ++light) {
            const auto view = [&](frame::DebugView what) { return show(renderer, what, technique, light); };
            const std::vector<float> ids = view(frame::DebugView::Ids), depth = view(frame::DebugView::Depth),
                                     normal = view(frame::DebugView::Normal), d = view(frame::DebugView::Distribution),
                                     g = view(frame::DebugView::Geometry), f = view(frame::DebugView::Fresnel);
            std::size_t lit = 0, unlit = 0;
            double worst[3] = {};
            for (std::size_t i = 0; i < std::size_t(kSize.x * kSize.y); ++i) {
                const Material* material = materialAt(&ids[4 * i]);
                if (material == nullptr) continue;
                const glm::dvec3 positionWS = pointAt(camera, i, depth[4 * i]);
                const glm::dvec3 n = glm::normalize(glm::dvec3(normal[4 * i], normal[4 * i + 1], normal[4 * i + 2]));
                glm::dvec3 l;
                const bool reached =
                    textbook::incident(scene_.lights[std::size_t(light)], positionWS, l) != glm::dvec3(0.0);
                const glm::dvec3 v = glm::normalize(glm::dvec3(camera.worldFromCamera[3]) - positionWS);
                // Rounding decides on the border between light and none, and where the surface is viewed edge-on.
                if (std::abs(glm::dot(n, l)) < 1e-5 || std::abs(glm::dot(n, v)) < 1e-3) continue;
                const Terms wanted = reached ? textbookTerms(*material, n, l, v) : Terms{};
                if (wanted.f == glm::dvec3(0.0)) {
                    ++unlit;
                    ASSERT_EQ(glm::vec3(f[4 * i], f[4 * i + 1], f[4 * i + 2]), glm::vec3(0.0f)) << i;
                    ASSERT_EQ(d[4 * i], 0.0f) << i;
                    continue;
                }
                ++lit;
                // D exceeds 1; the others are fractions.
                worst[0] = std::max(worst[0], std::abs(d[4 * i] - wanted.d) / std::max(1.0, wanted.d));
                worst[1] = std::max(worst[1], std::abs(g[4 * i] - wanted.g));
                for (std::size_t c = 0; c < 3; ++c)
                    worst[2] = std::max(worst[2], std::abs(f[4 * i + c] - wanted.f[int(c)]));
            }
            SCOPED_TRACE(fmt::format("{}, light {}: {} lit pixels, {} not; D {:.1e} G {:.1e} F {:.1e}", int(technique),
                                     light, lit, unlit, worst[0], worst[1], worst[2]));
            fmt::print("light {}: {} lit, {} not; D {:.1e} G {:.1e} F {:.1e}\n", light, lit, unlit, worst[0], worst[1],
                       worst[2]);
            EXPECT_GE(lit, 1000u);
            EXPECT_GE(unlit, 100u);
            for (const double error : worst) EXPECT_LE(error, 1e-5);
        }
}

} // namespace
} // namespace tessera
