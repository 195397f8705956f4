#include "scenes/builtin/HeadScan.h"

#include <cstdlib>
#include <system_error>

#include "base/Error.h"
#include "scenes/builtin/Author.h"
#include "scenes/import/Importers.h"

namespace tessera::scenes::builtin {

std::optional<std::filesystem::path> headScanFolder() {
    const char* assets = std::getenv("TESSERA_ASSETS");
    if (assets == nullptr || *assets == '\0') return std::nullopt;
    std::filesystem::path folder = std::filesystem::path(assets) / "LeePerrySmith";
    std::error_code failure;
    if (!std::filesystem::is_regular_file(folder / "head.obj", failure)) return std::nullopt;
    return folder;
}

int addHeadScan(Scene& scene, const std::filesystem::path& folder, double bottomY, double heightMetres,
                const ScanPaint& paint, LoadLedger& ledger) {
    Scene scan = importObj(folder / "head.obj", ledger);
    const Box3 boundsWS = worldBounds(scan);
    if (boundsWS.empty() || boundsWS.max.y <= boundsWS.min.y) {
        throw InputError((folder / "head.obj").string() + ": holds no surface; get the model again");
    }
    Material skin = microfacet("head", paint.value_or(glm::vec3(1.0f)), 1.4f, 0.35f);
    skin.normalMapSpace = NormalMapSpace::Object;
    if (!paint) {
        skin.texture(TextureSlot::BaseColor).image = addImage(scene, readImage(folder / "albedo_2k.jpg", ledger));
        skin.texture(TextureSlot::SpecularColor).image = addImage(scene, readImage(folder / "specular_2k.jpg", ledger));
    }
    skin.texture(TextureSlot::Normal).image = addImage(scene, readImage(folder / "normal_object_2k.jpg", ledger));
    const int material = addMaterial(scene, skin);

    const double scale = heightMetres / (boundsWS.max.y - boundsWS.min.y);
    const glm::dvec3 center = 0.5 * (boundsWS.min + boundsWS.max);
    const glm::dmat4 fitted({scale, 0.0, 0.0, 0.0}, {0.0, scale, 0.0, 0.0}, {0.0, 0.0, scale, 0.0},
                            {-scale * center.x, bottomY - scale * boundsWS.min.y, -scale * center.z, 1.0});
    const std::vector<glm::dmat4> scanFromNode = worldFromNodes(scan);
    const int firstMesh = static_cast<int>(scene.meshes.size());
    for (Mesh& mesh : scan.meshes) scene.meshes.push_back(std::move(mesh));
    for (std::size_t n = 0; n < scan.nodes.size(); ++n) {
        std::vector<MeshInstance> instances;
        for (const MeshInstance& instance : scan.nodes[n].instances) {
            instances.push_back({firstMesh + instance.mesh, material});
        }
        if (!instances.empty()) addNode(scene, scan.nodes[n].name, fitted * scanFromNode[n], std::move(instances));
    }
    scene.warnings.insert(scene.warnings.end(), scan.warnings.begin(), scan.warnings.end());
    return material;
}

} // namespace tessera::scenes::builtin
