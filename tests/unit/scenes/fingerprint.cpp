#include "scenes/Fingerprint.h"

#include <functional>
#include <set>
#include <span>
#include <string_view>

#include <gtest/gtest.h>

#include "scenes/Load.h"
#include "tests/support/LightPictures.h"
#include "tests/unit/scenes/RiggedScene.h"

namespace tessera::scenes {
namespace {

/// The least scene with one of everything that a scene may hold.
Scene sceneOfEverything() {
    Scene scene = riggedScene();
    scene.nodes[0].instances = scene.nodes[3].instances;
    Image& image = scene.images.emplace_back();
    image.width = image.height = 1;
    image.texels.assign(4, std::byte(7));
    scene.materials[0].texture(TextureSlot::BaseColor).image = 0;
    Light& light = scene.lights[0];
    light.animation.emplace();
    light.animation->keys.timesSeconds = {0.0, 1.0};
    light.animation->pointsWS = {glm::dvec3(0.0), glm::dvec3(1.0)};
    light.animation->keys.values = light.animation->pointsWS;
    light.keyframes.emplace_back().of = LightKeyed::Color;
    return scene;
}

struct Change {
    const char* what;
    std::function<void(Scene&)> make;
};

TextureUse& use(Scene& scene) {
    return scene.materials[0].texture(TextureSlot::BaseColor);
}

const std::vector<Change>& changes() {
    static const std::vector<Change> table{
        {"name", [](Scene& s) { s.name += 'x'; }},
        {"background", [](Scene& s) { s.background.z = 1e-30f; }},
        {"image.name", [](Scene& s) { s.images[0].name += 'x'; }},
        {"image.format", [](Scene& s) { s.images[0].format = TexelFormat::Rgba16Unorm; }},
        {"image.width", [](Scene& s) { s.images[0].width = 2; }},
        {"image.height", [](Scene& s) { s.images[0].height = 2; }},
        {"image.texels", [](Scene& s) { s.images[0].texels[3] = std::byte(8); }},
        {"use.image", [](Scene& s) { use(s).image = kNone; }},
        {"use.slot", [](Scene& s) { std::swap(use(s), s.materials[0].texture(TextureSlot::Emissive)); }},
        {"use.magnification", [](Scene& s) { use(s).sampler.magnification = Filter::Nearest; }},
        {"use.minification", [](Scene& s) { use(s).sampler.minification = Filter::Nearest; }},
        {"use.wrapU", [](Scene& s) { use(s).sampler.wrapU = Wrap::ClampToEdge; }},
        {"use.wrapV", [](Scene& s) { use(s).sampler.wrapV = Wrap::ClampToEdge; }},
        {"use.texCoordSet", [](Scene& s) { use(s).texCoordSet = 1; }},
        {"use.offset", [](Scene& s) { use(s).transform.offset.y = 1.0f; }},
        {"use.scale", [](Scene& s) { use(s).transform.scale.x = 2.0f; }},
        {"use.rotation", [](Scene& s) { use(s).transform.rotationRadians = 1.0f; }},
        {"material.name", [](Scene& s) { s.materials[0].name += 'x'; }},
        {"material.model", [](Scene& s) { s.materials[0].model = MaterialModel::Lambert; }},
        {"material.baseColor", [](Scene& s) { s.materials[0].baseColor.y = 0.5f; }},
        {"material.emissive", [](Scene& s) { s.materials[0].emissive.x = 1.0f; }},
        {"material.metallic", [](Scene& s) { s.materials[0].metallic = 0.0f; }},
        {"material.perceptualRoughness", [](Scene& s) { s.materials[0].perceptualRoughness = 0.5f; }},
        {"material.alpha", [](Scene& s) { s.materials[0].alpha = 0.25f; }},
        {"material.alphaY", [](Scene& s) { s.materials[0].alphaY = 0.25f; }},
        {"material.masking", [](Scene& s) { s.materials[0].masking = Masking::HalfVector; }},
        {"material.exponent", [](Scene& s) { s.materials[0].exponent = 1.0f; }},
        {"material.ior", [](Scene& s) { s.materials[0].ior = 2.0f; }},
        {"material.specularFactor", [](Scene& s) { s.materials[0].specularFactor = 0.5f; }},
        {"material.specularColor", [](Scene& s) { s.materials[0].specularColor.z = 0.5f; }},
        {"material.anisotropyStrength", [](Scene& s) { s.materials[0].anisotropyStrength = 0.5f; }},
        {"material.anisotropyRotation", [](Scene& s) { s.materials[0].anisotropyRotationRadians = 0.5f; }},
        {"material.clearcoat", [](Scene& s) { s.materials[0].clearcoat = 0.5f; }},
        {"material.clearcoatRoughness", [](Scene& s) { s.materials[0].clearcoatPerceptualRoughness = 0.5f; }},
        {"material.clearcoatNormalScale", [](Scene& s) { s.materials[0].clearcoatNormalScale = 0.5f; }},
        {"material.sheenColor", [](Scene& s) { s.materials[0].sheenColor.x = 0.5f; }},
        {"material.sheenRoughness", [](Scene& s) { s.materials[0].sheenPerceptualRoughness = 0.5f; }},
        {"material.iridescence", [](Scene& s) { s.materials[0].iridescence = 0.5f; }},
        {"material.iridescenceIor", [](Scene& s) { s.materials[0].iridescenceIor = 1.5f; }},
        {"material.iridescenceThickness", [](Scene& s) { s.materials[0].iridescenceThicknessNm = 100.0f; }},
        {"material.iridescenceLeastThickness", [](Scene& s) { s.materials[0].iridescenceLeastThicknessNm = 50.0f; }},
        {"material.transmission", [](Scene& s) { s.materials[0].transmission = 0.5f; }},
        {"material.thickness", [](Scene& s) { s.materials[0].thicknessMetres = 0.5f; }},
        {"material.attenuationColor", [](Scene& s) { s.materials[0].attenuationColor.z = 0.5f; }},
        {"material.attenuationDistance", [](Scene& s) { s.materials[0].attenuationDistanceMetres = 0.5f; }},
        {"material.dispersion", [](Scene& s) { s.materials[0].dispersion = 0.5f; }},
        {"material.normalScale", [](Scene& s) { s.materials[0].normalScale = 0.5f; }},
        {"material.occlusionStrength", [](Scene& s) { s.materials[0].occlusionStrength = 0.5f; }},
        {"material.normalMapSpace", [](Scene& s) { s.materials[0].normalMapSpace = NormalMapSpace::Object; }},
        {"material.tangents", [](Scene& s) { s.materials[0].tangents = TangentMethod::Lengyel; }},
        {"material.alphaMode", [](Scene& s) { s.materials[0].alphaMode = AlphaMode::Mask; }},
        {"material.alphaCutoff", [](Scene& s) { s.materials[0].alphaCutoff = 0.25f; }},
        {"material.doubleSided", [](Scene& s) { s.materials[0].doubleSided = true; }},
        {"material.castsShadow", [](Scene& s) { s.materials[0].castsShadow = false; }},
        {"subsurface.method", [](Scene& s) { s.materials[0].subsurface.method = SubsurfaceMethod::Wrap; }},
        {"subsurface.scale", [](Scene& s) { s.materials[0].subsurface.scaleMetres = 2.0f; }},
        {"subsurface.wrap", [](Scene& s) { s.materials[0].subsurface.wrap = 0.25f; }},
        {"subsurface.wrapTint", [](Scene& s) { s.materials[0].subsurface.wrapTint.y = 0.0f; }},
        {"subsurface.bodyRadius", [](Scene& s) { s.materials[0].subsurface.bodyRadiusMetres = 1.0f; }},
        {"subsurface.absorption", [](Scene& s) { s.materials[0].subsurface.absorptionPerMillimetre.z = 0.0f; }},
        {"subsurface.preScatterShare", [](Scene& s) { s.materials[0].subsurface.preScatterShare = 0.0f; }},
        {"subsurface.profile", [](Scene& s) { s.materials[0].subsurface.profile.resize(1); }},
        {"subsurface.weight",
         [](Scene& s) {
             s.materials[0].subsurface.profile.resize(1, {1.0f, {1.0f, 1.0f, 0.0f}});
         }},
        {"subsurface.variance",
         [](Scene& s) {
             s.materials[0].subsurface.profile.resize(1, {9.0f, glm::vec3(1.0f)});
         }},
        {"another material", [](Scene& s) { s.materials.emplace_back(); }},
        {"mesh.name", [](Scene& s) { s.meshes[0].name += 'x'; }},
        {"mesh.positions", [](Scene& s) { s.meshes[0].positionsOS[2].y = 5.0f; }},
        {"mesh.normals", [](Scene& s) { s.meshes[0].normalsOS[0].z = -1.0f; }},
        {"mesh.tangents", [](Scene& s) { s.meshes[0].tangentsOS.assign(3, glm::vec4(1.0f)); }},
        {"mesh.texCoords0", [](Scene& s) { s.meshes[0].texCoords[0].assign(3, glm::vec2(1.0f)); }},
        {"mesh.texCoords1", [](Scene& s) { s.meshes[0].texCoords[1].assign(3, glm::vec2(1.0f)); }},
        {"mesh.colors", [](Scene& s) { s.meshes[0].colors.assign(3, glm::vec4(1.0f)); }},
        {"mesh.indices",
         [](Scene& s) {
             s.meshes[0].indices = {1, 2, 0};
         }},
        {"node.name", [](Scene& s) { s.nodes[0].name += 'x'; }},
        {"node.parent", [](Scene& s) { s.nodes[0].parent = 0; }},
        {"node.transform", [](Scene& s) { s.nodes[0].parentFromNode[3][0] = 1.0; }},
        {"node.instances", [](Scene& s) { s.nodes[0].instances.clear(); }},
        {"instance.mesh", [](Scene& s) { s.nodes[0].instances[0].mesh = 1; }},
        {"instance.material", [](Scene& s) { s.nodes[0].instances[0].material = kNone; }},
        {"instance.castsShadow", [](Scene& s) { s.nodes[0].instances[0].castsShadow = false; }},
        {"light.name", [](Scene& s) { s.lights[0].name += 'x'; }},
        {"light.type", [](Scene& s) { s.lights[0].type = LightType::Spot; }},
        {"light.enabled", [](Scene& s) { s.lights[0].enabled = false; }},
        {"light.radius", [](Scene& s) { s.lights[0].radiusMetres = 0.5f; }},
        {"light.angle", [](Scene& s) { s.lights[0].angularRadiusRadians = 0.5f; }},
        {"light.castsShadow", [](Scene& s) { s.lights[0].castsShadow = true; }},
        {"light.color", [](Scene& s) { s.lights[0].color.y = 0.5f; }},
        {"light.intensity", [](Scene& s) { s.lights[0].intensity = 2.0f; }},
        {"light.position", [](Scene& s) { s.lights[0].positionWS.x = 1e-12; }},
        {"light.direction", [](Scene& s) { s.lights[0].directionWS.z = 1.0; }},
        {"light.falloff", [](Scene& s) { s.lights[0].falloff = Falloff::Attenuation; }},
        {"light.range", [](Scene& s) { s.lights[0].rangeMetres = 2.0f; }},
        {"light.attenuation", [](Scene& s) { s.lights[0].attenuation.z = 1.0f; }},
        {"light.innerCone", [](Scene& s) { s.lights[0].innerConeRadians = 0.1f; }},
        {"light.outerCone", [](Scene& s) { s.lights[0].outerConeRadians = 0.9f; }},
        {"light.width", [](Scene& s) { s.lights[0].widthMetres = 2.0f; }},
        {"light.height", [](Scene& s) { s.lights[0].heightMetres = 2.0f; }},
        {"light.length", [](Scene& s) { s.lights[0].lengthMetres = 2.0f; }},
        {"light.along", [](Scene& s) { s.lights[0].alongWS.z = 1.0; }},
        {"light.corners", [](Scene& s) { s.lights[0].corners.metres[3].y = 0.75f; }},
        {"light.cornerCount", [](Scene& s) { s.lights[0].corners.count = 3; }},
        {"light.twoSided", [](Scene& s) { s.lights[0].isTwoSided = true; }},
        {"light.seen", [](Scene& s) { s.lights[0].isSeen = false; }},
        {"light.texture", [](Scene& s) { s.lights[0].texture = tessera::test::evenLightTexture(glm::vec3(1.0f), 1); }},
        {"light.texels", [](Scene& s) { s.lights[0].texture = tessera::test::evenLightTexture(glm::vec3(0.5f), 1); }},
        {"light.flicker", [](Scene& s) { s.lights[0].flicker.emplace(); }},
        {"light.animation", [](Scene& s) { s.lights[0].animation.reset(); }},
        {"animation.kind", [](Scene& s) { s.lights[0].animation->kind = LightAnimationKind::Path; }},
        {"animation.period", [](Scene& s) { s.lights[0].animation->periodSeconds = 2.0; }},
        {"animation.phase", [](Scene& s) { s.lights[0].animation->phase = 0.5; }},
        {"animation.center", [](Scene& s) { s.lights[0].animation->centerWS.x = 1.0; }},
        {"animation.axis", [](Scene& s) { s.lights[0].animation->axisWS.x = 1.0; }},
        {"animation.amplitude", [](Scene& s) { s.lights[0].animation->amplitudeMetres.x = 1.0; }},
        {"animation.times", [](Scene& s) { s.lights[0].animation->keys.timesSeconds[1] = 2.0; }},
        {"animation.line", [](Scene& s) { s.lights[0].animation->line = PathLine::CatmullRom; }},
        {"animation.looksAhead", [](Scene& s) { s.lights[0].animation->looksAhead = true; }},
        {"animation.isOpen", [](Scene& s) { s.lights[0].animation->isOpen = true; }},
        {"animation.interpolation", [](Scene& s) { s.lights[0].animation->keys.interpolation = Interpolation::Step; }},
        {"animation.repeat", [](Scene& s) { s.lights[0].animation->keys.repeat = KeyRepeat::Loop; }},
        {"animation.inTangents", [](Scene& s) { s.lights[0].animation->keys.inTangents.emplace_back(1.0); }},
        {"animation.outTangents", [](Scene& s) { s.lights[0].animation->keys.outTangents.emplace_back(1.0); }},
        {"animation.values", [](Scene& s) { s.lights[0].animation->keys.values[1].z = 2.0; }},
        {"light.keyframes", [](Scene& s) { s.lights[0].keyframes.clear(); }},
        {"keyframes.of", [](Scene& s) { s.lights[0].keyframes[0].of = LightKeyed::Intensity; }},
        {"animation.points", [](Scene& s) { s.lights[0].animation->pointsWS[1].z = 2.0; }},
        {"camera.name", [](Scene& s) { s.cameras[0].name += 'x'; }},
        {"camera.projection", [](Scene& s) { s.cameras[0].projection = Projection::Orthographic; }},
        {"camera.pose", [](Scene& s) { s.cameras[0].worldFromCamera[3][2] = 1.0; }},
        {"camera.fovY", [](Scene& s) { s.cameras[0].fovYRadians = 1.0; }},
        {"camera.halfHeight", [](Scene& s) { s.cameras[0].halfHeightMetres = 2.0; }},
        {"camera.near", [](Scene& s) { s.cameras[0].nearMetres = 0.2; }},
        {"camera.far", [](Scene& s) { s.cameras[0].farMetres = 9.0; }},
        {"clip.name", [](Scene& s) { s.rig.clips[0].name += 'x'; }},
        {"sampler.interpolation", [](Scene& s) { s.rig.clips[0].samplers[1].interpolation = Interpolation::Step; }},
        {"sampler.width", [](Scene& s) { s.rig.clips[0].samplers[1].width = 2; }},
        {"sampler.times", [](Scene& s) { s.rig.clips[0].samplers[1].timesSeconds[1] = 2.0f; }},
        {"sampler.values", [](Scene& s) { s.rig.clips[0].samplers[1].values[1] = 2.0f; }},
        {"channel.property", [](Scene& s) { s.rig.clips[0].channels[0].property = AnimatedProperty::Scale; }},
        {"channel.target", [](Scene& s) { s.rig.clips[0].channels[0].target = 1; }},
        {"channel.sampler", [](Scene& s) { s.rig.clips[0].channels[0].sampler = 1; }},
        {"rig.playing", [](Scene& s) { s.rig.playing.clear(); }},
        {"rest.node", [](Scene& s) { s.rig.nodes[0].node = 1; }},
        {"rest.translation", [](Scene& s) { s.rig.nodes[0].translation.y = 1.0; }},
        {"rest.rotation", [](Scene& s) { s.rig.nodes[0].rotation.y = 1.0; }},
        {"rest.scale", [](Scene& s) { s.rig.nodes[0].scale.y = 2.0; }},
        {"rest weights", [](Scene& s) { s.rig.weights[0][0] = 1.0f; }},
        {"rest number.property", [](Scene& s) { s.rig.numbers[0].property = AnimatedProperty::LightRange; }},
        {"channel.factor", [](Scene& s) { s.rig.clips[0].channels[0].factor = 1; }},
        {"rest number.slot", [](Scene& s) { s.rig.numbers[0].slot = TextureSlot::Normal; }},
        {"rest number.element", [](Scene& s) { s.rig.numbers[0].element = 1; }},
        {"rest number.number", [](Scene& s) { s.rig.numbers[0].number.x = 3.0f; }},
        {"skin.name", [](Scene& s) { s.rig.skins[0].name += 'x'; }},
        {"skin.joints", [](Scene& s) { s.rig.skins[0].joints[0] = 0; }},
        {"skin.jointFromBind", [](Scene& s) { s.rig.skins[0].jointFromBind[0][3].y = 1.0; }},
        {"shape.rest", [](Scene& s) { s.rig.shapes[0].rest.positionsOS[2].y = 5.0f; }},
        {"shape.isFlat", [](Scene& s) { s.rig.shapes[0].isFlat = true; }},
        {"shape.influences", [](Scene& s) { s.rig.shapes[0].influences = 8; }},
        {"shape.joints", [](Scene& s) { s.rig.shapes[0].joints[0] = 1; }},
        {"shape.weights", [](Scene& s) { s.rig.shapes[0].weights[0] = 0.5f; }},
        {"target.positions", [](Scene& s) { s.rig.shapes[0].targets[0].positionsOS[2].z = 2.0f; }},
        {"target.normals", [](Scene& s) { s.rig.shapes[0].targets[0].normalsOS.resize(3); }},
        {"target.tangents", [](Scene& s) { s.rig.shapes[0].targets[0].tangentsOS.resize(3); }},
        {"target.texCoords0", [](Scene& s) { s.rig.shapes[0].targets[0].texCoords[0].resize(3); }},
        {"target.texCoords1", [](Scene& s) { s.rig.shapes[0].targets[0].texCoords[1].resize(3); }},
        {"target.colors", [](Scene& s) { s.rig.shapes[0].targets[0].colors.resize(3); }},
        {"deformed.mesh", [](Scene& s) { s.rig.deformed[0].mesh = 1; }},
        {"deformed.shape", [](Scene& s) { s.rig.deformed[0].shape = 1; }},
        {"deformed.node", [](Scene& s) { s.rig.deformed[0].node = 1; }},
        {"deformed.standsAt", [](Scene& s) { s.rig.deformed[0].standsAt = 2; }},
        {"deformed.skin", [](Scene& s) { s.rig.deformed[0].skin = kNone; }},
        {"deformed.weights", [](Scene& s) { s.rig.deformed[0].weights = kNone; }},
        {"carried light", [](Scene& s) { s.rig.lights[0].element = 1; }},
        {"carried light's node", [](Scene& s) { s.rig.lights[0].node = 1; }},
        {"carried camera", [](Scene& s) { s.rig.cameras.clear(); }},
        {"options.wishes", [](Scene& s) { s.options.wishes["layout"] = ""; }},
        {"a wish's key", [](Scene& s) { s.options.wishes["view"] = ""; }},
        {"a wish's text", [](Scene& s) { s.options.wishes["layout"] = "a"; }},
        {"a wish's number", [](Scene& s) { s.options.wishes["layout"] = 0.0; }},
        {"a wish's list", [](Scene& s) { s.options.wishes["layout"] = std::vector<double>(); }},
        {"a wish's switch", [](Scene& s) { s.options.wishes["layout"] = false; }},
        {"options.camera", [](Scene& s) { s.options.camera = ""; }},
        {"options.defaultLight", [](Scene& s) { s.options.defaultLight = false; }},
    };
    return table;
}

TEST(Fingerprint, aChangeOfAnyFieldGivesAnotherOne) {
    std::set<std::uint64_t> seen{fingerprint(sceneOfEverything())};
    for (const Change& change : changes()) {
        Scene scene = sceneOfEverything();
        change.make(scene);
        EXPECT_TRUE(seen.insert(fingerprint(scene)).second) << change.what;
    }
}

TEST(Fingerprint, anElementMovedToAnotherListChangesTheFingerprint) {
    // Without the lengths between them, both would be the same bytes.
    Scene a = tinyScene(), b = tinyScene();
    a.materials[0].name = std::string("ab");
    a.materials.emplace_back().name = std::string("c");
    b.materials[0].name = std::string("a");
    b.materials.emplace_back().name = std::string("bc");
    EXPECT_NE(fingerprint(a), fingerprint(b));
}

TEST(Fingerprint, equalScenesAndTheirWarningsGiveTheSameOne) {
    Scene scene = sceneOfEverything();
    scene.warnings.push_back("the file has a feature that is left out");
    EXPECT_EQ(fingerprint(scene), fingerprint(sceneOfEverything()));
    EXPECT_EQ(fingerprint(loadScene("lattice")), fingerprint(loadScene("lattice")));
    // Kept in the files of benches, and so the same in every build: FNV-1a of 159 zero bytes, which are eighteen
    // lengths of 8, three floats of 4 and three absent options of 1.
    EXPECT_EQ(fingerprint(Scene()), 0xfbe08face1831d47ull);
}

TEST(Fingerprint, bytesAloneHaveThePublishedHash) {
    // Test vectors of the draft that the header names.
    const auto of = [](std::string_view text) { return fingerprint(std::as_bytes(std::span(text))); };
    EXPECT_EQ(of(""), 0xcbf29ce484222325ull);
    EXPECT_EQ(of("a"), 0xaf63dc4c8601ec8cull);
    EXPECT_EQ(of("foobar"), 0x85944171f73967e8ull);
}

} // namespace
} // namespace tessera::scenes
