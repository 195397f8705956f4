#include "scenes/LightTexture.h"

#include <cassert>
#include <cstring>
#include <filesystem>

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/LoadLedger.h"
#include "scenes/RadianceMap.h"

namespace tessera::scenes {

LightTexture::LightTexture(LightPicture picture) {
    assert(picture.map.format == TexelFormat::Rgba32Float);
    picture.most = glm::vec3(0.0f);
    for (std::size_t at = 0; at + sizeof(glm::vec4) <= picture.map.texels.size(); at += sizeof(glm::vec4)) {
        glm::vec4 texel;
        std::memcpy(&texel, picture.map.texels.data() + at, sizeof texel);
        picture.most = glm::max(picture.most, glm::vec3(texel));
    }
    picture_ = std::make_shared<const LightPicture>(std::move(picture));
}

bool LightTexture::operator==(const LightTexture& other) const {
    if (picture_ == other.picture_) return true;
    if (!picture_ || !other.picture_) return false;
    const LightPicture &a = *picture_, &b = *other.picture_;
    return a.source == b.source && a.map.width == b.map.width && a.map.height == b.map.height &&
           a.map.texels == b.map.texels;
}

LightTexture loadLightTexture(const std::string& source, LoadLedger& ledger, std::vector<std::string>& warnings) {
    const std::filesystem::path file = std::filesystem::absolute(source).lexically_normal();
    LightPicture picture;
    picture.source = file.string();
    RadianceMap map = readRadianceMap(file, ledger);
    if ((long long)(map.image.width) * map.image.height > kMostLightTexels)
        throw InputError(fmt::format("{}: is {}x{} texels, and the texture of a light may have {} in all; make it "
                                     "smaller",
                                     picture.source, map.image.width, map.image.height, kMostLightTexels));
    warnOfReplaced(fmt::format("the texture '{}' of a light", map.image.name), map.replaced, warnings);
    picture.map = std::move(map.image);
    return LightTexture(std::move(picture));
}

} // namespace tessera::scenes
