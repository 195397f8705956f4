
#include <algorithm>
#include <charconv>
#include <iterator>

#include "scenes/import/GltfRig.h"

namespace tessera::scenes::gltf {
namespace {

constexpr std::string_view kArrays[] = {kNodesPointer, kMaterialsPointer, kLightsPointer, kCamerasPointer};

const AnimatedPropertyInfo* propertyOf(AnimatedOwner owner, std::string_view path) {
    for (const AnimatedPropertyInfo& row : animatedProperties())
        if (row.path == path && row.owner == owner) return &row;
    return nullptr;
}

/// KHR_materials_pbrSpecularGlossiness has others in the place of these (Materials::convertSpecularGlossiness).
bool isReplacedBySpecularGlossiness(AnimatedProperty property) {
    constexpr AnimatedProperty kReplaced[] = {AnimatedProperty::BaseColor,           AnimatedProperty::Metallic,
                                              AnimatedProperty::PerceptualRoughness, AnimatedProperty::Ior,
                                              AnimatedProperty::SpecularFactor,      AnimatedProperty::SpecularColor};
    return std::ranges::find(kReplaced, property) != std::end(kReplaced);
}
bool isOfSpecularGlossiness(TextureSlot slot) {
    constexpr TextureSlot kOwn[] = {TextureSlot::BaseColor, TextureSlot::MetallicRoughness, TextureSlot::SpecularColor,
                                    TextureSlot::SpecularFactor};
    return std::ranges::find(kOwn, slot) != std::end(kOwn);
}

} // namespace

std::optional<std::size_t> cutIndex(std::string_view& pointer, std::string_view array) {
    if (!pointer.starts_with(array)) return {};
    const char* const begin = pointer.data() + array.size();
    const char* const end = pointer.data() + pointer.size();
    std::size_t index = 0;
    const auto [rest, error] = std::from_chars(begin, end, index);
    if (error != std::errc() || rest == end || *rest != '/') return {};
    pointer = {rest + 1, end};
    return index;
}

std::string changedBy(const tiny::AnimationChannel& channel) {
    if (channel.target_path != "pointer")
        return fmt::format("{}{}/{}", kNodesPointer, channel.target_node, channel.target_path);
    std::string pointer = pointerOf(channel);
    for (const std::string_view array : kArrays) {
        std::string_view path = pointer;
        if (const auto index = cutIndex(path, array)) return fmt::format("{}{}/{}", array, *index, path);
    }
    return pointer;
}

std::optional<std::size_t> nodeOfWeights(const tiny::AnimationChannel& channel) {
    const std::string changed = changedBy(channel);
    std::string_view path = changed;
    const std::optional<std::size_t> node = cutIndex(path, kNodesPointer);
    return path == infoOf(AnimatedProperty::Weights).path ? node : std::nullopt;
}

std::string kindOf(std::string_view pointer) {
    std::string kind;
    for (std::size_t i = 0; i < pointer.size(); ++i) {
        const bool isDigit = pointer[i] >= '0' && pointer[i] <= '9';
        if (!isDigit || kind.empty() || kind.back() != '/') {
            kind += pointer[i];
            continue;
        }
        const std::size_t end = std::min(pointer.find('/', i), pointer.size());
        const std::string_view part = pointer.substr(i, end - i);
        kind += part.find_first_not_of("0123456789") == part.npos ? std::string_view("*") : part;
        i = end - 1;
    }
    return kind;
}

// ---- What they are in the scene ------------------------------------------------------------------------------------

std::optional<Rigging::Animated> Rigging::animatedOfNode(int index, std::string_view path) {
    const AnimatedPropertyInfo* info = propertyOf(AnimatedOwner::Node, path);
    if (info == nullptr) info = propertyOf(AnimatedOwner::Weights, path);
    if (info == nullptr) return {};
    Animated animated{info->property, std::size_t(info->width)};
    if (sceneNodes_[std::size_t(index)] == kNone) return animated; // nothing of the scene moves
    if (info->owner == AnimatedOwner::Weights) {
        const auto rest = weights_.find(index);
        if (rest == weights_.end()) return {};
        animated.targets.push_back(rest->second);
        animated.width = context_.scene.rig.weights[std::size_t(rest->second)].size();
        return animated;
    }
    if (!elementAt(context_.document.model.nodes, index).matrix.empty()) return {}; // has no parts to change
    animated.targets.push_back(restNode(index));
    return animated;
}

std::optional<Rigging::Animated> Rigging::animatedOfLight(std::size_t index, std::string_view path) {
    const AnimatedPropertyInfo* const info = propertyOf(AnimatedOwner::Light, path);
    const std::vector<double>& wattsPerUnit = context_.document.wattsPerUnit;
    if (info == nullptr || index >= wattsPerUnit.size()) return {};
    Animated animated{info->property, std::size_t(info->width)};
    if (info->property == AnimatedProperty::LightIntensity) animated.scale = wattsPerUnit[index];
    for (const int light : lights_[int(index)]) animated.targets.push_back(restNumber(info->property, light));
    return animated;
}

std::optional<Rigging::Animated> Rigging::animatedOfMaterial(std::size_t index, std::string_view path) {
    const std::vector<StoredMaterial>& materials = context_.document.materials;
    if (index >= materials.size()) return {};
    const AnimatedPropertyInfo* const info = propertyOf(AnimatedOwner::Material, path);
    if (info == nullptr) return animatedOfTexture(index, path);
    Animated animated{info->property, std::size_t(info->width)};
    const StoredMaterial& stored = materials[index];
    const bool isOfEmission =
        info->property == AnimatedProperty::Emissive || info->property == AnimatedProperty::EmissiveStrength;
    const bool isUnlit = stored.surface.model == MaterialModel::SingleColor;
    const bool isOfUnlit =
        info->property == AnimatedProperty::BaseColor || info->property == AnimatedProperty::AlphaCutoff;
    // What other programs make of a material changes nothing here.
    if (isUnlit && !isOfUnlit) return animated;
    if (stored.specularGlossiness && isReplacedBySpecularGlossiness(info->property)) return animated;
    animated.emissiveFactor = stored.emissiveFactor;
    if (info->property == AnimatedProperty::Thickness) {
        const auto scale = context_.thicknessScales.find(int(index));
        if (scale != context_.thicknessScales.end()) animated.scale = scale->second.value_or(1.0);
    }
    for (const int material : materials_.imported(int(index))) {
        const MaterialModel shown = context_.scene.materials[std::size_t(material)].model;
        if (shown == MaterialModel::SingleColor && !isOfUnlit) continue;
        const bool hasEmission =
            !isUnlit && shown == MaterialModel::SingleColor && stored.surface.emissive != glm::vec3(0.0f);
        if (hasEmission && info->property == AnimatedProperty::BaseColor) {
            context_.warn("/materials/{}: a clip of its base colour is left out at points and lines without "
                          "normals, whose colour has its emission too",
                          index);
            continue;
        }
        animated.targets.push_back(restNumber(isOfEmission ? AnimatedProperty::Emissive : info->property, material));
    }
    return animated;
}

/// None where the document has no texture there, whose transform would change nothing.
std::optional<Rigging::Animated> Rigging::animatedOfTexture(std::size_t index, std::string_view path) {
    const StoredMaterial& stored = context_.document.materials[index];
    for (std::size_t i = 0; i < stored.textures.size(); ++i) {
        const auto& [place, slot] = kTexturePlaces[i];
        if (!path.starts_with(place) || path.size() == place.size() || path[place.size()] != '/') continue;
        const AnimatedPropertyInfo* const info = propertyOf(AnimatedOwner::Texture, path.substr(place.size() + 1));
        if (info == nullptr || stored.textures[i].texture == kNone) return {};
        Animated animated{info->property, std::size_t(info->width)};
        if (stored.specularGlossiness && isOfSpecularGlossiness(slot)) return animated; // has another texture there
        for (const int material : materials_.imported(int(index)))
            if (context_.scene.materials[std::size_t(material)].texture(slot).image != kNone)
                animated.targets.push_back(restNumber(info->property, material, slot));
        return animated;
    }
    return {};
}

std::optional<Rigging::Animated> Rigging::animatedOfCamera(std::size_t index, std::string_view path) {
    const AnimatedPropertyInfo* const info = propertyOf(AnimatedOwner::Camera, path);
    const std::vector<tiny::Camera>& cameras = context_.document.model.cameras;
    if (info == nullptr || index >= cameras.size()) return {};
    const bool isPerspective = cameras[index].type == "perspective";
    if (info->path.starts_with("perspective/") != isPerspective) return {};
    Animated animated{info->property, std::size_t(info->width)};
    const bool isUpsideDown =
        info->property == AnimatedProperty::CameraHalfHeight && cameras[index].orthographic.ymag < 0;
    if (isUpsideDown) animated.scale = -1.0; // its size counts, as where it is imported
    for (const int camera : cameras_[int(index)]) animated.targets.push_back(restNumber(info->property, camera));
    return animated;
}

/// None where the scene has no such thing that can change.
std::optional<Rigging::Animated> Rigging::animated(const tiny::AnimationChannel& channel) {
    const std::string changed = changedBy(channel);
    std::string_view path = changed;
    if (const auto node = cutIndex(path, kNodesPointer))
        return *node < sceneNodes_.size() ? animatedOfNode(int(*node), path) : std::nullopt;
    if (const auto light = cutIndex(path, kLightsPointer)) return animatedOfLight(*light, path);
    if (const auto material = cutIndex(path, kMaterialsPointer)) return animatedOfMaterial(*material, path);
    if (const auto camera = cutIndex(path, kCamerasPointer)) return animatedOfCamera(*camera, path);
    return {};
}

} // namespace tessera::scenes::gltf
