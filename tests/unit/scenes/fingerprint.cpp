#include "scenes/Fingerprint.h"

#include <cmath>
#include <functional>
#include <set>

#include <gtest/gtest.h>

#include "scenes/Load.h"
#include "tests/support/LightPictures.h"
#include "tests/unit/scenes/RiggedScene.h"

namespace tessera::scenes {
namespace {

/// The smallest scene with one of everything that a scene may hold.
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
    std::string what;
    std::function<void(Scene&)> make;
};

void giveGaussian(Scene& scene, float variance, const glm::vec3& weight) {
    scene.materials[0].subsurface.profile = {{variance, weight}};
}

TextureUse& use(Scene& scene) {
    return scene.materials[0].texture(TextureSlot::BaseColor);
}

/// Changes a member of any type.
template <typename Value>
void change(Value& value) {
    if constexpr (std::is_same_v<Value, bool>)
        value = !value;
    else if constexpr (std::is_enum_v<Value>)
        value = Value(int(value) + 1);
    else if constexpr (std::is_floating_point_v<Value>)
        value = std::isfinite(value) ? value + Value(0.25) : Value(0.25);
    else if constexpr (requires { value.length(), value.x; })
        value[value.length() - 1] += 0.25f;
    else if constexpr (requires { value.has_value(); })
        value.has_value() ? value.reset() : void(value.emplace());
    else
        value.empty() ? void(value.emplace_back()) : value.clear();
}
void change(std::string& text) {
    text += 'x';
}
void change(LightCorners& corners) {
    corners.metres[3].y = 0.75f;
}
void change(LightTexture& texture) {
    texture = tessera::test::evenLightTexture(glm::vec3(1.0f), 1);
}
void change(Subsurface& subsurface) {
    subsurface.preScatterShare = 0.0f;
}

/// Adds a change of each member of a table, applied to the element that `elementOf` returns.
template <typename Fields, typename ElementOf>
void addFields(std::vector<Change>& changes, const char* of, const Fields& fields, ElementOf elementOf) {
    visitFields(fields, [&](const auto& field) {
        changes.push_back(
            {std::string(of) + field.name, [=](Scene& scene) { change(elementOf(scene).*field.member); }});
    });
}

std::vector<Change> changes() {
    std::vector<Change> table{
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
        {"subsurface.weight",
         [](Scene& s) {
             giveGaussian(s, 1.0f, {1.0f, 1.0f, 0.0f});
         }},
        {"subsurface.variance", [](Scene& s) { giveGaussian(s, 9.0f, glm::vec3(1.0f)); }},
        {"another material", [](Scene& s) { s.materials.emplace_back(); }},
        {"mesh.name", [](Scene& s) { s.meshes[0].name += 'x'; }},
        {"mesh.positions", [](Scene& s) { s.meshes[0].positionsOS[2].y = 5.0f; }},
        {"mesh.normals", [](Scene& s) { s.meshes[0].normalsOS[0].z = -1.0f; }},
        {"mesh.tangents", [](Scene& s) { s.meshes[0].tangentsOS.assign(3, glm::vec4(1.0f)); }},
        {"mesh.texCoords0", [](Scene& s) { s.meshes[0].texCoords[0].assign(3, glm::vec2(1.0f)); }},
        {"mesh.texCoords1", [](Scene& s) { s.meshes[0].texCoords[1].assign(3, glm::vec2(1.0f)); }},
        {"mesh.colors", [](Scene& s) { s.meshes[0].colors.assign(3, glm::vec4(1.0f)); }},
        {"mesh.indices", [](Scene& s) { std::swap(s.meshes[0].indices[0], s.meshes[0].indices[1]); }},
        {"node.name", [](Scene& s) { s.nodes[0].name += 'x'; }},
        {"node.parent", [](Scene& s) { s.nodes[0].parent = 0; }},
        {"node.transform", [](Scene& s) { s.nodes[0].parentFromNode[3][0] = 1.0; }},
        {"node.instances", [](Scene& s) { s.nodes[0].instances.clear(); }},
        {"instance.mesh", [](Scene& s) { s.nodes[0].instances[0].mesh = 1; }},
        {"instance.material", [](Scene& s) { s.nodes[0].instances[0].material = kNone; }},
        {"instance.castsShadow", [](Scene& s) { s.nodes[0].instances[0].castsShadow = false; }},
        {"light.cornerCount", [](Scene& s) { s.lights[0].corners.count = 3; }},
        {"light.texels", [](Scene& s) { s.lights[0].texture = tessera::test::evenLightTexture(glm::vec3(0.5f), 1); }},
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
        {"options.requested", [](Scene& s) { s.options.requested["layout"] = ""; }},
        {"an option's key", [](Scene& s) { s.options.requested["view"] = ""; }},
        {"an option's text", [](Scene& s) { s.options.requested["layout"] = "a"; }},
        {"an option's number", [](Scene& s) { s.options.requested["layout"] = 0.0; }},
        {"an option's list", [](Scene& s) { s.options.requested["layout"] = std::vector<double>(); }},
        {"an option's switch", [](Scene& s) { s.options.requested["layout"] = false; }},
        {"options.camera", [](Scene& s) { s.options.camera = ""; }},
        {"options.defaultLight", [](Scene& s) { s.options.defaultLight = false; }},
    };
    addFields(table, "material.", kMaterialFields, [](Scene& s) -> Material& { return s.materials[0]; });
    addFields(table, "subsurface.", kSubsurfaceFields,
              [](Scene& s) -> Subsurface& { return s.materials[0].subsurface; });
    addFields(table, "light.", kLightFields, [](Scene& s) -> Light& { return s.lights[0]; });
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
    // Without lengths in between, both would be the same bytes.
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
    // Benchmark files store it, so it is the same in every build: FNV-1a of 159 zero bytes, which are eighteen lengths
    // of 8, three floats of 4 and three absent options of 1.
    EXPECT_EQ(fingerprint(Scene()), 0xfbe08face1831d47ull);
}

TEST(Fingerprint, bytesAloneHaveThePublishedHash) {
    // Test vectors of the draft that the header cites.
    const auto of = [](std::string_view text) { return fingerprint(std::as_bytes(std::span(text))); };
    EXPECT_EQ(of(""), 0xcbf29ce484222325ull);
    EXPECT_EQ(of("a"), 0xaf63dc4c8601ec8cull);
    EXPECT_EQ(of("foobar"), 0x85944171f73967e8ull);
}

} // namespace
} // namespace tessera::scenes
