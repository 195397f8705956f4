#pragma once
#include <memory>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Image.h"

/// Textures that modulate the radiance of flat area lights over their surface (docs/area-lights.md).
namespace tessera::scenes {

class LoadLedger;

struct LightPicture {
    std::string source;   ///< the absolute path of its file
    Image map;            ///< Rgba32Float, RGB 0 to kMostRadiance: factors of the light's radiance
    glm::vec3 most{1.0f}; ///< the greatest factor of each channel
};

/// A light's texture: immutable, and shared by all lights and scenes that use the same file. Factors are interpolated
/// bilinearly between texel centres and clamped beyond the outermost ones. The image covers the square around the
/// light's position that reaches to its radius or farthest corner, or the rectangle of its sides. Seen from the lit
/// side it runs from the left along Light::alongWS and from the bottom perpendicular to that.
class LightTexture {
public:
    LightTexture() = default;
    /// Computes LightPicture::most.
    explicit LightTexture(LightPicture picture);

    explicit operator bool() const { return picture_ != nullptr; }
    const LightPicture& operator*() const { return *picture_; }
    const LightPicture* operator->() const { return picture_.get(); }
    /// Textures are equal if they come from the same file and have the same texels.
    bool operator==(const LightTexture& other) const;

    /// The greatest factor of each channel; 1 without a texture.
    glm::vec3 most() const { return picture_ ? picture_->most : glm::vec3(1.0f); }

private:
    std::shared_ptr<const LightPicture> picture_;
};

/// Maximum number of texels of one light texture, and of all those of a frame together, before prefiltering.
inline constexpr long long kMostLightTexels = 1LL << 22;

/// Loads an image file: integer formats are taken as sRGB, float formats as linear. Invalid numbers are replaced and
/// counted in `warnings`. Throws InputError that names the file and its fault.
LightTexture loadLightTexture(const std::string& file, LoadLedger& ledger, std::vector<std::string>& warnings);

} // namespace tessera::scenes
