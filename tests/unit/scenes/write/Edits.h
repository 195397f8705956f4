#pragma once
#include <algorithm>
#include <numbers>

#include "scenes/Scene.h"
#include "tests/support/Random.h"

/// Random elements with a different value in every member, including unused ones.
namespace tessera::scenes::test {

class Edits {
public:
    explicit Edits(std::uint64_t seed) : random_(seed) {}

    float share() { return float(random_.unit()); }
    double coordinate() { return random_.between(-100.0, 100.0); }
    glm::dvec3 point() { return {coordinate(), coordinate(), coordinate()}; }
    glm::dvec3 direction() { return glm::normalize(point()); }
    glm::vec3 color() { return {share(), share(), share()}; }

    LightAnimation animation(LightAnimationKind kind) {
        LightAnimation animation;
        animation.kind = kind;
        animation.periodSeconds = 1.0 + share();
        animation.phase = share();
        animation.centerWS = point();
        animation.axisWS = direction();
        animation.amplitudeMetres = point();
        animation.pointsWS = {point(), point()};
        animation.line = random_.unit() < 0.5 ? PathLine::Straight : PathLine::CatmullRom;
        animation.isOpen = random_.unit() < 0.5;
        animation.looksAhead = random_.unit() < 0.5;
        animation.keys = keys(LightKeyed::Position);
        return animation;
    }

    LightKeys keys(LightKeyed of) {
        LightKeys keys;
        keys.of = of;
        keys.timesSeconds = {share(), 2.0 + share()};
        const auto value = [&]() -> glm::dvec3 {
            if (infoOf(of).isOnSphere) return direction();
            if (infoOf(of).width() == 1) return {random_.unit(), 0.0, 0.0};
            return of == LightKeyed::Position ? point() : glm::dvec3(random_.unit(), random_.unit(), random_.unit());
        };
        keys.values = {value(), value()};
        keys.interpolation = Interpolation(std::min(2.0, 3.0 * random_.unit()));
        keys.repeat = KeyRepeat(std::min(2.0, 3.0 * random_.unit()));
        keys.inTangents = {point(), point()};
        keys.outTangents = {point(), point()};
        return keys;
    }

    Light light(LightType type, Falloff falloff) {
        Light light;
        light.name = "edited \"light\"";
        light.type = type;
        light.enabled = random_.unit() < 0.5;
        light.color = color();
        light.intensity = 100.0f * share();
        light.flicker = LightFlicker{.amplitude = random_.unit(), .frequencyHz = 1.0 + share(), .seed = 3};
        for (const LightKeyedInfo& member : keyedMembers())
            if (member.member != LightKeyed::Position && share() < 0.5f) light.keyframes.push_back(keys(member.member));
        light.positionWS = point();
        light.directionWS = direction();
        light.falloff = falloff;
        light.rangeMetres = 10.0f * share();
        light.attenuation = color();
        light.outerConeRadians = share();
        light.innerConeRadians = share() * light.outerConeRadians;
        light.widthMetres = 2.0f * share();
        light.heightMetres = 2.0f * share();
        light.lengthMetres = 2.0f * share();
        light.radiusMetres = share();
        light.alongWS = glm::normalize(glm::cross(light.directionWS, direction()));
        light.corners.count = 0;
        for (const glm::vec2& corner : {glm::vec2(0.0f, 0.0f), glm::vec2(1.0f, 0.0f), glm::vec2(0.3f, 0.3f),
                                        glm::vec2(0.0f, 1.0f), glm::vec2(-0.5f, 0.5f)})
            light.corners.add(corner + 0.1f * glm::vec2(share(), share()));
        light.isTwoSided = share() < 0.5f;
        light.isSeen = share() < 0.5f;
        return light;
    }

    /// Every texture slot has one of `images` images.
    Material material(MaterialModel model, int images) {
        Material material;
        material.name = "edited";
        material.model = model;
        material.baseColor = glm::vec4(color(), share());
        material.emissive = 5.0f * color();
        for (float* member : {&material.metallic, &material.perceptualRoughness, &material.alpha, &material.alphaY,
                              &material.specularFactor, &material.anisotropyStrength, &material.clearcoat,
                              &material.clearcoatPerceptualRoughness, &material.sheenPerceptualRoughness,
                              &material.normalScale, &material.clearcoatNormalScale, &material.alphaCutoff,
                              &material.anisotropyRotationRadians, &material.transmission, &material.thicknessMetres,
                              &material.attenuationDistanceMetres, &material.dispersion, &material.iridescence})
            *member = share();
        material.masking = Masking::HalfVector;
        material.exponent = 50.0f * share();
        material.ior = 1.0f + share();
        material.iridescenceIor = 1.0f + share();
        material.iridescenceThicknessNm = 1000.0f * share();
        material.iridescenceLeastThicknessNm = 1000.0f * share();
        material.specularColor = color();
        material.sheenColor = color();
        material.attenuationColor = color();
        material.subsurface.method = SubsurfaceMethod(random_.index(int(SubsurfaceMethod::Count)));
        for (float* member : {&material.subsurface.scaleMetres, &material.subsurface.wrap,
                              &material.subsurface.bodyRadiusMetres, &material.subsurface.preScatterShare})
            *member = share();
        material.subsurface.wrapTint = color();
        material.subsurface.absorptionPerMillimetre = 3.0f * color();
        if (share() < 0.5f) material.subsurface.profile = namedProfiles()[1].profile;
        if (share() < 0.5f) material.subsurface.profile = {{share(), glm::vec3(1.0f)}};
        material.alphaMode = AlphaMode::Mask;
        material.doubleSided = true;
        for (TextureUse& use : material.textures) {
            use.image = random_.index(images);
            use.sampler = {Filter::Nearest, Filter::NearestMipmapLinear, Wrap::ClampToEdge, Wrap::MirroredRepeat};
            use.texCoordSet = share() < 0.5f ? 0 : 1;
            use.transform = {{share(), share()}, {share(), share()}, share()};
        }
        return material;
    }

private:
    tessera::test::Random random_;
};

} // namespace tessera::scenes::test
