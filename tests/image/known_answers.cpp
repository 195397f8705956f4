#include "tests/image/ImageTest.h"
#include "tests/image/Textbook.h"

namespace tessera {
namespace {

using engine::Technique;
using scenes::Light;
using scenes::Material;
using scenes::MaterialModel;
using namespace test;

constexpr int kAnswerSidePixels = 96;
/// The specification's limit for the sharpest highlight it names, alpha = 0.002: rounding multiplied by 1/alpha.
constexpr double kAnyDriver = 3e-4;

struct Errors {
    double worst = 0.0; ///< the largest relative error of all pixels and channels
    double brightest = 0.0;
};

/// Quads viewed head on, with every pixel computed a second time in double precision.
class KnownAnswers : public ImageTest {
protected:
    Errors errors(const Material& material, const Light& light, Technique technique) {
        scenes::Scene scene = quadScene(material);
        scene.lights = {light};
        const scenes::Camera& camera = scene.cameras[0];
        frame::FrameSettings settings = ofSize(kAnswerSidePixels, kAnswerSidePixels);
        const Picture picture = engine::toPicture(frameOf(scene, settings, technique));

        const glm::dvec3 eyeWS(camera.worldFromCamera[3]);
        const double half = eyeWS.z * std::tan(0.5 * camera.fovYRadians);
        std::vector<glm::dvec3> truths;
        std::vector<double> channels;
        for (int y = 0; y < kAnswerSidePixels; ++y)
            for (int x = 0; x < kAnswerSidePixels; ++x) {
                const glm::dvec3 positionWS((2.0 * (x + 0.5) / kAnswerSidePixels - 1.0) * half,
                                            (1.0 - 2.0 * (y + 0.5) / kAnswerSidePixels) * half, 0.0);
                glm::dvec3 toLightWS;
                const glm::dvec3 intensity = textbook::incident(light, positionWS, toLightWS);
                const glm::dvec3 share =
                    textbook::reflected(material, {0, 0, 1}, toLightWS, glm::normalize(eyeWS - positionWS));
                const double dimmed = 1.0 - textbook::coatWeight(material, glm::normalize(eyeWS - positionWS).z);
                truths.push_back(intensity * share + dimmed * glm::dvec3(material.emissive));
                for (int c = 0; c < 3; ++c) {
                    if (truths.back()[c] > 0.0) channels.push_back(truths.back()[c]);
                }
            }
        Errors result;
        if (channels.empty()) return result;
        std::ranges::sort(channels);
        result.brightest = channels.back();
        // Where a window or cone lets almost nothing through, fp32 has no relative precision left. There errors are
        // relative to a thousandth of the image's median, as in every comparison.
        const double floor = 1e-3 * channels[channels.size() / 2];
        for (std::size_t i = 0; i < truths.size(); ++i)
            for (int c = 0; c < 3; ++c) {
                const double error = std::abs(picture.pixel(i)[c] - truths[i][c]) / std::max(truths[i][c], floor);
                result.worst = std::max(result.worst, error);
            }
        return result;
    }

    /// `tolerance` is for software rasterisers, which round every operation correctly. GLSL allows 2.5 roundings for a
    /// division and more for a square root (4.7.1), so others have the specification's limit.
    void expectAnswer(const char* what, const Material& material, const Light& light, double tolerance) {
        if (!context().capabilities().isSoftware) tolerance = std::max(tolerance, kAnyDriver);
        const std::size_t turn = answers_++;
        for (const engine::TechniqueInfo& technique : engine::techniqueTable()) {
            const bool isInTurn = std::size_t(technique.technique) == turn % engine::techniqueTable().size();
            if (!isWholeSweep() && technique.technique != Technique::Deferred && !isInTurn) continue;
            SCOPED_TRACE(fmt::format("{} {}", what, technique.name));
            const Errors found = errors(material, light, technique.technique);
            EXPECT_GT(found.brightest, 1e-3) << "the light does not reach the quad";
            EXPECT_LE(found.worst, tolerance);
            if (technique.technique == Technique::Deferred) {
                fmt::print("{:<62} worst {:.1e} of {:.1e}  brightest {:.3g}\n", what, found.worst, tolerance,
                           found.brightest);
            }
        }
    }

private:
    std::size_t answers_ = 0; ///< answers so far
};

Material coloured() {
    return lambert({0.75f, 0.5f, 0.25f, 1.0f});
}

/// metallic_roughness without a specular lobe: rho / pi.
Material chalk() {
    Material material;
    material.baseColor = {0.75f, 0.5f, 0.25f, 1.0f};
    material.metallic = 0.0f;
    material.specularFactor = 0.0f;
    return material;
}

// fp32 rounding of the position, squared by the falloff: four roundings of 2^-24, with the sums around them ten.
constexpr double kPlain = 6e-7;
// Where a window closes, its factor is a difference of nearly equal numbers: near the floor of 1e-3 a window w of 0.03
// loses 2^-20 (the packed range's safety) x 4 / w = 1e-4.
constexpr double kWindowed = 3e-4;

struct NamedLight {
    const char* name;
    Light light;
    double tolerance = kPlain;
};

std::vector<NamedLight> everyLight() {
    std::vector<NamedLight> lights;
    const Light point = pointLight({0.3, -0.2, 0.8}, 2.5f);
    lights.push_back({"point light without range", point});
    Light ranged = point;
    ranged.rangeMetres = 1.1f;
    lights.push_back({"point light whose range ends on the quad", ranged, kWindowed});
    for (const glm::vec3 abc :
         {glm::vec3(1, 0, 0), glm::vec3(0, 2, 0), glm::vec3(0, 0, 3), glm::vec3(0.5f, 0.25f, 1.5f)}) {
        Light attenuated = point;
        attenuated.falloff = scenes::Falloff::Attenuation;
        attenuated.attenuation = abc;
        lights.push_back({"attenuation A B C", attenuated});
    }
    Light spot = point;
    spot.type = scenes::LightType::Spot;
    spot.directionWS = glm::normalize(glm::dvec3(-0.2, 0.1, -1.0));
    spot.innerConeRadians = 0.25f;
    spot.outerConeRadians = 0.7f;
    lights.push_back({"spot, soft cone", spot, kWindowed});
    spot.rangeMetres = 1.3f;
    lights.push_back({"spot, soft cone and range", spot, kWindowed});
    Light sun = point;
    sun.type = scenes::LightType::Directional;
    sun.directionWS = glm::normalize(glm::dvec3(0.4, -0.7, -1.0));
    sun.color = {1.0f, 0.5f, 0.25f};
    lights.push_back({"directional, coloured", sun});
    return lights;
}

TEST_SWEEP(KnownAnswers, lambertIsAlbedoTimesIntensityTimesCosine) {
    for (const NamedLight& named : everyLight()) expectAnswer(named.name, coloured(), named.light, named.tolerance);
}

TEST_SWEEP(KnownAnswers, metallicRoughnessWithoutLobeIsLambertOverPi) {
    for (const NamedLight& named : everyLight()) expectAnswer(named.name, chalk(), named.light, named.tolerance);
}

/// In fp32 a highlight's slope multiplies the rounding of h, 2^-24, by up to 2/alpha. Measured: half of that.
double highlight(float alpha) {
    return kPlain + 2.0 * 0x1p-24 / double(alpha);
}

/// A power of the cosine falls over a width of 1/sqrt(exponent); at its foot, a thousandth of the median, its slope is
/// four times that. Measured: a quarter to all of that.
double highlightOf(float exponent) {
    return kPlain + 4.0 * 0x1p-24 * std::sqrt(double(exponent));
}

TEST_SWEEP(KnownAnswers, microfacetHighlightsAreTheTextbooks) {
    Light sun = everyLight().back().light;
    sun.directionWS = glm::normalize(glm::dvec3(0.05, -0.08, -1.0)); // its reflection is in the image
    for (const float alpha : {0.01f, 0.05f, 0.3f, 1.0f})
        for (const float ior : {1.05f, 1.5f, 2.4f}) {
            Material material = materialOf(MaterialModel::Microfacet, {0.2f, 0.1f, 0.05f, 1.0f});
            material.specularColor = {1.0f, 0.75f, 0.5f};
            material.alpha = alpha;
            material.ior = ior;
            expectAnswer(fmt::format("microfacet alpha {} ior {}, point", alpha, ior).c_str(), material,
                         everyLight().front().light, highlight(alpha));
            expectAnswer(fmt::format("microfacet alpha {} ior {}, directional", alpha, ior).c_str(), material, sun,
                         highlight(alpha));
        }
}

TEST_SWEEP(KnownAnswers, totalInternalReflectionIsTheTextbooks) {
    Material material = materialOf(MaterialModel::Microfacet);
    material.alpha = 0.4f;
    material.ior = 0.6f;
    // Grazing, so that part of the quad lies beyond the critical angle of 37 degrees, where F rises as a square root:
    // that amplifies a rounding at the quad's nearest pixel to 1e-4. Measured 3.3e-5.
    expectAnswer("microfacet ior 0.6", material, pointLight({1.5, 0.4, 0.5}, 2.0f), 1e-4);
}

TEST_SWEEP(KnownAnswers, blinnPhongHighlightsAreTheTextbooks) {
    for (const float exponent : {0.0f, 1.0f, 20.0f, 1000.0f}) {
        Material material = materialOf(MaterialModel::BlinnPhong, {0.2f, 0.1f, 0.05f, 1.0f});
        material.specularColor = {1.0f, 0.75f, 0.5f};
        material.exponent = exponent;
        expectAnswer(fmt::format("blinn_phong exponent {}, point", exponent).c_str(), material,
                     everyLight().front().light, highlightOf(exponent));
        expectAnswer(fmt::format("blinn_phong exponent {}, directional", exponent).c_str(), material,
                     everyLight().back().light, highlightOf(exponent));
    }
}

TEST_SWEEP(KnownAnswers, anisotropicHighlightsAreTheTextbooks) {
    for (const auto& [alphaX, alphaY] : {std::pair(0.05f, 0.4f), std::pair(0.8f, 0.02f), std::pair(0.3f, 0.3f)}) {
        for (const scenes::Masking masking :
             {scenes::Masking::Walter, scenes::Masking::Directional, scenes::Masking::HalfVector}) {
            Material material = materialOf(MaterialModel::MicrofacetAnisotropic, {0.2f, 0.1f, 0.05f, 1.0f});
            material.specularColor = {1.0f, 0.75f, 0.5f};
            material.alpha = alphaX;
            material.alphaY = alphaY;
            material.masking = masking;
            expectAnswer(fmt::format("anisotropic {} {}, masking {}", alphaX, alphaY, int(masking)).c_str(), material,
                         everyLight().front().light, highlight(std::min(alphaX, alphaY)));
        }
    }
}

TEST_SWEEP(KnownAnswers, maskingByTheHalfVectorIsTheHandouts) {
    Material material = materialOf(MaterialModel::Microfacet);
    material.alpha = 0.5f;
    material.masking = scenes::Masking::HalfVector;
    expectAnswer("microfacet, masking half_vector", material, pointLight({1.5, 0.4, 0.5}, 2.0f), highlight(0.5f));
}

TEST_SWEEP(KnownAnswers, layersOfMetallicRoughnessAreTheExtensions) {
    Material base;
    base.baseColor = {0.9f, 0.6f, 0.3f, 1.0f};
    base.perceptualRoughness = 0.5f;
    base.metallic = 0.7f;
    const Light light = pointLight({0.3, -0.2, 0.8}, 2.5f);
    Material stretched = base;
    stretched.anisotropyStrength = 0.8f;
    stretched.anisotropyRotationRadians = 0.7f;
    expectAnswer("anisotropy", stretched, light, highlight(0.25f)); // alpha is the roughness squared
    Material coated = stretched;
    coated.clearcoat = 0.8f;
    coated.clearcoatPerceptualRoughness = 0.3f;
    expectAnswer("clearcoat over anisotropy", coated, light, highlight(0.09f));
    // Light below a sheen is scaled by a fit, off by up to 0.035 of the sheen's brightest colour (SheenTest).
    Material cloth = base;
    cloth.sheenColor = {0.2f, 0.5f, 1.0f};
    cloth.sheenPerceptualRoughness = 0.6f;
    expectAnswer("sheen", cloth, light, 0.06);
    cloth.baseColor = {0.0f, 0.0f, 0.0f, 1.0f};
    cloth.metallic = 1.0f;
    // Its D is a power of the sine of h, 1 - (n.h)^2, which cancels where h is near n. Measured 5.6e-6.
    expectAnswer("sheen over black", cloth, light, 2e-5);
}

TEST_SWEEP(KnownAnswers, wrappedLightIsTheTextbooks) {
    std::vector<std::pair<const char*, Material>> materials{{"lambert", coloured()}, {"chalk", chalk()}};
    Material phong = coloured();
    phong.model = MaterialModel::BlinnPhong;
    phong.exponent = 20.0f;
    materials.emplace_back("blinn_phong", phong);
    Material glossy = coloured();
    glossy.model = MaterialModel::Microfacet;
    glossy.alpha = 0.3f;
    materials.emplace_back("microfacet", glossy);
    Material coated;
    coated.baseColor = {0.9f, 0.6f, 0.3f, 1.0f};
    coated.perceptualRoughness = 0.6f;
    coated.metallic = 0.3f;
    coated.clearcoat = 0.8f;
    coated.clearcoatPerceptualRoughness = 0.5f;
    materials.emplace_back("metallic_roughness, coated", coated);
    Material cloth = chalk();
    cloth.sheenColor = {0.2f, 0.5f, 1.0f};
    cloth.sheenPerceptualRoughness = 0.6f;
    materials.emplace_back("cloth", cloth);
    // The last one stands behind the quad.
    const Light lights[] = {pointLight({0.3, -0.2, 0.8}, 2.5f), pointLight({2.5, 0.6, -0.4}, 9.0f)};
    for (auto& [name, material] : materials) {
        material.subsurface.method = scenes::SubsurfaceMethod::Wrap;
        material.subsurface.wrap = 0.7f;
        material.subsurface.wrapTint = {1.0f, 0.6f, 0.4f};
        for (const Light& light : lights) {
            // As above; from behind, the sheen transmits 0.34 to the surface below, so that 0.035 are a tenth.
            const double sheen = material.sheenColor.z == 0.0f ? 0.0 : light.positionWS.z > 0.0 ? 0.06 : 0.12;
            expectAnswer(fmt::format("wrap, {}, light at z = {}", name, light.positionWS.z).c_str(), material, light,
                         std::max(sheen, 2e-6));
        }
    }
}

TEST_F(KnownAnswers, emissionIsDimmedByItsCoat) {
    Material material;
    material.emissive = {1.0f, 0.5f, 0.25f};
    material.clearcoat = 1.0f;
    scenes::Scene scene = quadScene(material);
    scene.lights = {};
    frame::FrameSettings settings = ofSize(kAnswerSidePixels, kAnswerSidePixels);
    engine::Renderer renderer(context(), scene);
    for (const engine::TechniqueInfo& technique : engine::techniqueTable()) {
        const Picture picture = engine::toPicture(renderer.render(technique.technique, settings));
        const float* centre =
            picture.pixel(std::size_t(kAnswerSidePixels * kAnswerSidePixels / 2 + kAnswerSidePixels / 2));
        // Head on the coat takes 4 %; half a pixel off the axis changes that by 1e-9.
        EXPECT_NEAR(centre[0], 0.96, 1e-6) << technique.name;
        EXPECT_NEAR(centre[2], 0.24, 1e-6) << technique.name;
    }
}

TEST_SWEEP(KnownAnswers, metallicRoughnessHighlightsAreTheTextbooks) {
    for (const float roughness : {0.1f, 0.3f, 0.7f, 1.0f})
        for (const float metallic : {0.0f, 0.5f, 1.0f}) {
            Material material;
            material.baseColor = {0.9f, 0.6f, 0.3f, 1.0f};
            material.perceptualRoughness = roughness;
            material.metallic = metallic;
            material.ior = 1.8f;
            material.specularFactor = 0.75f;
            material.specularColor = {1.0f, 0.8f, 0.5f};
            material.emissive = {0.01f, 0.02f, 0.03f};
            expectAnswer(fmt::format("metallic_roughness {} metallic {}", roughness, metallic).c_str(), material,
                         pointLight({0.3, -0.2, 0.8}, 2.5f), highlight(roughness * roughness));
        }
}

} // namespace
} // namespace tessera
