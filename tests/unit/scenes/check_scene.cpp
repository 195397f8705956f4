#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "base/Error.h"
#include "scenes/builtin/Pictures.h"
#include "tests/support/ErrorText.h"
#include "tests/unit/scenes/TinyScene.h"

namespace tessera::scenes {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

Environment sky(float radiance, float intensity, float rotationDegrees) {
    return {"test", builtin::drawRadiance("sky", 2, 1, [=](int, int) { return glm::dvec3(radiance); }), intensity,
            rotationDegrees};
}

/// Adds keyframes at the origin at these times.
LightKeys& giveKeyframes(Light& light, std::vector<double> timesSeconds) {
    LightAnimation& animation = light.animation.emplace();
    animation.kind = LightAnimationKind::Keyframes;
    animation.keys.values.assign(timesSeconds.size(), glm::dvec3(0.0));
    animation.keys.timesSeconds = std::move(timesSeconds);
    return animation.keys;
}

using Spoil = std::function<void(Scene&)>;

/// Sets a member of the only material, light or camera.
template <typename Member, typename Value>
Spoil with(Member Material::*member, Value value) {
    return [=](Scene& scene) { scene.materials[0].*member = value; };
}
template <typename Member, typename Value>
Spoil with(Member Light::*member, Value value) {
    return [=](Scene& scene) { scene.lights[0].*member = value; };
}
template <typename Member, typename Value>
Spoil with(Member Camera::*member, Value value) {
    return [=](Scene& scene) { scene.cameras[0].*member = value; };
}
Spoil both(Spoil first, Spoil second) {
    return [=](Scene& scene) {
        first(scene);
        second(scene);
    };
}

/// The message checkScene() gives for the tiny scene after `spoil`, or "" when it passes.
std::string verdict(const Spoil& spoil) {
    Scene scene = tinyScene();
    scene.lights.emplace_back().name = "lamp";
    scene.cameras.emplace_back().name = "eye";
    spoil(scene);
    return tessera::test::errorText<InputError>([&] { checkScene(scene); });
}

TEST(CheckScene, soundScenePasses) {
    EXPECT_EQ(verdict([](Scene&) {}), "");
    EXPECT_EQ(verdict([](Scene& s) { s = Scene(); }), "");
    EXPECT_EQ(verdict(with(&Light::alongWS, Light().directionWS)), "") << "of a point light, which has no width";
    EXPECT_EQ(verdict(both(with(&Light::type, LightType::Rectangle), with(&Light::widthMetres, 0.0f))), "") << "dark";
}

TEST(CheckScene, messageNamesSceneAndElement) {
    EXPECT_EQ(verdict([](Scene& s) { s.nodes[0].instances[0].mesh = 7; }),
              "scene 'tiny': node 0 'root': refers to mesh 7, but there are 1");
    EXPECT_EQ(verdict([](Scene& s) { s.nodes[0].instances[0].material = kNone; }),
              "scene 'tiny': node 0 'root': refers to material -1, but there are 1");
    EXPECT_EQ(verdict([](Scene& s) { s.meshes[0].indices[1] = 3; }),
              "scene 'tiny': mesh 0 'triangle': index 1 is 3, but there are 3 vertices");
    EXPECT_EQ(verdict([](Scene& s) { s.meshes[0].positionsOS[2].y = kNaN; }),
              "scene 'tiny': mesh 0 'triangle': entry 2 of its positions is not finite");
    EXPECT_EQ(verdict([](Scene& s) { s.meshes[0].normalsOS.pop_back(); }),
              "scene 'tiny': mesh 0 'triangle': has 3 positions but 2 normals");
    EXPECT_EQ(verdict(both(with(&Light::falloff, Falloff::Attenuation), with(&Light::attenuation, glm::vec3(0.0f)))),
              "scene 'tiny': light 0 'lamp': the attenuation coefficients A, B, C are all 0; give at least one");
    EXPECT_EQ(verdict(both(with(&Material::model, MaterialModel::Microfacet),
                           with(&Material::masking, Masking::Directional))),
              "scene 'tiny': material 0 'white': masking by direction needs the model microfacet_anisotropic");
    EXPECT_EQ(verdict([](Scene& s) { s.options.camera = "door"; }),
              "scene 'tiny': the option camera names 'door', but no camera is called that");
}

TEST(CheckScene, aNameThatNoMessageCanShowIsRefused) {
    const std::string longest(4096, 'x');
    EXPECT_EQ(verdict([&](Scene& s) { s.name = s.nodes[0].name = s.materials[0].name = longest; }), "");
    EXPECT_EQ(verdict([&](Scene& s) { s.nodes[0].name = longest + "x"; }),
              "scene 'tiny': a node has a name of 4097 bytes, and at most 4096 can be used; shorten it");
    EXPECT_EQ(verdict([&](Scene& s) { s.name = longest + "x"; }),
              "scene '" + std::string(40, 'x') +
                  "': a scene has a name of 4097 bytes, and at most 4096 can be used; shorten it");
}

TEST(CheckScene, eachBrokenRuleIsReported) {
    using testing::HasSubstr;
    const std::vector<std::pair<const char*, Spoil>> cases = {
        {"both must be positive", [](Scene& s) { s.images.emplace_back(); }},
        {"need 16",
         [](Scene& s) {
             Image& image = s.images.emplace_back();
             image.width = image.height = 2;
         }},
        {"texel is not finite",
         [](Scene& s) {
             Image& image = s.images.emplace_back();
             image.format = TexelFormat::Rgba32Float;
             image.width = image.height = 1;
             image.texels.assign(16, std::byte{0xff});
         }},
        {"base colour", [](Scene& s) { s.materials[0].baseColor.y = kNaN; }},
        {"emission", [](Scene& s) { s.materials[0].emissive.x = -1.0f; }},
        {"alphaY", with(&Material::alphaY, -0.1f)},
        {"exponent", with(&Material::exponent, kNaN)},
        {"anisotropy must", with(&Material::anisotropyStrength, 1.1f)},
        {"anisotropy's rotation", with(&Material::anisotropyRotationRadians, kInfinity)},
        {"clearcoat must", with(&Material::clearcoat, kNaN)},
        {"clearcoat's roughness", with(&Material::clearcoatPerceptualRoughness, -1.0f)},
        {"clearcoat normal map's scale", with(&Material::clearcoatNormalScale, kNaN)},
        {"sheen's colour", [](Scene& s) { s.materials[0].sheenColor.y = 1.5f; }},
        {"sheen's roughness", with(&Material::sheenPerceptualRoughness, 2.0f)},
        {"iridescence must", with(&Material::iridescence, 1.1f)},
        {"film's index of refraction", with(&Material::iridescenceIor, 0.9f)},
        {"film's thickness", with(&Material::iridescenceThicknessNm, kNaN)},
        {"film's least thickness", with(&Material::iridescenceLeastThicknessNm, -1.0f)},
        {"transmission must", with(&Material::transmission, 1.1f)},
        {"thickness must", with(&Material::thicknessMetres, -0.1f)},
        {"attenuation's colour", [](Scene& s) { s.materials[0].attenuationColor.y = 1.5f; }},
        {"attenuation's distance", with(&Material::attenuationDistanceMetres, kNaN)},
        {"dispersion must", with(&Material::dispersion, -0.1f)},
        {"specular colour", [](Scene& s) { s.materials[0].specularColor.x = kInfinity; }},
        {"metalness", with(&Material::metallic, 1.5f)},
        {"roughness", with(&Material::perceptualRoughness, kNaN)},
        {"alpha must", with(&Material::alpha, -0.1f)},
        {"index of refraction", with(&Material::ior, kInfinity)},
        {"specular factor", with(&Material::specularFactor, 2.0f)},
        {"normal map's scale", with(&Material::normalScale, kNaN)},
        {"cutoff", with(&Material::alphaCutoff, kNaN)},
        {"scale of its subsurface must", [](Scene& s) { s.materials[0].subsurface.scaleMetres = 0.0f; }},
        {"wrap of its subsurface must", [](Scene& s) { s.materials[0].subsurface.wrap = 1.5f; }},
        {"tint of its subsurface's wrap", [](Scene& s) { s.materials[0].subsurface.wrapTint.y = kNaN; }},
        {"body's radius", [](Scene& s) { s.materials[0].subsurface.bodyRadiusMetres = -1.0f; }},
        {"body's radius", [](Scene& s) { s.materials[0].subsurface.bodyRadiusMetres = 2e6f; }},
        {"absorption of its subsurface",
         [](Scene& s) { s.materials[0].subsurface.absorptionPerMillimetre.x = kInfinity; }},
        {"share of albedo before", [](Scene& s) { s.materials[0].subsurface.preScatterShare = -0.5f; }},
        {"has 9 Gaussians; give 1 to 8", [](Scene& s) { s.materials[0].subsurface.profile.resize(9); }},
        {"a variance of its profile",
         [](Scene& s) { s.materials[0].subsurface.profile.push_back({-1.0f, glm::vec3(1.0f)}); }},
        {"a weight of its profile",
         [](Scene& s) { s.materials[0].subsurface.profile.emplace_back(1.0f, glm::vec3(kNaN)); }},
        {"sum to 1.267, 1 and 1 in red, green and blue; divide",
         [](Scene& s) {
             s.materials[0].subsurface.profile = namedProfiles()[0].profile;
             s.materials[0].subsurface.profile[0].weight.x = 0.5f;
         }},
        {"256 materials have a subsurface, and at most 255 can",
         [](Scene& s) {
             s.materials[0].subsurface.method = SubsurfaceMethod::Wrap;
             s.materials.resize(256, s.materials[0]);
         }},
        {"image 0, but there are 0", [](Scene& s) { s.materials[0].texture(TextureSlot::Normal).image = 0; }},
        {"tangents", [](Scene& s) { s.meshes[0].tangentsOS.resize(2); }},
        {"colours", [](Scene& s) { s.meshes[0].colors.resize(4, glm::vec4(1.0f)); }},
        {"texture coordinates", [](Scene& s) { s.meshes[0].texCoords[1].resize(1); }},
        {"whole number of triangles", [](Scene& s) { s.meshes[0].indices.pop_back(); }},
        {"does not stand before it", [](Scene& s) { s.nodes[0].parent = 0; }},
        {"does not stand before it", [](Scene& s) { s.nodes[0].parent = -2; }},
        {"transform is not finite", [](Scene& s) { s.nodes[0].parentFromNode[3].x = kNaN; }},
        {"colour must", [](Scene& s) { s.lights[0].color.x = -0.5f; }},
        {"intensity", with(&Light::intensity, kInfinity)},
        {"position", [](Scene& s) { s.lights[0].positionWS.z = kNaN; }},
        {"more than 1e+15 m from the origin; move", [](Scene& s) { s.lights[0].positionWS.z = -1.1e15; }},
        {"leads more than 1e+15 m", [](Scene& s) { s.lights[0].animation.emplace().amplitudeMetres.y = 1e16; }},
        {"more than 1e+15 m from the origin; make", [](Scene& s) { s.nodes[0].parentFromNode *= glm::dmat4(1e30); }},
        {"stands more than 1e+15 m", [](Scene& s) { s.cameras[0].worldFromCamera[3].x = 1e16; }},
        {"near plane at 1e-30 m must lie 1e-09 to 1e+15 m ahead", with(&Camera::nearMetres, 1e-30)},
        {"near plane at 1e+16 m must lie 0 to 1e+15 m ahead",
         both(with(&Camera::projection, Projection::Orthographic), with(&Camera::nearMetres, 1e16))},
        {"half height of 1e+30 m must be at most 1e+15 m",
         both(with(&Camera::projection, Projection::Orthographic), with(&Camera::halfHeightMetres, 1e30))},
        {"unit length", with(&Light::directionWS, glm::dvec3(0.0))},
        {"the direction of its width must be of unit length", [](Scene& s) { s.lights[0].alongWS *= 2.0; }},
        {"the direction of its width must be at right angles to its direction",
         both(with(&Light::type, LightType::Rectangle), with(&Light::alongWS, glm::normalize(glm::dvec3(1.0, 0.0, 0.01))))},
        {"its corners 1 and 3 lie in one place; keep one",
         [](Scene& s) { s.lights[0].corners.metres[3] = s.lights[0].corners.metres[1]; }},
        {"its corners number 9; 3 to 8 are needed", [](Scene& s) { s.lights[0].corners.count = 9; }},
        {"the width must be between 0 and 1e+06 m", with(&Light::widthMetres, 1.1e6f)},
        {"the height must be between 0 and 1e+06 m", with(&Light::heightMetres, -1.0f)},
        {"the length must be between 0 and 1e+06 m", with(&Light::lengthMetres, kNaN)},
        {"a tube light falls off by its shape",
         both(with(&Light::type, LightType::Tube), with(&Light::falloff, Falloff::Attenuation))},
        {"range", with(&Light::rangeMetres, -1.0f)},
        {"range", with(&Light::rangeMetres, kNaN)},
        {"A, B, C must", with(&Light::attenuation, glm::vec3(1.0f, -1.0f, 0.0f))},
        {"inner cone of 1 radians is wider than its outer cone of 0.785398 radians; make it narrower",
         with(&Light::innerConeRadians, 1.0f)},
        {"the half angle of the outer cone must be between 0 and 3.14159 radians",
         with(&Light::outerConeRadians, 3.2f)},
        {"the half angle of the inner cone must be between 0 and 3.14159 radians",
         with(&Light::innerConeRadians, -0.1f)},
        {"period", [](Scene& s) { s.lights[0].animation.emplace().periodSeconds = 0.0; }},
        {"axis of its orbit", [](Scene& s) { s.lights[0].animation.emplace().axisWS = glm::dvec3(0.0); }},
        {"two points", [](Scene& s) { s.lights[0].animation.emplace().kind = LightAnimationKind::Path; }},
        {"its path has no length",
         [](Scene& s) {
             LightAnimation& animation = s.lights[0].animation.emplace();
             animation.kind = LightAnimationKind::Path;
             animation.pointsWS.assign(3, glm::dvec3(1.0));
         }},
        {"key times", [](Scene& s) { s.lights[0].animation.emplace().kind = LightAnimationKind::Keyframes; }},
        {"ascend", [](Scene& s) { giveKeyframes(s.lights[0], std::vector{1.0, 1.0}); }},
        {"amplitude of its flicker", [](Scene& s) { s.lights[0].flicker.emplace().amplitude = kNaN; }},
        {"frequency of its flicker", [](Scene& s) { s.lights[0].flicker.emplace().frequencyHz = 0.0; }},
        {"seed of its flicker", [](Scene& s) { s.lights[0].flicker.emplace().seed = -1; }},
        {"0 in-tangents and 0 out-tangents for 1 key times",
         [](Scene& s) { giveKeyframes(s.lights[0], {1.0}).interpolation = Interpolation::CubicSpline; }},
        {"a tangent of its keys",
         [](Scene& s) {
             LightKeys& keys = giveKeyframes(s.lights[0], {1.0});
             keys.interpolation = Interpolation::CubicSpline;
             keys.inTangents.assign(1, glm::dvec3(kNaN));
             keys.outTangents.assign(1, glm::dvec3(0.0));
         }},
        {"of unit length",
         [](Scene& s) {
             LightKeys& keys = s.lights[0].keyframes.emplace_back(giveKeyframes(s.lights[0], {1.0}));
             keys.of = LightKeyed::Direction;
         }},
        {"has keyframes of its color twice",
         [](Scene& s) {
             s.lights[0].keyframes.assign(2, giveKeyframes(s.lights[0], {1.0}));
             for (LightKeys& keys : s.lights[0].keyframes) keys.of = LightKeyed::Color;
         }},
        {"belong into its animation", [](Scene& s) { s.lights[0].keyframes = {giveKeyframes(s.lights[0], {1.0})}; }},
        {"must be of position", [](Scene& s) { giveKeyframes(s.lights[0], {1.0}).of = LightKeyed::Color; }},
        {"a key of its intensity is not finite",
         [](Scene& s) {
             LightKeys& keys = s.lights[0].keyframes.emplace_back(giveKeyframes(s.lights[0], {1.0}));
             keys.of = LightKeyed::Intensity;
             keys.values[0].x = kNaN;
         }},
        {"only rotate and move", [](Scene& s) { s.cameras[0].worldFromCamera[0].x = 2.0; }},
        {"only rotate and move", [](Scene& s) { s.cameras[0].worldFromCamera[0].x = -1.0; }},
        {"far plane", with(&Camera::farMetres, 0.05)},
        {"far plane", with(&Camera::farMetres, kNaN)},
        {"near plane", with(&Camera::nearMetres, 0.0)},
        {"field of view", with(&Camera::fovYRadians, 4.0)},
        {"half height",
         both(with(&Camera::projection, Projection::Orthographic), with(&Camera::halfHeightMetres, 0.0))},
        {"the base colour", [](Scene& s) { s.materials[0].baseColor.x = 1.1e6f; }},
        {"the specular colour", [](Scene& s) { s.materials[0].specularColor.x = 1.1e6f; }},
        {"the emission", [](Scene& s) { s.materials[0].emissive.x = 1.1e30f; }},
        {"alpha", with(&Material::alpha, 1.1e6f)},
        {"alphaY", with(&Material::alphaY, 1.1e6f)},
        {"the index of refraction", with(&Material::ior, 1.1e6f)},
        {"background", [](Scene& s) { s.background.x = kNaN; }},
        {"the option exposureEV is not finite", [](Scene& s) { s.options.requested["exposureEV"] = double(kNaN); }},
        {"environment 0 'sky': its intensity must be finite and not negative",
         [](Scene& s) { s.environment = sky(1.0f, kInfinity, 0.0f); }},
        {"its intensity must be finite and not negative", [](Scene& s) { s.environment = sky(1.0f, -1.0f, 0.0f); }},
        {"its rotation must be finite", [](Scene& s) { s.environment = sky(1.0f, 1.0f, kNaN); }},
        {"its rotation must be finite", [](Scene& s) { s.environment = sky(1.0f, 1.0f, -kInfinity); }},
        {"a texel is not finite", [](Scene& s) { s.environment = sky(kInfinity, 1.0f, 0.0f); }},
        {"a texel is below 0", [](Scene& s) { s.environment = sky(-1.0f, 1.0f, 0.0f); }},
        {"its brightest texel times its intensity is 2e+30, and at most 1e+30 can be shown; lower its intensity",
         [](Scene& s) { s.environment = sky(2e20f, 1e10f, 0.0f); }},
        {"the option size is not finite",
         [](Scene& s) { s.options.requested["size"] = std::vector<double>{double(kNaN), 5.0}; }},
    };
    for (const auto& [text, spoil] : cases) EXPECT_THAT(verdict(spoil), HasSubstr(text));
}

TEST(CheckScene, extremesThatAreAllowedPass) {
    EXPECT_EQ(verdict([](Scene& s) {
                  Light& light = s.lights[0];
                  light.type = LightType::Spot;
                  light.intensity = 1e20f;
                  light.rangeMetres = 0.0f;
                  light.innerConeRadians = light.outerConeRadians = 3.14159265f;
                  s.cameras[0].farMetres = std::numeric_limits<double>::infinity();
                  s.materials[0].ior = 1e6f;
                  s.materials[0].alpha = 0.0f;
                  s.environment = sky(1e-8f, 1e38f, -3e38f);
              }),
              "");
    // Bounds rounded to single precision, as files give them, are accepted.
    for (const double scale : {kLeastScaleMetres, kMostScaleMetres})
        EXPECT_EQ(verdict([=](Scene& s) { s.materials[0].subsurface.scaleMetres = float(scale); }), "") << scale;
}

} // namespace
} // namespace tessera::scenes
