#include "scenes/import/GltfRig.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

#include "scenes/import/GltfSteps.h"

namespace tessera::scenes::gltf {
namespace {

constexpr std::string_view kArrays[] = {kNodesPointer, kMaterialsPointer, kLightsPointer, kCamerasPointer};

const AnimatedPropertyInfo* propertyOf(AnimatedOwner owner, std::string_view path) {
    for (const AnimatedPropertyInfo& row : animatedProperties())
        if (row.path == path && row.owner == owner) return &row;
    return nullptr;
}

/// Whether KHR_materials_pbrSpecularGlossiness replaces the property (Materials::convertSpecularGlossiness).
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

/// Channels with the same target. The specification forbids more than one; the last one applies.
struct Rivals {
    std::size_t last = 0;
    std::size_t count = 0;
};

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

// ---- Targets in the scene ------------------------------------------------------------------------------------------

std::optional<Rigging::Animated> Rigging::animatedOfNode(int index, std::string_view path) {
    const AnimatedPropertyInfo* info = propertyOf(AnimatedOwner::Node, path);
    if (info == nullptr) info = propertyOf(AnimatedOwner::Weights, path);
    if (info == nullptr) return {};
    Animated animated{info->property, std::size_t(info->width)};
    if (sceneNodes_[std::size_t(index)] == kNone) return animated; // the node is not in the scene
    if (info->owner == AnimatedOwner::Weights) {
        const auto rest = weights_.find(index);
        if (rest == weights_.end()) return {};
        animated.targets.push_back(rest->second);
        animated.width = context_.scene.rig.weights[std::size_t(rest->second)].size();
        return animated;
    }
    if (!elementAt(context_.document.model.nodes, index).matrix.empty()) return {}; // has no TRS to change
    if (info->property == AnimatedProperty::NodeVisibility) return visibilityOf(index);
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
    const bool isUnlit = stored.surface.model == MaterialModel::SingleColor;
    const bool isOfUnlit =
        info->property == AnimatedProperty::BaseColor || info->property == AnimatedProperty::AlphaCutoff;
    // Fallback properties for other programs have no effect here.
    if (isUnlit && !isOfUnlit) return animated;
    if (stored.specularGlossiness && isReplacedBySpecularGlossiness(info->property)) return animated;
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
        const glm::vec3& emission = stored.emissiveFactor;
        if (info->property == AnimatedProperty::EmissiveStrength)
            animated.multiplied.push_back({AnimatedProperty::Emissive,
                                           restNumber(AnimatedProperty::Emissive, material),
                                           {emission.x, emission.y, emission.z}});
        else
            animated.targets.push_back(restNumber(info->property, material));
    }
    return animated;
}

/// Empty if the document has no texture there.
std::optional<Rigging::Animated> Rigging::animatedOfTexture(std::size_t index, std::string_view path) {
    const StoredMaterial& stored = context_.document.materials[index];
    for (std::size_t i = 0; i < stored.textures.size(); ++i) {
        const auto& [place, slot] = kTexturePlaces[i];
        if (!path.starts_with(place) || path.size() == place.size() || path[place.size()] != '/') continue;
        const AnimatedPropertyInfo* const info = propertyOf(AnimatedOwner::Texture, path.substr(place.size() + 1));
        if (info == nullptr || stored.textures[i].texture == kNone) return {};
        Animated animated{info->property, std::size_t(info->width)};
        if (stored.specularGlossiness && isOfSpecularGlossiness(slot)) return animated; // uses another texture there
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
    if (isUpsideDown) animated.scale = -1.0; // its magnitude counts, as on import
    for (const int camera : cameras_[int(index)]) animated.targets.push_back(restNumber(info->property, camera));
    return animated;
}

/// Empty if the scene cannot animate the channel's target.
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

int Rigging::restNode(int index) {
    Rig& rig = context_.scene.rig;
    const auto [entry, isNew] = nodes_.try_emplace(index, int(rig.nodes.size()));
    if (isNew) {
        const tiny::Node& node = elementAt(context_.document.model.nodes, index);
        context_.document.charge(2 * sizeof(RestNode), "nodes", index);
        const glm::dvec4 rotation = rotationOf(node);
        rig.nodes.push_back({sceneNodes_[std::size_t(index)], translationOf(node),
                             rotation == glm::dvec4(0.0) ? kNoRotation : rotation, scaleOf(node)});
    }
    return entry->second;
}

int Rigging::restNumber(AnimatedProperty property, int element, TextureSlot slot) {
    std::vector<RestNumber>& numbers = context_.scene.rig.numbers;
    const auto [entry, isNew] = numbers_.try_emplace({property, element, slot}, int(numbers.size()));
    if (isNew) numbers.push_back({property, element, glm::dvec4(0.0), slot});
    return entry->second;
}

std::optional<int> Rigging::nodeWithoutTargets(const tiny::AnimationChannel& channel) const {
    const std::optional<std::size_t> node = nodeOfWeights(channel);
    if (!node || *node >= sceneNodes_.size()) return {};
    const int mesh = context_.document.model.nodes[*node].mesh;
    const bool hasTargets = mesh != kNone && targetCounts_[std::size_t(mesh)] > 0;
    return hasTargets ? std::nullopt : std::optional(int(*node));
}

void Rigging::warnOfMorphless() {
    if (morphless_.empty()) return;
    const tiny::Model& model = context_.document.model;
    const int first = *morphless_.begin();
    const tiny::Node& node = elementAt(model.nodes, first);
    const auto named = [](const char* kind, const std::string& name, int index) {
        return name.empty() ? fmt::format("{} {}", kind, index) : fmt::format("{} '{}'", kind, name);
    };
    std::string which = named("node", node.name, first);
    if (const std::size_t others = morphless_.size() - 1; others > 0)
        which += fmt::format(" and {} other node{}", others, others == 1 ? "" : "s");
    std::string why = "it has no mesh";
    if (node.mesh != kNone)
        why = fmt::format("its {} has no morph targets",
                          named("mesh", elementAt(model.meshes, node.mesh).name, node.mesh));
    context_.warn("/animations: weights of {} are animated, but {}; they are left out", which, why);
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
    context_.warn("/animations: {} {} that cannot be animated, and {} left out: {}", leftOut_,
                  leftOut_ == 1 ? "channel changes something" : "channels change things", leftOut_ == 1 ? "is" : "are",
                  fmt::join(paths, ", "));
}

AnimationSampler Rigging::sampler(int animation, int index, const Animated& animated) {
    const Document& document = context_.document;
    const std::vector<tiny::AnimationSampler>& samplers = elementAt(document.model.animations, animation).samplers;
    const std::string place = fmt::format("/animations/{}/samplers/{}", animation, index);
    const tiny::AnimationSampler stored =
        std::size_t(index) < samplers.size() ? elementAt(samplers, index) : tiny::AnimationSampler();
    if (stored.input == kNone || stored.output == kNone) document.fail(place, "is not there, or left out");
    AnimationSampler sampler;
    const bool isWhole = animated.property == AnimatedProperty::NodeVisibility;
    if (isWhole)
        sampler.interpolation = Interpolation::Step;
    else if (stored.interpolation != "LINEAR")
        sampler.interpolation = stored.interpolation == "STEP" ? Interpolation::Step : Interpolation::CubicSpline;
    sampler.width = int(animated.width);

    Elements times = context_.accessors.elements(stored.input);
    const auto failTimes = [&](const std::string& what) {
        document.fail(place + "/input", "accessor {} {}", stored.input, what);
    };
    if (times.components != 1 || times.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
        failTimes("holds key times, so it must be SCALAR of FLOAT");
    float before = 0.0f; // stored time of the previous key
    for (std::size_t key = 0; key < times.count; ++key) {
        if (!std::isfinite(times.values[key]))
            failTimes(fmt::format("has key {} at {} s; key times must be finite", key, times.values[key]));
        const float time = times.values[key];
        if (key > 0 && !(time > times.values[key - 1])) {
            const std::string what =
                fmt::format("has key {} at {} s and key {} at {} s; key times must ascend", key - 1, before, key, time);
            if (time < before) failTimes(what);
            document.repair(place + "/input", "the clip jumps from one to the other", "{}", what);
            times.values[key] = std::nextafter(times.values[key - 1], std::numeric_limits<float>::infinity());
            if (!std::isfinite(times.values[key])) failTimes(what);
        }
        before = time;
    }
    sampler.timesSeconds = std::move(times.values);

    Elements values = context_.accessors.elements(stored.output);
    const auto failValues = [&](const std::string& what) {
        document.fail(place + "/output", "accessor {} {}", stored.output, what);
    };
    const AnimatedPropertyInfo& info = infoOf(animated.property);
    const bool isOneByOne = info.owner == AnimatedOwner::Weights;
    const int components = isOneByOne ? 1 : info.width;
    if (values.components != components)
        failValues(fmt::format("has {} components an element; {} needs {}", values.components, info.path, components));
    // Integers that are not normalized are plain numbers for pointers. Source: KHR_animation_pointer, "Output Accessor
    // Component Types".
    if (values.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT && !values.normalized && !ownsNumbers(info.owner) &&
        !isWhole)
        failValues("holds integers that are not normalized");
    const std::size_t each = sampler.valuesPerKey() * (isOneByOne ? animated.width : std::size_t{1});
    const std::size_t needed = sampler.timesSeconds.size() * each;
    if (values.count != needed) {
        const std::string what = fmt::format("has {} elements, but {} keys of {} need {}", values.count,
                                             sampler.timesSeconds.size(), info.path, needed);
        if (each == 0 || values.count < each) failValues(what);
        const std::size_t keys = std::min(values.count / each, sampler.timesSeconds.size());
        document.repair(place + "/output", "what has no partner is left out", "{}", what);
        sampler.timesSeconds.resize(keys);
        values.values.resize(keys * each * std::size_t(components));
    }
    for (std::size_t i = 0; i < values.values.size(); ++i)
        if (!std::isfinite(values.values[i]))
            failValues(fmt::format("holds {} in element {}; every value must be finite", values.values[i],
                                   i / std::size_t(components)));
    sampler.values = std::move(values.values);
    constexpr double kMost = std::numeric_limits<float>::max();
    if (animated.scale != 1.0)
        for (float& value : sampler.values) value = float(std::clamp(value * animated.scale, -kMost, kMost));
    if (isWhole)
        for (float& value : sampler.values) value = value != 0.0f ? 1.0f : 0.0f;
    if (animated.property == AnimatedProperty::Rotation)
        for (std::size_t key = 0; key < sampler.timesSeconds.size(); ++key) {
            const std::size_t first =
                (key * sampler.valuesPerKey() + (sampler.valuesPerKey() > 1 ? 1 : 0)) * animated.width;
            const auto numbers = std::span(sampler.values).subspan(first, animated.width);
            if (std::ranges::any_of(numbers, [](float number) { return number != 0.0f; })) continue;
            document.repair(place + "/output", kNotRotated, "key {} {}", key, kZeroQuaternion);
            numbers.back() = 1.0f;
        }
    return sampler;
}

Clip Rigging::clip(int index) {
    const Document& document = context_.document;
    const tiny::Animation& stored = elementAt(document.model.animations, index);
    const auto used = [&] { return document.ledger.usedBytes() - context_.buffers.heldBytes(); };
    std::uint64_t mark = used();
    Clip clip;
    clip.name = nameOr(stored.name, "animation", index);
    std::map<std::pair<int, double>, int> samplers; // sampler of the clip, by that of the document and scale
    std::map<std::pair<AnimatedProperty, int>, std::size_t> channels; // channel of the clip, by target
    std::set<std::array<int, 4>> failed;                              // samplers that could not be read
    constexpr std::size_t kEntryBytes = 96;                           // per map entry
    std::vector<Rivals> counting;                                     // by target, in document order
    std::map<std::string, std::size_t> places;                        // in `counting`
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
    // One target in the document can be many in the scene, such as all instances of a light.
    for (const auto& [i, count] : counting) {
        const tiny::AnimationChannel& channel = stored.channels[i];
        const std::string pointer = pointerOf(channel);
        std::optional<Animated> what = animated(channel);
        if (!what) {
            if (const std::optional<int> node = nodeWithoutTargets(channel))
                morphless_.insert(*node);
            else
                leaveOut(pointer.empty() ? channel.target_path : pointer, count);
            continue;
        }
        const std::size_t changes = what->targets.size() + what->multiplied.size();
        if (changes == 0) continue;
        if (what->property == AnimatedProperty::Emissive) {
            std::string_view path = pointer;
            const std::size_t material = cutIndex(path, kMaterialsPointer).value_or(0);
            const std::string strength =
                fmt::format("{}{}/{}", kMaterialsPointer, material, infoOf(AnimatedProperty::EmissiveStrength).path);
            if (!places.contains(strength)) what->scale = double(document.materials[material].emissiveStrength);
        }
        document.charge(changes * (2 * sizeof(AnimationChannel) + kEntryBytes) + sizeof(AnimationSampler), "animations",
                        index);
        const std::size_t number = i; // clang captures no structured binding
        const std::array<int, 4> read{index, channel.sampler, int(what->property), int(what->width)};
        if (failed.contains(read)) continue;
        auto entry = samplers.find({channel.sampler, what->scale});
        const std::uint64_t usedBefore = used();
        const bool isGood = document.repairs.attempt("the channel is left out", [&] {
            if (entry == samplers.end()) {
                clip.samplers.push_back(sampler(index, channel.sampler, *what));
                entry = samplers.emplace(std::pair(channel.sampler, what->scale), int(clip.samplers.size()) - 1).first;
            }
            const int width = clip.samplers[std::size_t(entry->second)].width;
            if (std::size_t(width) != what->width)
                document.fail(fmt::format("/animations/{}/channels/{}", index, number),
                              "takes values of {} numbers from sampler {}, which another channel takes as of {}",
                              what->width, channel.sampler, width);
        });
        if (!isGood) {
            failed.insert(read);
            mark += used() - usedBefore; // stays charged, which bounds the time spent on flawed samplers
            continue;
        }
        // Several targets in the document may be one in the scene.
        for (const int target : what->targets) {
            const auto [same, isFirst] = channels.try_emplace({what->property, target}, clip.channels.size());
            if (isFirst) clip.channels.push_back({what->property, target});
            clip.channels[same->second].sampler = entry->second;
        }
        for (const auto& [property, target, rest] : what->multiplied) {
            const auto [same, isFirst] = channels.try_emplace({property, target}, clip.channels.size());
            if (isFirst) { // constant, unless another channel animates it too
                document.charge(2 * sizeof(AnimationSampler) + (1 + rest.size()) * sizeof(float), "animations", index);
                clip.channels.push_back({property, target, int(clip.samplers.size())});
                clip.samplers.push_back({Interpolation::Linear, int(rest.size()), {0.0f}, rest});
            }
            clip.channels[same->second].factor = entry->second;
        }
    }
    document.ledger.settle(mark, context_.buffers.heldBytes() + bytesOf(clip));
    return clip;
}

} // namespace tessera::scenes::gltf
