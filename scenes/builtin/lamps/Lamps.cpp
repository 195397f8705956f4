#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/builtin/Author.h"
#include "scenes/builtin/Builtin.h"
#include "scenes/builtin/lamps/Lights.h"
#include "scenes/builtin/lamps/Parts.h"
#include "scenes/builtin/lamps/Plan.h"
#include "scenes/builtin/lamps/Textures.h"

namespace tessera::scenes::builtin {
namespace lamps {
namespace {

struct LibraryFinishes {
    int plaster, oak, boards, books, bronze, iron, stone, carpet, leather, enamel, paper;
};

LibraryFinishes addLibraryFinishes(Scene& scene) {
    LibraryFinishes f{};
    f.plaster = addMaterial(scene, metallicRoughness("plaster", {0.55f, 0.51f, 0.45f}, 0.0f, 0.95f));
    f.oak = addMaterial(scene, metallicRoughness("dark oak", {0.13f, 0.062f, 0.028f}, 0.0f, 0.45f));
    Material boards = metallicRoughness("waxed boards", glm::vec3(1.0f), 0.0f, 0.38f);
    boards.texture(TextureSlot::BaseColor).image = addImage(scene, boardColors());
    boards.texture(TextureSlot::BaseColor).transform.scale = glm::vec2(1.0f / kBoardsMetres);
    f.boards = addMaterial(scene, boards);
    Material books = metallicRoughness("books", glm::vec3(1.0f), 0.0f, 0.6f);
    books.texture(TextureSlot::BaseColor).image = addImage(scene, spineColors());
    f.books = addMaterial(scene, books);
    f.bronze = addMaterial(scene, metallicRoughness("bronze", {0.72f, 0.46f, 0.24f}, 1.0f, 0.32f));
    f.iron = addMaterial(scene, metallicRoughness("burnished iron", {0.36f, 0.36f, 0.38f}, 1.0f, 0.42f));
    f.stone = addMaterial(scene, metallicRoughness("limestone", {0.48f, 0.44f, 0.38f}, 0.0f, 0.7f));
    f.carpet = addMaterial(scene, metallicRoughness("carpet", {0.30f, 0.030f, 0.036f}, 0.0f, 1.0f));
    f.leather = addMaterial(scene, metallicRoughness("desk leather", {0.065f, 0.15f, 0.095f}, 0.0f, 0.5f));
    f.enamel = addMaterial(scene, metallicRoughness("green enamel", {0.012f, 0.10f, 0.045f}, 0.0f, 0.15f));
    scene.materials.back().doubleSided = true; // shades are open below
    f.paper = addMaterial(scene, metallicRoughness("paper", {0.72f, 0.69f, 0.61f}, 0.0f, 0.9f));
    return f;
}

glm::dmat4 libraryPlace(double x, double z, double turnRadians = 0.0) {
    return glm::rotate(glm::translate(glm::dmat4(1.0), {x, 0.0, z}), turnRadians, glm::dvec3(0.0, 1.0, 0.0));
}

void addLibrary(Scene& scene, const LibraryFinishes& f) {
    addNode(scene, "building", glm::dmat4(1.0),
            {{addMesh(scene, "walls", walls()), f.plaster},
             {addMesh(scene, "ceiling", ceiling()), f.oak},
             {addMesh(scene, "beams", beams()), f.oak},
             {addMesh(scene, "floor", floorBoards()), f.boards},
             {addMesh(scene, "carpet", carpetRunner()), f.carpet},
             {addMesh(scene, "window bars", windowBars()), f.iron},
             {addMesh(scene, "luminaires", luminaires()), f.iron}});
    const std::vector<MeshInstance> side{{addMesh(scene, "gallery", gallery()), f.stone},
                                         {addMesh(scene, "railing", railing()), f.bronze},
                                         {addMesh(scene, "upper boards", upperBoards()), f.oak},
                                         {addMesh(scene, "upper books", upperBooks()), f.books},
                                         {addMesh(scene, "fixtures", fixtures()), f.iron}};
    const MeshInstance column{addMesh(scene, "pillar", pillar()), f.bronze};
    const MeshInstance boards{addMesh(scene, "case", caseBoards()), f.oak};
    const MeshInstance books[] = {{addMesh(scene, "books 0", caseBooks(5)), f.books},
                                  {addMesh(scene, "books 1", caseBooks(6)), f.books}};
    const std::vector<MeshInstance> furniture{{addMesh(scene, "desk", desk()), f.leather},
                                              {addMesh(scene, "benches", benches()), f.oak},
                                              {addMesh(scene, "papers", papers()), f.paper},
                                              {addMesh(scene, "desk lamp stands", deskLampStands()), f.bronze},
                                              {addMesh(scene, "desk lamp shades", deskLampShades()), f.enamel}};
    constexpr int kPillars = kCases / 2; // between every other pair of cases
    for (const double right : {-1.0, 1.0}) {
        const std::string name = right < 0.0 ? "left " : "right ";
        const double turnRadians = right < 0.0 ? std::numbers::pi : 0.0;
        addNode(scene, name + "gallery", libraryPlace(0.0, 0.0, turnRadians), side);
        for (int c = 0; c < kCases; ++c)
            addNode(scene, name + "case " + std::to_string(c), libraryPlace(0.0, caseZ(c), turnRadians),
                    {boards, books[c % 2]});
        for (int p = 0; p < kPillars; ++p)
            addNode(scene, name + "pillar " + std::to_string(p),
                    libraryPlace(right * (kNaveHalf + 0.25), caseZ(2 * p) + 0.5 * kCaseSpacing), {column});
        for (int d = 0; d < kDesks; ++d)
            addNode(scene, name + "desk " + std::to_string(d), libraryPlace(right * kDeskX, deskZ(d)), furniture);
    }
}

void addGlow(Scene& scene, const std::vector<LampPlace>& places) {
    std::vector<MeshInstance> glowing;
    for (const LampKind& kind : kLampKinds) {
        const std::string name = "shining " + std::string(kind.name);
        Material glow = metallicRoughness(name, glm::vec3(0.0f), 0.0f, 1.0f);
        glow.emissive = kind.radiance * kind.color;
        glow.castsShadow = false; // some lie in front of their light
        glowing.push_back(
            {addMesh(scene, name, glowingSurfaces(places, kind.lamp)), addMaterial(scene, std::move(glow))});
    }
    addNode(scene, "lamps", glm::dmat4(1.0), std::move(glowing));
}

} // namespace
} // namespace lamps

Scene makeLamps(const LoadOptions& options, LoadLedger&) {
    Scene scene;
    scene.name = "lamps";
    scene.background = {0.010f, 0.017f, 0.045f}; // the night behind the window
    lamps::addLibrary(scene, lamps::addLibraryFinishes(scene));
    const std::vector<lamps::LampPlace> places = lamps::lampPlaces();
    lamps::addGlow(scene, places);
    lamps::addLamps(scene, places, options.lights.value_or(lamps::kLampPlaces));
    addCamera(scene, "nave", {0.5, 2.6, 23.3}, {-0.3, 2.15, 0.0}, 56.0);
    addCamera(scene, "between cases", {3.3, 1.65, 12.4}, {8.4, 1.35, 8.6}, 58.0);
    addCamera(scene, "gallery", {5.9, 5.45, -21.5}, {-2.6, 2.3, 0.0}, 62.0);
    return scene;
}

} // namespace tessera::scenes::builtin
