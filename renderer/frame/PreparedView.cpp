#include "renderer/frame/PreparedView.h"

#include <span>

#include "renderer/frame/LightBuffer.h"
#include "renderer/frame/MaterialFeatures.h"
#include "renderer/frame/PackedMaterial.h"

namespace tessera::frame {

namespace {

/// FNV-1a, 64 bits.
class Hash {
public:
    void add(std::span<const std::byte> bytes) {
        for (const std::byte byte : bytes) value_ = (value_ ^ std::uint64_t(byte)) * 0x100000001b3u;
    }
    template <typename Value>
    void add(const Value& value) {
        static_assert(std::has_unique_object_representations_v<Value> || std::is_floating_point_v<Value>);
        add(std::as_bytes(std::span(&value, 1)));
    }
    void addFloats(const auto& structs) { add(std::as_bytes(std::span(structs))); }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325u;
};

} // namespace

std::uint64_t diffusionKey(const scenes::Scene& scene, const DiffusionObject& object, const PreparedView& prepared,
                           std::uint64_t casterRevision) {
    const FrameSettings& settings = prepared.spec.settings;
    Hash hash;
    hash.addFloats(texelsOf(prepared.lights, prepared.spec.features));
    // Textures never change, and the packed lights refer to them by number.
    for (const ShownPicture& shown : prepared.lights.pictures)
        hash.add(std::uint64_t(reinterpret_cast<std::uintptr_t>(&*shown.texture)));
    hash.add(std::uint64_t(prepared.lights.shadowed));
    hash.addFloats(prepared.shadowFaces);
    const PackedSubsurfaces subsurfaces = packSubsurfaces(scene, settings.subsurface);
    const std::size_t row = subsurfaces.rowOf[std::size_t(object.material)];
    hash.addFloats(std::vector{packMaterial(enteredMaterial(scene.materials[std::size_t(object.material)]), row)});
    // Light is transmitted only through objects of equal absorption, so all rows count.
    hash.addFloats(subsurfaces.rows);
    const DiffusionKernel& kernel = prepared.spec.diffusionKernel.value();
    const auto addWeight = [&](const glm::dvec3& weight) {
        for (int channel = 0; channel < 3; ++channel) hash.add(weight[channel]);
    };
    addWeight(kernel.inPixels);
    addWeight(kernel.inTexels);
    for (const DiffusionLevel& level : kernel.levels) {
        hash.add(level.totalSquareMetres);
        addWeight(level.weight);
    }
    hash.add(casterRevision);
    scenes::visitFields(kDiffusionFields, [&](const auto& field) { hash.add(settings.diffusion.*field.member); });
    hash.add(std::uint8_t(settings.shadowFilter));
    hash.add(std::uint8_t(settings.shadowTerminator));
    hash.add(settings.shadowSamples);
    hash.add(settings.shadowMaps.widthTexels);
    hash.add(settings.shadowMaps.cascades);
    if (prepared.spec.features.areaLights()) {
        hash.add(std::uint8_t(settings.area.lights));
        if (prepared.spec.usesAreaSamples()) hash.add(settings.area.samples);
    }
    hash.add(std::uint8_t(settings.filter));
    hash.add(settings.prune);
    if (scene.hook) {
        hash.add(scene.hook->contentHash);
        hash.add(scene.hook->changes(std::size_t(object.material)));
        for (const glm::vec4& numbers : prepared.hook.numbers)
            for (int i = 0; i < 4; ++i) hash.add(numbers[i]);
    }
    if (prepared.spec.features[Feature::Environment]) {
        hash.addFloats(std::vector{prepared.environment});
        hash.add(std::uint8_t(settings.environment.light));
        if (prepared.spec.usesEnvironmentSamples()) hash.add(settings.environment.samples);
    }
    return hash.value();
}

} // namespace tessera::frame
