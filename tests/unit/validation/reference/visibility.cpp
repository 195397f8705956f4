#include "validation/reference/Visibility.h"

#include <cmath>

#include <gtest/gtest.h>

#include "renderer/frame/DepthInterval.h"
#include "scenes/LookAt.h"
#include "tests/unit/scenes/TinyScene.h"
#include "validation/culling/PixelPositions.h"

namespace tessera::reference {
namespace {

using scenes::AlphaMode;

/// The tiny scene's triangle (0,0), (2,0), (0,4) of z = 0, viewed from the front at 5 m.
class ReferenceVisibility : public testing::Test {
protected:
    ReferenceVisibility() : scene_(scenes::tinyScene()) {
        camera_.worldFromCamera = scenes::worldFromLookAt({0.5, 1.0, 5.0}, {0.5, 1.0, 0.0});
    }

    /// Adds a second node with the triangle, moved along z; a transparent one gets its own material.
    void addTriangle(double z, AlphaMode mode = AlphaMode::Opaque) {
        scene_.nodes.push_back(scene_.nodes.front());
        scene_.nodes.back().parentFromNode[3].z = z;
        if (mode == AlphaMode::Opaque) return;
        scene_.materials.push_back(scene_.materials.front());
        scene_.materials.back().alphaMode = mode;
        scene_.nodes.back().instances.front().material = int(scene_.materials.size()) - 1;
    }

    /// The hit at the image's centre, which shows the point (0.5, 1, 0).
    std::optional<Hit> middle() const { return at(0, 0); }
    std::optional<Hit> at(int column, int row, glm::ivec2 size = {1, 1}) const {
        const CameraRays rays(camera_, size);
        const Objects objects(scene_, rays);
        const Textures textures(scene_, Filtering::Exact);
        return copied(Visibility(objects, rays, textures).nearestOpaque(rays.through(column, row)));
    }
    /// Stores the object's number instead of the object, which does not outlive the call.
    std::optional<Hit> copied(std::optional<Hit> hit) const {
        number_ = hit ? int(hit->object->number) : -1;
        if (hit) hit->object = nullptr;
        return hit;
    }

    scenes::Scene scene_;
    scenes::Camera camera_;
    mutable int number_ = -1;
};

/// Scales of nested nodes multiply: the square of a side times a distance overflows.
TEST_F(ReferenceVisibility, aTriangleTooLargeForNumbersIsNotHit) {
    for (int axis = 0; axis < 3; ++axis) scene_.nodes.front().parentFromNode[axis] *= 1e150;
    scene_.nodes.front().parentFromNode[3].z = -1e150;
    EXPECT_FALSE(middle());
    const CameraRays rays(camera_, {1, 1});
    EXPECT_FALSE(hitOf(Objects(scene_, rays).opaque().front(), 0, rays.through(0, 0)));
}

/// Far off the view axis a ray's direction is long: per metre of depth it goes sqrt(1 + 3^2) m.
TEST_F(ReferenceVisibility, aDistantTriangleAtTheEdgeOfAWidePictureIsHit) {
    constexpr double kSlope = 3.0, kDepthMetres = 100.0;
    camera_.worldFromCamera = glm::dmat4(1.0);
    camera_.fovYRadians = 2.0 * std::atan(0.5 * kSlope); // the right pixel of three looks 2/3 of 3 half heights aside
    scene_.nodes.front().parentFromNode[3] = {kSlope * kDepthMetres - 0.5, -1.0, -kDepthMetres, 1.0};
    const std::optional<Hit> hit = at(2, 0, {3, 1});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->depthMetres, kDepthMetres, 1e-11);
    EXPECT_NEAR(hit->weights.y, 0.25, 1e-11);
}

/// Under parallel rays the anchor's ball holds the visible part of all objects. A corner whose coordinate of 1e6 m is
/// rounded may move sideways by several roundings of 0.06 m, here into the image.
TEST_F(ReferenceVisibility, theAnchorIncludesWhatRoundingMovesIntoThePicture) {
    constexpr double kAsideMetres = 0.3;
    camera_.worldFromCamera = glm::dmat4(1.0);
    camera_.projection = scenes::Projection::Orthographic;
    camera_.halfHeightMetres = 1.0;
    camera_.farMetres = 2e6;
    const auto x = float(camera_.halfHeightMetres + kAsideMetres);
    scene_.meshes.front().positionsOS = {{x, 0.0f, -10.0f}, {x, 0.0f, -1e6f}, {x, 0.5f, -10.0f}};
    const Anchor anchor = Objects(scene_, CameraRays(camera_, {1, 1})).anchor();
    for (const double depth : {10.0, 1e6})
        EXPECT_LE(glm::distance(anchor.centreRWS, {camera_.halfHeightMetres, 0.0, -depth}), anchor.radiusMetres);
}

TEST_F(ReferenceVisibility, aHitIsWhereTheRayMeetsTheTriangle) {
    const std::optional<Hit> hit = middle();
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->depthMetres, 5.0, 1e-14);
    EXPECT_NEAR(hit->weights.y, 0.25, 1e-14);
    EXPECT_NEAR(hit->weights.z, 0.25, 1e-14);
    EXPECT_TRUE(hit->frontFacing);
    camera_.projection = scenes::Projection::Orthographic;
    const std::optional<Hit> parallel = middle();
    ASSERT_TRUE(parallel);
    EXPECT_NEAR(parallel->depthMetres, 5.0, 1e-14);
}

TEST_F(ReferenceVisibility, raysOfOddPicturesGoThroughThePositionsOfTheirPixels) {
    for (const scenes::Projection projection : {scenes::Projection::Perspective, scenes::Projection::Orthographic}) {
        camera_.projection = projection;
        camera_.farMetres = 50.0;
        frame::FrameSettings settings;
        settings.sizePixels = {7, 5};
        const validation::PixelPositions positions(camera_, settings, {camera_.nearMetres, camera_.farMetres});
        const CameraRays rays(camera_, settings.sizePixels);
        for (int row = 0; row < 5; ++row) {
            for (int column = 0; column < 7; ++column) {
                const glm::dvec3 near = positions.positionWS(column, 4 - row, 1.0f);
                const glm::dvec3 own = rays.eyeWS() + rays.through(column, row).at(camera_.nearMetres);
                EXPECT_LT(glm::distance(near, own), 1e-14);
            }
        }
    }
}

TEST_F(ReferenceVisibility, theBackOfASingleSidedSurfaceIsNotSeen) {
    camera_.worldFromCamera = scenes::worldFromLookAt({0.5, 1.0, -5.0}, {0.5, 1.0, 0.0});
    EXPECT_FALSE(middle());
    scene_.materials[0].doubleSided = true;
    ASSERT_TRUE(middle());
    EXPECT_FALSE(middle()->frontFacing);
}

TEST_F(ReferenceVisibility, aMirroringTransformNeverTurnsAFrontIntoABack) {
    scene_.nodes[0].parentFromNode[2].z = -1.0; // z is mirrored: the triangle stays in z = 0 and faces -z
    EXPECT_FALSE(middle());
    camera_.worldFromCamera = scenes::worldFromLookAt({0.5, 1.0, -5.0}, {0.5, 1.0, 0.0});
    ASSERT_TRUE(middle());
    EXPECT_TRUE(middle()->frontFacing);
}

/// Compared with differences of the weights two pixels apart, which err by 1e-6 in an image of 2000 rows.
TEST_F(ReferenceVisibility, changesToTheNextPixelsAreDerivativesOfTheWeights) {
    camera_.worldFromCamera = scenes::worldFromLookAt({3.0, -1.0, 4.0}, {0.5, 1.0, 0.0});
    for (const auto projection : {scenes::Projection::Perspective, scenes::Projection::Orthographic}) {
        camera_.projection = projection;
        const glm::ivec2 size(2000, 2000);
        const auto hit = at(1000, 1000, size), right = at(1001, 1000, size), left = at(999, 1000, size);
        const auto up = at(1000, 999, size), down = at(1000, 1001, size);
        ASSERT_TRUE(hit && right && left && up && down);
        const double scale = glm::length(hit->weightsDx);
        EXPECT_LT(glm::distance(hit->weightsDx, 0.5 * (right->weights - left->weights)), 1e-5 * scale);
        EXPECT_LT(glm::distance(hit->weightsDy, 0.5 * (up->weights - down->weights)), 1e-5 * scale);
        EXPECT_GT(scale, 1e-5);
        const double change = glm::length(right->weightsDx - hit->weightsDx) / scale;
        EXPECT_LE(change, 2.0 * hit->perspective * 1.01 + 1e-12);
    }
}

/// A small triangle 100 m ahead, once as it is and once with its node 1e6 m aside, whose rounding widens the product's
/// range of depths. The near plane cuts that range, so that its middle moves.
TEST_F(ReferenceVisibility, theProductsOriginIsAsNearToTheAnchorAsItSays) {
    camera_.worldFromCamera = glm::dmat4(1.0);
    camera_.nearMetres = 99.999;
    camera_.farMetres = 500.0;
    scene_.nodes.front().parentFromNode[3].z = -100.0;
    for (const auto projection : {scenes::Projection::Perspective, scenes::Projection::Orthographic})
        for (const float aside : {0.0f, 1e6f}) {
            camera_.projection = projection;
            scene_.nodes.front().parentFromNode[3].x = aside;
            scene_.meshes.front().positionsOS = {
                {-aside, 0.0f, 0.0f}, {0.125f - aside, 0.0f, 0.0f}, {-aside, 0.25f, 0.0f}};
            const CameraRays rays(camera_, {1, 1});
            const Anchor anchor = Objects(scene_, rays).anchor();
            const double origin =
                frame::depthInterval(camera_, rays.halfExtent(), frame::surfaceBounds(scene_)).originMetres;
            EXPECT_GT(origin, camera_.nearMetres + 1e-7 * double(aside));
            EXPECT_GT(anchor.radiusMetres, 0.0);
            EXPECT_LE(glm::distance(anchor.centreRWS, origin * rays.forward()), anchor.otherOriginMetres) << aside;
        }
}

TEST_F(ReferenceVisibility, onlySurfacesBetweenNearAndFarPlaneAreVisible) {
    addTriangle(2.0);
    middle();
    EXPECT_EQ(number_, 1);
    camera_.nearMetres = 3.001;
    middle();
    EXPECT_EQ(number_, 0);
    camera_.farMetres = 4.999;
    EXPECT_FALSE(middle());
}

TEST_F(ReferenceVisibility, aHoleOfAMaskShowsTheSurfaceBehind) {
    addTriangle(2.0, AlphaMode::Mask);
    scene_.materials[1].alphaCutoff = 0.5f;
    scene_.materials[1].baseColor.a = 0.5f; // opacity >= cutoff stays
    middle();
    EXPECT_EQ(number_, 1);
    scene_.materials[1].baseColor.a = 0.49f;
    middle();
    EXPECT_EQ(number_, 0);
}

TEST_F(ReferenceVisibility, transparentSurfacesAreBlendedFarToNearAndNeverFromBehindAnOpaqueOne) {
    for (const double z : {1.0, -1.0, 3.0, 2.0}) addTriangle(z, AlphaMode::Blend);
    const CameraRays rays(camera_, {1, 1});
    const Objects objects(scene_, rays);
    const Textures textures(scene_, Filtering::Exact);
    const Visibility visibility(objects, rays, textures);
    const Ray ray = rays.through(0, 0);
    const std::optional<Hit> opaque = visibility.nearestOpaque(ray);
    ASSERT_TRUE(opaque);
    EXPECT_EQ(opaque->object->number, 0u);
    std::vector<std::uint32_t> order;
    for (const Hit& hit : visibility.transparentBefore(ray, opaque->depthMetres)) order.push_back(hit.object->number);
    EXPECT_EQ(order, (std::vector<std::uint32_t>{1, 4, 3}));
}

TEST_F(ReferenceVisibility, aSceneFarFromTheOriginIsSeenAsAtTheOrigin) {
    scene_.nodes[0].parentFromNode[3] = glm::dvec4(0x1p20, 0x1p21, -0x1p20, 1.0);
    camera_.worldFromCamera[3] += glm::dvec4(0x1p20, 0x1p21, -0x1p20, 0.0);
    const std::optional<Hit> hit = middle();
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->weights.y, 0.25, 1e-9); // double's step there is 2^-32 m
}

} // namespace
} // namespace tessera::reference
