#pragma once
#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>

#include "scenes/Scene.h"

/// Access to the values that clips change, for scenes/Pose.cpp and scenes/Rest.cpp.
namespace tessera::scenes {

/// Writes a value into a member of `owner` if it has that member; `bounded` clamps each component.
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

/// Writes an animated value. Splines overshoot their keys, so values are clamped to the member's bounds; lights and
/// materials have no other negative values.
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

/// Calls `use` with the part of a material that has a rest value: the material itself, or a texture's transform.
void usePartOf(auto& material, const RestNumber& rest, const auto& use) {
    if (rest.slot == TextureSlot::Count)
        use(material);
    else
        use(material.texture(rest.slot).transform);
}

/// Calls `use` with the part of a scene that has a rest value; its element must still exist.
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
        return; // not in Rig::numbers
    }
}

} // namespace tessera::scenes
