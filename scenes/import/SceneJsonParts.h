#pragma once
#include <functional>

#include "scenes/import/JsonReader.h"

/// How the parts of a .json scene are read. All throw InputError naming the place in the document.
namespace tessera::scenes::scenejson {

/// 16 numbers, column by column as in glTF, of an affine matrix.
glm::dmat4 readMatrix(const JsonValue& value);

/// The keys "transform" ({translation, rotation or eulerDegrees, scale}) or "matrix" of an object; the identity without
/// both. Scale comes first, then rotation, then translation; euler angles turn about the fixed axes X, then Y, then Z.
/// Throws InputError for both keys at once. A transform may flatten what it places.
glm::dmat4 readTransform(JsonObject& object);

/// True when the matrix only rotates and moves, to the tolerance of checkScene().
bool isRigid(const glm::dmat4& matrix);

/// The file that a name in a document means: relative names start at the document's folder, and ${TESSERA_ASSETS}
/// stands for that environment variable, as nothing else does. Throws InputError when the variable is not set or the
/// file is missing.
std::filesystem::path resolveFile(const JsonValue& name);

/// The pictures that a document may name. The first `baseImages` of the scene are those of the document's base, which
/// are named by number.
class Images {
public:
    /// Reads files into the scene, each once however often it is named.
    Images(Scene& scene, std::size_t baseImages, LoadLedger& ledger)
        : baseImages_(baseImages), scene_(&scene), ledger_(&ledger) {}
    /// Reads none: a document that names a file is refused.
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

/// A file name alone, or {file or image, texCoord, transform: {offset, scale, rotationDegrees},
/// sampler: {magFilter, minFilter, wrapU, wrapV}}, where `image` is the number of one of the base's.
/// The second form reads those keys of an object that has more.
TextureUse readTexture(const JsonValue& value, Images& images);
TextureUse readTexture(JsonObject& object, Images& images);

/// A new material: its name, its model and the model's parameters. Throws InputError for parameters that the model does
/// not have.
Material readMaterial(const JsonValue& value, Images& images);

/// Changes the parameters an override gives, and no others; "model" changes the model first. The caller reads the key
/// that says which materials are meant.
void changeMaterial(JsonObject& object, Material& material, Images& images);

/// The picture that a document names; throws InputError at the name.
using ReadLightTexture = std::function<LightTexture(const JsonValue& fileName)>;

/// A light of any type of lightTypes(), with its falloff and animation; `index` names a nameless one. Throws
/// InputError; "area" and "environment" are refused with what to write instead.
Light readLight(const JsonValue& value, std::size_t index, const ReadLightTexture& readTexture);
/// The same where a light that names a picture is refused.
Light readLight(const JsonValue& value, std::size_t index);

/// A perspective or orthographic camera, placed by position and target or direction, or by a matrix.
Camera readCamera(const JsonValue& value, std::size_t index);

struct PatternMatch {
    bool isMatch;
    std::size_t steps; ///< that were taken to find out, of a character each

    explicit operator bool() const { return isMatch; }
};

/// Whether `pattern`, in which * stands for any text and ? for any character, matches the whole name.
PatternMatch matchesPattern(std::string_view pattern, std::string_view name);

/// Applies overrides one after the other. {"node": PATTERN, "material": NAME} binds a material to all that is drawn at
/// the matching nodes and below them; {"material": PATTERN, ...} changes parameters of the matching materials.
/// `ownMaterials` is the index of the first material that the document itself defines: those are found by name before
/// included ones, and are not changed. Throws InputError with the nearest names when nothing matches, and where the
/// overrides are too many for all that they match.
void applyOverrides(const std::vector<JsonValue>& overrides, Scene& scene, std::size_t ownMaterials, Images& images);

/// Removes the included materials (those before `ownMaterials`) that `wasUsed` marks and that nothing uses any more,
/// with the pictures only they used; and warns about the document's own materials that nothing uses.
void dropReplacedMaterials(Scene& scene, std::size_t ownMaterials, const std::vector<bool>& wasUsed,
                           const std::filesystem::path& file);

/// For every material, whether something is drawn with it.
std::vector<bool> usedMaterials(const Scene& scene);

/// {file, materials: [names], mayMoveMetres, parameters: [{name, value, least, most}]}, in place of the hook that the
/// scene has; null: it has none; {values: {name: number}}: the same with other values of its parameters. Without
/// `materials` it changes all that the scene has. Throws InputError naming the place in the document, or file and line
/// where the file is at fault.
void readHook(const JsonValue& value, Scene& scene, LoadLedger& ledger);

} // namespace tessera::scenes::scenejson
