#include "scenes/import/GltfMaterials.h"

#include <algorithm>
#include <limits>
#include <unordered_set>

#include <fmt/ranges.h>

#include "scenes/import/GltfSteps.h"
#include "scenes/import/Importers.h"
#include "scenes/import/MadeImages.h"

namespace tessera::scenes::gltf {
namespace {

/// Limit of memory used in turn by images that cannot be read. Each takes as long as a readable one, and any number of
/// them may name one file or buffer. The ledger bounds only the number of readable ones.
constexpr std::uint64_t kMostUnreadableBytes = std::uint64_t{1} << 32;

Image decoded(Context& context, int index) {
    const Document& document = context.document;
    const tiny::Image& stored = elementAt(document.model.images, index);
    const std::string& uri = stored.uri;
    const std::string place = fmt::format("/images/{}", index);
    Image image;
    if (stored.bufferView != kNone) {
        image = decodeImage(context.buffers.view(stored.bufferView), fmt::format("{}: {}", document.file, place),
                            document.ledger);
    } else if (isDataUri(uri)) {
        const std::uint64_t mark = document.ledger.usedBytes();
        document.charge(2 * uri.size(), "images", index);
        std::vector<std::byte> bytes;
        try {
            bytes = decodeDataUri(uri);
        } catch (const InputError& error) {
            document.fail(place, error);
        }
        image = decodeImage(bytes, fmt::format("{}: {}", document.file, place), document.ledger);
        document.ledger.settle(mark, image.texels.size());
    } else if (!uri.empty()) {
        const std::filesystem::path file = document.fileAt(place, uri);
        try {
            image = readImage(file, document.ledger);
        } catch (const InputError& error) {
            document.fail(place, error);
        }
    } else {
        document.fail(place, "has neither a uri nor a bufferView");
    }
    image.name = stored.name;
    if (image.name.empty()) image.name = uri.empty() || isDataUri(uri) ? fmt::format("image {}", index) : uri;
    return image;
}

/// Name suffix of materials whose shading is not the stated one.
std::string suffixOf(const ShownMaterial& shown) {
    std::string suffix = shown.lostSets != 0 ? ", without texture coordinates" : "";
    if (shown.shading == Shading::AsStated) return suffix;
    return suffix += shown.shading == Shading::Unlit ? ", unlit" : ", without normal maps";
}

unsigned bitOf(int texCoordSet) {
    return 1u << std::min(texCoordSet, kTexCoordSets);
}

bool isNormalMap(TextureSlot slot) {
    return slot == TextureSlot::Normal || slot == TextureSlot::ClearcoatNormal;
}

/// The unlit version of a lit material.
Material unlitOf(const Material& lit) {
    Material unlit;
    unlit.name = lit.name;
    unlit.model = MaterialModel::SingleColor;
    unlit.baseColor = lit.baseColor;
    unlit.alphaMode = lit.alphaMode;
    unlit.alphaCutoff = lit.alphaCutoff;
    unlit.doubleSided = lit.doubleSided;
    return unlit;
}

const TextureInfo& storedTexture(const StoredMaterial& stored, TextureSlot slot) {
    std::size_t i = 0;
    while (kTexturePlaces[i].slot != slot) ++i;
    return stored.textures[i];
}

} // namespace

std::optional<Image> readableImage(Context& context, int index, const char* instead) {
    const Document& document = context.document;
    const std::uint64_t mark = document.ledger.usedBytes() - context.buffers.heldBytes();
    try {
        return decoded(context, index);
    } catch (const MemoryRefused&) {
        throw;
    } catch (const InputError& error) {
        if (document.ledger.importOptions().isStrict) throw;
        context.unreadableBytes += document.ledger.usedBytes() - context.buffers.heldBytes() - mark;
        if (context.unreadableBytes > kMostUnreadableBytes)
            document.fail(fmt::format("/images/{}", index),
                          "the pictures up to here that cannot be read took {} of memory, and {} at most "
                          "are spent on them; mend the model's pictures, or take them out",
                          sizeText(context.unreadableBytes), sizeText(kMostUnreadableBytes));
        document.ledger.settle(mark, context.buffers.heldBytes());
        const std::string text = error.what(), file = document.file + ": "; // warn() adds this itself
        context.warn(text.substr(text.starts_with(file) ? file.size() : 0) + instead);
        return std::nullopt;
    }
}

unsigned Materials::neededSets(const ShownMaterial& shown) const {
    if (shown.index < 0) return 0;
    const StoredMaterial& stored = context_.document.materials[std::size_t(shown.index)];
    unsigned needed = 0;
    const auto add = [&](const TextureInfo& info) {
        if (info.texture != kNone) needed |= bitOf(info.texCoordSet);
    };
    for (std::size_t i = 0; i < stored.textures.size(); ++i) {
        const TextureSlot slot = kTexturePlaces[i].slot;
        const bool isShown = shown.shading == Shading::Unlit ? slot == TextureSlot::BaseColor
                                                             : shown.shading == Shading::AsStated || !isNormalMap(slot);
        if (isShown) add(stored.textures[i]);
    }
    if (stored.specularGlossiness) {
        add(stored.specularGlossiness->diffuseTexture);
        add(stored.specularGlossiness->specularGlossinessTexture);
    }
    return needed;
}

ShownMaterial Materials::shownBy(const tiny::Primitive& primitive, Mesh& mesh) const {
    ShownMaterial shown{primitive.material, shadingOf(primitive), bitOf(kTexCoordSets)};
    for (int set = 0; set < kTexCoordSets; ++set)
        if (mesh.texCoords[std::size_t(set)].empty()) shown.lostSets |= bitOf(set);
    const ShownMaterial ofVariant{context_.variantMaterial(primitive).value_or(kNone), shown.shading};
    const unsigned needed = neededSets(shown) | neededSets(ofVariant);
    for (int set = 0; set < kTexCoordSets; ++set) {
        // Stand-ins of sets that are not supported take set 0.
        const unsigned shownSets = set == 0 ? bitOf(0) | bitOf(kTexCoordSets) : bitOf(set);
        if ((needed & shownSets) == 0 || !mesh.texCoords[std::size_t(set)].empty()) continue;
        context_.document.ledger.charge(mesh.positionsOS.size() * sizeof(glm::vec2), [&] { return mesh.name; });
        mesh.texCoords[std::size_t(set)] = boxCoordinates(mesh);
    }
    return shown;
}

ShownMaterial Materials::distinct(ShownMaterial shown) const {
    shown.lostSets &= neededSets(shown);
    const ShownMaterial asStated{shown.index, Shading::AsStated, shown.lostSets};
    if (shown.shading == Shading::AsStated) return asStated;
    if (shown.index < 0) return shown.shading == Shading::Unlit ? shown : asStated;
    const StoredMaterial& stored = context_.document.materials[std::size_t(shown.index)];
    if (stored.surface.model == MaterialModel::SingleColor) return asStated;
    const auto hasTexture = [&](TextureSlot slot) { return storedTexture(stored, slot).texture != kNone; };
    const bool hasNormalMap = hasTexture(TextureSlot::Normal) || hasTexture(TextureSlot::ClearcoatNormal);
    return shown.shading == Shading::Unlit || hasNormalMap ? shown : asStated;
}

int Materials::material(ShownMaterial requested) {
    const ShownMaterial shown = distinct(requested);
    if (const auto found = materials_.find(shown); found != materials_.end()) return found->second;
    Material material;
    if (shown.index >= 0) {
        material = convert(shown);
    } else {
        material.name = "default";
        material.name += suffixOf(shown);
        if (shown.shading == Shading::Unlit) material = unlitOf(material);
    }
    context_.scene.materials.push_back(std::move(material));
    return materials_[shown] = int(context_.scene.materials.size()) - 1;
}

Material Materials::convert(ShownMaterial shown) {
    const int index = shown.index;
    const StoredMaterial& stored = context_.document.materials[std::size_t(index)];
    const std::string place = fmt::format("/materials/{}", index);
    const std::string suffix = suffixOf(shown);
    constexpr std::size_t kCopies = 2; // while a vector grows
    context_.document.charge(kCopies * (sizeof(Material) + stored.surface.name.size() + suffix.size()), "materials",
                             index);
    Material material = shown.shading == Shading::Unlit ? unlitOf(stored.surface) : stored.surface;
    material.name = nameOr(material.name, "material", index);
    material.name += suffix;
    const bool isUnlit = material.model == MaterialModel::SingleColor;
    for (std::size_t i = 0; i < stored.textures.size(); ++i) {
        const auto& [path, slot] = kTexturePlaces[i];
        if (isUnlit && slot != TextureSlot::BaseColor) continue;
        if (shown.shading == Shading::WithoutNormalMaps && isNormalMap(slot)) continue;
        const bool isReplaced = slot == TextureSlot::BaseColor || slot == TextureSlot::MetallicRoughness ||
                                slot == TextureSlot::SpecularColor || slot == TextureSlot::SpecularFactor;
        if (stored.specularGlossiness && isReplaced) continue;
        material.texture(slot) = use(stored.textures[i], slot, fmt::format("{}/{}", place, path), shown.lostSets);
    }
    const std::string glossyPlace = place + "/extensions/KHR_materials_pbrSpecularGlossiness";
    if (isUnlit) {
        if (stored.specularGlossiness) takeDiffuse(*stored.specularGlossiness, glossyPlace, shown.lostSets, material);
        if (shown.shading == Shading::Unlit) addEmission(stored, place, material);
        return material;
    }
    if (material.ior != 0.0f && material.ior < 1.0f) {
        context_.document.repair(place + "/extensions/KHR_materials_ior/ior", "1 is taken",
                                 "is {}; it must be 0 or at least 1", material.ior);
        material.ior = 1.0f;
    }
    if (stored.specularGlossiness)
        convertSpecularGlossiness(*stored.specularGlossiness, glossyPlace, shown.lostSets, material);
    return material;
}

void Materials::addEmission(const StoredMaterial& stored, const std::string& place, Material& material) {
    const glm::vec3& emissive = stored.surface.emissive;
    if (emissive == glm::vec3(0.0f)) return;
    const bool hasTexture = storedTexture(stored, TextureSlot::Emissive).texture != kNone ||
                            material.texture(TextureSlot::BaseColor).image != kNone;
    if (hasTexture)
        return context_.warn(place + ": its emission is left out at points and lines without normals, since it or the "
                                     "base colour has a texture");
    const float most = float(fieldOf(kMaterialFields, &Material::baseColor).most);
    material.baseColor = glm::vec4(glm::min(glm::vec3(material.baseColor) + emissive, most), material.baseColor.a);
}

void Materials::takeDiffuse(const SpecularGlossiness& stored, const std::string& place, unsigned lostSets,
                            Material& material) {
    material.baseColor = stored.diffuse;
    material.texture(TextureSlot::BaseColor) =
        use(stored.diffuseTexture, TextureSlot::BaseColor, place + "/diffuseTexture", lostSets);
}

/// Converts to a dielectric with an index of refraction of 0, which reflects all light, tinted by the extension's
/// specular colour. In both models that is F0, F90 is 1, and the diffuse part loses the reflected one.
/// Source: KHR_materials_ior, "Implementation": its mode for specular-glossiness materials.
void Materials::convertSpecularGlossiness(const SpecularGlossiness& stored, const std::string& place, unsigned lostSets,
                                          Material& material) {
    constexpr const char* kNote = "materials of specular and glossiness (KHR_materials_pbrSpecularGlossiness) are "
                                  "converted to dielectrics of roughness 1 - glossiness, tinted as their specular";
    std::vector<std::string>& notes = context_.scene.notes;
    if (std::ranges::find(notes, kNote) == notes.end()) notes.emplace_back(kNote);
    takeDiffuse(stored, place, lostSets, material);
    material.ior = 0.0f;
    material.metallic = 0.0f;
    material.specularFactor = 1.0f;
    material.specularColor = stored.specular;
    material.perceptualRoughness = 1.0f - stored.glossiness;
    const TextureUse both = use(stored.specularGlossinessTexture, TextureSlot::SpecularColor,
                                place + "/specularGlossinessTexture", lostSets);
    material.texture(TextureSlot::SpecularColor) = both;
    if (both.image == kNone || both.image == standIn_) return;
    material.perceptualRoughness = 1.0f;
    TextureUse& roughness = material.texture(TextureSlot::MetallicRoughness) = both;
    roughness.image = roughnessOf(both.image, stored.glossiness);
}

int Materials::roughnessOf(int image, float glossiness) {
    const auto [entry, isNew] = roughness_.try_emplace({image, glossiness}, kNone);
    if (!isNew) return entry->second;
    std::vector<Image>& images = context_.scene.images;
    const Image& alpha = images[std::size_t(image)];
    context_.document.ledger.charge(alpha.texels.size(), [&] {
        return fmt::format("{}: the roughness of '{}'", context_.document.file, alpha.name);
    });
    const ChannelSource roughness{&alpha, 3, -double(glossiness), 1.0};
    Image packed = packChannels(alpha.name + " as roughness", {ChannelSource{}, roughness, ChannelSource{}, {}});
    images.push_back(std::move(packed));
    return entry->second = int(images.size()) - 1;
}

std::vector<int> Materials::imported(int index) const {
    std::vector<int> found;
    for (auto at = materials_.lower_bound({index}); at != materials_.end() && at->first.index == index; ++at)
        found.push_back(at->second);
    return found;
}

TextureUse Materials::use(const TextureInfo& info, TextureSlot slot, const std::string& place, unsigned lostSets) {
    if (info.texture == kNone) return {};
    if (lostSets & bitOf(info.texCoordSet)) {
        context_.repair(
            place, kStandInText, "{}",
            info.texCoordSet < kTexCoordSets
                ? fmt::format("needs TEXCOORD_{}, which a mesh lacks", info.texCoordSet)
                : fmt::format("uses texture coordinate set {}; only 0 and 1 are supported", info.texCoordSet));
        if (!usesStandIn(slot)) return {};
        return {standIn(), {}, info.texCoordSet < kTexCoordSets ? info.texCoordSet : 0, {}};
    }
    const tiny::Model& model = context_.document.model;
    const tiny::Texture& texture = elementAt(model.textures, info.texture);
    const int webp = integerOf(valueAt(texture.extensions, "EXT_texture_webp/source")); // preferred
    int picture = kNone;
    if (webp != kNone)
        picture = image(webp, texture.source == kNone ? kStandInText : "; the texture's other picture is used instead");
    if (picture == kNone && texture.source != kNone) picture = image(texture.source, kStandInText);
    if (texture.source == kNone && webp == kNone)
        context_.repair(fmt::format("/textures/{}", info.texture), kStandInText, "{}",
                        std::ranges::count(model.extensionsUsed, "KHR_texture_basisu") > 0
                            ? "has a source in KTX2 alone; 'ktx extract --transcode rgba8 IN.ktx2 OUT.png' of "
                              "KTX-Software makes it one in PNG"
                            : "has no source in a supported format; store it as PNG or JPEG");
    if (picture == kNone && !usesStandIn(slot)) return {};
    TextureUse use{picture == kNone ? standIn() : picture, {}, info.texCoordSet, info.transform};
    if (texture.sampler != kNone) use.sampler = samplerOf(elementAt(model.samplers, texture.sampler));
    return use;
}

int Materials::image(int index, const char* instead) {
    const auto [entry, isNew] = images_.try_emplace(index, kNone);
    if (!isNew) return entry->second;
    std::optional<Image> readable = readableImage(context_, index, instead);
    if (!readable) return kNone;
    context_.scene.images.push_back(std::move(*readable));
    return entry->second = int(context_.scene.images.size()) - 1;
}

int Materials::standIn() {
    if (standIn_ == kNone) {
        const std::string& file = context_.document.file;
        context_.scene.images.push_back(standInPicture(context_.document.ledger, file + ": a stand-in"));
        standIn_ = int(context_.scene.images.size()) - 1;
    }
    return standIn_;
}

// ---- Variants -------------------------------------------------------------------------------------------------------

void importVariant(Context& context, Materials& materials) {
    const std::optional<std::string>& requested = context.document.ledger.importOptions().variant;
    std::vector<std::string>& names = context.scene.variants;
    std::unordered_set<std::string_view> known;
    const tiny::Value* const variants = valueAt(context.document.model.extensions, "KHR_materials_variants/variants");
    for (const tiny::Value& variant : elementsOf(variants)) {
        const std::string& name = variant.Get("name").Get<std::string>();
        if (name.empty() || !known.insert(name).second) continue;
        context.document.charge(2 * (sizeof(std::string) + name.size()), "its variants");
        names.push_back(name);
    }
    if (names.empty()) return;
    constexpr std::size_t kMostNamed = 20;
    const std::span<const std::string> named = std::span(names).first(std::min(names.size(), kMostNamed));
    context.scene.notes.push_back(fmt::format("{}; its variants are {}{}",
                                              requested && known.contains(*requested)
                                                  ? fmt::format("shows the variant '{}'", *requested)
                                                  : "shows its materials as they are without a variant",
                                              fmt::join(named, ", "), named.size() < names.size() ? ", ..." : ""));
    for (const auto& [sceneMesh, shown] : context.variantMaterials) materials.material(shown);
}

void bindVariant(Context& context, Materials& materials) {
    if (context.variantMaterials.empty()) return;
    for (Node& node : context.scene.nodes)
        for (MeshInstance& instance : node.instances) {
            const auto found = context.variantMaterials.find(instance.mesh);
            if (found != context.variantMaterials.end()) instance.material = materials.material(found->second);
        }
}

} // namespace tessera::scenes::gltf
