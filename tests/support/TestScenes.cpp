#include "tests/support/TestScenes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <numbers>
#include <string_view>

#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/Sweep.h"

namespace tessera::test {

using namespace scenes;

namespace {

/// An image of smooth, different values in every channel.
Image pattern(const std::string& name, int size, bool normalMap) {
    Image image;
    image.name = name;
    image.width = image.height = size;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const double u = double(x) / size, v = double(y) / size, turn = 2.0 * std::numbers::pi;
            const glm::dvec3 bumpy(0.3 * std::sin(3 * turn * u), 0.3 * std::cos(2 * turn * v), 1.0);
            const glm::dvec3 value =
                normalMap ? glm::normalize(bumpy) * 0.5 + 0.5
                          : glm::dvec3(0.6 + 0.4 * std::sin(turn * (u + v)), 0.3 + 0.6 * u, 0.2 + 0.7 * v);
            for (int c = 0; c < 3; ++c) image.texels.push_back(std::byte(std::lround(255.0 * value[c])));
            image.texels.push_back(std::byte((x / 4 + y / 4) % 3 == 0 ? 40 : 220));
        }
    }
    return image;
}

Mesh sphere(int slices, int stacks) {
    Mesh mesh;
    mesh.name = "sphere";
    for (int j = 0; j <= stacks; ++j) {
        for (int i = 0; i <= slices; ++i) {
            const double theta = std::numbers::pi * j / stacks, phi = 2.0 * std::numbers::pi * i / slices;
            const glm::vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi));
            mesh.positionsOS.push_back(n);
            mesh.normalsOS.push_back(n);
            mesh.texCoords[0].push_back({float(i) / float(slices), float(j) / float(stacks)});
        }
    }
    const auto index = [&](int i, int j) { return std::uint32_t(j * (slices + 1) + i); };
    for (int j = 0; j < stacks; ++j) {
        for (int i = 0; i < slices; ++i) {
            for (const std::uint32_t corner : {index(i, j), index(i, j + 1), index(i + 1, j + 1), index(i, j),
                                               index(i + 1, j + 1), index(i + 1, j)}) {
                mesh.indices.push_back(corner);
            }
        }
    }
    return mesh;
}

TextureUse textured(int image) {
    TextureUse use;
    use.image = image;
    return use;
}

constexpr int kColors = 0, kNormals = 1; ///< indices of images

/// Adds the models and layers whose lobes have a separate direction, exponent or normal.
void addLobes(std::vector<Material>& materials) {
    const auto add = [&](MaterialModel model, const char* name, const glm::vec3& color) -> Material& {
        Material material;
        material.name = name;
        material.model = model;
        material.baseColor = glm::vec4(color, 1.0f);
        return materials.emplace_back(material);
    };
    Material& phong = add(MaterialModel::BlinnPhong, "blinn_phong", {0.2f, 0.3f, 0.5f});
    phong.exponent = 60.0f;
    phong.specularColor = {0.8f, 0.7f, 0.4f};
    phong.texture(TextureSlot::MetallicRoughness) = textured(kColors);
    phong.texture(TextureSlot::SpecularColor) = textured(kColors);
    Material& brushed = add(MaterialModel::MicrofacetAnisotropic, "brushed, masking by direction", {0.2f, 0.1f, 0.1f});
    brushed.alpha = 0.7f;
    brushed.alphaY = 0.4f;
    brushed.ior = 2.5f;
    brushed.masking = Masking::Directional;
    brushed.texture(TextureSlot::Anisotropy) = textured(kColors);
    brushed.texture(TextureSlot::Normal) = textured(kNormals);
    brushed.texture(TextureSlot::Normal).transform = {{0.0f, 0.2f}, {-1.0f, 1.0f}, 0.7f};
    Material& silk = add(MaterialModel::MicrofacetAnisotropic, "silk, masking of Walter", {0.1f, 0.2f, 0.3f});
    silk.alpha = 0.2f;
    silk.alphaY = 0.7f;
    silk.ior = 2.0f;
    silk.doubleSided = true;
    Material& handout = add(MaterialModel::Microfacet, "masking by half vector", {0.3f, 0.2f, 0.1f});
    handout.alpha = 0.5f;
    handout.masking = Masking::HalfVector;
    Material& coated = add(MaterialModel::MetallicRoughness, "coated, anisotropic below", {0.7f, 0.2f, 0.1f});
    coated.metallic = 0.8f;
    coated.perceptualRoughness = 0.5f;
    coated.emissive = {0.05f, 0.1f, 0.02f};
    coated.anisotropyStrength = 0.9f;
    coated.anisotropyRotationRadians = 0.6f;
    coated.clearcoat = 0.9f;
    coated.clearcoatPerceptualRoughness = 0.5f;
    coated.clearcoatNormalScale = 0.8f;
    coated.texture(TextureSlot::Anisotropy) = textured(kColors);
    coated.texture(TextureSlot::Clearcoat) = textured(kColors);
    coated.texture(TextureSlot::ClearcoatRoughness) = textured(kColors);
    coated.texture(TextureSlot::ClearcoatNormal) = textured(kNormals);
    coated.texture(TextureSlot::Occlusion) = textured(kColors);
    coated.occlusionStrength = 0.7f;
    coated.texture(TextureSlot::ClearcoatNormal).transform = {{0.2f, 0.1f}, {1.0f, -1.0f}, 0.5f};
    Material& cloth = add(MaterialModel::MetallicRoughness, "cloth", {0.2f, 0.3f, 0.6f});
    cloth.metallic = 0.0f;
    cloth.perceptualRoughness = 0.9f;
    cloth.sheenColor = {0.9f, 0.8f, 0.5f};
    cloth.sheenPerceptualRoughness = 0.8f;
    cloth.texture(TextureSlot::SheenColor) = textured(kColors);
    cloth.texture(TextureSlot::SheenRoughness) = textured(kColors);
    cloth.subsurface.method = SubsurfaceMethod::Wrap;
    cloth.subsurface.wrap = 0.8f;
    cloth.subsurface.wrapTint = {0.2f, 1.0f, 0.6f};
}

constexpr int kMetalMaterial = 3, kMaskedMaterial = 5,
              kPaneMaterial = 6; ///< indices in everyMaterial(), all metallic-roughness

std::vector<Material> everyMaterial() {
    std::vector<Material> materials;
    const auto add = [&](MaterialModel model, const char* name) -> Material& {
        Material material;
        material.name = name;
        material.model = model;
        materials.push_back(material);
        return materials.back();
    };
    Material& unlit = add(MaterialModel::SingleColor, "unlit");
    unlit.baseColor = {0.2f, 0.5f, 1.4f, 1.0f};
    Material& lambert = add(MaterialModel::Lambert, "lambert");
    lambert.baseColor = {0.7f, 0.4f, 0.3f, 1.0f};
    lambert.texture(TextureSlot::BaseColor) = textured(kColors);
    lambert.texture(TextureSlot::BaseColor).transform = {{0.1f, 0.2f}, {2.0f, 3.0f}, 0.4f};
    Material& microfacet = add(MaterialModel::Microfacet, "microfacet, object-space normals");
    microfacet.baseColor = {0.3f, 0.5f, 0.3f, 1.0f};
    microfacet.alpha = 0.6f;
    microfacet.ior = 1.6f;
    microfacet.specularColor = {0.9f, 0.7f, 0.5f};
    microfacet.normalMapSpace = NormalMapSpace::Object;
    microfacet.texture(TextureSlot::Normal) = textured(kNormals);
    microfacet.texture(TextureSlot::SpecularColor) = textured(kColors);
    microfacet.texture(TextureSlot::MetallicRoughness) = textured(kColors);
    microfacet.texture(TextureSlot::Ior) = textured(kNormals);
    microfacet.subsurface.method = SubsurfaceMethod::Wrap;
    Material& metal = add(MaterialModel::MetallicRoughness, "metallic-roughness, tangent-space normals");
    metal.baseColor = {0.9f, 0.8f, 0.5f, 1.0f};
    metal.perceptualRoughness = 0.8f;
    metal.normalScale = 0.7f;
    metal.emissive = {0.02f, 0.01f, 0.05f};
    metal.texture(TextureSlot::Normal) = textured(kNormals);
    metal.texture(TextureSlot::Normal).transform = {{0.1f, 0.0f}, {1.0f, -1.0f}, -0.3f};
    metal.texture(TextureSlot::MetallicRoughness) = textured(kColors);
    metal.texture(TextureSlot::Emissive) = textured(kColors);
    Material& specular = add(MaterialModel::MetallicRoughness, "dielectric with specular textures, uv 1");
    specular.baseColor = {0.5f, 0.2f, 0.2f, 1.0f};
    specular.metallic = 0.0f;
    specular.perceptualRoughness = 0.4f;
    specular.ior = 1.8f;
    specular.specularFactor = 0.8f;
    specular.specularColor = {1.0f, 0.9f, 0.6f};
    specular.doubleSided = true;
    specular.texture(TextureSlot::SpecularFactor) = textured(kColors);
    specular.texture(TextureSlot::BaseColor) = textured(kColors);
    specular.texture(TextureSlot::BaseColor).texCoordSet = 1;
    Material& masked = add(MaterialModel::MetallicRoughness, "masked");
    masked.metallic = 0.0f;
    masked.alphaMode = AlphaMode::Mask;
    masked.doubleSided = true;
    masked.texture(TextureSlot::BaseColor) = textured(kColors);
    Material& glass = add(MaterialModel::MetallicRoughness, "blended");
    glass.baseColor = {0.4f, 0.6f, 0.9f, 0.5f};
    glass.metallic = 0.0f;
    glass.perceptualRoughness = 0.2f;
    glass.alphaMode = AlphaMode::Blend;
    glass.doubleSided = true;
    addLobes(materials);
    return materials;
}

Node nodeAt(const glm::dvec3& positionWS, const glm::dvec3& scale, int mesh, int material, double turnDegrees = 0.0) {
    Node node;
    node.name = "node";
    node.parentFromNode =
        glm::rotate(glm::translate(glm::dmat4(1.0), positionWS), glm::radians(turnDegrees), glm::dvec3(1, 0, 0));
    node.parentFromNode = glm::scale(node.parentFromNode, scale);
    node.instances = {{mesh, material}};
    return node;
}

Camera cameraAt(const glm::dvec3& eyeWS, const glm::dvec3& targetWS) {
    Camera camera;
    camera.name = "camera";
    camera.worldFromCamera = glm::inverse(glm::lookAt(eyeWS, targetWS, glm::dvec3(0, 1, 0)));
    return camera;
}

} // namespace

frame::DiffusionSettings coarseDiffusion() {
    frame::DiffusionSettings settings;
    settings.sideTexels = 64;
    return settings;
}

Scene builtinForSweep(const BuiltinScene& builtin, LoadOptions options) {
    constexpr std::string_view kOfManyLights[] = {"hall", "lattice", "lamps"}; // scenes of 256 lights and more
    constexpr int kFewerLights = 100; // as bright as with all lights (scenes/builtin/Places.h)
    if (!isWholeSweep() && std::ranges::find(kOfManyLights, builtin.name) != std::end(kOfManyLights))
        options.lights = kFewerLights;
    return loadScene(std::string(builtin.name), options);
}

bool isTakenBySweep(const BuiltinScene& builtin) {
    constexpr std::string_view kOfMostFeatures[] = {"models", "head_skin", "glass"};
    return std::ranges::find(kOfMostFeatures, builtin.name) != std::end(kOfMostFeatures);
}

std::vector<BuiltinScene> builtinsForSweep() {
    std::vector<BuiltinScene> taken;
    for (const BuiltinScene& builtin : builtinScenes())
        if (isWholeSweep() || isTakenBySweep(builtin)) taken.push_back(builtin);
    return taken;
}

std::span<const frame::Feature> featuresThatNoBuiltinForSweepHas() {
    static constexpr frame::Feature kMissing[] = {frame::featureOf(TextureSlot::MetallicRoughness),
                                                  frame::featureOf(LightType::Sphere)};
    return kMissing;
}

Mesh quad() {
    Mesh mesh;
    mesh.name = "quad";
    mesh.positionsOS = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.normalsOS.assign(4, {0, 0, 1});
    mesh.texCoords[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.texCoords[1] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
    mesh.colors = {{1, 1, 1, 1}, {0.5, 1, 1, 1}, {1, 0.5, 1, 1}, {1, 1, 0.5, 1}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

Scene modelUnderSun(const std::filesystem::path& file, double aspect) {
    LoadOptions options;
    options.defaultLight = false;
    options.aspect = aspect;
    Scene scene = loadScene(file.string(), options);
    if (!scene.lights.empty()) return scene;
    const glm::dmat3 worldFromCamera(scene.cameras[0].worldFromCamera);
    Light& sun = scene.lights.emplace_back();
    sun.name = "sun";
    sun.type = LightType::Directional;
    sun.intensity = 3.0f;
    sun.castsShadow = true;
    sun.directionWS = -glm::normalize(worldFromCamera * glm::dvec3(0.5, 0.75, 1.0));
    return scene;
}

Light pointLight(const glm::dvec3& positionWS, float candela) {
    Light light;
    light.name = "point";
    light.positionWS = positionWS;
    light.intensity = candela;
    return light;
}

Scene everythingScene() {
    Scene scene;
    scene.name = "everything";
    scene.images = {pattern("colours", 64, false), pattern("normals", 64, true)};
    scene.materials = everyMaterial();
    scene.meshes = {quad(), sphere(32, 20)};
    scene.nodes = {nodeAt({0, -1, 0}, {6, 6, 1}, 0, 1, -90.0),       nodeAt({-3, 0, -1}, {0.8, 0.8, 0.8}, 1, 0),
                   nodeAt({-1, 0, -1}, {0.9, 0.7, 0.9}, 1, 2),       nodeAt({1, 0, -1}, {-0.9, 0.9, 0.9}, 1, 3),
                   nodeAt({3, 0, -1}, {0.8, 0.8, 0.8}, 0, 4, 160.0), nodeAt({-0.5, 0.6, 1}, {0.7, 0.7, 0.7}, 0, 5),
                   nodeAt({1.2, 0.4, 1.5}, {0.6, 0.6, 0.6}, 0, 6),   nodeAt({1.6, 0.6, 2}, {0.5, 0.5, 0.5}, 0, 6)};
    constexpr int kFirstLobe = 7, kLobes = 6;
    for (int i = 0; i < kLobes; ++i) {
        const glm::dvec3 positionWS(1.5 * (i - 0.5 * (kLobes - 1)), 1.9, -2.5);
        const bool mirrored = i == 1;
        scene.nodes.push_back(nodeAt(positionWS, {mirrored ? -0.7 : 0.7, 0.6, 0.7}, 1, kFirstLobe + i, 20.0));
    }
    Light sun = pointLight({}, 1.0f);
    sun.type = LightType::Directional;
    sun.directionWS = glm::normalize(glm::dvec3(-0.4, -1.0, -0.5));
    Light spot = pointLight({0, 4, 2}, 30.0f);
    spot.type = LightType::Spot;
    spot.directionWS = glm::normalize(glm::dvec3(0.1, -1.0, -0.5));
    spot.innerConeRadians = 0.2f;
    spot.outerConeRadians = 0.6f;
    Light ranged = pointLight({-2, 1.5, 0.5}, 4.0f);
    ranged.rangeMetres = 4.0f;
    ranged.color = {1.0f, 0.6f, 0.3f};
    Light attenuated = pointLight({2.5, 1.0, 0.5}, 1.0f);
    attenuated.falloff = Falloff::Attenuation;
    attenuated.attenuation = {0.5f, 0.3f, 0.6f};
    Light off = pointLight({0, 1, 1}, 9.0f);
    off.enabled = false;
    scene.lights = {sun, spot, ranged, off, attenuated, pointLight({0, 2, 3}, 3.0f)};
    scene.cameras = {cameraAt({0, 1.5, 6}, {0, 0, 0})};
    scene.background = {0.05f, 0.06f, 0.08f};
    return scene;
}

scenes::Scene evenScene() {
    scenes::Scene scene = everythingScene();
    for (scenes::Material& material : scene.materials) {
        for (std::size_t i = 0; i < scenes::kTextureSlotCount; ++i) {
            const auto slot = static_cast<scenes::TextureSlot>(i);
            if (slot != scenes::TextureSlot::Normal && slot != scenes::TextureSlot::ClearcoatNormal)
                material.textures[i] = {};
        }
        material.anisotropyStrength = 0.0f;
        if (material.model == scenes::MaterialModel::MicrofacetAnisotropic) {
            material.model = scenes::MaterialModel::Microfacet;
            material.masking = {};
        }
    }
    for (scenes::Mesh& mesh : scene.meshes) mesh.colors.clear();
    return scene;
}

Scene metalScene() {
    Scene scene = everythingScene();
    for (Node& node : scene.nodes)
        for (MeshInstance& instance : node.instances)
            if (instance.material != kMaskedMaterial && instance.material != kPaneMaterial)
                instance.material = kMetalMaterial;
    return scene;
}

Scene lambertScene() {
    Scene scene = everythingScene();
    scene.name = "everything in lambert";
    for (Material& material : scene.materials) {
        if (material.model == MaterialModel::SingleColor) continue;
        Material plain;
        plain.name = material.name;
        plain.model = MaterialModel::Lambert;
        plain.baseColor = material.baseColor;
        plain.texture(TextureSlot::BaseColor) = material.texture(TextureSlot::BaseColor);
        plain.alphaMode = material.alphaMode;
        plain.alphaCutoff = material.alphaCutoff;
        plain.doubleSided = material.doubleSided;
        material = std::move(plain);
    }
    return scene;
}

Scene withUnusedOfEverything(Scene scene) {
    const Scene spare = everythingScene();
    const int images = int(spare.images.size()), materials = int(spare.materials.size()),
              meshes = int(spare.meshes.size());
    for (Material& material : scene.materials)
        for (scenes::TextureUse& use : material.textures)
            if (use.image != scenes::kNone) use.image += images;
    for (scenes::Node& node : scene.nodes)
        for (scenes::MeshInstance& instance : node.instances) {
            instance.mesh += meshes;
            instance.material += materials;
        }
    scene.images.insert(scene.images.begin(), spare.images.begin(), spare.images.end());
    scene.materials.insert(scene.materials.begin(), spare.materials.begin(), spare.materials.end());
    scene.meshes.insert(scene.meshes.begin(), spare.meshes.begin(), spare.meshes.end());
    Material& bright = scene.materials.emplace_back();
    bright.model = scenes::MaterialModel::Microfacet;
    bright.masking = scenes::Masking::HalfVector;
    bright.baseColor = glm::vec4(4.0f);
    bright.specularColor = glm::vec3(4.0f);
    scenes::Mesh painted = quad();
    painted.colors.assign(painted.positionsOS.size(), glm::vec4(4.0f));
    scene.meshes.push_back(painted);
    scene.meshes.emplace_back().name = "no triangles";
    scenes::Node& node = scene.nodes.emplace_back();
    for (int material = 0; material < materials; ++material)
        node.instances.push_back({int(scene.meshes.size()) - 1, material});
    node.instances.push_back({int(scene.meshes.size()) - 1, int(scene.materials.size()) - 1});
    scene.cameras.insert(scene.cameras.end(), spare.cameras.begin(), spare.cameras.end());
    return scene;
}

Scene quadScene(const Material& material) {
    Scene scene;
    scene.name = "quad";
    scene.materials = {material};
    scene.meshes = {quad()};
    scene.meshes[0].colors.clear();
    scene.nodes = {nodeAt({0, 0, 0}, {1, 1, 1}, 0, 0)};
    scene.cameras = {cameraAt({0, 0, 3}, {0, 0, 0})};
    scene.cameras[0].fovYRadians = 0.5;
    return scene;
}

} // namespace tessera::test
