#pragma once
#include "scenes/import/SceneJsonFiles.h"

namespace tessera::scenes::scenejson {

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

} // namespace tessera::scenes::scenejson
