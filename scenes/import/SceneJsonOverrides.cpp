#include "scenes/import/SceneJsonOverrides.h"

#include <algorithm>

#include "scenes/import/SceneJsonMaterials.h"

namespace tessera::scenes::scenejson {
namespace {

template <typename Element>
std::vector<std::string_view> namesOf(std::span<const Element> elements) {
    std::vector<std::string_view> names;
    for (const Element& element : elements)
        if (std::ranges::find(names, element.name) == names.end()) names.push_back(element.name);
    return names;
}

/// A material to bind: the document's own of that name, else the first included one.
int materialCalled(const JsonValue& value, const Scene& scene, std::size_t ownMaterials) {
    const std::string name = value.text();
    const auto findFrom = [&](std::size_t first) {
        return std::ranges::find(scene.materials.begin() + static_cast<std::ptrdiff_t>(first), scene.materials.end(),
                                 name, &Material::name);
    };
    auto found = findFrom(ownMaterials);
    if (found == scene.materials.end()) found = findFrom(0);
    if (found == scene.materials.end())
        value.failUnknown("material", name, namesOf(std::span<const Material>(scene.materials)));
    return static_cast<int>(found - scene.materials.begin());
}

void bindMaterial(JsonObject& object, const JsonValue& pattern, Scene& scene, std::size_t ownMaterials) {
    const int material = materialCalled(object.require("material"), scene, ownMaterials);
    object.done("an override of a node");
    const std::string text = pattern.text();
    std::vector<bool> isBelow(scene.nodes.size(), false);
    bool someMatch = false;
    bool someDrawn = false;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        Node& node = scene.nodes[i];
        const bool matches = matchesPattern(text, node.name);
        someMatch = someMatch || matches;
        // A parent stands before its children, so its mark is set already.
        isBelow[i] = matches || (node.parent != kNone && isBelow[static_cast<std::size_t>(node.parent)]);
        if (!isBelow[i]) continue;
        for (MeshInstance& instance : node.instances) {
            instance.material = material;
            someDrawn = true;
        }
    }
    if (!someMatch) pattern.failUnknown("node", text, namesOf(std::span<const Node>(scene.nodes)));
    if (!someDrawn)
        pattern.fail(fmt::format("nothing is drawn at or below the nodes '{}'; name one that has a mesh", text));
}

void changeMaterials(const JsonValue& value, const JsonValue& pattern, Scene& scene, std::size_t ownMaterials,
                     Images& images) {
    const std::string text = pattern.text();
    bool someMatch = false;
    for (std::size_t i = 0; i < ownMaterials; ++i) {
        if (!matchesPattern(text, scene.materials[i].name)) continue;
        someMatch = true;
        JsonObject object = value.object(); // anew, because each material's model has other keys
        object.find("material");
        changeMaterial(object, scene.materials[i], images);
    }
    const std::span<const Material> included(scene.materials.data(), ownMaterials);
    if (!someMatch) pattern.failUnknown("included material", text, namesOf(included));
}

} // namespace

bool matchesPattern(std::string_view pattern, std::string_view name) {
    std::size_t at = 0;
    std::size_t star = std::string_view::npos; // the last one seen, which takes up whatever the rest does not
    std::size_t taken = 0;
    for (std::size_t i = 0; i < name.size();) {
        if (at < pattern.size() && pattern[at] == '*') {
            star = at++;
            taken = i;
        } else if (at < pattern.size() && (pattern[at] == '?' || pattern[at] == name[i])) {
            ++at;
            ++i;
        } else if (star != std::string_view::npos) {
            at = star + 1;
            i = ++taken;
        } else {
            return false;
        }
    }
    return pattern.find_first_not_of('*', at) == std::string_view::npos;
}

void applyOverride(const JsonValue& value, Scene& scene, std::size_t ownMaterials, Images& images) {
    JsonObject object = value.object();
    if (const auto node = object.find("node")) return bindMaterial(object, *node, scene, ownMaterials);
    const std::optional<JsonValue> material = object.find("material");
    if (!material) value.fail("names neither a 'node' nor a 'material' to override");
    changeMaterials(value, *material, scene, ownMaterials, images);
}

std::vector<bool> usedMaterials(const Scene& scene) {
    std::vector<bool> used(scene.materials.size(), false);
    for (const Node& node : scene.nodes)
        for (const MeshInstance& instance : node.instances) used[static_cast<std::size_t>(instance.material)] = true;
    return used;
}

void dropReplacedMaterials(Scene& scene, std::size_t ownMaterials, const std::vector<bool>& wasUsed,
                           const std::filesystem::path& file) {
    const std::vector<bool> used = usedMaterials(scene);
    std::vector<int> newMaterial(scene.materials.size(), kNone);
    std::vector<bool> imageIsKept(scene.images.size(), true);
    std::vector<Material> kept;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        Material& material = scene.materials[i];
        if (i < ownMaterials && wasUsed[i] && !used[i]) {
            for (const TextureUse& use : material.textures)
                if (use.image != kNone) imageIsKept[static_cast<std::size_t>(use.image)] = false;
            continue;
        }
        if (i >= ownMaterials && !used[i])
            scene.warnings.push_back(
                fmt::format("{}: nothing is drawn with the material '{}'", file.string(), material.name));
        newMaterial[i] = static_cast<int>(kept.size());
        kept.push_back(std::move(material));
    }
    scene.materials = std::move(kept);
    for (Node& node : scene.nodes)
        for (MeshInstance& instance : node.instances)
            instance.material = newMaterial[static_cast<std::size_t>(instance.material)];

    for (const Material& material : scene.materials)
        for (const TextureUse& use : material.textures)
            if (use.image != kNone) imageIsKept[static_cast<std::size_t>(use.image)] = true;
    std::vector<int> newImage(scene.images.size(), kNone);
    std::vector<Image> keptImages;
    for (std::size_t i = 0; i < scene.images.size(); ++i) {
        if (!imageIsKept[i]) continue;
        newImage[i] = static_cast<int>(keptImages.size());
        keptImages.push_back(std::move(scene.images[i]));
    }
    scene.images = std::move(keptImages);
    for (Material& material : scene.materials)
        for (TextureUse& use : material.textures)
            if (use.image != kNone) use.image = newImage[static_cast<std::size_t>(use.image)];
}

} // namespace tessera::scenes::scenejson
