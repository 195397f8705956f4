#include "scenes/import/GltfRig.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>

#include <fmt/format.h>

namespace tessera::scenes::gltf {
namespace {

constexpr std::string_view kNodesPointer = "/nodes/";
constexpr std::string_view kMaterialsPointer = "/materials/";
constexpr std::string_view kLightsPointer = "/extensions/KHR_lights_punctual/lights/";
constexpr std::string_view kCamerasPointer = "/cameras/";
constexpr std::string_view kArrays[] = {kNodesPointer, kMaterialsPointer, kLightsPointer, kCamerasPointer};

/// Cuts "/nodes/" and a number from the begin of "/nodes/3/translation", and the slash after.
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

/// A pointer to what a channel changes, the same for all channels that change the same thing of the document.
std::string changedBy(const model::AnimationChannel& channel) {
    if (channel.path != "pointer") return fmt::format("{}{}/{}", kNodesPointer, channel.node, channel.path);
    for (const std::string_view array : kArrays) {
        std::string_view path = channel.pointer;
        if (const auto index = cutIndex(path, array)) return fmt::format("{}{}/{}", array, *index, path);
    }
    return channel.pointer;
}

/// A pointer without its numbers, which is the same for all things of a kind: "/cameras/*/orthographic/xmag".
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

/// Channels that change one thing of the document, of which the last counts; the specification forbids others.
struct Rivals {
    std::size_t last = 0;
    std::size_t count = 0;
};

const AnimatedPropertyInfo* propertyAt(std::string_view path, auto isOwner) {
    const auto rows = animatedProperties();
    const auto found = std::ranges::find_if(
        rows, [&](const AnimatedPropertyInfo& row) { return row.path == path && isOwner(row.owner); });
    return found == rows.end() ? nullptr : &*found;
}

const AnimatedPropertyInfo* propertyOf(AnimatedOwner owner, std::string_view path) {
    return propertyAt(path, [&](AnimatedOwner of) { return of == owner; });
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

Rigging::Rigging(Context& context, Materials& materials, std::vector<int> sceneNodes)
    : context_(context), materials_(materials), sceneNodes_(std::move(sceneNodes)),
      hasAnimatedWeights_(sceneNodes_.size()) {
    for (const model::Animation& animation : context.document.model.animations)
        for (const model::AnimationChannel& channel : animation.channels) {
            std::string_view pointer = channel.pointer;
            if (channel.path == "weights" && channel.node != kNone)
                hasAnimatedWeights_[static_cast<std::size_t>(channel.node)] = true;
            else if (const auto node = cutIndex(pointer, kNodesPointer);
                     node && *node < hasAnimatedWeights_.size() && pointer == "weights")
                hasAnimatedWeights_[*node] = true;
        }
}

int Rigging::restNode(int index) {
    Rig& rig = context_.scene.rig;
    const auto [entry, isNew] = nodes_.try_emplace(index, static_cast<int>(rig.nodes.size()));
    if (isNew) {
        const model::Node& node = context_.document.model.nodes[static_cast<std::size_t>(index)];
        context_.document.charge(2 * sizeof(RestNode), "nodes", index);
        rig.nodes.push_back(
            {sceneNodes_[static_cast<std::size_t>(index)], node.translation, node.rotation, node.scale});
    }
    return entry->second;
}

int Rigging::restNumber(AnimatedProperty property, int element, TextureSlot slot) {
    std::vector<RestNumber>& numbers = context_.scene.rig.numbers;
    const auto [entry, isNew] = numbers_.try_emplace({property, element, slot}, static_cast<int>(numbers.size()));
    if (isNew) numbers.push_back({property, element, glm::dvec4(0.0), slot});
    return entry->second;
}

std::optional<Rigging::Animated> Rigging::animatedOfNode(int index, std::string_view path) {
    const AnimatedPropertyInfo* const info = propertyAt(
        path, [](AnimatedOwner owner) { return owner == AnimatedOwner::Node || owner == AnimatedOwner::Weights; });
    if (info == nullptr) return {};
    Animated animated{info->property, {}, static_cast<std::size_t>(info->width)};
    if (sceneNodes_[static_cast<std::size_t>(index)] == kNone) return animated; // nothing of the scene moves
    if (info->owner == AnimatedOwner::Weights) {
        const auto rest = weights_.find(index);
        if (rest == weights_.end()) return {};
        animated.targets.push_back(rest->second);
        animated.width = context_.scene.rig.weights[static_cast<std::size_t>(rest->second)].weights.size();
        return animated;
    }
    if (context_.document.model.nodes[static_cast<std::size_t>(index)].matrix) return {}; // has no parts to change
    animated.targets.push_back(restNode(index));
    return animated;
}

std::optional<Rigging::Animated> Rigging::animatedOfLight(std::size_t index, std::string_view path) {
    const AnimatedPropertyInfo* const info = propertyOf(AnimatedOwner::Light, path);
    const std::vector<model::Light>& lights = context_.document.model.lights;
    if (info == nullptr || index >= lights.size()) return {};
    Animated animated{info->property, {}, static_cast<std::size_t>(info->width)};
    if (info->property == AnimatedProperty::LightIntensity) animated.scale = lights[index].wattsPerUnit;
    for (const int light : lights_[static_cast<int>(index)])
        animated.targets.push_back(restNumber(info->property, light));
    return animated;
}

std::optional<Rigging::Animated> Rigging::animatedOfMaterial(std::size_t index, std::string_view path) {
    const std::vector<model::Material>& materials = context_.document.model.materials;
    if (index >= materials.size()) return {};
    const AnimatedPropertyInfo* const info = propertyOf(AnimatedOwner::Material, path);
    if (info == nullptr) return animatedOfTexture(index, path);
    Animated animated{info->property, {}, static_cast<std::size_t>(info->width)};
    const model::Material& stored = materials[index];
    const bool isOfEmission =
        info->property == AnimatedProperty::Emissive || info->property == AnimatedProperty::EmissiveStrength;
    const bool isUnlit = stored.surface.model == MaterialModel::SingleColor;
    const bool isOfUnlit =
        info->property == AnimatedProperty::BaseColor || info->property == AnimatedProperty::AlphaCutoff;
    // What other programs make of a material changes nothing here.
    if (isUnlit && !isOfUnlit) return animated;
    if (stored.specularGlossiness && isReplacedBySpecularGlossiness(info->property)) return animated;
    animated.emissiveFactor = stored.emissiveFactor;
    if (const std::optional<int> material = materials_.imported(static_cast<int>(index)))
        animated.targets.push_back(restNumber(isOfEmission ? AnimatedProperty::Emissive : info->property, *material));
    return animated;
}

/// None where the document has no texture there, whose transform would change nothing.
std::optional<Rigging::Animated> Rigging::animatedOfTexture(std::size_t index, std::string_view path) {
    const model::Material& stored = context_.document.model.materials[index];
    for (std::size_t i = 0; i < stored.textures.size(); ++i) {
        const auto& [place, slot] = model::kTexturePlaces[i];
        if (!path.starts_with(place) || path.size() == place.size() || path[place.size()] != '/') continue;
        const AnimatedPropertyInfo* const info = propertyOf(AnimatedOwner::Texture, path.substr(place.size() + 1));
        if (info == nullptr || stored.textures[i].texture == kNone) return {};
        Animated animated{info->property, {}, static_cast<std::size_t>(info->width)};
        if (stored.specularGlossiness && isOfSpecularGlossiness(slot)) return animated; // has another texture there
        const std::optional<int> material = materials_.imported(static_cast<int>(index));
        if (material && context_.scene.materials[static_cast<std::size_t>(*material)].texture(slot).image != kNone)
            animated.targets.push_back(restNumber(info->property, *material, slot));
        return animated;
    }
    return {};
}

std::optional<Rigging::Animated> Rigging::animatedOfCamera(std::size_t index, std::string_view path) {
    const AnimatedPropertyInfo* const info = propertyOf(AnimatedOwner::Camera, path);
    const std::vector<model::Camera>& cameras = context_.document.model.cameras;
    if (info == nullptr || index >= cameras.size()) return {};
    const bool isPerspective = cameras[index].projection == Projection::Perspective;
    if (info->path.starts_with("perspective/") != isPerspective) return {};
    Animated animated{info->property, {}, static_cast<std::size_t>(info->width)};
    const bool isUpsideDown =
        info->property == AnimatedProperty::CameraHalfHeight && cameras[index].orthographic.ymag < 0;
    if (isUpsideDown) animated.scale = -1.0; // its size counts, as where it is imported
    for (const int camera : cameras_[static_cast<int>(index)])
        animated.targets.push_back(restNumber(info->property, camera));
    return animated;
}

std::optional<Rigging::Animated> Rigging::animatedByPointer(const std::string& pointer) {
    std::string_view path = pointer;
    if (const auto node = cutIndex(path, kNodesPointer))
        return *node < sceneNodes_.size() ? animatedOfNode(static_cast<int>(*node), path) : std::nullopt;
    if (const auto light = cutIndex(path, kLightsPointer)) return animatedOfLight(*light, path);
    if (const auto material = cutIndex(path, kMaterialsPointer)) return animatedOfMaterial(*material, path);
    if (const auto camera = cutIndex(path, kCamerasPointer)) return animatedOfCamera(*camera, path);
    return {};
}

/// None where the scene has no such thing that can change.
std::optional<Rigging::Animated> Rigging::animated(const model::AnimationChannel& channel) {
    if (channel.path == "pointer") return animatedByPointer(channel.pointer);
    return channel.node == kNone ? std::nullopt : animatedOfNode(channel.node, channel.path);
}

std::optional<int> Rigging::morphlessNode(const model::AnimationChannel& channel) const {
    std::string_view path = channel.pointer;
    std::optional<std::size_t> node = cutIndex(path, kNodesPointer);
    if (channel.path != "pointer") {
        path = channel.path;
        node = channel.node == kNone ? std::nullopt : std::optional(static_cast<std::size_t>(channel.node));
    }
    if (!node || *node >= sceneNodes_.size() || path != "weights") return {};
    const int index = static_cast<int>(*node);
    const bool hasTargets = context_.document.model.nodes[*node].mesh != kNone && !restWeights(index).empty();
    return hasTargets ? std::nullopt : std::optional(index);
}

void Rigging::warnOfMorphless() {
    if (morphless_.empty()) return;
    const model::Model& model = context_.document.model;
    const int first = *morphless_.begin();
    const model::Node& node = model.nodes[static_cast<std::size_t>(first)];
    const auto named = [](const char* kind, const std::string& name, int index) {
        return name.empty() ? fmt::format("{} {}", kind, index) : fmt::format("{} '{}'", kind, name);
    };
    std::string which = named("node", node.name, first);
    if (const std::size_t others = morphless_.size() - 1; others > 0)
        which += fmt::format(" and {} other node{}", others, others == 1 ? "" : "s");
    std::string why = "it has no mesh";
    if (node.mesh != kNone)
        why = fmt::format("its {} has no morph targets",
                          named("mesh", model.meshes[static_cast<std::size_t>(node.mesh)].name, node.mesh));
    context_.warn(fmt::format("/animations: weights of {} are animated, but {}; they are left out", which, why));
}

void Rigging::leaveOut(const std::string& pointer, std::size_t channels) {
    constexpr std::size_t kMostNamed = 16;
    leftOut_ += channels;
    std::string kind = kindOf(pointer);
    if (leftOutPaths_.contains(kind)) return;
    if (leftOutPaths_.size() < kMostNamed)
        leftOutPaths_.emplace(std::move(kind), pointer);
    else
        hasMoreLeftOut_ = true;
}

void Rigging::warnOfLeftOut() {
    if (leftOut_ == 0) return;
    std::vector<std::string_view> paths;
    for (const auto& [kind, path] : leftOutPaths_) paths.push_back(path);
    if (hasMoreLeftOut_) paths.push_back("and others");
    context_.warn(fmt::format("/animations: {} {} that cannot be animated, and {} left out: {}", leftOut_,
                              leftOut_ == 1 ? "channel changes something" : "channels change things",
                              leftOut_ == 1 ? "is" : "are", fmt::join(paths, ", ")));
}

AnimationSampler Rigging::sampler(int animation, int index, const Animated& animated) {
    const Document& document = context_.document;
    const model::AnimationSampler& stored =
        document.model.animations[static_cast<std::size_t>(animation)].samplers[static_cast<std::size_t>(index)];
    const std::string place = fmt::format("/animations/{}/samplers/{}", animation, index);
    AnimationSampler sampler;
    sampler.interpolation = stored.interpolation;
    sampler.width = static_cast<int>(animated.width);

    Elements times = context_.accessors.elements(stored.input);
    const auto failTimes = [&](const std::string& what) {
        document.fail(place + "/input", fmt::format("accessor {} {}", stored.input, what));
    };
    if (times.components != 1 || times.componentType != model::ComponentType::Float)
        failTimes("holds key times, so it must be SCALAR of FLOAT");
    for (std::size_t key = 0; key < times.count; ++key) {
        if (!std::isfinite(times.values[key]))
            failTimes(fmt::format("has key {} at {} s; key times must be finite", key, times.values[key]));
        if (key > 0 && !(times.values[key] > times.values[key - 1]))
            failTimes(fmt::format("has key {} at {} s and key {} at {} s; key times must ascend", key - 1,
                                  times.values[key - 1], key, times.values[key]));
    }
    sampler.timesSeconds = std::move(times.values);

    Elements values = context_.accessors.elements(stored.output);
    const auto failValues = [&](const std::string& what) {
        document.fail(place + "/output", fmt::format("accessor {} {}", stored.output, what));
    };
    const AnimatedPropertyInfo& info = infoOf(animated.property);
    const bool isOneByOne = info.owner == AnimatedOwner::Weights;
    const int components = isOneByOne ? 1 : info.width;
    if (values.components != components)
        failValues(fmt::format("has {} components an element; {} needs {}", values.components, info.path, components));
    if (values.componentType != model::ComponentType::Float && !values.normalized)
        failValues("holds integers that are not normalized");
    const std::size_t needed =
        sampler.timesSeconds.size() * sampler.valuesPerKey() * (isOneByOne ? animated.width : std::size_t{1});
    if (values.count != needed)
        failValues(fmt::format("has {} elements, but {} keys of {} need {}", values.count, sampler.timesSeconds.size(),
                               info.path, needed));
    for (std::size_t i = 0; i < values.values.size(); ++i)
        if (!std::isfinite(values.values[i]))
            failValues(fmt::format("holds {} in element {}; every value must be finite", values.values[i],
                                   i / static_cast<std::size_t>(components)));
    sampler.values = std::move(values.values);
    if (animated.scale != 1.0)
        for (float& value : sampler.values) value = static_cast<float>(value * animated.scale);
    if (animated.property == AnimatedProperty::Rotation)
        for (std::size_t key = 0; key < sampler.timesSeconds.size(); ++key) {
            const std::size_t first =
                (key * sampler.valuesPerKey() + (sampler.valuesPerKey() > 1 ? 1 : 0)) * animated.width;
            const auto numbers = std::span(sampler.values).subspan(first, animated.width);
            if (std::ranges::all_of(numbers, [](float number) { return number == 0.0f; }))
                failValues(fmt::format("has the zero quaternion at key {}, which is no rotation", key));
        }
    return sampler;
}

Clip Rigging::clip(int index) {
    const Document& document = context_.document;
    const model::Animation& stored = document.model.animations[static_cast<std::size_t>(index)];
    const std::uint64_t mark = document.ledger.usedBytes() - context_.buffers.heldBytes();
    Clip clip;
    clip.name = nameOr(stored.name, "animation", index);
    std::map<std::pair<int, double>, int> samplers; // of the clip, by those of the document and their scale
    std::map<std::pair<AnimatedProperty, int>, std::size_t> channels; // of the clip, by what they change
    constexpr std::size_t kEntryBytes = 96;                           // of a map
    std::vector<Rivals> counting;                                     // by what they change, in document order
    std::map<std::string, std::size_t> places;                        // in it
    for (std::size_t i = 0; i < stored.channels.size(); ++i) {
        std::string changed = changedBy(stored.channels[i]);
        auto place = places.find(changed);
        if (place == places.end()) {
            document.charge(kEntryBytes + changed.size() + 2 * sizeof(Rivals), "animations", index);
            place = places.emplace(std::move(changed), counting.size()).first;
            counting.emplace_back();
        }
        Rivals& rivals = counting[place->second];
        rivals.last = i;
        ++rivals.count;
    }
    // What one thing of the document is in the scene may be much, such as all lights that it stands for.
    for (const auto& [i, count] : counting) {
        const model::AnimationChannel& channel = stored.channels[i];
        std::optional<Animated> what = animated(channel);
        if (const std::optional<int> node = morphlessNode(channel); !what && node) {
            morphless_.insert(*node);
            continue;
        }
        if (!what) {
            leaveOut(channel.pointer.empty() ? channel.path : channel.pointer, count);
            continue;
        }
        if (what->targets.empty()) continue;
        const bool isStrength = what->property == AnimatedProperty::EmissiveStrength;
        if (what->property == AnimatedProperty::Emissive) {
            std::string_view path = channel.pointer;
            const std::size_t material = cutIndex(path, kMaterialsPointer).value_or(0);
            const std::string strength =
                fmt::format("{}{}/{}", kMaterialsPointer, material, infoOf(AnimatedProperty::EmissiveStrength).path);
            if (!places.contains(strength)) what->scale = double(document.model.materials[material].emissiveStrength);
        }
        document.charge(what->targets.size() * (2 * sizeof(AnimationChannel) + kEntryBytes) + sizeof(AnimationSampler),
                        "animations", index);
        const auto [entry, isNew] =
            samplers.try_emplace({channel.sampler, what->scale}, static_cast<int>(clip.samplers.size()));
        if (isNew) clip.samplers.push_back(sampler(index, channel.sampler, *what));
        if (static_cast<std::size_t>(clip.samplers[static_cast<std::size_t>(entry->second)].width) != what->width)
            document.fail(
                fmt::format("/animations/{}/channels/{}", index, i),
                fmt::format("takes values of {} numbers from sampler {}, which another channel takes as of {}",
                            what->width, channel.sampler,
                            clip.samplers[static_cast<std::size_t>(entry->second)].width));
        // Things of the document may be one of the scene's.
        for (const int target : what->targets) {
            const AnimatedProperty changes = isStrength ? AnimatedProperty::Emissive : what->property;
            const auto [same, isFirst] = channels.try_emplace({changes, target}, clip.channels.size());
            if (isFirst && isStrength) { // of a factor that stays as it is, unless another channel changes it too
                document.charge(2 * sizeof(AnimationSampler) + 4 * sizeof(float), "animations", index);
                const glm::vec3& factor = what->emissiveFactor;
                clip.channels.push_back({changes, target, static_cast<int>(clip.samplers.size())});
                clip.samplers.push_back({Interpolation::Linear, 3, {0.0f}, {factor.x, factor.y, factor.z}});
            } else if (isFirst) {
                clip.channels.push_back({changes, target, entry->second});
            }
            AnimationChannel& made = clip.channels[same->second];
            (isStrength ? made.factor : made.sampler) = entry->second;
        }
    }
    document.ledger.settle(mark, context_.buffers.heldBytes() + bytesOf(clip));
    return clip;
}

} // namespace tessera::scenes::gltf
