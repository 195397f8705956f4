#pragma once
#include <map>
#include <string>

#include "scenes/import/GltfContext.h"

namespace tessera::scenes::gltf {

/// A textureInfo of any of tinygltf's types, or of an extension's object.
struct TextureReference {
    int texture = kNone;
    int texCoordSet = 0;
    const tinygltf::Value* transform = nullptr; ///< KHR_texture_transform
};

template <typename Info>
TextureReference referenceOf(const Info& info) {
    return {info.index, info.texCoord, findExtension(info.extensions, "KHR_texture_transform")};
}
TextureReference referenceIn(const tinygltf::Value& extension, const std::string& name);

/// Turns texture references into uses of the scene's images; an image is decoded the first time it is used.
class Textures {
public:
    explicit Textures(Context& context) : context_(context) {}

    /// `place` names the reference in messages. Throws InputError naming the image's file when it cannot be read.
    TextureUse use(const TextureReference& reference, const std::string& place);

private:
    int image(int index);
    Image decoded(int index) const;

    Context& context_;
    std::map<int, int> imported_; ///< scene image by glTF image
};

} // namespace tessera::scenes::gltf
