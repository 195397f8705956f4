#include "scenes/CheckRig.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include <fmt/format.h>

#include "scenes/CheckElement.h"
#include "scenes/RigLinks.h"

namespace tessera::scenes {
namespace {

/// Checks one rig.
class RigCheck {
public:
    explicit RigCheck(const Scene& scene) : scene_(scene), rig_(scene.rig) {}

    void check() {
        for (std::size_t i = 0; i < rig_.nodes.size(); ++i) checkNodeAtRest(i);
        for (std::size_t i = 0; i < rig_.weights.size(); ++i) {
            begin("resting weights", i, {});
            requireFinite(rig_.weights[i], "weights");
        }
        for (std::size_t i = 0; i < rig_.numbers.size(); ++i) {
            begin("resting number", i, {});
            const auto& [property, element, number, slot] = rig_.numbers[i];
            const AnimatedPropertyInfo& info = infoOf(property);
            require(ownsNumbers(info.owner) && info.member.index() != 0, "is no number of a light, material or camera");
            require((info.owner == AnimatedOwner::Texture) == (slot < TextureSlot::Count),
                    "names a texture, and is none's, or the other way round");
            if (element == kNone) continue;
            requireIndex(element, elementCount(scene_, info.owner),
                         info.owner == AnimatedOwner::Light    ? "light"
                         : info.owner == AnimatedOwner::Camera ? "camera"
                                                               : "material");
        }
        for (std::size_t i = 0; i < rig_.clips.size(); ++i) checkClip(i);
        for (std::size_t i = 0; i < rig_.skins.size(); ++i) checkSkin(i);
        for (std::size_t i = 0; i < rig_.shapes.size(); ++i) checkShape(i);
        for (std::size_t i = 0; i < rig_.deformed.size(); ++i) checkDeformed(i);
        begin("rig", 0, {});
        for (const int clip : rig_.playing) requireIndex(clip, rig_.clips.size(), "clip");
        for (const Carried& carried : rig_.lights) checkCarried(carried, scene_.lights.size(), "light");
        for (const Carried& carried : rig_.cameras) checkCarried(carried, scene_.cameras.size(), "camera");
    }

private:
    void begin(std::string_view kind, std::size_t index, std::string_view name) {
        element_.emplace(scene_, kind, index, name);
    }

    void require(bool holds, std::string_view problem) const { element_->require(holds, problem); }

    void requireIndex(int index, std::size_t count, std::string_view kind) const {
        element_->requireIndex(index, count, kind);
    }

    void requireFinite(const std::vector<float>& numbers, std::string_view what) const {
        if (!std::ranges::all_of(numbers, [](float number) { return std::isfinite(number); }))
            require(false, fmt::format("one of its {} is not finite", what));
    }

    void checkNodeAtRest(std::size_t i) {
        begin("resting node", i, {});
        const auto& [node, translation, rotation, scale] = rig_.nodes[i];
        requireIndex(node, scene_.nodes.size(), "node");
        const double sum = translation.x + translation.y + translation.z + scale.x + scale.y + scale.z;
        require(std::isfinite(sum), "its translation or scale is not finite");
        const double square = glm::dot(rotation, rotation);
        require(std::isfinite(square) && rotation != glm::dvec4(0.0), "its rotation is zero or not finite");
    }

    void checkClip(std::size_t i) {
        const Clip& clip = rig_.clips[i];
        begin("clip", i, clip.name);
        for (const AnimationSampler& sampler : clip.samplers) {
            const std::vector<float>& times = sampler.timesSeconds;
            require(!times.empty() && sampler.width > 0, "a sampler has no keys or no numbers");
            requireFinite(times, "key times");
            require(std::ranges::adjacent_find(times, std::greater_equal<>()) == times.end(),
                    "the key times of a sampler must ascend");
            require(sampler.values.size() == times.size() * sampler.valuesPerKey() * std::size_t(sampler.width),
                    "a sampler has another number of values than its keys need");
            requireFinite(sampler.values, "values");
        }
        for (const AnimationChannel& channel : clip.channels) {
            const AnimatedPropertyInfo& info = infoOf(channel.property);
            requireIndex(channel.sampler, clip.samplers.size(), "sampler");
            if (channel.factor != kNone) {
                requireIndex(channel.factor, clip.samplers.size(), "sampler");
                require(clip.samplers[std::size_t(channel.factor)].width == 1, "a factor needs 1 number");
            }
            auto width = std::size_t(info.width);
            if (info.owner == AnimatedOwner::Node) {
                requireIndex(channel.target, rig_.nodes.size(), "resting node");
            } else if (info.owner == AnimatedOwner::Weights) {
                requireIndex(channel.target, rig_.weights.size(), "resting weights");
                width = rig_.weights[std::size_t(channel.target)].size();
            } else {
                requireIndex(channel.target, rig_.numbers.size(), "resting number");
                require(rig_.numbers[std::size_t(channel.target)].property == channel.property,
                        "a channel's target is another property's");
            }
            require(std::size_t(clip.samplers[std::size_t(channel.sampler)].width) == width,
                    fmt::format("the values of {} need {} numbers", info.path, width));
        }
    }

    void checkSkin(std::size_t i) {
        const Skin& skin = rig_.skins[i];
        begin("skin", i, skin.name);
        require(skin.joints.size() == skin.jointFromBind.size(), "needs a matrix for each joint");
        for (const int joint : skin.joints) requireIndex(joint, scene_.nodes.size(), "node");
        for (const glm::dmat4& matrix : skin.jointFromBind)
            for (int column = 0; column < 4; ++column)
                require(std::isfinite(matrix[column].x + matrix[column].y + matrix[column].z),
                        "the matrix of a joint is not finite");
    }

    template <typename Vector>
    void requireLength(const std::vector<Vector>& values, std::size_t vertices, bool mayBeEmpty = true) const {
        require(values.size() == vertices || (mayBeEmpty && values.empty()),
                "an attribute has another length than the positions");
        for (const Vector& value : values)
            for (glm::length_t i = 0; i < value.length(); ++i)
                require(std::isfinite(value[i]), "an attribute is not finite");
    }

    void checkShape(std::size_t i) {
        const Shape& shape = rig_.shapes[i];
        begin("shape", i, shape.rest.name);
        const std::size_t vertices = shape.rest.positionsOS.size();
        requireLength(shape.rest.positionsOS, vertices, false);
        requireLength(shape.rest.normalsOS, vertices, false);
        requireLength(shape.rest.tangentsOS, vertices);
        for (const auto& set : shape.rest.texCoords) requireLength(set, vertices);
        requireLength(shape.rest.colors, vertices);
        for (const MorphTarget& target : shape.targets) {
            requireLength(target.positionsOS, vertices);
            requireLength(target.normalsOS, vertices);
            requireLength(target.tangentsOS, vertices);
            for (const auto& set : target.texCoords) requireLength(set, vertices);
            requireLength(target.colors, vertices);
        }
        require(shape.joints.size() == vertices * shape.influences && shape.weights.size() == shape.joints.size(),
                "has another number of joints or weights than its vertices follow");
        for (const float weight : shape.weights)
            require(std::isfinite(weight) && weight >= 0.0f, "a weight is negative or not finite");
    }

    void checkDeformed(std::size_t i) {
        const Deformed& deformed = rig_.deformed[i];
        begin("deformed mesh", i, {});
        requireIndex(deformed.mesh, scene_.meshes.size(), "mesh");
        requireIndex(deformed.shape, rig_.shapes.size(), "shape");
        requireIndex(deformed.node, scene_.nodes.size(), "node");
        requireIndex(deformed.standsAt, scene_.nodes.size(), "node");
        if (deformed.weights != kNone) requireIndex(deformed.weights, rig_.weights.size(), "resting weights");
        const Shape& shape = rig_.shapes[std::size_t(deformed.shape)];
        const Mesh& mesh = scene_.meshes[std::size_t(deformed.mesh)];
        const auto sizes = [](const Mesh& of) {
            return std::array{of.positionsOS.size(),  of.normalsOS.size(),    of.tangentsOS.size(),
                              of.texCoords[0].size(), of.texCoords[1].size(), of.colors.size()};
        };
        require(sizes(mesh) == sizes(shape.rest) && mesh.indices == shape.rest.indices,
                "its mesh is not that of its shape");
        if (deformed.skin == kNone) return;
        requireIndex(deformed.skin, rig_.skins.size(), "skin");
        const std::size_t joints = rig_.skins[std::size_t(deformed.skin)].joints.size();
        for (std::size_t k = 0; k < shape.joints.size(); ++k)
            if (shape.joints[k] >= joints)
                require(false, fmt::format("a vertex follows joint {}, but its skin has {}", shape.joints[k], joints));
    }

    void checkCarried(const Carried& carried, std::size_t elements, std::string_view kind) const {
        requireIndex(carried.element, elements, kind);
        requireIndex(carried.node, scene_.nodes.size(), "node");
    }

    const Scene& scene_;
    const Rig& rig_;
    std::optional<CheckedElement> element_; ///< the element under check
};

} // namespace

void checkRig(const Scene& scene) {
    RigCheck(scene).check();
}

} // namespace tessera::scenes
