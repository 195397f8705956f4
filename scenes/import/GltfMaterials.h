#pragma once
#include <map>

#include "scenes/import/GltfTextures.h"

namespace tessera::scenes::gltf {

/// Turns glTF materials into the scene's, the first time each is used.
/// Source: glTF 2.0 section 3.9; KHR_materials_unlit, _emissive_strength, _ior, _specular, _anisotropy, _clearcoat,
/// _sheen.
class Materials {
public:
    explicit Materials(Context& context) : context_(context), textures_(context) {}

    /// The scene's index of glTF material `index`; kNone gives the default material of the specification, named
    /// "default".
    int material(int index);

private:
    Material convert(int index);
    void convertSpecular(const tinygltf::Material& stored, const std::string& place, Material& material);
    void convertAnisotropy(const tinygltf::Material& stored, const std::string& place, Material& material);
    void convertClearcoat(const tinygltf::Material& stored, const std::string& place, Material& material);
    void convertSheen(const tinygltf::Material& stored, const std::string& place, Material& material);

    Context& context_;
    Textures textures_;
    std::map<int, int> imported_; ///< scene material by glTF material
};

} // namespace tessera::scenes::gltf
