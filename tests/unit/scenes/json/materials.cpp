#include <numbers>

#include <fmt/format.h>

#include "tests/unit/scenes/json/OneMaterial.h"

namespace tessera::scenes {
namespace {

using test::bound;
using test::errorOfMaterial;
using test::materialOf;
using test::redOf;
using test::SceneFolder;
using test::sceneOf;
using testing::ElementsAre;

TEST(SceneJsonMaterials, singleColorIsItsColor) {
    const SceneFolder folder;
    const Material material = materialOf(folder, R"("model": "single_color", "color": [0.25, 0.5, 3])");
    EXPECT_EQ(material.model, MaterialModel::SingleColor);
    EXPECT_EQ(material.baseColor, glm::vec4(0.25f, 0.5f, 3, 1));
}

TEST(SceneJsonMaterials, lambertHasItsDiffuseColorAndOpacity) {
    const SceneFolder folder;
    const Material material = materialOf(folder, R"("model": "lambert", "k_d": [0.25, 0.5, 0.75, 0.125])");
    EXPECT_EQ(material.model, MaterialModel::Lambert);
    EXPECT_EQ(material.baseColor, glm::vec4(0.25f, 0.5f, 0.75f, 0.125f));
    EXPECT_EQ(materialOf(folder, R"("model": "lambert")").baseColor, glm::vec4(1));
}

TEST(SceneJsonMaterials, microfacetHasItsFourParametersAndTheirTextures) {
    const SceneFolder folder;
    const Material material = materialOf(
        folder, R"("model": "microfacet", "k_d": [0.1, 0, 0], "k_s": [0.2, 0, 0], "ior": 0.75, "alpha": 0.3)");
    EXPECT_EQ(material.model, MaterialModel::Microfacet);
    EXPECT_EQ(material.baseColor, glm::vec4(0.1f, 0, 0, 1));
    EXPECT_EQ(material.specularColor, glm::vec3(0.2f, 0, 0));
    EXPECT_EQ(material.ior, 0.75f);
    EXPECT_EQ(material.alpha, 0.3f);
    const Material plain = materialOf(folder, R"("model": "microfacet")");
    EXPECT_EQ(plain.specularColor, glm::vec3(1));
    EXPECT_EQ(plain.ior, 1.5f);
    EXPECT_EQ(plain.alpha, 0.5f);

    const Scene textured = sceneOf(folder, R"("model": "microfacet",
        "k_d": {"texture": "pictures/albedo.tga"},
        "k_s": {"factor": [0.5, 0.5, 0.5], "texture": {"file": "pictures/specular.tga"}},
        "alpha": {"factor": 0.7, "texture": "pictures/normal.tga"},
        "ior": {"factor": 2, "texture": "pictures/albedo.tga"})");
    EXPECT_EQ(redOf(textured, TextureSlot::BaseColor), 10);
    EXPECT_EQ(redOf(textured, TextureSlot::SpecularColor), 40);
    EXPECT_EQ(redOf(textured, TextureSlot::MetallicRoughness), 128);
    EXPECT_EQ(redOf(textured, TextureSlot::Ior), 10);
    EXPECT_EQ(textured.images.size(), 3u); // albedo is decoded once
    EXPECT_EQ(textured.materials[0].specularColor, glm::vec3(0.5f));
    EXPECT_EQ(textured.materials[0].alpha, 0.7f);
    EXPECT_EQ(textured.materials[0].ior, 2.0f);
}

TEST(SceneJsonMaterials, metallicRoughnessHasItsParametersAndTheirTextures) {
    const SceneFolder folder;
    const Scene scene = sceneOf(folder, R"("model": "metallic_roughness",
        "baseColor": {"factor": [0.1, 0.2, 0.3, 0.4], "texture": "pictures/albedo.tga"},
        "metallic": 0.5, "perceptualRoughness": 0.25, "metallicRoughnessTexture": "pictures/specular.tga",
        "ior": {"factor": 1.25, "texture": "pictures/normal.tga"},
        "specularFactor": {"factor": 0.75, "texture": "pictures/albedo.tga"},
        "specularColor": {"factor": [2, 1, 0], "texture": "pictures/specular.tga"},
        "emissive": {"factor": [1, 2, 3], "texture": "pictures/normal.tga"}, "emissiveStrength": 10)");
    const Material& material = scene.materials[0];
    EXPECT_EQ(material.model, MaterialModel::MetallicRoughness);
    EXPECT_EQ(material.baseColor, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(material.metallic, 0.5f);
    EXPECT_EQ(material.perceptualRoughness, 0.25f);
    EXPECT_EQ(material.ior, 1.25f);
    EXPECT_EQ(material.specularFactor, 0.75f);
    EXPECT_EQ(material.specularColor, glm::vec3(2, 1, 0));
    EXPECT_EQ(material.emissive, glm::vec3(10, 20, 30));
    EXPECT_EQ(redOf(scene, TextureSlot::BaseColor), 10);
    EXPECT_EQ(redOf(scene, TextureSlot::MetallicRoughness), 40);
    EXPECT_EQ(redOf(scene, TextureSlot::Ior), 128);
    EXPECT_EQ(redOf(scene, TextureSlot::SpecularFactor), 10);
    EXPECT_EQ(redOf(scene, TextureSlot::SpecularColor), 40);
    EXPECT_EQ(redOf(scene, TextureSlot::Emissive), 128);
    EXPECT_EQ(materialOf(folder, R"("model": "metallic_roughness", "ior": 0)").ior, 0.0f);
}

TEST(SceneJsonMaterials, tangentsAreDerivedAsTheMaterialSays) {
    const SceneFolder folder;
    EXPECT_EQ(materialOf(folder, R"("model": "lambert")").tangents, TangentMethod::MikkTSpace);
    for (const char* model : {"lambert", "blinn_phong", "microfacet", "microfacet_anisotropic", "metallic_roughness"}) {
        const std::string start = fmt::format(R"("model": "{}", "tangents": )", model);
        EXPECT_EQ(materialOf(folder, start + R"("lengyel")").tangents, TangentMethod::Lengyel);
        EXPECT_EQ(materialOf(folder, start + R"("mikktspace")").tangents, TangentMethod::MikkTSpace);
    }
    EXPECT_EQ(errorOfMaterial(folder, R"("model": "lambert", "tangents": "mikk")"),
              "/materials/0/tangents: there is no way to derive tangents 'mikk'; did you mean 'mikktspace'?");
}

TEST(SceneJsonMaterials, normalMapsKeepTheirSpaceAndScale) {
    const SceneFolder folder;
    const std::string start = R"("model": "lambert", "normalMap": )";
    const Scene brief = sceneOf(folder, start + R"("pictures/normal.tga")");
    EXPECT_EQ(redOf(brief, TextureSlot::Normal), 128);
    EXPECT_EQ(brief.materials[0].normalMapSpace, NormalMapSpace::Tangent);
    EXPECT_EQ(brief.materials[0].normalScale, 1.0f);
    const Material tangent = materialOf(
        folder, start + R"({"file": "pictures/normal.tga", "space": "tangent", "scale": 0.5, "texCoord": 1})");
    EXPECT_EQ(tangent.normalScale, 0.5f);
    EXPECT_EQ(tangent.texture(TextureSlot::Normal).texCoordSet, 1);
    const Material object = materialOf(folder, start + R"({"file": "pictures/normal.tga", "space": "object"})");
    EXPECT_EQ(object.normalMapSpace, NormalMapSpace::Object);
    EXPECT_EQ(errorOfMaterial(folder, start + R"({"file": "pictures/normal.tga", "space": "object", "scale": 2})"),
              "/materials/0/normalMap/scale: only a tangent-space normal map can be scaled; remove it");
    EXPECT_EQ(errorOfMaterial(folder, start + R"({"file": "pictures/normal.tga", "space": "world"})"),
              "/materials/0/normalMap/space: there is no normal map space 'world'; valid are tangent, object");
}

TEST(SceneJsonMaterials, texturesKeepTransformAndSampler) {
    const SceneFolder folder;
    const TextureUse use = materialOf(folder, R"("model": "lambert", "k_d": {"texture": {
        "file": "pictures/albedo.tga", "texCoord": 1,
        "transform": {"offset": [0.25, 0.5], "scale": [2, 4], "rotationDegrees": 90},
        "sampler": {"magFilter": "nearest", "minFilter": "nearest_mipmap_linear",
                    "wrapU": "mirrored_repeat", "wrapV": "clamp_to_edge"}}})")
                               .texture(TextureSlot::BaseColor);
    EXPECT_EQ(use.texCoordSet, 1);
    EXPECT_EQ(use.transform.offset, glm::vec2(0.25f, 0.5f));
    EXPECT_EQ(use.transform.scale, glm::vec2(2, 4));
    EXPECT_FLOAT_EQ(use.transform.rotationRadians, std::numbers::pi_v<float> / 2);
    EXPECT_EQ(use.sampler.magnification, Filter::Nearest);
    EXPECT_EQ(use.sampler.minification, Filter::NearestMipmapLinear);
    EXPECT_EQ(use.sampler.wrapU, Wrap::MirroredRepeat);
    EXPECT_EQ(use.sampler.wrapV, Wrap::ClampToEdge);
}

TEST(SceneJsonMaterials, alphaModeAndSidesAreKept) {
    const SceneFolder folder;
    const Material mask =
        materialOf(folder, R"("model": "lambert", "alphaMode": "mask", "alphaCutoff": 0.25, "doubleSided": true)");
    EXPECT_EQ(mask.alphaMode, AlphaMode::Mask);
    EXPECT_EQ(mask.alphaCutoff, 0.25f);
    EXPECT_TRUE(mask.doubleSided);
    EXPECT_TRUE(mask.castsShadow);
    EXPECT_FALSE(materialOf(folder, R"("model": "lambert", "castsShadow": false)").castsShadow);
    EXPECT_EQ(materialOf(folder, R"("model": "lambert", "alphaMode": "blend")").alphaMode, AlphaMode::Blend);
    EXPECT_EQ(materialOf(folder, R"("model": "lambert")").alphaMode, AlphaMode::Opaque);
}

TEST(SceneJsonMaterials, blinnPhongHasItsThreeParametersAndTheirTextures) {
    const SceneFolder folder;
    const Material plain = materialOf(folder, R"("model": "blinn_phong")");
    EXPECT_EQ(plain.model, MaterialModel::BlinnPhong);
    EXPECT_EQ(plain.specularColor, glm::vec3(1));
    EXPECT_EQ(plain.exponent, 32.0f);
    const Scene scene = sceneOf(folder, R"("model": "blinn_phong", "k_d": [0.1, 0, 0],
        "k_s": {"factor": [0.2, 0, 0], "texture": "pictures/specular.tga"},
        "exponent": {"factor": 0.5, "texture": "pictures/normal.tga"})");
    EXPECT_EQ(scene.materials[0].baseColor, glm::vec4(0.1f, 0, 0, 1));
    EXPECT_EQ(scene.materials[0].specularColor, glm::vec3(0.2f, 0, 0));
    EXPECT_EQ(scene.materials[0].exponent, 0.5f);
    EXPECT_EQ(redOf(scene, TextureSlot::SpecularColor), 40);
    EXPECT_EQ(redOf(scene, TextureSlot::MetallicRoughness), 128);
    EXPECT_EQ(errorOfMaterial(folder, R"("model": "blinn_phong", "exponent": -1)"),
              "/materials/0/exponent: is -1; at least 0 is needed");
}

TEST(SceneJsonMaterials, microfacetAnisotropicHasTwoAlphasAndTheirTextures) {
    const SceneFolder folder;
    const Scene scene = sceneOf(folder, R"("model": "microfacet_anisotropic", "k_d": [0.1, 0, 0], "k_s": [0.2, 0, 0],
        "ior": 2, "alphaX": {"factor": 0.25, "texture": "pictures/normal.tga"},
        "alphaY": {"factor": 0.75, "texture": "pictures/specular.tga"}, "masking": "directional")");
    const Material& material = scene.materials[0];
    EXPECT_EQ(material.model, MaterialModel::MicrofacetAnisotropic);
    EXPECT_EQ(material.baseColor, glm::vec4(0.1f, 0, 0, 1));
    EXPECT_EQ(material.specularColor, glm::vec3(0.2f, 0, 0));
    EXPECT_EQ(material.ior, 2.0f);
    EXPECT_EQ(material.alpha, 0.25f);
    EXPECT_EQ(material.alphaY, 0.75f);
    EXPECT_EQ(redOf(scene, TextureSlot::MetallicRoughness), 128);
    EXPECT_EQ(redOf(scene, TextureSlot::Anisotropy), 40);
}

TEST(SceneJsonMaterials, maskingIsOneThatTheModelHas) {
    const SceneFolder folder;
    const auto masking = [&](const char* model, const char* name) {
        return materialOf(folder, fmt::format(R"("model": "{}", "masking": "{}")", model, name)).masking;
    };
    EXPECT_EQ(materialOf(folder, R"("model": "microfacet")").masking, Masking::Walter);
    EXPECT_EQ(masking("microfacet", "walter"), Masking::Walter);
    EXPECT_EQ(masking("microfacet", "half_vector"), Masking::HalfVector);
    EXPECT_EQ(masking("microfacet_anisotropic", "walter"), Masking::Walter);
    EXPECT_EQ(masking("microfacet_anisotropic", "directional"), Masking::Directional);
    EXPECT_EQ(masking("microfacet_anisotropic", "half_vector"), Masking::HalfVector);
    EXPECT_EQ(errorOfMaterial(folder, R"("model": "microfacet", "masking": "directional")"),
              "/materials/0/masking: there is no masking 'directional'; valid are walter, half_vector");
}

TEST(SceneJsonMaterials, whatTransmitsHasNoSubsurface) {
    Material material;
    material.subsurface.method = SubsurfaceMethod::DepthMap;
    EXPECT_EQ(scenes::subsurfaceOf(material, {}), SubsurfaceMethod::DepthMap);
    material.transmission = 0.5f;
    EXPECT_EQ(scenes::subsurfaceOf(material, {}), SubsurfaceMethod::None);
    EXPECT_EQ(scenes::subsurfaceOf(material, SubsurfaceMethod::TextureSpaceDiffusion), SubsurfaceMethod::None);
    material.model = MaterialModel::Lambert;
    EXPECT_EQ(scenes::subsurfaceOf(material, {}), SubsurfaceMethod::DepthMap) << "of which nothing transmits";
}

TEST(SceneJsonMaterials, aSubsurfaceIsAMethodOrAnObjectWithWhatMethodsUse) {
    const SceneFolder folder;
    const auto subsurfaceOf = [&](const std::string& json) {
        return sceneOf(folder, R"("model": "lambert", "subsurface": )" + json).materials[0].subsurface;
    };
    Subsurface wrap;
    wrap.method = SubsurfaceMethod::Wrap;
    EXPECT_EQ(subsurfaceOf(R"("wrap")"), wrap);
    Subsurface all;
    all.method = SubsurfaceMethod::DepthMap;
    all.scaleMetres = 0.125f;
    all.wrap = 0.25f;
    all.wrapTint = {1.0f, 0.5f, 0.0f};
    all.bodyRadiusMetres = 2.0f;
    all.absorptionPerMillimetre = {1.0f, 2.0f, 3.0f};
    all.preScatterShare = 1.0f;
    all.profile = {{0.5f, {1.0f, 0.25f, 0.0f}}, {2.0f, {0.0f, 0.75f, 1.0f}}};
    EXPECT_EQ(subsurfaceOf(R"({"method": "depth_map", "scaleMetres": 0.125, "wrap": 0.25, "wrapTint": [1, 0.5, 0],
        "bodyRadiusMetres": 2, "absorptionPerMillimetre": [1, 2, 3], "preScatterShare": 1,
        "profile": [{"varianceSquareMillimetres": 0.5, "weight": [1, 0.25, 0]},
                    {"varianceSquareMillimetres": 2, "weight": [0, 0.75, 1]}]})"),
              all);
    const DiffusionProfile marble = subsurfaceOf(R"({"profile": "marble"})").profile;
    EXPECT_EQ(marble, namedProfiles()[1].profile);
    const auto errorOf = [&](const std::string& json) {
        return errorOfMaterial(folder, R"("model": "lambert", "subsurface": )" + json);
    };
    EXPECT_EQ(errorOf(R"("warp")"),
              "/materials/0/subsurface: there is no subsurface method 'warp'; did you mean 'wrap'?");
    EXPECT_EQ(errorOf(R"({"profile": "skim"})"),
              "/materials/0/subsurface/profile: there is no profile 'skim'; did you mean 'skin'?");
    EXPECT_EQ(errorOf(R"({"wrap": 2})"), "/materials/0/subsurface/wrap: is 2; at most 1 is allowed");
    EXPECT_EQ(errorOf(R"({"wrapTint": [0, 2, 0]})"), "/materials/0/subsurface/wrapTint/1: is 2; at most 1 is allowed");
    EXPECT_EQ(folder.errorBeyondSchemaOf(
                  R"({"tessera": 1, "materials": [{"name": "m", "model": "lambert", "subsurface":
                     {"profile": [{"varianceSquareMillimetres": 1, "weight": [1, 0.5, 1]}]}}]})"),
              "/materials/0/subsurface/profile: the weights of its profile sum to 1, 0.5 and 1 in red, green and "
              "blue; divide them by their sums");
    EXPECT_EQ(errorOf(R"({"wraptint": [1, 1, 1]})"),
              "/materials/0/subsurface: a subsurface has no key 'wraptint'; did you mean 'wrapTint'?");
}

TEST(SceneJsonMaterials, modelsThatDoNotExistAreRefusedByName) {
    const SceneFolder folder;
    EXPECT_EQ(errorOfMaterial(folder, R"("model": "lambertian")"),
              "/materials/0/model: there is no material model 'lambertian'; did you mean 'lambert'?");
    EXPECT_EQ(errorOfMaterial(folder, R"("k_d": [1, 1, 1])"), "/materials/0: lacks the key 'model'; add it");
}

TEST(SceneJsonMaterials, parametersOfAnotherModelAreRefused) {
    const SceneFolder folder;
    EXPECT_EQ(errorOfMaterial(folder, R"("model": "lambert", "alpha": 0.5)"),
              "/materials/0: a lambert material has no key 'alpha'; did you mean 'alphaMode' or 'alphaCutoff'?");
    EXPECT_EQ(errorOfMaterial(folder, R"("model": "metallic_roughness", "metalic": 0.5)"),
              "/materials/0: a metallic_roughness material has no key 'metalic'; did you mean 'metallic'?");
    EXPECT_EQ(errorOfMaterial(folder, R"("model": "single_color", "normalMap": "pictures/normal.tga")"),
              "/materials/0: a single_color material has no key 'normalMap'; valid are name, model, replaces, color, "
              "alphaMode, alphaCutoff, doubleSided, castsShadow, fields");
    EXPECT_EQ(errorOfMaterial(folder, R"("model": "lambert", "k_d": {"factr": [1, 1, 1]})"),
              "/materials/0/k_d: a parameter with a texture has no key 'factr'; did you mean 'factor'?");
}

TEST(SceneJsonMaterials, numbersOutOfRangeAreRefused) {
    const SceneFolder folder;
    const std::string pbr = R"("model": "metallic_roughness", )";
    EXPECT_EQ(errorOfMaterial(folder, R"("model": "lambert", "k_d": [1, 1])"),
              "/materials/0/k_d: has 2 elements; at least 3 are needed");
    EXPECT_EQ(errorOfMaterial(folder, R"("model": "lambert", "k_d": [1, 1, 1, 1, 1])"),
              "/materials/0/k_d: has 5 elements; at most 4 are allowed");
    EXPECT_EQ(errorOfMaterial(folder, R"("model": "lambert", "k_d": [1, 1, 1, 2])"),
              "/materials/0/k_d/3: is 2; at most 1 is allowed");
    EXPECT_EQ(errorOfMaterial(folder, R"("model": "lambert", "k_d": 1)"),
              "/materials/0/k_d: is a number; an array is needed");
    EXPECT_EQ(errorOfMaterial(folder, R"("model": "microfacet", "ior": 0)"),
              "/materials/0/ior: is 0; more than 0 is needed");
    EXPECT_EQ(errorOfMaterial(folder, R"("model": "microfacet", "alpha": {"factor": -1})"),
              "/materials/0/alpha/factor: is -1; at least 0 is needed");
    EXPECT_EQ(errorOfMaterial(folder, pbr + R"("metallic": 1.5)"),
              "/materials/0/metallic: is 1.5; at most 1 is allowed");
    EXPECT_EQ(errorOfMaterial(folder, pbr + R"("ior": 0.5)"), "/materials/0/ior: is 0.5; 0 or at least 1 is needed");
    EXPECT_EQ(
        errorOfMaterial(folder, R"("model": "lambert", "normalMap": {"file": "pictures/normal.tga", "texCoord": 2})"),
        "/materials/0/normalMap/texCoord: is 2; at most 1 is allowed");
    EXPECT_EQ(folder.errorBeyondSchemaOfMembers(bound(pbr + R"("emissive": [1e30, 0, 0], "emissiveStrength": 1e30)")),
              "/materials/0/emissiveStrength: emissive times emissiveStrength is not finite in single precision; lower "
              "it");
}

TEST(SceneJsonMaterials, aMissingOrBrokenPictureIsNamed) {
    const SceneFolder folder;
    folder.write("pictures/broken.png", "no picture");
    const std::string folderName = folder.path().string();
    EXPECT_EQ(folder.errorBeyondSchemaOfMembers(bound(R"("model": "lambert", "k_d": {"texture": "none.png"})")),
              "/materials/0/k_d/texture: there is no file '" + folderName +
                  "/none.png'; names are relative to the document's folder");
    const std::string broken =
        folder.errorBeyondSchemaOfMembers(bound(R"("model": "lambert", "normalMap": {"file": "pictures/broken.png"})"));
    EXPECT_TRUE(broken.starts_with("/materials/0/normalMap/file: " + folderName + "/pictures/broken.png: ")) << broken;
}

TEST(SceneJsonMaterials, aNameGivenTwiceIsRefused) {
    const SceneFolder folder;
    EXPECT_EQ(folder.errorBeyondSchemaOfMembers(
                  R"("materials": [{"name": "a", "model": "lambert"}, {"name": "a", "model": "lambert"}])"),
              "/materials/1: the name 'a' is taken by element 0; give another");
}

TEST(SceneJsonMaterials, aMaterialThatNothingIsDrawnWithWarns) {
    const SceneFolder folder;
    const Scene scene = folder.importMembers(R"("materials": [{"name": "spare", "model": "lambert"}])");
    EXPECT_THAT(scene.warnings,
                ElementsAre((folder.path() / "scene.json").string() + ": nothing is drawn with the material 'spare'"));
    EXPECT_EQ(scene.materials.size(), 2u);
}

} // namespace
} // namespace tessera::scenes
