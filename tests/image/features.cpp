#include <functional>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/image/ImageTest.h"
#include "validation/figures/ErrorFigures.h"

namespace tessera {
namespace {

using engine::Technique;
using scenes::Light;
using scenes::Material;
using scenes::MaterialModel;
using scenes::Scene;
using scenes::TextureSlot;
using namespace test;

/// Indices into everythingScene().
enum : std::size_t { kUnlit, kFloor, kGloss, kMetal, kDielectric, kMasked, kGlass };
enum : std::size_t { kPhong = kGlass + 1, kBrushed, kSilk, kHandout, kCoated, kCloth };
enum : std::size_t { kSun, kSpot, kRanged, kOff, kAttenuated, kPoint };
constexpr std::size_t kQuadMesh = 0, kSphereMesh = 1, kMirroredNode = 3;

struct Change {
    const char* what;
    std::function<void(Scene&)> apply;
};

/// Expects each change alone, applied to the scene of every feature or another one, to change the image.
class Features : public ImageTest {
protected:
    static frame::FrameSettings small() { return ofSize(160, 90); }
    static std::size_t changedPixels(const Picture& a, const Picture& b) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < a.pixelCount(); ++i) count += !std::equal(a.pixel(i), a.pixel(i) + 3, b.pixel(i));
        return count;
    }
    /// Without pruning, so that all share programs, whose compilation takes most of the time. A whole sweep also draws
    /// the scene with pruning and every fourth change in forward; elsewhere Glass covers pruning and Parity techniques.
    void expectEachShows(const std::vector<Change>& changes, const Scene& base = everythingScene()) {
        std::size_t turn = 0;
        engine::Renderer baseRenderer(context(), base);
        frame::FrameSettings settings = small();
        settings.prune = false;
        const Picture before = engine::toPicture(baseRenderer.render(Technique::Deferred, settings));
        if (isWholeSweep()) {
            EXPECT_EQ(engine::toPicture(baseRenderer.render(Technique::Deferred, small())).rgba, before.rgba);
        }
        for (const Change& change : changes) {
            SCOPED_TRACE(change.what);
            Scene scene = base;
            change.apply(scene);
            ASSERT_NO_THROW(scenes::checkScene(scene));
            engine::Renderer renderer(context(), scene);
            const Picture deferred = engine::toPicture(renderer.render(Technique::Deferred, settings));
            EXPECT_GT(changedPixels(before, deferred), 10u) << "the picture did not change";
            if (!isWholeSweep() || turn++ % 4 != 0) continue;
            const Picture forward = engine::toPicture(renderer.render(Technique::Forward, settings));
            EXPECT_EQ(forward.rgba, deferred.rgba) << "forward and deferred do not agree on it";
            const validation::ErrorFigures figures = validation::errorFigures(deferred, forward);
            EXPECT_EQ(figures.bad.sum() + figures.badOutside.sum(), 0u);
        }
    }
};

/// A change of one material's field or texture.
Change material(const char* what, std::size_t index, std::function<void(Material&)> apply) {
    return {what, [=](Scene& scene) { apply(scene.materials[index]); }};
}
Change light(const char* what, std::size_t index, std::function<void(Light&)> apply) {
    return {what, [=](Scene& scene) { apply(scene.lights[index]); }};
}
Change camera(const char* what, std::function<void(scenes::Camera&)> apply) {
    return {what, [=](Scene& scene) { apply(scene.cameras[0]); }};
}
Change withoutTexture(const char* what, std::size_t index, TextureSlot slot) {
    return material(what, index, [=](Material& m) { m.texture(slot) = {}; });
}

TEST_SWEEP(Features, everyTextureSlotChangesThePicture) {
    const std::vector<Change> changes{
        withoutTexture("base colour of lambert", kFloor, TextureSlot::BaseColor),
        withoutTexture("base colour of metallic_roughness", kDielectric, TextureSlot::BaseColor),
        withoutTexture("normal, object space", kGloss, TextureSlot::Normal),
        withoutTexture("normal, tangent space", kMetal, TextureSlot::Normal),
        withoutTexture("alpha of microfacet", kGloss, TextureSlot::MetallicRoughness),
        withoutTexture("metallic and roughness", kMetal, TextureSlot::MetallicRoughness),
        withoutTexture("emissive", kMetal, TextureSlot::Emissive),
        withoutTexture("specular factor", kDielectric, TextureSlot::SpecularFactor),
        withoutTexture("k_s", kGloss, TextureSlot::SpecularColor),
        withoutTexture("ior", kGloss, TextureSlot::Ior),
        material("specular tint", kDielectric,
                 [](Material& m) { m.texture(TextureSlot::SpecularColor) = m.texture(TextureSlot::SpecularFactor); }),
        withoutTexture("exponent of blinn_phong", kPhong, TextureSlot::MetallicRoughness),
        withoutTexture("k_s of blinn_phong", kPhong, TextureSlot::SpecularColor),
        withoutTexture("alpha_y", kBrushed, TextureSlot::Anisotropy),
        withoutTexture("normal below an anisotropic lobe", kBrushed, TextureSlot::Normal),
        material("alpha_x", kSilk, [](Material& m) { m.texture(TextureSlot::MetallicRoughness).image = 0; }),
        withoutTexture("anisotropy", kCoated, TextureSlot::Anisotropy),
        withoutTexture("clearcoat", kCoated, TextureSlot::Clearcoat),
        withoutTexture("clearcoat roughness", kCoated, TextureSlot::ClearcoatRoughness),
        withoutTexture("clearcoat normal", kCoated, TextureSlot::ClearcoatNormal),
        withoutTexture("sheen colour", kCloth, TextureSlot::SheenColor),
        withoutTexture("sheen roughness", kCloth, TextureSlot::SheenRoughness),
        material("base colour of single_color", kUnlit,
                 [](Material& m) { m.texture(TextureSlot::BaseColor).image = 0; }),
    };
    expectEachShows(everyNth(changes, 2));
}

Scene withTexturedGlassAndFilm() {
    Scene base = everythingScene();
    Material& metal = base.materials[kMetal];
    metal.iridescence = 1.0f;
    metal.texture(TextureSlot::Iridescence).image = metal.texture(TextureSlot::IridescenceThickness).image = 0;
    Material& glass = base.materials[kGlass];
    glass.transmission = 0.8f;
    glass.thicknessMetres = glass.attenuationDistanceMetres = 1.0f;
    glass.attenuationColor = {0.1f, 1.0f, 0.1f};
    glass.texture(TextureSlot::Transmission).image = glass.texture(TextureSlot::Thickness).image = 0;
    return base;
}
TEST_SWEEP(Features, everyTextureOfGlassAndFilmsChangesThePicture) {
    const std::vector<Change> changes{
        withoutTexture("iridescence", kMetal, TextureSlot::Iridescence),
        withoutTexture("thickness of a film", kMetal, TextureSlot::IridescenceThickness),
        material("least thickness of a film", kMetal, [](Material& m) { m.iridescenceLeastThicknessNm = 700.0f; }),
        withoutTexture("transmission", kGlass, TextureSlot::Transmission),
        withoutTexture("thickness of a body", kGlass, TextureSlot::Thickness),
    };
    expectEachShows(changes, withTexturedGlassAndFilm());
}

TEST_SWEEP(Features, everyTextureSettingChangesThePicture) {
    const auto floor = [](const char* what, std::function<void(scenes::TextureUse&)> apply) {
        return material(what, kFloor, [=](Material& m) { apply(m.texture(TextureSlot::BaseColor)); });
    };
    const std::vector<Change> changes{
        floor("offset", [](scenes::TextureUse& use) { use.transform.offset.x += 0.3f; }),
        floor("scale", [](scenes::TextureUse& use) { use.transform.scale.y *= 0.5f; }),
        floor("rotation", [](scenes::TextureUse& use) { use.transform.rotationRadians = -0.4f; }),
        floor("coordinate set", [](scenes::TextureUse& use) { use.texCoordSet = 1; }),
        floor("wrap u, clamp", [](scenes::TextureUse& use) { use.sampler.wrapU = scenes::Wrap::ClampToEdge; }),
        floor("wrap v, clamp", [](scenes::TextureUse& use) { use.sampler.wrapV = scenes::Wrap::ClampToEdge; }),
        floor("wrap u, mirror", [](scenes::TextureUse& use) { use.sampler.wrapU = scenes::Wrap::MirroredRepeat; }),
        floor("wrap v, mirror", [](scenes::TextureUse& use) { use.sampler.wrapV = scenes::Wrap::MirroredRepeat; }),
        floor("minification", [](scenes::TextureUse& use) { use.sampler.minification = scenes::Filter::Nearest; }),
        floor("magnification",
              [](scenes::TextureUse& use) {
                  use.transform.scale = glm::vec2(0.05f);
                  use.sampler.magnification = scenes::Filter::Nearest;
              }),
        material("transform of the normal map", kMetal,
                 [](Material& m) { m.texture(TextureSlot::Normal).transform.scale = glm::vec2(2.0f); }),
        material("transform of the roughness map", kGloss,
                 [](Material& m) { m.texture(TextureSlot::MetallicRoughness).transform.offset = glm::vec2(0.5f); }),
        material("transform of the emissive map", kMetal,
                 [](Material& m) { m.texture(TextureSlot::Emissive).transform.rotationRadians = 1.0f; }),
        {"texels of the colours",
         [](Scene& s) {
             s.images[0].texels[0] = s.images[0].texels[4 * 2080] = std::byte(255);
             s.images[0].texels.assign(s.images[0].texels.size(), std::byte(90));
         }},
    };
    expectEachShows(everyNth(changes, 2));
}

TEST_SWEEP(Features, everyMaterialParameterChangesThePicture) {
    const std::vector<Change> changes{
        material("colour of single_color", kUnlit, [](Material& m) { m.baseColor.r = 0.9f; }),
        material("k_d of lambert", kFloor, [](Material& m) { m.baseColor.g = 0.1f; }),
        material("k_d of microfacet", kGloss, [](Material& m) { m.baseColor.b = 0.9f; }),
        material("base colour", kMetal, [](Material& m) { m.baseColor.r = 0.2f; }),
        material("emission", kMetal, [](Material& m) { m.emissive.b = 0.5f; }),
        material("emission of lambert", kFloor, [](Material& m) { m.emissive.r = 0.01f; }),
        material("metallic", kMetal, [](Material& m) { m.metallic = 0.3f; }),
        material("perceptual roughness", kMetal, [](Material& m) { m.perceptualRoughness = 0.3f; }),
        material("alpha", kGloss, [](Material& m) { m.alpha = 0.2f; }),
        material("ior of microfacet", kGloss, [](Material& m) { m.ior = 2.4f; }),
        material("ior of metallic_roughness", kDielectric, [](Material& m) { m.ior = 1.2f; }),
        material("specular factor", kDielectric, [](Material& m) { m.specularFactor = 0.2f; }),
        material("k_s", kGloss, [](Material& m) { m.specularColor = glm::vec3(0.1f, 0.9f, 0.9f); }),
        material("specular tint", kDielectric, [](Material& m) { m.specularColor = glm::vec3(0.1f, 0.2f, 0.9f); }),
        material("k_d of blinn_phong", kPhong, [](Material& m) { m.baseColor.r = 0.9f; }),
        material("k_s of blinn_phong", kPhong, [](Material& m) { m.specularColor.b = 0.9f; }),
        material("exponent", kPhong, [](Material& m) { m.exponent = 4.0f; }),
        material("exponent 0", kPhong, [](Material& m) { m.exponent = 0.0f; }),
        material("alpha_x", kSilk, [](Material& m) { m.alpha = 0.6f; }),
        material("alpha_y", kSilk, [](Material& m) { m.alphaY = 0.1f; }),
        material("ior of microfacet_anisotropic", kSilk, [](Material& m) { m.ior = 1.2f; }),
        material("k_s of microfacet_anisotropic", kSilk, [](Material& m) { m.specularColor.r = 0.2f; }),
        material("masking, Walter to directional", kSilk,
                 [](Material& m) { m.masking = scenes::Masking::Directional; }),
        material("masking, directional to half vector", kBrushed,
                 [](Material& m) { m.masking = scenes::Masking::HalfVector; }),
        material("masking, half vector to Walter", kHandout, [](Material& m) { m.masking = scenes::Masking::Walter; }),
        material("anisotropy", kCoated, [](Material& m) { m.anisotropyStrength = 0.3f; }),
        material("rotation of the anisotropy", kCoated, [](Material& m) { m.anisotropyRotationRadians = -0.6f; }),
        material("no anisotropy", kCoated, [](Material& m) { m.anisotropyStrength = 0.0f; }),
        material("clearcoat", kCoated, [](Material& m) { m.clearcoat = 0.4f; }),
        material("no clearcoat", kCoated, [](Material& m) { m.clearcoat = 0.0f; }),
        material("clearcoat roughness", kCoated, [](Material& m) { m.clearcoatPerceptualRoughness = 0.9f; }),
        material("clearcoat normal scale", kCoated, [](Material& m) { m.clearcoatNormalScale = 0.1f; }),
        material("sheen colour", kCloth, [](Material& m) { m.sheenColor.g = 0.1f; }),
        material("no sheen", kCloth, [](Material& m) { m.sheenColor = glm::vec3(0.0f); }),
        material("sheen roughness", kCloth, [](Material& m) { m.sheenPerceptualRoughness = 0.3f; }),
        material("iridescence", kMetal, [](Material& m) { m.iridescence = 1.0f; }),
        material("normal scale", kMetal, [](Material& m) { m.normalScale = 0.2f; }),
        material("normal-map space", kMetal, [](Material& m) { m.normalMapSpace = scenes::NormalMapSpace::Object; }),
        material("alpha cutoff", kMasked, [](Material& m) { m.alphaCutoff = 0.1f; }),
        material("mask off", kMasked, [](Material& m) { m.alphaMode = scenes::AlphaMode::Opaque; }),
        material("opacity of a blended surface", kGlass, [](Material& m) { m.baseColor.a = 0.9f; }),
        material("transmission", kGlass, [](Material& m) { m.transmission = 0.8f; }),
        material("transmission of unblended surfaces", kMasked, [](Material& m) { m.transmission = 0.8f; }),
        material("absorption of a body", kGlass,
                 [](Material& m) {
                     m.transmission = 0.8f;
                     m.thicknessMetres = m.attenuationDistanceMetres = 1.0f;
                     m.attenuationColor = {0.1f, 1.0f, 0.1f};
                 }),
        material("blend off", kGlass, [](Material& m) { m.alphaMode = scenes::AlphaMode::Opaque; }),
        material("double-sided, seen from behind", kDielectric, [](Material& m) { m.doubleSided = false; }),
        material("wrap", kGloss, [](Material& m) { m.subsurface.wrap = 0.2f; }),
        material("tint of the wrap", kCloth, [](Material& m) { m.subsurface.wrapTint.r = 1.0f; }),
        material("no subsurface", kCloth, [](Material& m) { m.subsurface.method = scenes::SubsurfaceMethod::None; }),
        material("unlit", kDielectric, [](Material& m) { m.model = MaterialModel::SingleColor; }),
        material("lambert", kDielectric, [](Material& m) { m.model = MaterialModel::Lambert; }),
        material("microfacet", kDielectric, [](Material& m) { m.model = MaterialModel::Microfacet; }),
        material("blinn_phong", kDielectric, [](Material& m) { m.model = MaterialModel::BlinnPhong; }),
        material("microfacet_anisotropic", kDielectric,
                 [](Material& m) { m.model = MaterialModel::MicrofacetAnisotropic; }),
    };
    expectEachShows(everyNth(changes, 3));
}

TEST_SWEEP(Features, everyVertexAttributeAndTransformChangesThePicture) {
    const std::vector<Change> changes{
        {"vertex colours", [](Scene& s) { s.meshes[kQuadMesh].colors.clear(); }},
        {"a vertex colour",
         [](Scene& s) {
             s.meshes[kQuadMesh].colors[2] = {0, 0, 0, 1};
         }},
        {"vertex opacity",
         [](Scene& s) {
             for (glm::vec4& color : s.meshes[kQuadMesh].colors) color.a = 0.3f;
         }},
        {"first uv set",
         [](Scene& s) {
             for (glm::vec2& uv : s.meshes[kQuadMesh].texCoords[0]) uv *= 0.5f;
         }},
        {"second uv set",
         [](Scene& s) {
             for (glm::vec2& uv : s.meshes[kQuadMesh].texCoords[1]) uv = {uv.y, uv.x * 0.5f};
         }},
        {"normals",
         [](Scene& s) {
             for (glm::vec3& n : s.meshes[kSphereMesh].normalsOS) n = {0, 0, 1};
         }},
        {"authored tangents",
         [](Scene& s) {
             // Differ from the tangents of the texture coordinates: turned by 45 degrees and mirrored.
             for (const glm::vec3& n : s.meshes[kSphereMesh].normalsOS) {
                 const glm::vec3 other = std::abs(n.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
                 s.meshes[kSphereMesh].tangentsOS.emplace_back(
                     glm::normalize(glm::cross(n, other) + glm::cross(n, glm::cross(n, other))), -1.0f);
             }
         }},
        {"mirrored node",
         [](Scene& s) {
             s.nodes[kMirroredNode].parentFromNode =
                 glm::scale(s.nodes[kMirroredNode].parentFromNode, glm::dvec3(-1, 1, 1));
         }},
        {"parent's transform",
         [](Scene& s) {
             s.nodes[4].parent = 3;
             s.nodes[4].parentFromNode = glm::translate(glm::dmat4(1.0), glm::dvec3(-1.6, 0.2, 0.4));
         }},
    };
    expectEachShows(changes);
}

TEST_SWEEP(Features, everyLightParameterChangesThePicture) {
    const std::vector<Change> changes{
        light("disabled", kSun, [](Light& l) { l.enabled = false; }),
        light("enabled", kOff, [](Light& l) { l.enabled = true; }),
        light("directional to point", kSun, [](Light& l) { l.type = scenes::LightType::Point; }),
        light("point to spot", kPoint, [](Light& l) { l.type = scenes::LightType::Spot; }),
        light("colour", kPoint, [](Light& l) { l.color = glm::vec3(0.2f, 0.4f, 1.0f); }),
        light("intensity", kPoint, [](Light& l) { l.intensity *= 1.5f; }),
        light("position", kPoint, [](Light& l) { l.positionWS.x += 0.5; }),
        light("direction of the sun", kSun,
              [](Light& l) { l.directionWS = glm::normalize(glm::dvec3(0.4, -1, -0.5)); }),
        light("direction of the spot", kSpot,
              [](Light& l) { l.directionWS = glm::normalize(glm::dvec3(-0.4, -1, -0.5)); }),
        light("range", kRanged, [](Light& l) { l.rangeMetres = 2.0f; }),
        light("inner cone", kSpot, [](Light& l) { l.innerConeRadians = 0.4f; }),
        light("outer cone", kSpot, [](Light& l) { l.outerConeRadians = 0.4f; }),
        light("attenuation A", kAttenuated, [](Light& l) { l.attenuation.x = 0.1f; }),
        light("attenuation B", kAttenuated, [](Light& l) { l.attenuation.y = 0.9f; }),
        light("attenuation C", kAttenuated, [](Light& l) { l.attenuation.z = 0.0f; }),
        light("falloff", kAttenuated, [](Light& l) { l.falloff = scenes::Falloff::InverseSquare; }),
        light("animation at time 0", kPoint,
              [](Light& l) {
                  l.animation.emplace();
                  l.animation->kind = scenes::LightAnimationKind::Wobble;
                  l.animation->phase = 0.25;
                  l.animation->amplitudeMetres = {1.0, 0.0, 0.0};
              }),
    };
    expectEachShows(changes);
}

TEST_SWEEP(Features, everyCameraParameterChangesThePicture) {
    const std::vector<Change> changes{
        camera("place", [](scenes::Camera& c) { c.worldFromCamera[3].y += 0.2; }),
        camera("field of view", [](scenes::Camera& c) { c.fovYRadians = 0.6; }),
        camera("near plane", [](scenes::Camera& c) { c.nearMetres = 5.0; }),
        camera("far plane", [](scenes::Camera& c) { c.farMetres = 6.0; }),
        camera("orthographic", [](scenes::Camera& c) { c.projection = scenes::Projection::Orthographic; }),
        {"background", [](Scene& s) { s.background.g = 0.5f; }},
    };
    expectEachShows(changes);
}

TEST_F(Features, anAnimatedLightMovesWithTimeAndOthersNever) {
    Scene scene = everythingScene();
    engine::Renderer still(context(), scene);
    frame::FrameSettings settings = small();
    const std::vector<float> atStart = still.render(Technique::Deferred, settings).radiance;
    settings.timeSeconds = 0.25;
    EXPECT_EQ(still.render(Technique::Deferred, settings).radiance, atStart);
    scene.lights[kPoint].animation.emplace();
    scene.lights[kPoint].animation->centerWS = {0, 2, 0};
    EXPECT_NE(drawn(scene, settings), atStart);
}

TEST_F(Features, everyFrameSettingChangesItsOwnFeaturesOnly) {
    const Scene scene = everythingScene();
    engine::Renderer renderer(context(), scene);
    const engine::RenderedFrame base = renderer.render(Technique::Deferred, small());
    struct Setting {
        const char* what;
        bool radiance; ///< whether radiance changes; the display image always does
        std::function<void(frame::FrameSettings&)> apply;
    };
    const std::vector<Setting> settings = {
        {"exposure", false, [](frame::FrameSettings& s) { s.exposureEV = 1.0f; }},
        {"khronos_neutral", false, [](frame::FrameSettings& s) { s.toneMap = frame::ToneMap::KhronosNeutral; }},
        {"aces", false, [](frame::FrameSettings& s) { s.toneMap = frame::ToneMap::Aces; }},
        {"agx", false, [](frame::FrameSettings& s) { s.toneMap = frame::ToneMap::Agx; }},
        {"specular off", true, [](frame::FrameSettings& s) { s.specular = false; }},
        {"solo light", true, [](frame::FrameSettings& s) { s.soloLight = int(kSpot); }},
        {"view", true, [](frame::FrameSettings& s) { s.view = frame::DebugView::Normal; }},
        {"subsurface none", true, [](frame::FrameSettings& s) { s.subsurface = scenes::SubsurfaceMethod::None; }},
        {"filter", true, [](frame::FrameSettings& s) { s.filter = frame::TextureFilter::Exact; }},
    };
    for (const Setting& setting : settings) {
        SCOPED_TRACE(setting.what);
        frame::FrameSettings changed = small();
        setting.apply(changed);
        const engine::RenderedFrame frame = renderer.render(Technique::Deferred, changed);
        EXPECT_NE(frame.display, base.display);
        EXPECT_EQ(frame.radiance != base.radiance, setting.radiance);
    }
}

} // namespace
} // namespace tessera
