#pragma once
#include <map>
#include <optional>

#include "scenes/import/GltfContext.h"

namespace tessera::scenes::gltf {

/// Turns glTF materials into the scene's the first time each is used, and images likewise.
class Materials {
public:
    explicit Materials(Context& context) : context_(context) {}

    /// The scene's index of glTF material `index`; kNone gives the default material of the specification, named
    /// "default". Throws InputError naming the image's file when one cannot be read.
    int material(int index);
    /// The scene's index of glTF material `index` where something uses it.
    std::optional<int> imported(int index) const;

private:
    Material convert(int index);
    /// `place` names the use in messages.
    TextureUse use(const model::TextureInfo& info, const std::string& place);
    int image(int index);
    Image decoded(int index) const;

    Context& context_;
    std::map<int, int> materials_; ///< scene material by glTF material
    std::map<int, int> images_;    ///< scene image by glTF image
};

} // namespace tessera::scenes::gltf
