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
    for (const std::string_view array : {kNodesPointer, kMaterialsPointer, kLightsPointer}) {
        std::string_view path = channel.pointer;
        if (const auto index = cutIndex(path, array)) return fmt::format("{}{}/{}", array, *index, path);
    }
    return channel.pointer;
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

int Rigging::restNumber(AnimatedProperty property, int element) {
    std::vector<RestNumber>& numbers = context_.scene.rig.numbers;
    const auto [entry, isNew] = numbers_.try_emplace({property, element}, static_cast<int>(numbers.size()));
    if (isNew) numbers.push_back({property, element});
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

std::optional<Rigging::Animated> Rigging::animatedNumber(AnimatedOwner owner, std::size_t index,
                                                         std::string_view path) {
    const AnimatedPropertyInfo* const info = propertyAt(path, [&](AnimatedOwner of) { return of == owner; });
    if (info == nullptr) return {};
    const model::Model& model = context_.document.model;
    Animated animated{info->property, {}, static_cast<std::size_t>(info->width)};
    if (owner == AnimatedOwner::Light) {
        if (index >= model.lights.size()) return {};
        if (info->property == AnimatedProperty::LightIntensity) animated.scale = model.lights[index].wattsPerUnit;
        for (const int light : lights_[static_cast<int>(index)])
            animated.targets.push_back(restNumber(info->property, light));
        return animated;
    }
    if (index >= model.materials.size()) return {};
    const model::Material& stored = model.materials[index];
    const bool isUnlit = stored.surface.model == MaterialModel::SingleColor;
    if (info->property == AnimatedProperty::Emissive && (isUnlit || stored.emissiveStrength != 1.0f)) return {};
    if (const std::optional<int> material = materials_.imported(static_cast<int>(index)))
        animated.targets.push_back(restNumber(info->property, *material));
    return animated;
}

std::optional<Rigging::Animated> Rigging::animatedByPointer(const std::string& pointer) {
    std::string_view path = pointer;
    if (const auto node = cutIndex(path, kNodesPointer))
        return *node < sceneNodes_.size() ? animatedOfNode(static_cast<int>(*node), path) : std::nullopt;
    if (const auto light = cutIndex(path, kLightsPointer)) return animatedNumber(AnimatedOwner::Light, *light, path);
    if (const auto material = cutIndex(path, kMaterialsPointer))
        return animatedNumber(AnimatedOwner::Material, *material, path);
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
        const std::optional<Animated> what = animated(channel);
        if (const std::optional<int> node = morphlessNode(channel); !what && node) {
            morphless_.insert(*node);
            continue;
        }
        if (!what) {
            if (leftOut_ == 0) leftOutPath_ = channel.pointer.empty() ? channel.path : channel.pointer;
            leftOut_ += count;
            continue;
        }
        if (what->targets.empty()) continue;
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
            const auto [same, isFirst] = channels.try_emplace({what->property, target}, clip.channels.size());
            if (isFirst)
                clip.channels.push_back({what->property, target, entry->second});
            else
                clip.channels[same->second].sampler = entry->second;
        }
    }
    document.ledger.settle(mark, context_.buffers.heldBytes() + bytesOf(clip));
    return clip;
}

} // namespace tessera::scenes::gltf
