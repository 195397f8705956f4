#include "scenes/Fingerprint.h"

#include <bit>
#include <type_traits>

namespace tessera::scenes {
namespace {

/// Hashes a scene field by field. Structured bindings list every member, so that a struct with a new field does not
/// compile until it is hashed here; static_asserts do the same for kMaterialFields and kLightFields.
class Hash {
public:
    std::uint64_t value() const { return hash_; }

    void add(std::byte byte) {
        constexpr std::uint64_t kPrime = 1099511628211ull;
        hash_ = (hash_ ^ std::to_integer<std::uint64_t>(byte)) * kPrime;
    }
    template <typename Number>
    requires std::is_integral_v<Number> || std::is_enum_v<Number>
    void add(Number number) {
        // Little-endian on every machine.
        const auto bits = static_cast<std::uint64_t>(number);
        for (unsigned byte = 0; byte < sizeof(Number); ++byte) add(std::byte(bits >> (8 * byte) & 0xffu));
    }
    void add(float number) { add(std::bit_cast<std::uint32_t>(number)); }
    void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }

    template <glm::length_t kLength, typename Number, glm::qualifier kQualifier>
    void add(const glm::vec<kLength, Number, kQualifier>& vector) {
        for (glm::length_t i = 0; i < kLength; ++i) add(vector[i]);
    }
    void add(const glm::dmat4& matrix) {
        for (glm::length_t i = 0; i < 4; ++i) add(matrix[i]);
    }
    void add(const std::string& text) {
        add(std::uint64_t(text.size()));
        for (const char c : text) add(std::byte(c));
    }
    template <typename Element>
    void add(const std::vector<Element>& list) {
        add(std::uint64_t(list.size()));
        for (const Element& element : list) add(element);
    }
    template <typename Element, std::size_t kCount>
    void add(const std::array<Element, kCount>& list) {
        for (const Element& element : list) add(element);
    }
    template <typename Content>
    void add(const std::optional<Content>& content) {
        add(content.has_value());
        if (content) add(*content);
    }

    void add(const Image& image) {
        const auto& [name, format, width, height, texels] = image;
        addAll(name, format, width, height, texels);
    }
    void add(const Sampler& sampler) {
        const auto& [magnification, minification, wrapU, wrapV] = sampler;
        addAll(magnification, minification, wrapU, wrapV);
    }
    void add(const TextureTransform& transform) {
        const auto& [offset, scale, rotationRadians] = transform;
        addAll(offset, scale, rotationRadians);
    }
    void add(const TextureUse& use) {
        const auto& [image, sampler, texCoordSet, transform] = use;
        addAll(image, sampler, texCoordSet, transform);
    }
    void add(const DiffusionGaussian& gaussian) {
        const auto& [varianceSquareMillimetres, weight] = gaussian;
        addAll(varianceSquareMillimetres, weight);
    }
    void add(const Subsurface& subsurface) {
        visitFields(kSubsurfaceFields, [&](const auto& field) { add(subsurface.*field.member); });
    }
    void add(const Material& material) {
        visitFields(kMaterialFields, [&](const auto& field) { add(material.*field.member); });
        add(material.textures);
    }
    void add(const Mesh& mesh) {
        const auto& [name, positionsOS, normalsOS, tangentsOS, texCoords, colors, indices] = mesh;
        addAll(name, positionsOS, normalsOS, tangentsOS, texCoords, colors, indices);
    }
    void add(const MeshInstance& instance) {
        const auto& [mesh, material, castsShadow] = instance;
        addAll(mesh, material, castsShadow);
    }
    void add(const Node& node) {
        const auto& [name, parent, parentFromNode, instances] = node;
        addAll(name, parent, parentFromNode, instances);
    }
    void add(const LightKeys& keys) {
        const auto& [of, timesSeconds, values, interpolation, repeat, inTangents, outTangents] = keys;
        addAll(of, timesSeconds, values, interpolation, repeat, inTangents, outTangents);
    }
    void add(const LightAnimation& animation) {
        const auto& [kind, periodSeconds, phase, centerWS, axisWS, amplitudeMetres, pointsWS, line, isOpen, looksAhead,
                     keys] = animation;
        addAll(kind, periodSeconds, phase, centerWS, axisWS, amplitudeMetres, pointsWS, line, isOpen, looksAhead, keys);
    }
    void add(const LightFlicker& flicker) {
        const auto& [amplitude, frequencyHz, seed] = flicker;
        addAll(amplitude, frequencyHz, seed);
    }
    void add(const LightCorners& corners) {
        add(std::uint64_t(corners.count));
        for (const glm::vec2& corner : corners.all()) add(corner);
    }
    void add(const LightTexture& texture) {
        if (!texture) return; // absent: the fingerprint stays as before
        const auto& [source, map, most] = *texture;
        add(map);
        static_cast<void>(source); // origin, not content
        static_cast<void>(most);   // derived from the texels
    }
    void add(const Light& light) {
        visitFields(kLightFields, [&](const auto& field) { add(light.*field.member); });
    }
    void add(const Camera& camera) {
        const auto& [name, projection, worldFromCamera, fovYRadians, halfHeightMetres, nearMetres, farMetres] = camera;
        addAll(name, projection, worldFromCamera, fovYRadians, halfHeightMetres, nearMetres, farMetres);
    }
    void add(const SceneOptions& options) {
        const auto& [camera, clip, defaultLight, requested] = options;
        addAll(camera, defaultLight, std::uint64_t(requested.size()));
        static_cast<void>(clip); // the rig lists the active clips
        for (const auto& [key, option] : requested) {
            addAll(key, std::uint64_t(option.index()));
            std::visit([this](const auto& value) { add(value); }, option);
        }
    }
    void add(const Environment& environment) {
        const auto& [source, map, intensity, rotationDegrees] = environment;
        addAll(map, intensity, rotationDegrees);
        static_cast<void>(source); // origin, not content
    }
    void add(const HookParameter& parameter) {
        const auto& [name, value, least, most] = parameter;
        addAll(name, value, least, most);
    }
    void add(const Hook& hook) {
        const auto& [file, contentHash, materials, parameters, changesSurfaces, movesVertices, mayMoveMetres] = hook;
        addAll(contentHash, materials, parameters, changesSurfaces, movesVertices, mayMoveMetres);
        static_cast<void>(file); // origin, not content
    }
    void add(const AnimationSampler& sampler) {
        const auto& [interpolation, width, timesSeconds, values] = sampler;
        addAll(interpolation, width, timesSeconds, values);
    }
    void add(const AnimationChannel& channel) {
        const auto& [property, target, sampler, factor] = channel;
        addAll(property, target, sampler, factor);
    }
    void add(const Clip& clip) {
        const auto& [name, samplers, channels] = clip;
        addAll(name, samplers, channels);
    }
    void add(const RestNode& node) {
        const auto& [index, translation, rotation, scale] = node;
        addAll(index, translation, rotation, scale);
    }
    void add(const RestNumber& rest) {
        const auto& [property, element, number, slot] = rest;
        addAll(property, element, number, slot);
    }
    void add(const Skin& skin) {
        const auto& [name, joints, jointFromBind] = skin;
        addAll(name, joints, jointFromBind);
    }
    void add(const MorphTarget& target) {
        const auto& [positionsOS, normalsOS, tangentsOS, texCoords, colors] = target;
        addAll(positionsOS, normalsOS, tangentsOS, texCoords, colors);
    }
    void add(const Shape& shape) {
        const auto& [rest, isFlat, targets, influences, joints, weights] = shape;
        addAll(rest, isFlat, targets, influences, joints, weights);
    }
    void add(const Deformed& deformed) {
        const auto& [mesh, shape, node, standsAt, skin, weights] = deformed;
        addAll(mesh, shape, node, standsAt, skin, weights);
    }
    void add(const Carried& carried) {
        const auto& [element, node] = carried;
        addAll(element, node);
    }
    void add(const Rig& rig) {
        const auto& [clips, playing, nodes, weights, numbers, skins, shapes, deformed, lights, cameras] = rig;
        addAll(clips, playing, nodes, weights, numbers, skins, shapes, deformed, lights, cameras);
    }
    void add(const Scene& scene) {
        const auto& [name, images, materials, meshes, nodes, lights, cameras, rig, environment, hook, background,
                     options, supplied, variants, notes, warnings] = scene;
        addAll(name, images, materials, meshes, nodes, lights, cameras, rig, environment, background, options);
        if (hook) add(*hook);        // absent: the fingerprint stays as before
        static_cast<void>(supplied); // describes the camera and the environment, which are hashed
        for (const auto* words : {&variants, &notes, &warnings}) static_cast<void>(words); // about the file only
    }

private:
    template <typename... Fields>
    void addAll(const Fields&... fields) {
        (add(fields), ...);
    }

    std::uint64_t hash_ = 14695981039346656037ull; ///< FNV-1a offset basis
};

} // namespace

std::uint64_t fingerprint(const Scene& scene) {
    Hash hash;
    hash.add(scene);
    return hash.value();
}

std::uint64_t fingerprint(std::span<const std::byte> bytes) {
    Hash hash;
    for (const std::byte byte : bytes) hash.add(byte);
    return hash.value();
}

} // namespace tessera::scenes
