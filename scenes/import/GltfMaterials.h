#pragma once
#include "scenes/import/GltfContext.h"

namespace tessera::scenes::gltf {

/// Converts glTF materials and images to the scene's on first use.
class Materials {
public:
    explicit Materials(Context& context) : context_(context) {}

    /// The scene's index of a glTF material; kNone gives the default material of the specification, named "default". A
    /// shading that changes it gives a separate material with a name suffix. An image that cannot be read is replaced
    /// by a stand-in, with a warning that names its file; a strict load throws InputError with the same text.
    int material(ShownMaterial shown);
    /// The material as shown by a primitive. If its materials need texture coordinates and the mesh has none, adds some
    /// for the stand-in.
    ShownMaterial shownBy(const tiny::Primitive& primitive, Mesh& mesh) const;
    /// The scene's indices of glTF material `index`, one for each shading in use.
    std::vector<int> imported(int index) const;

private:
    /// Bits of the texture coordinate sets that a material needs; bit kTexCoordSets stands for all further sets.
    unsigned neededSets(const ShownMaterial& shown) const;
    /// Replaces the shading by AsStated if it changes nothing.
    ShownMaterial distinct(ShownMaterial shown) const;
    Material convert(ShownMaterial shown);
    /// Adds the emission to the base colour of an unlit material, unless a texture scales either.
    void addEmission(const StoredMaterial& stored, const std::string& place, Material& material);
    void takeDiffuse(const SpecularGlossiness& stored, const std::string& place, unsigned lostSets, Material& material);
    void convertSpecularGlossiness(const SpecularGlossiness& stored, const std::string& place, unsigned lostSets,
                                   Material& material);
    /// The scene's index of an image whose green channel is the roughness 1 - `glossiness` x the alpha of `image`.
    int roughnessOf(int image, float glossiness);
    /// `place` names the use in messages.
    TextureUse use(const TextureInfo& info, TextureSlot slot, const std::string& place, unsigned lostSets);
    /// `instead` ends the warning about an image that cannot be read.
    int image(int index, const char* instead);
    int standIn();

    Context& context_;
    std::map<ShownMaterial, int> materials_;         ///< scene material by glTF material
    std::map<int, int> images_;                      ///< scene image by glTF image; kNone: it cannot be read
    int standIn_ = kNone;                            ///< scene image
    std::map<std::pair<int, float>, int> roughness_; ///< scene image by arguments of roughnessOf()
};

/// Reports the variants, and imports the materials of the requested one. Called after all other materials, so that
/// their indices do not change: scene files name materials by index.
void importVariant(Context& context, Materials& materials);

/// Assigns these materials to instances. Called when all instances exist.
void bindVariant(Context& context, Materials& materials);

} // namespace tessera::scenes::gltf
