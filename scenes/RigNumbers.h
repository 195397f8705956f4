#pragma once
#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>

#include "scenes/Scene.h"

/// Where the numbers are that clips change, for scenes/Pose.cpp and scenes/Rest.cpp.
namespace tessera::scenes {

/// Writes numbers into a member of `owner` if it has that member, each component by way of `bounded`.
template <typename Owner>
void setMember(Owner& owner, const AnimatedMember& member, const glm::dvec4& number, const auto& bounded) {
    std::visit(
        [&](auto memberOfAny) {
            if constexpr (requires { owner.*memberOfAny; }) {
                auto& value = owner.*memberOfAny;
                using Value = std::decay_t<decltype(value)>;
                if constexpr (std::is_floating_point_v<Value>)
                    value = Value(bounded(memberOfAny, number.x));
                else
                    for (glm::length_t i = 0; i < value.length(); ++i)
                        value[i] = float(bounded(memberOfAny, number[i]));
            }
        },
        member);
}

/// What a clip says. Splines go past their keys; a member that has bounds stays within them, and no other number of a
/// light or material is negative.
template <typename Owner>
void setPosed(Owner& owner, const AnimatedPropertyInfo& info, const glm::dvec4& number) {
    setMember(owner, info.member, number, [&](auto member, double value) {
        double least = info.least, most = info.most;
        const auto narrow = [&](const auto& field) {
            least = std::max(least, field.what != nullptr ? field.least : 0.0);
            if (field.what != nullptr) most = std::min(most, field.most);
        };
        if constexpr (std::is_same_v<Owner, Light>) narrow(fieldOf(kLightFields, member));
        if constexpr (std::is_same_v<Owner, Material>) narrow(fieldOf(kMaterialFields, member));
        value = std::clamp(value, least, most);
        return std::isinf(value) ? value : std::clamp(value, -kAnyNumber, kAnyNumber); // a range may be infinite
    });
}

/// Calls `use` with what of a material has a number at rest: the material, or its use of a texture.
void usePartOf(auto& material, const RestNumber& rest, const auto& use) {
    if (rest.slot == TextureSlot::Count)
        use(material);
    else
        use(material.texture(rest.slot).transform);
}

/// Calls `use` with the part of a scene that a number at rest, of an element that is there, belongs to.
void useOwner(auto& scene, const RestNumber& rest, const auto& use) {
    const auto element = std::size_t(rest.element);
    switch (infoOf(rest.property).owner) {
    case AnimatedOwner::Light:
        return use(scene.lights[element]);
    case AnimatedOwner::Material:
    case AnimatedOwner::Texture:
        return usePartOf(scene.materials[element], rest, use);
    case AnimatedOwner::Camera:
        return use(scene.cameras[element]);
    case AnimatedOwner::Node:
    case AnimatedOwner::Weights:
        return; // have lists of their own
    }
}

} // namespace tessera::scenes
