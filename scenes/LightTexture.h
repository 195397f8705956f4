#pragma once
#include <memory>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Image.h"

/// Pictures of how the radiance of flat area lights varies over their surface (docs/area-lights.md).
namespace tessera::scenes {

class LoadLedger;

struct LightPicture {
    std::string source;   ///< the absolute path of its file
    Image map;            ///< Rgba32Float, RGB 0 to kMostRadiance: factors of the light's radiance
    glm::vec3 most{1.0f}; ///< of each channel the greatest factor
};

/// What a light has of a picture: all lights and scenes that name one share it, and nobody changes it. The factor of a
/// place is interpolated bilinearly between the centres of four texels; beyond the outermost centres it is that of the
/// nearest place between them. The picture lies in the square around the light's position that reaches as far as its
/// sides, its radius or its farthest corner (the rectangle, where it has sides): seen from where it shines, from the
/// left along Light::alongWS and from the bottom across it.
class LightTexture {
public:
    LightTexture() = default;
    /// Finds LightPicture::most.
    explicit LightTexture(LightPicture picture);

    explicit operator bool() const { return picture_ != nullptr; }
    const LightPicture& operator*() const { return *picture_; }
    const LightPicture* operator->() const { return picture_.get(); }
    /// Pictures are the same where they come from the same file and hold the same.
    bool operator==(const LightTexture& other) const;

    /// The greatest factor of each channel; 1 without a picture.
    glm::vec3 most() const { return picture_ ? picture_->most : glm::vec3(1.0f); }

private:
    std::shared_ptr<const LightPicture> picture_;
};

/// As many texels as the pictures of a frame may have together before they are prefiltered, and one alone.
inline constexpr long long kMostLightTexels = 1LL << 22;

/// From a picture file: one of whole numbers is taken as sRGB, one of floats as linear. Numbers that are no light are
/// replaced: `warnings` tells how many. Throws InputError that names the file and its fault.
LightTexture loadLightTexture(const std::string& file, LoadLedger& ledger, std::vector<std::string>& warnings);

} // namespace tessera::scenes
