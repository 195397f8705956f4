#include "validation/reference/Reflectance.h"

#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "tests/image/Textbook.h"
#include "tests/support/Random.h"
#include "validation/reference/Sampling.h"

namespace tessera::reference {
namespace {

using scenes::Material;
using scenes::MaterialModel;

Material randomMaterial(MaterialModel model, test::Random& random) {
    Material material;
    material.model = model;
    material.baseColor = {random.unit(), random.unit(), random.unit(), 1.0};
    material.specularColor = {random.unit(), random.unit(), random.unit()};
    material.metallic = float(random.unit());
    material.perceptualRoughness = float(random.unit());
    material.alpha = float(random.unit());
    material.ior = float(0.5 + 2.0 * random.unit());
    material.specularFactor = float(random.unit());
    material.exponent = float(50.0 * random.unit());
    material.alphaY = float(random.unit());
    material.masking = scenes::Masking(random.index(3));
    if (model == MaterialModel::Microfacet && material.masking == scenes::Masking::Directional)
        material.masking = scenes::Masking::Walter;
    return material;
}

/// A direction at right angles to the normal.
glm::dvec3 tangentOf(const glm::dvec3& normal) {
    return glm::normalize(glm::cross(normal, std::abs(normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
}

SurfacePoint pointOf(const Material& material, const glm::dvec3& normal) {
    SurfacePoint point;
    const scenes::MaterialModelInfo& model = scenes::infoOf(material.model);
    point.model = material.model;
    point.color = glm::dvec3(material.baseColor);
    point.metallic = material.metallic;
    const bool squares = material.model == MaterialModel::MetallicRoughness;
    const double alpha =
        squares ? double(material.perceptualRoughness) * double(material.perceptualRoughness) : double(material.alpha);
    point.alpha = std::max(alpha, kSmallestAlpha);
    point.ior = material.ior;
    point.specularFactor = material.specularFactor;
    point.specularColor = glm::dvec3(material.specularColor);
    point.normal = normal;
    if (model.roughness) point.roughness = double(material.*model.roughness);
    point.masking = material.masking;
    point.alphaAcross = point.alpha;
    if (material.model == MaterialModel::MicrofacetAnisotropic) {
        point.alphaAcross = std::max(double(material.alphaY), kSmallestAlpha);
        point.tangent = tangentOf(normal);
    }
    return point;
}

constexpr MaterialModel kLit[] = {MaterialModel::Lambert, MaterialModel::BlinnPhong, MaterialModel::Microfacet,
                                  MaterialModel::MicrofacetAnisotropic, MaterialModel::MetallicRoughness};

TEST(ReferenceReflectance, everyModelIsTheTextbooks) {
    test::Random random(20);
    for (const MaterialModel model : kLit) {
        for (int i = 0; i < 20000; ++i) {
            const Material material = randomMaterial(model, random);
            const glm::dvec3 n = random.direction(), l = random.direction(), v = random.direction();
            // The textbook's Fresnel factor refuses cosines beyond 1, which rounding gives where l = v.
            if (glm::dot(l, v) > 1.0 - 1e-9) continue;
            const glm::dvec3 wanted = test::textbook::reflected(material, n, l, v, tangentOf(n));
            const glm::dvec3 found = reflected(pointOf(material, n), l, v, true);
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(found[c], wanted[c], 1e-9 * std::max(wanted[c], 1e-6)) << int(model) << ' ' << i;
        }
    }
}

TEST(ReferenceReflectance, layersOfMetallicRoughnessAreTheTextbooks) {
    test::Random random(21);
    for (int i = 0; i < 20000; ++i) {
        Material material = randomMaterial(MaterialModel::MetallicRoughness, random);
        material.anisotropyStrength = i % 3 == 0 ? 0.0f : float(random.unit());
        material.clearcoat = i % 2 == 0 ? 0.0f : float(random.unit());
        material.clearcoatPerceptualRoughness = float(random.unit());
        const glm::dvec3 n = random.direction(), l = random.direction(), v = random.direction();
        if (glm::dot(l, v) > 1.0 - 1e-9) continue;
        SurfacePoint point = pointOf(material, n);
        point.tangent = tangentOf(n);
        point.alpha = std::lerp(point.alpha, 1.0, double(material.anisotropyStrength) * material.anisotropyStrength);
        point.coat = material.clearcoat;
        const double coatRoughness = material.clearcoatPerceptualRoughness;
        point.coatAlpha = std::max(coatRoughness * coatRoughness, kSmallestAlpha);
        point.coatNormal = n;
        const glm::dvec3 wanted = test::textbook::reflected(material, n, l, v, tangentOf(n));
        const glm::dvec3 found = reflected(point, l, v, true);
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(found[c], wanted[c], 1e-8 * std::max(wanted[c], 1e-6)) << i;
    }
}

TEST(ReferenceReflectance, aSheenEqualsTheTextbooksAndDarkensTheBaseNearlyAsMuch) {
    test::Random random(22);
    for (int i = 0; i < 2000; ++i) {
        Material material = randomMaterial(MaterialModel::MetallicRoughness, random);
        const bool black = i % 2 == 0;
        if (black) {
            material.baseColor = {0, 0, 0, 1};
            material.metallic = 0.0f;
            material.specularFactor = 0.0f;
        }
        material.sheenColor = {random.unit(), random.unit(), random.unit()};
        material.sheenPerceptualRoughness = i % 4 < 2 ? 0.5f : 0.8f; // the textbook makes a table for each
        const glm::dvec3 n = random.direction(), l = random.around(n, 0.05, 1.0), v = random.around(n, 0.05, 1.0);
        SurfacePoint point = pointOf(material, n);
        point.sheenColor = glm::dvec3(material.sheenColor);
        point.sheenAlpha = double(material.sheenPerceptualRoughness) * material.sheenPerceptualRoughness;
        Material bare = material;
        bare.sheenColor = glm::vec3(0.0f);
        const glm::dvec3 below = test::textbook::reflected(bare, n, l, v, tangentOf(n));
        const glm::dvec3 wanted = test::textbook::reflected(material, n, l, v, tangentOf(n));
        const glm::dvec3 found = reflected(point, l, v, true);
        // The layers below are scaled by a fit instead of the integral, off by up to 0.035.
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(found[c], wanted[c], 1e-8 * wanted[c] + 1e-12 + (black ? 0.0 : 0.04 * below[c])) << i;
    }
}

/// A coat transmits 1 - coat (0.04 + 0.96 (1 - n.v)^5) of all light from below: light through a body from behind,
/// diffused light and emission.
TEST(ReferenceReflectance, aCoatDimsAllThatLeavesBelowIt) {
    constexpr double kCoat = 0.7, kCosine = 0.3;
    const glm::dvec3 n(0.0, 0.0, 1.0), v(std::sqrt(1.0 - kCosine * kCosine), 0.0, kCosine), behind(0.6, 0.0, -0.8);
    Material material;
    material.model = MaterialModel::MetallicRoughness;
    material.baseColor = {0.8f, 0.5f, 0.3f, 1.0f};
    material.metallic = 0.2f;
    SurfacePoint bare = pointOf(material, n);
    bare.passes = true;
    bare.emission = {0.3, 0.2, 0.1};
    SurfacePoint coated = bare;
    coated.coat = kCoat;
    coated.coatNormal = n;
    const double left = 1.0 - kCoat * (0.04 + 0.96 * std::pow(1.0 - kCosine, 5.0));
    const auto expectDimmed = [&](const char* what, const auto& of) {
        for (int c = 0; c < 3; ++c) {
            EXPECT_GT(of(bare)[c], 0.01) << what;
            EXPECT_NEAR(of(coated)[c], left * of(bare)[c], 1e-12) << what;
        }
    };
    expectDimmed("from behind", [&](const SurfacePoint& point) { return passedOn(point, behind, v); });
    expectDimmed("spread", [&](const SurfacePoint& point) { return leaving(point, v, 0.5); });
    expectDimmed("emitted", [&](const SurfacePoint& point) { return emitted(point, v); });
}

TEST(ReferenceReflectance, wrappedLightIsTheTextbooks) {
    test::Random random(23);
    for (const MaterialModel model : kLit) {
        for (int i = 0; i < 5000; ++i) {
            Material material = randomMaterial(model, random);
            material.subsurface.method = scenes::SubsurfaceMethod::Wrap;
            material.subsurface.wrap = float(random.unit());
            const glm::dvec3 n = random.direction(), l = random.direction(), v = random.direction();
            if (glm::dot(l, v) > 1.0 - 1e-9) continue;
            SurfacePoint point = pointOf(material, n);
            point.wrap = double(material.subsurface.wrap) * glm::dvec3(material.subsurface.wrapTint);
            const glm::dvec3 wanted = test::textbook::reflected(material, n, l, v, tangentOf(n));
            const glm::dvec3 found = reflected(point, l, v, true);
            // The highlight is the difference of the lobe and the rest, so rounding scales with the brightest channel.
            const double brightest = std::max({wanted.r, wanted.g, wanted.b, 1e-6});
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(found[c], wanted[c], 1e-9 * brightest) << int(model) << ' ' << i;
        }
    }
}

// The energy that docs/skin.md states.
TEST(ReferenceReflectance, wrappedLightGivesOneAndItsWrapTimesTheLightOfACosine) {
    SurfacePoint point;
    point.color = glm::dvec3(1.0);
    point.normal = {0.0, 0.0, 1.0};
    point.wrap = {0.0, 0.3, 1.0};
    glm::dvec3 sum(0.0);
    constexpr int kSteps = 20000;
    for (int i = 0; i < kSteps; ++i) { // uniform in the cosine, and so over the sphere
        const double cosine = 2.0 * (i + 0.5) / kSteps - 1.0;
        const glm::dvec3 toLight(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
        sum += reflected(point, toLight, point.normal, true) * (4.0 * std::numbers::pi / kSteps);
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], std::numbers::pi * (1.0 + point.wrap[c]), 1e-6);
}

TEST(ReferenceReflectance, specularAloneIsReciprocal) {
    test::Random random(20);
    for (const MaterialModel model :
         {MaterialModel::Microfacet, MaterialModel::MicrofacetAnisotropic, MaterialModel::MetallicRoughness}) {
        for (int i = 0; i < 2000; ++i) {
            Material material = randomMaterial(model, random);
            material.metallic = 1.0f;
            SurfacePoint point = pointOf(material, random.direction());
            const glm::dvec3 l = random.direction(), v = random.direction();
            const double nl = glm::dot(point.normal, l), nv = glm::dot(point.normal, v);
            if (nl < 1e-3 || nv < 1e-3) continue;
            const auto lobe = [&](const glm::dvec3& toLight, const glm::dvec3& toViewer) {
                return reflected(point, toLight, toViewer, true) - reflected(point, toLight, toViewer, false);
            };
            const glm::dvec3 there = lobe(l, v) / nl, back = lobe(v, l) / nv;
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(there[c], back[c], 1e-9 * std::max(there[c], 1e-3));
        }
    }
}

TEST(ReferenceReflectance, aMirrorReflectsAllThatItsLobeWouldAndWhatLiesAboveTakesItsShare) {
    test::Random random(24);
    const glm::dvec3 n(0.0, 0.0, 1.0);
    for (const MaterialModel model :
         {MaterialModel::Microfacet, MaterialModel::MicrofacetAnisotropic, MaterialModel::MetallicRoughness})
        for (int i = 0; i < 20; ++i) {
            Material material = randomMaterial(model, random);
            material.perceptualRoughness = material.alpha = material.alphaY = 0.0f;
            material.ior = 1.1f + float(random.unit()); // no edge of total reflection
            SurfacePoint point = pointOf(material, n);
            if (model == MaterialModel::MetallicRoughness) {
                point.coat = random.unit();
                point.coatAlpha = 0.5;
                point.coatNormal = glm::normalize(glm::dvec3(0.2, 0.1, 1.0));
                point.sheenColor = glm::dvec3(random.unit());
                point.sheenAlpha = 0.3;
            }
            const double cosView = 0.3 + 0.7 * random.unit(), sine = std::sqrt(1.0 - cosView * cosView);
            const glm::dvec3 toViewer(0.6 * sine, -0.8 * sine, cosView);
            const std::vector<Mirror> mirrors = mirrorsOf(point, toViewer);
            ASSERT_EQ(mirrors.size(), 1u);
            EXPECT_LT(glm::distance(mirrors[0].direction, glm::dvec3(-toViewer.x, -toViewer.y, cosView)), 1e-12);
            const SurfacePoint rest = withoutMirrors(point);
            const ByMicrofacets lobe(glm::dvec2(point.alpha), n, point.tangent, toViewer);
            constexpr int kSide = 32;
            glm::dvec3 sum(0.0);
            for (int cell = 0; cell < kSide * kSide; ++cell) {
                const glm::dvec3 l = lobe.direction({(cell % kSide + 0.5) / kSide, (cell / kSide + 0.5) / kSide});
                sum += (reflected(point, l, toViewer, true) - reflected(rest, l, toViewer, true)) /
                       (lobe.density(l) * kSide * kSide);
            }
            // A lobe of alpha 0.001 covers angles that differ as much.
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(sum[c], mirrors[0].share[c], 5e-3 * mirrors[0].share[c] + 1e-9) << int(model) << ' ' << i;
        }
}

TEST(ReferenceReflectance, onlyGgxLobesOfTheLeastAlphaAreMirrors) {
    test::Random random(25);
    const glm::dvec3 n(0.0, 0.0, 1.0), toViewer(0.6, 0.0, 0.8);
    for (const MaterialModel model : kLit) {
        Material material = randomMaterial(model, random);
        material.alpha = material.alphaY = 1.1e-3f;
        material.perceptualRoughness = 0.04f;
        SurfacePoint point = pointOf(material, n);
        EXPECT_TRUE(mirrorsOf(point, toViewer).empty()) << int(model);
        EXPECT_EQ(reflected(withoutMirrors(point), toViewer, toViewer, true),
                  reflected(point, toViewer, toViewer, true))
            << int(model);
        // A coat is a mirror by itself.
        point.coat = 0.5;
        point.coatAlpha = kSmallestAlpha;
        point.coatNormal = n;
        const std::vector<Mirror> mirrors = mirrorsOf(point, toViewer);
        ASSERT_EQ(mirrors.size(), 1u);
        EXPECT_NEAR(mirrors[0].share.g, 0.5 * (0.04 + 0.96 * std::pow(0.2, 5)), 1e-12);
        EXPECT_TRUE(mirrorsOf(point, -toViewer).empty());
    }
}

TEST(ReferenceReflectance, thereIsNotALobeBelowTheHorizonOrBetweenOppositeDirections) {
    test::Random random(20);
    const glm::dvec3 n(0, 0, 1), l = glm::normalize(glm::dvec3(0.3, 0.1, 0.5));
    for (const MaterialModel model : kLit) {
        const SurfacePoint point = pointOf(randomMaterial(model, random), n);
        EXPECT_EQ(reflected(point, -l, l, true), glm::dvec3(0.0));
        for (const glm::dvec3& viewer : {-l, glm::normalize(glm::dvec3(1, 0, -0.2))})
            EXPECT_EQ(reflected(point, l, viewer, true), reflected(point, l, viewer, false)) << int(model);
    }
}

TEST(ReferenceReflectance, aModelWithoutARowIsRefused) {
    for (const Model& row : modelTable()) EXPECT_EQ(modelOf(row.model).reflected, row.reflected);
    EXPECT_THROW(modelOf(MaterialModel(250)), std::logic_error);
}

TEST(ReferenceReflectance, lightIsBentBySnellsLawAndNotBeyondTheCriticalAngle) {
    test::Random random(24);
    int total = 0;
    for (int i = 0; i < 20000; ++i) {
        SurfacePoint point;
        point.normal = random.direction();
        point.ior = 0.5 + 2.0 * random.unit();
        const glm::dvec3 toViewer = random.direction();
        const glm::dvec3 outward = glm::dot(point.normal, toViewer) < 0.0 ? -point.normal : point.normal;
        const double sine = glm::length(glm::cross(outward, toViewer));
        const std::optional<glm::dvec3> bent = refracted(point, toViewer, point.ior);
        ASSERT_EQ(bent.has_value(), sine <= point.ior);
        total += bent ? 0 : 1;
        if (!bent) continue;
        ASSERT_NEAR(glm::length(*bent), 1.0, 1e-12);
        ASSERT_LE(glm::dot(*bent, outward), 1e-12) << "it goes on below the surface";
        // Source: Born and Wolf, "Principles of Optics", section 3.2.2: n1 (N x s1) = n2 (N x s2).
        const glm::dvec3 off = glm::cross(outward, -toViewer) - point.ior * glm::cross(outward, *bent);
        ASSERT_LE(glm::length(off), 1e-12) << i;
    }
    EXPECT_GT(total, 100);
    SurfacePoint ahead;
    ahead.normal = {0.0, 0.0, 1.0};
    EXPECT_EQ(refracted(ahead, ahead.normal, 1.5), -ahead.normal) << "straight on";
}

TEST(ReferenceReflectance, anIndexOf0BendsLightOntoTheNormalAsOneWithoutBound) {
    test::Random random(25);
    for (int i = 0; i < 1000; ++i) {
        SurfacePoint point;
        point.normal = random.direction();
        point.ior = 0.0;
        const glm::dvec3 toViewer = random.direction();
        const std::optional<glm::dvec3> bent = refracted(point, toViewer, point.ior);
        ASSERT_TRUE(bent);
        const glm::dvec3 outward = glm::dot(point.normal, toViewer) < 0.0 ? -point.normal : point.normal;
        EXPECT_LE(glm::distance(*bent, -outward), 1e-12);
    }
}

TEST(ReferenceReflectance, atBrewstersAngleLightIsBentAtRightAnglesToItsMirrorImage) {
    for (const double ior : {0.75, 1.33, 1.5, 2.4}) {
        SurfacePoint point;
        point.normal = {0.0, 0.0, 1.0};
        point.ior = ior;
        const double angle = std::atan(ior);
        const glm::dvec3 toViewer(std::sin(angle), 0.0, std::cos(angle));
        const std::optional<glm::dvec3> bent = refracted(point, toViewer, point.ior);
        ASSERT_TRUE(bent);
        EXPECT_NEAR(glm::dot(*bent, glm::dvec3(-toViewer.x, 0.0, toViewer.z)), 0.0, 1e-12) << ior;
    }
}

/// An Abbe number of 20: the indices of blue and red are a twentieth of n_d - 1 apart, and none is below 1.
TEST(ReferenceReflectance, colorsAreBentByTheirOwnIndicesOfRefraction) {
    SurfacePoint point;
    point.ior = 1.5;
    EXPECT_EQ(iorsOf(point), glm::dvec3(1.5));
    point.dispersion = 1.0;
    const glm::dvec3 iors = iorsOf(point);
    EXPECT_NEAR(iors.b - iors.r, 0.025, 1e-15);
    EXPECT_EQ(iors.g, 1.5);
    EXPECT_NEAR(0.5 * (iors.r + iors.b), 1.5, 1e-15);
    point.dispersion = 100.0;
    EXPECT_EQ(iorsOf(point).r, 1.0);
    for (const double ior : {0.0, 0.5, 1.0}) {
        point.ior = ior;
        EXPECT_EQ(iorsOf(point), glm::dvec3(ior));
    }
}

/// Under uniform illumination, reflected and transmitted light are all of it.
TEST(ReferenceReflectance, aBodyThatAbsorbsAllIsClearWhereNoLightCrossesIt) {
    SurfacePoint point;
    point.bodyPerMetre = glm::dvec3(std::numeric_limits<double>::infinity());
    EXPECT_EQ(leftByBody(point, {0.0, 0.1, 0.0}), glm::dvec3(1.0, 0.0, 1.0));
}

TEST(ReferenceReflectance, clearGlassLosesNoLight) {
    test::Random random(25);
    for (int i = 0; i < 2000; ++i) {
        SurfacePoint point;
        point.model = MaterialModel::MetallicRoughness;
        point.normal = {0.0, 0.0, 1.0};
        point.color = glm::dvec3(1.0);
        point.alpha = point.alphaAcross = kSmallestAlpha;
        point.ior = 1.0 + random.unit();
        point.specularFactor = random.unit();
        point.transmission = 1.0;
        point.coat = i % 2 == 0 ? 0.0 : random.unit();
        point.coatAlpha = kSmallestAlpha;
        point.coatNormal = point.normal;
        point.film = i % 3 == 0 ? 0.0 : random.unit();
        point.filmThicknessNm = 1000.0 * random.unit();
        const glm::dvec3 toViewer = random.around(point.normal, 0.05, 1.0);
        glm::dvec3 sum = transmitted(point, toViewer);
        for (const Mirror& mirror : mirrorsOf(point, toViewer)) sum += mirror.share;
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(sum[c], 1.0, 1e-12) << i;
    }
}

SurfacePoint roughGlass(double perceptualRoughness, double ior) {
    SurfacePoint point;
    point.model = MaterialModel::MetallicRoughness;
    point.normal = {0.0, 0.0, 1.0};
    point.color = glm::dvec3(1.0);
    point.roughness = perceptualRoughness;
    point.alpha = point.alphaAcross = perceptualRoughness * perceptualRoughness;
    point.ior = ior;
    point.transmission = 1.0;
    return point;
}

glm::dvec3 seenAt(double cosView) {
    return {std::sqrt(1.0 - cosView * cosView), 0.0, cosView};
}

/// A and B of the split sum by cosine and perceptual roughness, shading.md section 6: under uniform illumination a lobe
/// reflects F0 A + F90 B.
TEST(ReferenceReflectance, roughGlassPassesWhatPublishedTablesLeave) {
    constexpr double kCosines[] = {0.1, 0.5, 1.0}, kRoughnesses[] = {0.25, 0.5, 0.75, 1.0};
    constexpr double kA[3][4] = {
        {.5051, .7519, .7958, .7363}, {.9557, .8349, .6547, .4477}, {.9957, .9158, .6268, .3067}};
    constexpr double kB[3][4] = {{.3916, .1397, .0526, .0239}, {.0326, .0223, .0085, .0030}, {0.0, 0.0, 0.0, 0.0}};
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 4; ++r) {
            const glm::dvec3 toViewer = seenAt(kCosines[c]);
            // An infinite index reflects all light at any angle; an index of 1 reflects none at normal incidence.
            const double opaque = transmitted(roughGlass(kRoughnesses[r], 0.0), toViewer).r;
            const double bare = transmitted(roughGlass(kRoughnesses[r], 1.0), toViewer).r;
            // Errors: 2e-4 of the table, 2e-3 of the integral and 2e-4 of that for dielectrics (EvenLight.h).
            EXPECT_NEAR(1.0 - opaque, kA[c][r] + kB[c][r], 2e-3) << kCosines[c] << ", " << kRoughnesses[r];
            EXPECT_NEAR(1.0 - bare, kB[c][r], 4e-4) << kCosines[c] << ", " << kRoughnesses[r];
        }
}

/// At grazing angles an anisotropic lobe reflects about as much as an isotropic one of the alpha along the view: little
/// where that is the larger one.
TEST(ReferenceReflectance, glassOfTwoAlphasPassesByTheDirectionItIsSeenFrom) {
    SurfacePoint glass = roughGlass(0.3, 1.5);
    const double narrow = transmitted(glass, seenAt(0.1)).r;
    glass.tangent = {0.0, 1.0, 0.0};
    EXPECT_NEAR(transmitted(glass, seenAt(0.1)).r, narrow, 2e-4) << "alphas alike";
    glass.alpha = 0.6; // along y
    const double across = transmitted(glass, seenAt(0.1)).r;
    glass.tangent = {1.0, 0.0, 0.0};
    const double along = transmitted(glass, seenAt(0.1)).r;
    EXPECT_GT(along, across + 0.1);
    EXPECT_NEAR(across, narrow, 0.1);
}

TEST(ReferenceReflectance, aNormalThatPointsAwayLetsAllOfItPass) {
    for (const double roughness : {0.0, 0.5})
        EXPECT_EQ(transmitted(roughGlass(roughness, 1.5), {0.6, 0.0, -0.8}), glm::dvec3(1.0)) << roughness;
}

} // namespace
} // namespace tessera::reference
