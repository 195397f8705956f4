// Normals that face away from the viewer: their correction, and the hits that it applies to.
#include "validation/reference/NormalAt.h"

#include <cmath>

#include <gtest/gtest.h>

#include "scenes/LookAt.h"
#include "tests/support/Random.h"
#include "tests/unit/scenes/TinyScene.h"
#include "validation/reference/Visibility.h"

namespace tessera::reference {
namespace {

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

TEST(ReferenceNormal, thatFacesTheViewerEnoughKeepsEveryBit) {
    test::Random random(11);
    for (int i = 0; i < 10000; ++i) {
        const glm::dvec3 toViewer = random.direction(), normal = random.around(toViewer, kLeastFacing, 1.0);
        if (glm::dot(normal, toViewer) < kLeastFacing) continue; // by rounding
        EXPECT_EQ(bentToViewer(normal, toViewer, kLeastFacing), normal);
    }
}

/// A rotation in the plane of both is the shortest to its cosine. The component across the viewer's direction is kept
/// and the one along it raised to `least`, so the cosine is least / hypot(sine, least).
TEST(ReferenceNormal, thatTurnsAwayIsTurnedInThePlaneOfBothUntilItFacesTheViewer) {
    test::Random random(12);
    for (int i = 0; i < 10000; ++i) {
        const double least = random.logarithmic(1e-6, kLeastFacing);
        const glm::dvec3 toViewer = random.direction(), normal = random.around(toViewer, -0.9999, least - 1e-9);
        const glm::dvec3 turned = bentToViewer(normal, toViewer, least);
        const double cosine = glm::dot(normal, toViewer), sine = glm::length(glm::cross(normal, toViewer));
        EXPECT_NEAR(glm::length(turned), 1.0, 1e-14);
        EXPECT_GE(glm::dot(turned, toViewer), least / std::hypot(1.0, least) - 1e-14);
        EXPECT_NEAR(glm::dot(turned, toViewer), least / std::hypot(sine, least), 1e-13);
        EXPECT_NEAR(glm::dot(turned, glm::cross(normal, toViewer)), 0.0, 1e-13);
        EXPECT_GT(glm::dot(turned, normal - cosine * toViewer), 0.0);
        EXPECT_NEAR(angleBetween(normal, turned), angleBetween(normal, toViewer) - angleBetween(turned, toViewer),
                    1e-11);
    }
}

TEST(ReferenceNormal, isBentWithoutAStep) {
    const glm::dvec3 toViewer(0.0, 0.0, 1.0);
    const auto at = [&](double cosine) {
        return bentToViewer({std::sqrt(1.0 - cosine * cosine), 0.0, cosine}, toViewer, kLeastFacing);
    };
    EXPECT_LT(glm::distance(at(kLeastFacing - 1e-9), at(kLeastFacing + 1e-9)), 3e-9);
    // Opposite to the viewer: all normals around end at the viewer's direction.
    EXPECT_LT(glm::distance(at(-1.0), toViewer), 1e-12);
    EXPECT_LT(
        glm::distance(bentToViewer(glm::normalize(glm::dvec3(1e-6, 0.0, -1.0)), toViewer, kLeastFacing), toViewer),
        1e-4);
    EXPECT_LT(
        glm::distance(bentToViewer(glm::normalize(glm::dvec3(0.0, -1e-6, -1.0)), toViewer, kLeastFacing), toViewer),
        1e-4);
}

/// The tiny scene's triangle in z = 0, with a normal that deviates from its own.
class ReferenceNormalOfHit : public testing::Test {
protected:
    ReferenceNormalOfHit() : scene_(scenes::tinyScene()) {
        scene_.materials[0].clearcoat = 1.0f;
        seenFrom(1.0);
    }

    /// Views the triangle at this cosine to its normal, in the plane y = 1.
    void seenFrom(double cosine) {
        const glm::dvec3 target(0.5, 1.0, 0.0);
        toViewer_ = {-std::sqrt(1.0 - cosine * cosine), 0.0, cosine};
        scene_.cameras.resize(1);
        scene_.cameras[0].worldFromCamera = scenes::worldFromLookAt(target + 5.0 * toViewer_, target);
    }
    void lean(const glm::vec3& normal) { scene_.meshes[0].normalsOS.assign(3, normal); }

    struct Normals {
        glm::dvec3 seen, unseen,
            coat; ///< at the centre of the image; without a viewer; of its coat
    };
    Normals normals() const {
        const CameraRays rays(scene_.cameras[0], {1, 1});
        const Objects objects(scene_, rays);
        const Textures textures(scene_, Filtering::Exact);
        std::optional<Hit> hit = Visibility(objects, rays, textures).nearestOpaque(rays.through(0, 0));
        if (!hit) {
            ADD_FAILURE() << "the triangle is not seen";
            return {};
        }
        Normals result;
        result.seen = normalAt(*hit, textures);
        result.coat = coatNormalAt(*hit, textures);
        hit->toViewer = glm::dvec3(0.0);
        result.unseen = normalAt(*hit, textures);
        return result;
    }

    scenes::Scene scene_;
    glm::dvec3 toViewer_{0.0};
};

constexpr double kStoredNormal = 1e-7; ///< meshes hold them in single precision

TEST_F(ReferenceNormalOfHit, isBentWhereSomebodyLooks) {
    lean({0.8f, 0.0f, -0.6f});
    const Normals found = normals();
    const glm::dvec3 expected = glm::normalize(glm::dvec3(0.8, 0.0, kLeastFacing));
    EXPECT_LT(glm::distance(found.seen, expected), kStoredNormal);
    EXPECT_LT(glm::distance(found.coat, expected), kStoredNormal);
    EXPECT_LT(glm::distance(found.unseen, glm::dvec3(0.8, 0.0, -0.6)), kStoredNormal);
}

/// u runs along x and v against y, so that the texel's axes are those of the world.
TEST_F(ReferenceNormalOfHit, ofEachMapLeansByItsOwnScale) {
    const glm::vec3 texel(0.3f, -0.2f, 0.8f);
    scene_.meshes[0].texCoords[0] = {{0.0f, 0.0f}, {1.0f, 0.0f}, {0.0f, -1.0f}};
    scenes::Image& image = scene_.images.emplace_back();
    image.name = "texel";
    image.width = image.height = 1;
    image.format = scenes::TexelFormat::Rgba32Float;
    const glm::vec4 stored(0.5f * texel + 0.5f, 1.0f);
    const auto* bytes = reinterpret_cast<const std::byte*>(&stored);
    image.texels.assign(bytes, bytes + sizeof(stored));
    scenes::Material& material = scene_.materials[0];
    material.model = scenes::MaterialModel::MetallicRoughness;
    material.clearcoat = 1.0f;
    material.normalScale = 0.5f;
    material.clearcoatNormalScale = 2.0f;
    for (const auto slot : {scenes::TextureSlot::Normal, scenes::TextureSlot::ClearcoatNormal})
        material.texture(slot).image = 0;
    seenFrom(1.0);
    const auto leaning = [&](double scale) {
        return glm::normalize(glm::dvec3(texel) * glm::dvec3(scale, scale, 1.0));
    };
    EXPECT_LT(glm::distance(normals().seen, leaning(0.5)), kStoredNormal);
    EXPECT_LT(glm::distance(normals().coat, leaning(2.0)), kStoredNormal);
}

TEST_F(ReferenceNormalOfHit, isTurnedToTheSideThatIsSeenBefore) {
    scene_.materials[0].doubleSided = true;
    seenFrom(-1.0);
    lean({0.8f, 0.0f, -0.6f}); // towards the viewer, so away once it is flipped
    const Normals found = normals();
    const glm::dvec3 expected = glm::normalize(glm::dvec3(-0.8, 0.0, -kLeastFacing));
    EXPECT_LT(glm::distance(found.seen, expected), kStoredNormal);
    EXPECT_LT(glm::distance(found.coat, expected), kStoredNormal);
}

TEST_F(ReferenceNormalOfHit, ofAFlatSurfaceKeepsEveryBitHoweverObliquelyItIsSeen) {
    for (const double cosine : {0.5, 0.02, 0.01, 1e-3, 1e-4}) {
        seenFrom(cosine);
        const Normals found = normals();
        EXPECT_EQ(found.seen, found.unseen) << cosine;
        EXPECT_EQ(found.coat, found.unseen) << cosine;
    }
}

TEST_F(ReferenceNormalOfHit, needFaceTheViewerHalfAsMuchAsATriangleThatIsSeenObliquely) {
    constexpr double kCosine = 0.01;
    seenFrom(kCosine);
    lean({0.0f, 1.0f, 0.0f}); // across the viewer's direction
    EXPECT_NEAR(glm::dot(normals().seen, toViewer_), 0.5 * kCosine / std::hypot(1.0, 0.5 * kCosine), 1e-6);
}

} // namespace
} // namespace tessera::reference
