#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/unit/scenes/json/SceneFiles.h"

/// Scenes of one material, whose members a test gives.
namespace tessera::scenes::test {

/// Members of a scene whose bust has the material.
inline std::string bound(const std::string& material) {
    return fmt::format(R"("materials": [{{"name": "m", {}}}], "overrides": [{{"node": "bust", "material": "m"}}])",
                       material);
}

/// The scene of a bust with one material, which its own default one gave way to.
inline Scene sceneOf(const SceneFolder& folder, const std::string& material) {
    Scene scene = folder.importMembers(bound(material));
    EXPECT_EQ(scene.materials.size(), 1u);
    EXPECT_THAT(scene.warnings, testing::IsEmpty());
    return scene;
}

inline Material materialOf(const SceneFolder& folder, const std::string& material) {
    return sceneOf(folder, material).materials.at(0);
}

inline std::string errorOfMaterial(const SceneFolder& folder, const std::string& material) {
    return folder.errorOfMembers(bound(material));
}

inline std::uint8_t redOf(const Scene& scene, TextureSlot slot) {
    const TextureUse& use = scene.materials.at(0).texture(slot);
    return std::to_integer<std::uint8_t>(scene.images.at(static_cast<std::size_t>(use.image)).texels.at(0));
}

} // namespace tessera::scenes::test
