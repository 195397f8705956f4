#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include <glm/glm.hpp>

/// How large the faces of shadow maps are within a budget, and where they lie in one texture.
namespace tessera::frame {

/// Bytes of a texel of the atlas.
inline constexpr std::size_t kShadowTexelBytes = 4;

/// The smallest side of a face that a budget reduces one to.
inline constexpr int kLeastFaceTexels = 8;

/// `texels` rounded up to a power of two, from kLeastFaceTexels to 2048.
int automaticSideTexels(double texels);

/// What a light's faces are to be like.
struct ShadowDemand {
    int faces = 0;
    int wantedTexels = 0;       ///< side of each, where the budget is no matter; a power of two
    double pictureTexels = 0.0; ///< side that has a texel for each pixel of the picture across it
    double pixels = 0.0;        ///< of the picture that the light may reach
};

/// The side in texels that each light's faces get, 0 where the budget has no room for them. A texel is wanted / given
/// pixels wide, and an outline errs by part of one. The cost of halving a light's faces is that error, times the pixels
/// that the light may reach, for each texel saved; the cheapest halving comes first. Pixels and texels are rounded to
/// powers of two, so that the order seldom changes as the camera moves. Where all faces are of kLeastFaceTexels, the
/// last lights get none.
std::vector<int> fitBudget(std::span<const ShadowDemand> lights, double budgetBytes);

/// Places faces of the sides, powers of two, so that none overlap; the corners are parallel to them. Returns the
/// size of the atlas, 0 x 0 where there are none.
glm::ivec2 placeFaces(std::span<const int> sidesTexels, std::vector<glm::ivec2>& cornersTexels);

} // namespace tessera::frame
