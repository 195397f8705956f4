#include <numbers>

#include <fmt/format.h>

#include "tests/unit/scenes/Members.h"
#include "tests/unit/scenes/json/OneMaterial.h"

namespace tessera::scenes {
namespace {

using namespace test;

TEST_F(SceneJsonMaterials, everyModelHasItsParameters) {
    using enum MaterialModel;
    const struct {
        MaterialModel model;
        const char* keys;
        const char* members;
    } cases[] = {
        {SingleColor, R"("model": "single_color", "color": [0.25, 0.5, 3])", "baseColor 0.25 0.5 3 1"},
        {Lambert, R"("model": "lambert", "k_d": [0.25, 0.5, 0.75, 0.125])", "baseColor 0.25 0.5 0.75 0.125"},
        {Lambert, R"("model": "lambert")", "baseColor 1 1 1 1"},
        {Microfacet, R"("model": "microfacet", "k_d": [0.1, 0, 0], "k_s": [0.2, 0, 0], "ior": 0.75, "alpha": 0.3)",
         "baseColor 0.1 0 0 1, specularColor 0.2 0 0, ior 0.75, alpha 0.3"},
        {Microfacet, R"("model": "microfacet")", "specularColor 1 1 1, ior 1.5, alpha 0.5"},
        {BlinnPhong, R"("model": "blinn_phong")", "specularColor 1 1 1, exponent 32"},
        {MetallicRoughness, R"("model": "metallic_roughness", "ior": 0)", "ior 0"},
        {MetallicRoughness, R"("model": "metallic_roughness", "transmission": 0.75, "thicknessMetres": 0.02,
            "attenuationColor": [0.1, 0.5, 1], "attenuationDistanceMetres": 0.125, "dispersion": 0.25)",
         "transmission 0.75, thicknessMetres 0.02, attenuationColor 0.1 0.5 1, attenuationDistanceMetres 0.125, "
         "dispersion 0.25"},
        {MetallicRoughness, R"("model": "metallic_roughness", "iridescence": 0.75, "iridescenceIor": 1.5,
            "iridescenceThicknessNm": 250)",
         "iridescence 0.75, iridescenceIor 1.5, iridescenceThicknessNm 250"}};
    for (const auto& one : cases) {
        SCOPED_TRACE(one.keys);
        const Material material = materialOf(one.keys);
        EXPECT_EQ(material.model, one.model);
        EXPECT_EQ(material.alphaMode, AlphaMode::Opaque);
        EXPECT_EQ(isTransparent(material), material.transmission > 0.0f) << "whatever its alpha mode";
        expectMembers(material, one.members);
    }
}

/// Parameters and textures. The red value identifies a texture's image: 10 is albedo, 40 specular, 128 normal.
TEST_F(SceneJsonMaterials, everyModelHasTexturesOfItsParameters) {
    using enum TextureSlot;
    using Reds = std::vector<std::pair<TextureSlot, int>>;
    const struct {
        const char* keys;
        const char* members;
        Reds reds;
    } cases[] = {
        {R"("model": "microfacet", "k_d": {"texture": "pictures/albedo.tga"},
            "k_s": {"factor": [0.5, 0.5, 0.5], "texture": {"file": "pictures/specular.tga"}},
            "alpha": {"factor": 0.7, "texture": "pictures/normal.tga"},
            "ior": {"factor": 2, "texture": "pictures/albedo.tga"})",
         "specularColor 0.5 0.5 0.5, alpha 0.7, ior 2",
         {{BaseColor, 10}, {SpecularColor, 40}, {MetallicRoughness, 128}, {Ior, 10}}},
        {R"("model": "metallic_roughness",
            "baseColor": {"factor": [0.1, 0.2, 0.3, 0.4], "texture": "pictures/albedo.tga"},
            "metallic": 0.5, "perceptualRoughness": 0.25, "metallicRoughnessTexture": "pictures/specular.tga",
            "ior": {"factor": 1.25, "texture": "pictures/normal.tga"},
            "specularFactor": {"factor": 0.75, "texture": "pictures/albedo.tga"},
            "specularColor": {"factor": [2, 1, 0], "texture": "pictures/specular.tga"},
            "emissive": {"factor": [1, 2, 3], "texture": "pictures/normal.tga"}, "emissiveStrength": 10)",
         "baseColor 0.1 0.2 0.3 0.4, metallic 0.5, perceptualRoughness 0.25, ior 1.25, specularFactor 0.75, "
         "specularColor 2 1 0, emissive 10 20 30",
         {{BaseColor, 10},
          {MetallicRoughness, 40},
          {Ior, 128},
          {SpecularFactor, 10},
          {SpecularColor, 40},
          {Emissive, 128}}},
        {R"("model": "blinn_phong", "k_d": [0.1, 0, 0],
            "k_s": {"factor": [0.2, 0, 0], "texture": "pictures/specular.tga"},
            "exponent": {"factor": 0.5, "texture": "pictures/normal.tga"})",
         "baseColor 0.1 0 0 1, specularColor 0.2 0 0, exponent 0.5",
         {{SpecularColor, 40}, {MetallicRoughness, 128}}},
        {R"("model": "microfacet_anisotropic", "k_d": [0.1, 0, 0], "k_s": [0.2, 0, 0], "ior": 2,
            "alphaX": {"factor": 0.25, "texture": "pictures/normal.tga"},
            "alphaY": {"factor": 0.75, "texture": "pictures/specular.tga"}, "masking": "directional")",
         "baseColor 0.1 0 0 1, specularColor 0.2 0 0, ior 2, alpha 0.25, alphaY 0.75",
         {{MetallicRoughness, 128}, {Anisotropy, 40}}},
        {R"("model": "metallic_roughness", "anisotropyStrength": 0.5, "anisotropyTexture": "pictures/albedo.tga",
            "clearcoat": {"factor": 0.25, "texture": "pictures/specular.tga"},
            "clearcoatPerceptualRoughness": {"factor": 0.75, "texture": "pictures/normal.tga"},
            "clearcoatNormalMap": {"file": "pictures/normal.tga", "scale": 2, "texCoord": 1},
            "occlusionMap": {"file": "pictures/albedo.tga", "strength": 0.5, "texCoord": 1},
            "sheenColor": {"factor": [0.1, 0.2, 0.3], "texture": "pictures/albedo.tga"},
            "sheenPerceptualRoughness": {"factor": 0.125, "texture": "pictures/specular.tga"})",
         "anisotropyStrength 0.5, clearcoat 0.25, clearcoatPerceptualRoughness 0.75, clearcoatNormalScale 2, "
         "occlusionStrength 0.5, sheenColor 0.1 0.2 0.3, sheenPerceptualRoughness 0.125",
         {{Anisotropy, 10},
          {Clearcoat, 40},
          {ClearcoatRoughness, 128},
          {ClearcoatNormal, 128},
          {Occlusion, 10},
          {SheenColor, 10},
          {SheenRoughness, 40}}},
        {R"("model": "metallic_roughness", "transmission": {"factor": 0.75, "texture": "pictures/albedo.tga"},
            "thicknessMetres": {"factor": 0.5, "texture": {"file": "pictures/specular.tga", "texCoord": 1}},
            "iridescence": {"factor": 0.25, "texture": "pictures/specular.tga"},
            "iridescenceThicknessNm": {"factor": 250, "texture": "pictures/normal.tga"},
            "iridescenceLeastThicknessNm": 50)",
         "transmission 0.75, thicknessMetres 0.5, iridescence 0.25, iridescenceThicknessNm 250, "
         "iridescenceLeastThicknessNm 50",
         {{Transmission, 10}, {Thickness, 40}, {Iridescence, 40}, {IridescenceThickness, 128}}}};
    for (const auto& one : cases) {
        SCOPED_TRACE(one.keys);
        const Scene scene = sceneOf(one.keys);
        expectMembers(scene.materials[0], one.members);
        for (const auto& [slot, red] : one.reds) {
            EXPECT_EQ(redOf(scene, slot), red) << int(slot);
            const bool isSecond = slot == ClearcoatNormal || slot == Occlusion || slot == Thickness;
            EXPECT_EQ(scene.materials[0].texture(slot).texCoordSet, isSecond ? 1 : 0) << int(slot);
        }
        EXPECT_LE(scene.images.size(), 3u) << "each picture is decoded once";
    }
    const Scene brief = sceneOf(R"("model": "metallic_roughness", "occlusionMap": "pictures/albedo.tga")");
    EXPECT_EQ(redOf(brief, Occlusion), 10);
    EXPECT_EQ(brief.materials[0].occlusionStrength, 1.0f);
    EXPECT_FLOAT_EQ(
        materialOf(R"("model": "metallic_roughness", "anisotropyRotationDegrees": 90)").anisotropyRotationRadians,
        std::numbers::pi_v<float> / 2);
}

TEST_F(SceneJsonMaterials, tangentsAreDerivedAsTheMaterialSays) {
    EXPECT_EQ(materialOf(R"("model": "lambert")").tangents, TangentMethod::MikkTSpace);
    for (const char* model : {"lambert", "blinn_phong", "microfacet", "microfacet_anisotropic", "metallic_roughness"}) {
        const std::string start = fmt::format(R"("model": "{}", "tangents": )", model);
        EXPECT_EQ(materialOf(start + R"("lengyel")").tangents, TangentMethod::Lengyel);
        EXPECT_EQ(materialOf(start + R"("mikktspace")").tangents, TangentMethod::MikkTSpace);
    }
    EXPECT_EQ(errorOf(R"("model": "lambert", "tangents": "mikk")"),
              "/tangents: there is no way to derive tangents 'mikk'; did you mean 'mikktspace'?");
}

TEST_F(SceneJsonMaterials, normalMapsKeepTheirSpaceAndScale) {
    const std::string start = R"("model": "lambert", "normalMap": )";
    const Scene brief = sceneOf(start + R"("pictures/normal.tga")");
    EXPECT_EQ(redOf(brief, TextureSlot::Normal), 128);
    EXPECT_EQ(brief.materials[0].normalMapSpace, NormalMapSpace::Tangent);
    EXPECT_EQ(brief.materials[0].normalScale, 1.0f);
    const Material tangent =
        materialOf(start + R"({"file": "pictures/normal.tga", "space": "tangent", "scale": 0.5, "texCoord": 1})");
    EXPECT_EQ(tangent.normalScale, 0.5f);
    EXPECT_EQ(tangent.texture(TextureSlot::Normal).texCoordSet, 1);
    const Material object = materialOf(start + R"({"file": "pictures/normal.tga", "space": "object"})");
    EXPECT_EQ(object.normalMapSpace, NormalMapSpace::Object);
    EXPECT_EQ(errorOf(start + R"({"file": "pictures/normal.tga", "space": "object", "scale": 2})"),
              "/normalMap/scale: only a tangent-space normal map can be scaled; remove it");
    EXPECT_EQ(errorOf(start + R"({"file": "pictures/normal.tga", "space": "world"})"),
              "/normalMap/space: there is no normal map space 'world'; valid are tangent, object");
}

TEST_F(SceneJsonMaterials, texturesKeepTransformAndSampler) {
    const TextureUse use = materialOf(R"("model": "lambert", "k_d": {"texture": {
        "file": "pictures/albedo.tga", "texCoord": 1,
        "transform": {"offset": [0.25, 0.5], "scale": [2, 4], "rotationDegrees": 90},
        "sampler": {"magFilter": "nearest", "minFilter": "nearest_mipmap_linear",
                    "wrapU": "mirrored_repeat", "wrapV": "clamp_to_edge"}}})")
                               .texture(TextureSlot::BaseColor);
    EXPECT_EQ(use.texCoordSet, 1);
    EXPECT_EQ(use.transform.offset, glm::vec2(0.25f, 0.5f));
    EXPECT_EQ(use.transform.scale, glm::vec2(2, 4));
    EXPECT_FLOAT_EQ(use.transform.rotationRadians, std::numbers::pi_v<float> / 2);
    EXPECT_EQ(use.sampler,
              (Sampler{Filter::Nearest, Filter::NearestMipmapLinear, Wrap::MirroredRepeat, Wrap::ClampToEdge}));
}

TEST_F(SceneJsonMaterials, alphaModeAndSidesAreKept) {
    const Material mask =
        materialOf(R"("model": "lambert", "alphaMode": "mask", "alphaCutoff": 0.25, "doubleSided": true)");
    EXPECT_EQ(mask.alphaMode, AlphaMode::Mask);
    EXPECT_EQ(mask.alphaCutoff, 0.25f);
    EXPECT_TRUE(mask.doubleSided);
    EXPECT_TRUE(mask.castsShadow);
    EXPECT_FALSE(materialOf(R"("model": "lambert", "castsShadow": false)").castsShadow);
    EXPECT_EQ(materialOf(R"("model": "lambert", "alphaMode": "blend")").alphaMode, AlphaMode::Blend);
    EXPECT_EQ(materialOf(R"("model": "lambert")").alphaMode, AlphaMode::Opaque);
}

TEST_F(SceneJsonMaterials, maskingIsOneThatTheModelHas) {
    const auto masking = [&](const char* model, const char* name) {
        return materialOf(fmt::format(R"("model": "{}", "masking": "{}")", model, name)).masking;
    };
    EXPECT_EQ(materialOf(R"("model": "microfacet")").masking, Masking::Walter);
    for (const char* model : {"microfacet", "microfacet_anisotropic"}) {
        EXPECT_EQ(masking(model, "walter"), Masking::Walter) << model;
        EXPECT_EQ(masking(model, "half_vector"), Masking::HalfVector) << model;
    }
    EXPECT_EQ(masking("microfacet_anisotropic", "directional"), Masking::Directional);
    EXPECT_EQ(errorOf(R"("model": "microfacet", "masking": "directional")"),
              "/masking: there is no masking 'directional'; valid are walter, half_vector");
}

TEST_F(SceneJsonMaterials, whatTransmitsHasNoSubsurface) {
    Material material;
    material.subsurface.method = SubsurfaceMethod::DepthMap;
    EXPECT_EQ(scenes::subsurfaceOf(material, {}), SubsurfaceMethod::DepthMap);
    material.transmission = 0.5f;
    EXPECT_EQ(scenes::subsurfaceOf(material, {}), SubsurfaceMethod::None);
    EXPECT_EQ(scenes::subsurfaceOf(material, SubsurfaceMethod::TextureSpaceDiffusion), SubsurfaceMethod::None);
    material.model = MaterialModel::Lambert;
    EXPECT_EQ(scenes::subsurfaceOf(material, {}), SubsurfaceMethod::DepthMap) << "of which nothing transmits";
}

TEST_F(SceneJsonMaterials, aSubsurfaceIsAMethodOrAnObjectWithWhatMethodsUse) {
    const auto subsurfaceOf = [&](const std::string& json) {
        return sceneOf(R"("model": "lambert", "subsurface": )" + json).materials[0].subsurface;
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
    const auto refusal = [&](const std::string& json) {
        return errorOf(R"("model": "lambert", "subsurface": )" + json);
    };
    EXPECT_EQ(refusal(R"("warp")"), "/subsurface: there is no subsurface method 'warp'; did you mean 'wrap'?");
    EXPECT_EQ(refusal(R"({"profile": "skim"})"),
              "/subsurface/profile: there is no profile 'skim'; did you mean 'skin'?");
    EXPECT_EQ(refusal(R"({"wrap": 2})"), "/subsurface/wrap: is 2; at most 1 is allowed");
    EXPECT_EQ(refusal(R"({"wrapTint": [0, 2, 0]})"), "/subsurface/wrapTint/1: is 2; at most 1 is allowed");
    EXPECT_EQ(errorBeyondSchemaOf(R"("model": "lambert", "subsurface":
                  {"profile": [{"varianceSquareMillimetres": 1, "weight": [1, 0.5, 1]}]})"),
              "/subsurface/profile: the weights of its profile sum to 1, 0.5 and 1 in red, green and blue; divide them "
              "by their sums");
    EXPECT_EQ(refusal(R"({"wraptint": [1, 1, 1]})"),
              "/subsurface: a subsurface has no key 'wraptint'; did you mean 'wrapTint'?");
}

TEST_F(SceneJsonMaterials, mistakesAreRefusedByPlace) {
    const std::string lambert = R"("model": "lambert", )", pbr = R"("model": "metallic_roughness", )";
    for (const auto& [keys, error] : {
             std::pair<std::string, std::string>(
                 R"("model": "lambertian")",
                 "/model: there is no material model 'lambertian'; did you mean 'lambert'?"),
             {R"("k_d": [1, 1, 1])", ": lacks the key 'model'; add it"},
             // Parameters of another model.
             {lambert + R"("alpha": 0.5)",
              ": a lambert material has no key 'alpha'; did you mean 'alphaMode' or 'alphaCutoff'?"},
             {pbr + R"("metalic": 0.5)",
              ": a metallic_roughness material has no key 'metalic'; did you mean 'metallic'?"},
             {R"("model": "single_color", "normalMap": "pictures/normal.tga")",
              ": a single_color material has no key 'normalMap'; valid are name, model, replaces, color, alphaMode, "
              "alphaCutoff, doubleSided, castsShadow, fields"},
             {lambert + R"("k_d": {"factr": [1, 1, 1]})",
              "/k_d: a parameter with a texture has no key 'factr'; did you mean 'factor'?"},
             // Numbers out of range.
             {lambert + R"("k_d": [1, 1])", "/k_d: has 2 elements; at least 3 are needed"},
             {lambert + R"("k_d": [1, 1, 1, 1, 1])", "/k_d: has 5 elements; at most 4 are allowed"},
             {lambert + R"("k_d": [1, 1, 1, 2])", "/k_d/3: is 2; at most 1 is allowed"},
             {lambert + R"("k_d": 1)", "/k_d: is a number; an array is needed"},
             {R"("model": "microfacet", "ior": 0)", "/ior: is 0; more than 0 is needed"},
             {R"("model": "microfacet", "alpha": {"factor": -1})", "/alpha/factor: is -1; at least 0 is needed"},
             {R"("model": "blinn_phong", "exponent": -1)", "/exponent: is -1; at least 0 is needed"},
             {pbr + R"("metallic": 1.5)", "/metallic: is 1.5; at most 1 is allowed"},
             {pbr + R"("ior": 0.5)", "/ior: is 0.5; 0 or at least 1 is needed"},
             {pbr + R"("sheenColor": [0, 2, 0])", "/sheenColor/1: is 2; at most 1 is allowed"},
             {pbr + R"("clearcoat": -1)", "/clearcoat: is -1; at least 0 is needed"},
             {pbr + R"("transmission": 2)", "/transmission: is 2; at most 1 is allowed"},
             {pbr + R"("transmission": {"factor": 2})", "/transmission/factor: is 2; at most 1 is allowed"},
             {pbr + R"("thicknessMetres": -1)", "/thicknessMetres: is -1; at least 0 is needed"},
             {pbr + R"("dispersion": -1)", "/dispersion: is -1; at least 0 is needed"},
             {pbr + R"("attenuationColor": [0, 2, 0])", "/attenuationColor/1: is 2; at most 1 is allowed"},
             {pbr + R"("iridescenceIor": 0.5)", "/iridescenceIor: is 0.5; at least 1 is needed"},
             {pbr + R"("iridescenceLeastThicknessNm": -1)",
              "/iridescenceLeastThicknessNm: is -1; at least 0 is needed"},
             {lambert + R"("normalMap": {"file": "pictures/normal.tga", "texCoord": 2})",
              "/normalMap/texCoord: is 2; at most 1 is allowed"},
         })
        EXPECT_EQ(errorOf(keys), error);
    EXPECT_EQ(errorBeyondSchemaOf(pbr + R"("emissive": [1e30, 0, 0], "emissiveStrength": 1e30)"),
              "/emissiveStrength: emissive times emissiveStrength is not finite in single precision; lower it");
}

TEST_F(SceneJsonMaterials, aMissingOrBrokenPictureIsNamed) {
    folder.write("pictures/broken.png", "no picture");
    const std::string folderName = folder.path().string();
    EXPECT_EQ(errorBeyondSchemaOf(R"("model": "lambert", "k_d": {"texture": "none.png"})"),
              "/k_d/texture: there is no file '" + folderName +
                  "/none.png'; names are relative to the document's folder");
    const std::string broken =
        errorBeyondSchemaOf(R"("model": "lambert", "normalMap": {"file": "pictures/broken.png"})");
    EXPECT_TRUE(broken.starts_with("/normalMap/file: " + folderName + "/pictures/broken.png: ")) << broken;
}

TEST_F(SceneJsonMaterials, aNameGivenTwiceIsRefused) {
    EXPECT_EQ(folder.errorBeyondSchemaOfMembers(
                  R"("materials": [{"name": "a", "model": "lambert"}, {"name": "a", "model": "lambert"}])"),
              "/materials/1: the name 'a' is taken by element 0; give another");
}

TEST_F(SceneJsonMaterials, aMaterialThatNothingIsDrawnWithWarns) {
    const Scene scene = folder.importMembers(R"("materials": [{"name": "spare", "model": "lambert"}])");
    EXPECT_THAT(scene.warnings,
                ElementsAre((folder.path() / "scene.json").string() + ": nothing is drawn with the material 'spare'"));
    EXPECT_EQ(scene.materials.size(), 2u);
}

TEST_F(SceneJsonMaterials, onlyATextureThatMayGiveAFilmAThicknessMakesOneOfNone) {
    Material material;
    material.iridescence = 0.5f;
    material.iridescenceThicknessNm = 0.0f;
    EXPECT_FALSE(isIridescent(material));
    material.texture(TextureSlot::IridescenceThickness).image = 0;
    EXPECT_TRUE(isIridescent(material)) << "as thick as the least where the texture is 0";
    material.iridescenceLeastThicknessNm = 0.0f;
    EXPECT_FALSE(isIridescent(material));
}

TEST_F(SceneJsonMaterials, onlyMetallicRoughnessHasAFilmAndNoSubsurfaceBelowIt) {
    Material material;
    material.subsurface.method = SubsurfaceMethod::DepthMap;
    material.iridescence = 0.5f;
    for (const MaterialModelInfo& model : materialModels()) {
        material.model = model.model;
        EXPECT_EQ(isIridescent(material), model.model == MaterialModel::MetallicRoughness) << model.name;
    }
    material.model = MaterialModel::MetallicRoughness;
    EXPECT_EQ(subsurfaceOf(material, {}), SubsurfaceMethod::None);
    material.iridescenceThicknessNm = 0.0f;
    EXPECT_FALSE(isIridescent(material));
    EXPECT_EQ(subsurfaceOf(material, {}), SubsurfaceMethod::DepthMap);
}

TEST_F(SceneJsonMaterials, onlyMetallicRoughnessTransmits) {
    Material material;
    material.transmission = 1.0f;
    for (const MaterialModelInfo& model : materialModels()) {
        material.model = model.model;
        EXPECT_EQ(isTransmissive(material), model.model == MaterialModel::MetallicRoughness) << model.name;
    }
}

} // namespace
} // namespace tessera::scenes
