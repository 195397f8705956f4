#pragma once
#include "scenes/import/GltfContext.h"

namespace tessera::scenes::gltf {

/// Turns glTF materials into the scene's the first time each is used, and images likewise.
class Materials {
public:
    explicit Materials(Context& context) : context_(context) {}

    /// The scene's index of a glTF material; kNone gives the default material of the specification, named "default".
    /// One that a shading changes is a material of its own, and its name says how. For an image that cannot be read a
    /// stand-in is drawn, with a warning that names its file; a load that is to be strict throws InputError with the
    /// same text.
    int material(ShownMaterial shown);
    /// The material of a primitive as it shows it. Where the mesh has no texture coordinates that its materials need,
    /// it gets some for the stand-in.
    ShownMaterial shownBy(const tiny::Primitive& primitive, Mesh& mesh) const;
    /// The scene's indices of glTF material `index`, one for each shading in which something shows it.
    std::vector<int> imported(int index) const;

private:
    /// Bits of the texture coordinates that a material needs, the last one for all from kTexCoordSets.
    unsigned neededSets(const ShownMaterial& shown) const;
    /// The same material as stated where its shading changes nothing.
    ShownMaterial distinct(ShownMaterial shown) const;
    Material convert(ShownMaterial shown);
    /// Adds the emission to the base colour of an unlit material, where no texture scales either.
    void addEmission(const StoredMaterial& stored, const std::string& place, Material& material);
    void takeDiffuse(const SpecularGlossiness& stored, const std::string& place, unsigned lostSets, Material& material);
    void convertSpecularGlossiness(const SpecularGlossiness& stored, const std::string& place, unsigned lostSets,
                                   Material& material);
    /// The scene's index of a picture whose green is the roughness 1 - `glossiness` x the alpha of another.
    int roughnessOf(int image, float glossiness);
    /// `place` names the use in messages.
    TextureUse use(const TextureInfo& info, TextureSlot slot, const std::string& place, unsigned lostSets);
    /// `instead` ends the warning where it cannot be read.
    int image(int index, const char* instead);
    int standIn();

    Context& context_;
    std::map<ShownMaterial, int> materials_;         ///< scene material by glTF material
    std::map<int, int> images_;                      ///< scene image by glTF image; kNone: it cannot be read
    int standIn_ = kNone;                            ///< scene image
    std::map<std::pair<int, float>, int> roughness_; ///< scene image by what roughnessOf() takes
};

/// Reports the variants, and imports the materials of the requested one. Called after all other materials, which keep
/// their numbers: scene files name materials by number.
void importVariant(Context& context, Materials& materials);

/// Gives these materials to what shows them. Called when all instances are there.
void bindVariant(Context& context, Materials& materials);

} // namespace tessera::scenes::gltf
