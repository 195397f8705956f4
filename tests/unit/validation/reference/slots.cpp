// Points where rounding decides which texel a surface shows.
#include "validation/reference/Slots.h"

#include <optional>

#include <gtest/gtest.h>

#include "tests/support/TestScenes.h"
#include "validation/reference/LookupTolerance.h"
#include "validation/reference/Textures.h"

namespace tessera::reference {
namespace {

constexpr int kSide = 8;
constexpr double kRounding = 0x1p-24; ///< of a coordinate from 0.5 to 1 to single precision

class ReferenceSlots : public testing::Test {
protected:
    ReferenceSlots() : scene_(test::quadScene({})) {
        scenes::Image& image = scene_.images.emplace_back();
        image.name = "texels";
        image.width = image.height = kSide;
        image.texels.assign(std::size_t(4 * kSide * kSide), std::byte(128));
        scenes::TextureUse& use = scene_.materials[0].texture(scenes::TextureSlot::BaseColor);
        use.image = 0;
        use.sampler.magnification = use.sampler.minification = scenes::Filter::Nearest;
        objects_.emplace(scene_, CameraRays(scene_.cameras[0], {1, 1}));
        hit_.object = &objects_->opaque()[0];
    }
    /// Tests a point with u at `texCoord` beyond the texel edge at 3/4, and v at a texel's centre.
    bool isUndecidedBeyondEdge(double texCoord) {
        // Corners 0, 1 and 2 of the quad have the coordinates (0, 1), (1, 1) and (1, 0).
        const double u = 0.75 + texCoord, v = 0.5625;
        hit_.weights = {1.0 - u, u - 1.0 + v, 1.0 - v};
        return isUndecided(hit_, Textures(scene_, Filtering::Exact));
    }

    scenes::Scene scene_;
    std::optional<Objects> objects_;
    Hit hit_;
};

/// A program adds up three products. Each product and each sum may be rounded.
TEST_F(ReferenceSlots, edgesOfTexelsAreUndecidedWithinAFewRoundingsOfTheCoordinate) {
    for (const double sign : {1.0, -1.0}) {
        EXPECT_TRUE(isUndecidedBeyondEdge(sign * kRounding));
        EXPECT_FALSE(isUndecidedBeyondEdge(sign * 16.0 * kRounding));
    }
}

/// Rounding that moves a point over the image changes its coordinates: by a hundredth per pixel for a texture that
/// spans 100 pixels.
TEST_F(ReferenceSlots, edgesOfTexelsAreUndecidedAsFarAsAPointIsMovedOverThePicture) {
    hit_.weightsDx = glm::dvec3(-0.01, 0.01, 0.0); // u by 0.01, v by 0
    hit_.roundingPixels = 0.02;
    EXPECT_TRUE(isUndecidedBeyondEdge(1.9e-4));
    EXPECT_FALSE(isUndecidedBeyondEdge(2.1e-4));
    EXPECT_TRUE(isUndecidedBeyondEdge(-1.9e-4));
    EXPECT_FALSE(isUndecidedBeyondEdge(-2.1e-4));
}

/// Positions around 1 m are rounded by 2^-24 m, and sums of them by a few times as much.
TEST_F(ReferenceSlots, aPointIsMovedOverThePictureByAFewRoundingsOfItsPosition) {
    scenes::Camera camera = scene_.cameras[0];
    camera.projection = scenes::Projection::Orthographic;
    camera.halfHeightMetres = 1.0;
    const CameraRays rays(camera, {1000, 1000});
    const Objects objects(scene_, rays);
    const std::optional<Hit> hit = hitOf(objects.opaque()[0], 0, rays.through(700, 600));
    ASSERT_TRUE(hit);
    const double metresAPixel = 2.0 / 1000.0;
    EXPECT_GT(hit->roundingPixels, 1.0 * kRounding / metresAPixel);
    EXPECT_LT(hit->roundingPixels, 64.0 * kRounding / metresAPixel);
    EXPECT_GT(hit->roundingMetres, 1.0 * kRounding);
    EXPECT_LT(hit->roundingMetres, 64.0 * kRounding);
    // The relative stretch of a triangle of 1.4 m, in powers of two.
    EXPECT_GT(hit->roundingLevels, 1.0 * kRounding);
    EXPECT_LT(hit->roundingLevels, 64.0 * kRounding);
}

/// Hardware has eight bits for weights between texels and for texels. Its level of detail may differ as far as that of
/// known drivers does: by less than half a level.
TEST_F(ReferenceSlots, whatHardwareIsGrantedIsABitOfAWeightAndOfATexelAndLessThanHalfALevel) {
    const scenes::TextureUse& use = scene_.materials[0].texture(scenes::TextureSlot::BaseColor);
    const Textures textures(scene_, Filtering::Hardware);
    const Pyramid& pyramid = textures.pyramid(0, Transfer::Srgb);
    // One texel per pixel.
    const Footprint footprint{glm::dvec2(0.5), glm::dvec2(1.0 / kSide, 0.0), glm::dvec2(0.0, 1.0 / kSide)};
    const LookupTolerance tolerance = lookupTolerance(Filtering::Hardware, use, footprint, pyramid, hit_);
    for (int axis = 0; axis < 2; ++axis) {
        EXPECT_GT(tolerance.texCoord[axis] * kSide, 1.0 / 256.0);
        EXPECT_LT(tolerance.texCoord[axis] * kSide, 4.0 / 256.0);
    }
    EXPECT_DOUBLE_EQ(tolerance.codes, 1.0 / 255.0);
    for (const double levels : {tolerance.coarser, tolerance.finer}) {
        EXPECT_GT(levels, 0.25);
        EXPECT_LT(levels, 0.5);
    }
}

} // namespace
} // namespace tessera::reference
