#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include <glm/glm.hpp>

/// Sizes of shadow map faces within a memory budget, and their places in one atlas texture.
namespace tessera::frame {

/// Bytes of a texel of the atlas.
inline constexpr std::size_t kShadowTexelBytes = 4;

/// The smallest side to which the budget reduces a face.
inline constexpr int kLeastFaceTexels = 8;

/// `texels` rounded up to a power of two, from kLeastFaceTexels to 2048.
int automaticSideTexels(double texels);

/// Requested shadow map faces of a light.
struct ShadowDemand {
    int faces = 0;
    int wantedTexels = 0;       ///< side of each without a budget; a power of two
    double pictureTexels = 0.0; ///< side with one texel per image pixel across it
    double pixels = 0.0;        ///< of the image that are in range of the light
};

/// The side in texels of each light's faces, 0 if they do not fit the budget. A texel is wanted / given pixels wide,
/// and the error of a shadow's outline is a fraction of that. Halving a light's faces costs that error times the pixels
/// in range of the light, per texel saved; the cheapest halving comes first. Pixels and texels are rounded to powers of
/// two, so that the order seldom changes as the camera moves. When all faces have kLeastFaceTexels, the last lights get
/// none.
std::vector<int> fitBudget(std::span<const ShadowDemand> lights, double budgetBytes);

/// Places faces of the given sides, powers of two, without overlap; `cornersTexels` is parallel to `sidesTexels`.
/// Returns the size of the atlas, 0 x 0 without faces.
glm::ivec2 placeFaces(std::span<const int> sidesTexels, std::vector<glm::ivec2>& cornersTexels);

} // namespace tessera::frame
