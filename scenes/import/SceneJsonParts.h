#pragma once
#include <functional>

#include "scenes/import/JsonReader.h"

/// Readers of the parts of a .json scene. All throw InputError naming the place in the document.
namespace tessera::scenes::scenejson {

/// Reads an affine matrix from 16 numbers in column-major order, as in glTF.
glm::dmat4 readMatrix(const JsonValue& value);

/// Reads "transform" ({translation, rotation or eulerDegrees, scale}) or "matrix" of an object; the identity without
/// both. Scale comes first, then rotation, then translation; euler angles turn about the fixed axes X, then Y, then Z.
/// Throws InputError for both keys at once. A transform may be singular.
glm::dmat4 readTransform(JsonObject& object);

/// Whether the matrix only rotates and translates, within the tolerance of checkScene().
bool isRigid(const glm::dmat4& matrix);

/// Resolves a file name in a document: relative names start at the document's folder, and ${TESSERA_ASSETS} is replaced
/// by that environment variable, the only one allowed. Throws InputError if the variable is not set or the file is
/// missing.
std::filesystem::path resolveFile(const JsonValue& name);

/// The images that a document may name. The first `baseImages` of the scene are those of the document's base, which are
/// named by index.
class Images {
public:
    /// Reads files into the scene, each at most once.
    Images(Scene& scene, std::size_t baseImages, LoadLedger& ledger)
        : baseImages_(baseImages), scene_(&scene), ledger_(&ledger) {}
    /// Reads no files: a document that names one is refused.
    explicit Images(std::size_t baseImages) : baseImages_(baseImages) {}

    /// Throws InputError naming the place in the document and the file.
    int image(const JsonValue& fileName);
    int baseImage(const JsonValue& index) const;

private:
    std::size_t baseImages_;
    Scene* scene_ = nullptr;
    LoadLedger* ledger_ = nullptr;
    std::map<std::string, int> imageOfFile_;
};

/// Reads a file name, or {file or image, texCoord, transform: {offset, scale, rotationDegrees}, sampler: {magFilter,
/// minFilter, wrapU, wrapV}}, where `image` is the index of an image of the base. The second overload reads those keys
/// of an object that has more.
TextureUse readTexture(const JsonValue& value, Images& images);
TextureUse readTexture(JsonObject& object, Images& images);

/// Reads a new material: its name, its model and the model's parameters. Throws InputError for parameters that the
/// model does not have.
Material readMaterial(const JsonValue& value, Images& images);

/// Changes the parameters an override gives, and no others; "model" changes the model first. The caller reads the key
/// that selects the materials.
void changeMaterial(JsonObject& object, Material& material, Images& images);

/// Loads the image that a document names; throws InputError at the name.
using ReadLightTexture = std::function<LightTexture(const JsonValue& fileName)>;

/// Reads a light of any type of lightTypes(), with its falloff and animation; `index` names a nameless one. Throws
/// InputError; for "area" and "environment" the message names the alternative.
Light readLight(const JsonValue& value, std::size_t index, const ReadLightTexture& readTexture);
/// The same, but refuses a light that names an image.
Light readLight(const JsonValue& value, std::size_t index);

/// Reads a perspective or orthographic camera, placed by position and target or direction, or by a matrix.
Camera readCamera(const JsonValue& value, std::size_t index);

struct PatternMatch {
    bool isMatch;
    std::size_t steps; ///< characters compared

    explicit operator bool() const { return isMatch; }
};

/// Whether `pattern`, in which * stands for any text and ? for any character, matches the whole name.
PatternMatch matchesPattern(std::string_view pattern, std::string_view name);

/// Applies overrides in order. {"node": PATTERN, "material": NAME} binds a material to all meshes at and below the
/// matching nodes; {"material": PATTERN, ...} changes parameters of the matching materials. `ownMaterials` is the index
/// of the document's first local material: local ones are found by name before included ones, and are not changed.
/// Throws InputError with the nearest names if nothing matches, and if the overrides take too many steps for all their
/// matches.
void applyOverrides(const std::vector<JsonValue>& overrides, Scene& scene, std::size_t ownMaterials, Images& images);

/// Removes the included materials (those before `ownMaterials`) that were used (`wasUsed`) and no longer are, with the
/// images that only they used. Warns about unused local materials of the document.
void dropReplacedMaterials(Scene& scene, std::size_t ownMaterials, const std::vector<bool>& wasUsed,
                           const std::filesystem::path& file);

/// For every material, whether something is drawn with it.
std::vector<bool> usedMaterials(const Scene& scene);

/// Reads {file, materials: [names], mayMoveMetres, parameters: [{name, value, least, most}]}, which replaces the
/// scene's hook; null removes it; {values: {name: number}} changes values of its parameters. Without `materials` the
/// hook applies to all materials of the scene. Throws InputError naming the place in the document, or file and line if
/// the file is at fault.
void readHook(const JsonValue& value, Scene& scene, LoadLedger& ledger);

} // namespace tessera::scenes::scenejson
