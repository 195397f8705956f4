#include "validation/reference/Reflectance.h"

#include <gtest/gtest.h>

#include "tests/image/Textbook.h"
#include "tests/support/Random.h"

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
    return material;
}

SurfacePoint pointOf(const Material& material, const glm::dvec3& normal) {
    SurfacePoint point;
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
    return point;
}

constexpr MaterialModel kLit[] = {MaterialModel::Lambert, MaterialModel::Microfacet, MaterialModel::MetallicRoughness};

TEST(ReferenceReflectance, everyModelIsAlwaysTheTextbooks) {
    test::Random random(20);
    for (const MaterialModel model : kLit) {
        for (int i = 0; i < 20000; ++i) {
            const Material material = randomMaterial(model, random);
            const glm::dvec3 n = random.direction(), l = random.direction(), v = random.direction();
            // The textbook's Fresnel factor takes no cosine beyond 1, which rounding gives where l = v.
            if (glm::dot(l, v) > 1.0 - 1e-9) continue;
            const glm::dvec3 wanted = test::textbook::reflected(material, n, l, v);
            const glm::dvec3 found = reflected(pointOf(material, n), l, v, true);
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(found[c], wanted[c], 1e-9 * std::max(wanted[c], 1e-6)) << int(model) << ' ' << i;
        }
    }
}

TEST(ReferenceReflectance, specularAloneIsAlwaysReciprocal) {
    test::Random random(20);
    for (const MaterialModel model : {MaterialModel::Microfacet, MaterialModel::MetallicRoughness}) {
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

TEST(ReferenceReflectance, thereIsNeverALobeBelowTheHorizonOrBetweenOppositeDirections) {
    test::Random random(20);
    const glm::dvec3 n(0, 0, 1), l = glm::normalize(glm::dvec3(0.3, 0.1, 0.5));
    for (const MaterialModel model : kLit) {
        const SurfacePoint point = pointOf(randomMaterial(model, random), n);
        EXPECT_EQ(reflected(point, -l, l, true), glm::dvec3(0.0));
        for (const glm::dvec3& viewer : {-l, glm::normalize(glm::dvec3(1, 0, -0.2))})
            EXPECT_EQ(reflected(point, l, viewer, true), reflected(point, l, viewer, false)) << int(model);
    }
}

TEST(ReferenceReflectance, aModelWithoutARowIsAlwaysRefused) {
    for (const Model& row : modelTable()) EXPECT_EQ(modelOf(row.model).reflected, row.reflected);
    EXPECT_THROW(modelOf(MaterialModel(250)), std::logic_error);
}

} // namespace
} // namespace tessera::reference
