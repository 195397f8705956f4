#pragma once
#include <compare>
#include <unordered_map>
#include <unordered_set>

#include "scenes/import/GltfBuffers.h"

namespace tessera::scenes::gltf {

/// Modes of primitives. Those before kTriangles draw points and lines (GltfThinSolids.cpp).
inline constexpr int kPoints = 0, kLines = 1, kLineLoop = 2, kTriangles = 4, kStrip = 5, kFan = 6;

/// How primitives show their material. Source: glTF 2.0 specification, "Point and Line Materials".
enum class Shading : std::uint8_t {
    AsStated,
    WithoutNormalMaps, ///< points and lines with normals: lit with the face normals of their solids, without tangents
    Unlit              ///< points and lines without normals: base colour plus emission
};

/// Whether a primitive draws points or lines.
inline bool isThin(const tiny::Primitive& primitive) {
    return primitive.mode < kTriangles;
}

inline Shading shadingOf(const tiny::Primitive& primitive) {
    if (!isThin(primitive)) return Shading::AsStated;
    return primitive.attributes.contains("NORMAL") ? Shading::WithoutNormalMaps : Shading::Unlit;
}

inline constexpr int kTexCoordSets = std::tuple_size_v<decltype(Mesh::texCoords)>;

/// A material of the document as shown by primitives.
struct ShownMaterial {
    int index = kNone;
    Shading shading = Shading::AsStated;
    unsigned lostSets = 0; ///< bit N: the mesh lacks TEXCOORD_N; bit kTexCoordSets: all further sets
    auto operator<=>(const ShownMaterial&) const = default;
};

/// Shared state of one import.
struct Context {
    const Document& document;
    Scene& scene;
    Buffers buffers{document};
    Accessors accessors{document, buffers};
    DracoStreams streams{document, buffers};
    /// Material in the requested variant, by scene mesh.
    std::map<int, ShownMaterial> variantMaterials = {};
    std::map<int, int> thinModes = {}; ///< glTF modes of scene meshes that draw points or lines
    /// By material of the document: world metres per unit of the meshes that show it; empty if they share no uniform
    /// scale.
    std::map<int, std::optional<double>> thicknessScales = {};
    std::uint64_t unreadableBytes = 0;                       ///< spent on images that cannot be read
    std::unordered_set<std::string> warned = {};             ///< the scene's warnings
    std::unordered_map<std::string, int> cameraNumbers = {}; ///< the last number appended to a repeated name
    std::unordered_set<std::string> cameraNames = {};

    /// The document's material of a primitive in the requested variant, if the variant changes it.
    std::optional<int> variantMaterial(const tiny::Primitive& primitive) const {
        const std::optional<std::string>& requested = document.ledger.importOptions().variant;
        if (!requested) return std::nullopt;
        const auto variants = elementsOf(valueAt(document.model.extensions, "KHR_materials_variants/variants"));
        for (const tiny::Value& mapping : elementsOf(valueAt(primitive.extensions, "KHR_materials_variants/mappings")))
            for (const tiny::Value& variant : elementsOf(valueAt(&mapping, "variants")))
                if (const auto index = std::size_t(integerOf(&variant));
                    index < variants.size() && stringOf(valueAt(&variants[index], "name")) == *requested)
                    return integerOf(valueAt(&mapping, "material"));
        return std::nullopt;
    }
    /// Called for each scene mesh made from a primitive.
    void noteMesh(int sceneMesh, const tiny::Primitive& primitive, unsigned lostSets) {
        if (const std::optional<int> material = variantMaterial(primitive))
            variantMaterials[sceneMesh] = {*material, shadingOf(primitive), lostSets};
        if (isThin(primitive)) thinModes[sceneMesh] = primitive.mode;
    }

    /// Warns that the value at a JSON pointer was repaired; throws InputError instead if the load is strict. `repair`
    /// begins with punctuation and names what is drawn instead.
    template <typename... Values>
    void repair(const std::string& place, std::string_view repair, fmt::format_string<Values...> flaw,
                Values&&... values) {
        const std::string what = fmt::format(flaw, std::forward<Values>(values)...);
        if (document.ledger.importOptions().isStrict) document.fail(place, what);
        warn("{}: {}{}", place, what, repair);
    }

    /// Adds "file: text" to the scene's warnings unless it is already there. Charges the ledger for both copies.
    void warn(const std::string& text) {
        std::string line = fmt::format("{}: {}", document.file, text);
        if (warned.contains(line)) return;
        document.ledger.charge(2 * (line.size() + kWarningBytes), [&] { return document.file + ": its warnings"; });
        warned.insert(line);
        scene.warnings.push_back(std::move(line));
    }
    template <typename First, typename... Values>
    void warn(fmt::format_string<First, Values...> text, First&& first, Values&&... values) {
        warn(fmt::format(text, std::forward<First>(first), std::forward<Values>(values)...));
    }

private:
    static constexpr std::size_t kWarningBytes = 3 * sizeof(std::string); ///< beside its characters: node and table
};

/// `name` as the document gives it, else "`kind` `index`".
inline std::string nameOr(const std::string& name, const char* kind, int index) {
    return name.empty() ? fmt::format("{} {}", kind, index) : name;
}

} // namespace tessera::scenes::gltf
