#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/unit/scenes/json/SceneFiles.h"

/// Scenes of one material with given members.
namespace tessera::scenes::test {

/// Members of a scene whose bust has the material.
inline std::string bound(const std::string& material) {
    return fmt::format(R"("materials": [{{"name": "m", {}}}], "overrides": [{{"node": "bust", "material": "m"}}])",
                       material);
}

class SceneJsonMaterials : public OneElement {
protected:
    SceneJsonMaterials() : OneElement("materials") {}

    /// The scene of a bust with this material in place of its default one.
    Scene sceneOf(const std::string& material) const {
        Scene scene = folder.importMembers(bound(material));
        EXPECT_EQ(scene.materials.size(), 1u);
        EXPECT_THAT(scene.warnings, IsEmpty());
        return scene;
    }
    Material materialOf(const std::string& material) const { return sceneOf(material).materials.at(0); }
    std::string errorOf(const std::string& material) const { return inElement(folder.errorOfMembers(bound(material))); }
    std::string errorBeyondSchemaOf(const std::string& material) const {
        return inElement(folder.errorBeyondSchemaOfMembers(bound(material)));
    }
};

inline std::uint8_t redOf(const Scene& scene, TextureSlot slot) {
    const TextureUse& use = scene.materials.at(0).texture(slot);
    return std::to_integer<std::uint8_t>(scene.images.at(std::size_t(use.image)).texels.at(0));
}

} // namespace tessera::scenes::test
