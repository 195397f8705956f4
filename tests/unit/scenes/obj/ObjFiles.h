#pragma once
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/import/Importers.h"
#include "tests/support/UnderLedger.h"
#include "tests/unit/scenes/TempFolder.h"

/// Small OBJ and MTL files and their import.
namespace tessera::scenes::test {

constexpr std::string_view kThreeVertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
constexpr std::string_view kOneTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// Tests of OBJ files, with a folder for them.
class ObjFiles : public testing::Test {
protected:
    Scene importText(std::string_view text, const ImportOptions& importOptions = {}) const {
        Scene scene = underLedger(importObj, folder.write("model.obj", text), {}, importOptions);
        checkScene(scene);
        return scene;
    }
    /// A scene of one triangle whose material "paint" has the given MTL statements.
    Scene painted(const std::string& mtl, const ImportOptions& importOptions = {}) const {
        folder.write("paint.mtl", "newmtl paint\n" + mtl);
        return importText("mtllib paint.mtl\n" + std::string(kThreeVertices) + "vt 0 0\nusemtl paint\nf 1/1 2/1 3/1\n",
                          importOptions);
    }
    Material paint(const std::string& mtl) const { return painted(mtl).materials.at(0); }

    /// Returns the error of a strict load of the last text.
    std::string strictError() const {
        return inputErrorOf([&] { underLedger(importObj, folder.path() / "model.obj", {}, strictly()); });
    }
    /// Returns the scene's only warning without the folder. A strict load fails with its part before the last ';'.
    std::string onlyWarning(const Scene& scene) const {
        EXPECT_EQ(scene.warnings.size(), 1u) << testing::PrintToString(scene.warnings);
        if (scene.warnings.empty()) return {};
        const std::string place = folder.path().string() + "/";
        const std::string& warning = scene.warnings.front();
        EXPECT_EQ(strictError(), warning.substr(0, warning.rfind("; ")));
        return warning.substr(warning.starts_with(place) ? place.size() : 0);
    }

    const TempFolder folder;
};

inline double areaOf(const Scene& scene) {
    double area = 0.0;
    for (const Mesh& mesh : scene.meshes)
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const glm::dvec3 a(mesh.positionsOS[mesh.indices[i]]), b(mesh.positionsOS[mesh.indices[i + 1]]),
                c(mesh.positionsOS[mesh.indices[i + 2]]);
            area += 0.5 * glm::length(glm::cross(b - a, c - a));
        }
    return area;
}

} // namespace tessera::scenes::test
