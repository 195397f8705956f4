// Degenerate meshes and normal maps: zero lengths, zero areas and missing attributes.
#include <filesystem>

#include <fmt/format.h>

#include "scenes/Defaults.h"
#include "validation/stress/StressCase.h"
#include "validation/stress/StressScene.h"

namespace tessera::validation {

namespace {

using scenes::TextureSlot;

frame::FrameSettings exactSettings() {
    frame::FrameSettings settings;
    settings.sizePixels = {64, 45};
    settings.filter = frame::TextureFilter::Exact;
    settings.display = false;
    return settings;
}

StressPicture pictureOf(std::string what, scenes::Scene scene) {
    return {std::move(what), std::move(scene), exactSettings()};
}

/// The stress scene with a uniform normal map on everything except the floor.
scenes::Scene mappedScene(const glm::ivec4& texel, scenes::NormalMapSpace space) {
    scenes::Scene scene = stressScene();
    const int image = addUniformImage(scene, texel);
    for (std::size_t i = 1; i < scene.materials.size(); ++i) {
        scene.materials[i].texture(TextureSlot::Normal).image = image;
        scene.materials[i].normalMapSpace = space;
    }
    return scene;
}

std::vector<StressPicture> normalMapPictures(StressEffort) {
    std::vector<StressPicture> pictures;
    struct Named {
        const char* what;
        glm::ivec4 texel;
    };
    for (const Named& named : {Named{"pointing away", {128, 128, 0, 255}},
                               {"sideways", {255, 128, 128, 255}},
                               {"steep", {250, 5, 140, 255}}}) {
        for (const auto space : {scenes::NormalMapSpace::Tangent, scenes::NormalMapSpace::Object}) {
            pictures.push_back(pictureOf(fmt::format("texels {}, {} space", named.what,
                                                     space == scenes::NormalMapSpace::Tangent ? "tangent" : "object"),
                                         mappedScene(named.texel, space)));
        }
    }
    return pictures;
}

/// Code values 127 and 128: the shortest normals that 8 bits can store.
std::vector<StressPicture> shortNormalPictures(StressEffort) {
    return {
        pictureOf("texels of 1/255, tangent space", mappedScene({127, 128, 128, 255}, scenes::NormalMapSpace::Tangent)),
        pictureOf("texels of 1/255, object space", mappedScene({127, 128, 127, 255}, scenes::NormalMapSpace::Object))};
}

/// Texels of exactly (1/2, 1/2, 1/2), normals of zero length, which 8 bits cannot store.
std::vector<StressPicture> zeroNormalPictures(StressEffort) {
    std::vector<StressPicture> pictures;
    for (const auto space : {scenes::NormalMapSpace::Tangent, scenes::NormalMapSpace::Object}) {
        scenes::Scene scene = mappedScene({128, 128, 128, 255}, space);
        scenes::Image& image = scene.images.front();
        image.format = scenes::TexelFormat::Rgba32Float;
        const std::array<float, 4> half{0.5f, 0.5f, 0.5f, 1.0f};
        image.texels.clear();
        for (int i = 0; i < image.width * image.height; ++i) {
            const auto bytes = std::as_bytes(std::span(half));
            image.texels.insert(image.texels.end(), bytes.begin(), bytes.end());
        }
        pictures.push_back(pictureOf(
            fmt::format("zero texels, {} space", space == scenes::NormalMapSpace::Tangent ? "tangent" : "object"),
            std::move(scene)));
    }
    return pictures;
}

/// The scene with tangent-space normal maps and modified meshes.
template <class Change>
StressPicture changedMeshes(const char* what, Change change) {
    scenes::Scene scene = mappedScene({180, 100, 220, 255}, scenes::NormalMapSpace::Tangent);
    // Meshes without a defined tangent allow any, so the lobes are isotropic and do not depend on it.
    for (scenes::Material& material : scene.materials) material.alphaY = material.alpha;
    for (scenes::Mesh& mesh : scene.meshes) change(mesh);
    return pictureOf(what, std::move(scene));
}

std::vector<StressPicture> degeneratePictures(StressEffort) {
    std::vector<StressPicture> pictures;
    pictures.push_back(changedMeshes("triangles without area among the others", [](scenes::Mesh& mesh) {
        const std::vector<std::uint32_t> good = mesh.indices;
        for (std::size_t i = 0; i + 2 < good.size(); i += 3) {
            mesh.indices.insert(mesh.indices.end(), {good[i], good[i], good[i + 1]});
            mesh.indices.insert(mesh.indices.end(), {good[i], good[i], good[i]});
        }
    }));
    pictures.push_back(changedMeshes("texture coordinates all in one point", [](scenes::Mesh& mesh) {
        for (glm::vec2& uv : mesh.texCoords[0]) uv = {0.25f, 0.75f};
    }));
    pictures.push_back(changedMeshes("texture coordinates on a line", [](scenes::Mesh& mesh) {
        for (glm::vec2& uv : mesh.texCoords[0]) uv = {uv.x, 0.5f * uv.x};
    }));
    pictures.push_back(changedMeshes("no texture coordinates", [](scenes::Mesh& mesh) { mesh.texCoords = {}; }));
    pictures.push_back(changedMeshes("normals of no length", [](scenes::Mesh& mesh) {
        for (std::size_t i = 0; i < mesh.normalsOS.size(); i += 3) mesh.normalsOS[i] = glm::vec3(0.0f);
    }));
    pictures.push_back(changedMeshes("tangents along the normals", [](scenes::Mesh& mesh) {
        for (const glm::vec3& normal : mesh.normalsOS) mesh.tangentsOS.emplace_back(normal, 1.0f);
    }));
    pictures.push_back(changedMeshes("mirrored texture coordinates", [](scenes::Mesh& mesh) {
        for (glm::vec2& uv : mesh.texCoords[0]) uv.x = -uv.x;
    }));
    return pictures;
}

} // namespace

void addGeometryCases(std::vector<StressCase>& cases) {
    const auto add = [&cases](const char* name, const char* holds, auto pictures) {
        cases.push_back({name, holds, StressBound::WorstRel, kBallTolerance, kBallReason, {}, pictures});
    };
    add("geometry/normal_map", "normals from maps that point away from the viewer, sideways and steeply",
        &normalMapPictures);
    cases.push_back({"geometry/short_normal",
                     "normal texels 1/255 long still have a direction",
                     StressBound::WorstRel,
                     1e-2,
                     "twice a texel less 1 keeps 6e-8 of 1/255: a direction right to 1.5e-5, over a cosine of 2e-3",
                     {},
                     &shortNormalPictures});
    add("geometry/zero_normal", "normal texels of no length fall back to the vertex normal", &zeroNormalPictures);
    add("geometry/degenerate", "triangles and texture coordinates without area, attributes that are missing",
        &degeneratePictures);
}

} // namespace tessera::validation
