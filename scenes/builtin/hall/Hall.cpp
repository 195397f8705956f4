#include <algorithm>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/Limits.h"
#include "scenes/builtin/Author.h"
#include "scenes/builtin/Builtin.h"
#include "scenes/builtin/bust/Bust.h"
#include "scenes/builtin/hall/Finishes.h"
#include "scenes/builtin/hall/Lights.h"
#include "scenes/builtin/hall/Parts.h"
#include "scenes/builtin/hall/Plan.h"

namespace tessera::scenes::builtin {
namespace {

using namespace hall;

constexpr int kDefaultHallLights = 256;

glm::dmat4 placed(double x, double y, double z, double turnRadians = 0.0) {
    return glm::rotate(glm::translate(glm::dmat4(1.0), {x, y, z}), turnRadians, glm::dvec3(0.0, 1.0, 0.0));
}

/// Placement on a side: as made for the left, rotated by half a turn for the right.
glm::dmat4 onSide(double side, double z) {
    return placed(0.0, 0.0, z, side < 0.0 ? 0.0 : std::numbers::pi);
}

const char* sideName(double side) {
    return side < 0.0 ? "left " : "right ";
}

void addArchitecture(Scene& scene, const Finishes& f) {
    const MeshInstance shaft{addMesh(scene, "column shaft", columnShaft()), f.column};
    const MeshInstance plinth{addMesh(scene, "column plinth", columnPlinth()), f.plinth};
    const MeshInstance capital{addMesh(scene, "column capital", columnCapital()), f.gold};
    const MeshInstance walls{addMesh(scene, "bay walls", bayWalls()), f.wall};
    const MeshInstance trim{addMesh(scene, "bay trim", bayTrim()), f.trim};
    const MeshInstance gilding{addMesh(scene, "bay gilding", bayGilding()), f.gold};
    const MeshInstance frames{addMesh(scene, "vault frames", vaultFrames()), f.trim};
    const MeshInstance panels{addMesh(scene, "vault panels", vaultPanels()), f.coffer};
    const MeshInstance rosettes{addMesh(scene, "vault rosettes", vaultRosettes()), f.gold};
    for (const double side : {-1.0, 1.0}) {
        for (int c = 0; c <= kBays; ++c) {
            addNode(scene, std::string(sideName(side)) + "column " + std::to_string(c),
                    placed(side * kColumnX, 0.0, columnZ(c)), {plinth, shaft, capital});
        }
        for (int b = 0; b < kBays; ++b) {
            addNode(scene, std::string(sideName(side)) + "bay " + std::to_string(b), onSide(side, bayZ(b)),
                    {walls, trim, gilding});
        }
    }
    for (int b = 0; b < kBays; ++b) {
        addNode(scene, "vault " + std::to_string(b), placed(0.0, 0.0, bayZ(b)), {frames, panels, rosettes});
    }
    addNode(scene, "ends", glm::dmat4(1.0),
            {{addMesh(scene, "end walls", endWalls()), f.wall},
             {addMesh(scene, "end trim", endTrim()), f.trim},
             {addMesh(scene, "apse", apse()), f.mosaic},
             {addMesh(scene, "portal doors", portalDoors()), f.door}});
    addNode(scene, "floor", glm::dmat4(1.0),
            {{addMesh(scene, "floor", hall::floor()), f.floor}, {addMesh(scene, "carpet", carpet()), f.carpet}});
}

void addFurnishings(Scene& scene, const Finishes& f) {
    const int bust = addMesh(scene, "bust", bustMesh(56, 44, 1.25));
    const int stand = addMesh(scene, "pedestal", pedestal());
    const int amphora = addMesh(scene, "amphora", vase());
    const int cloth = addMesh(scene, "banner", banner());
    for (const double side : {-1.0, 1.0}) {
        const double towardsNave = side < 0.0 ? std::numbers::pi / 2.0 : -std::numbers::pi / 2.0;
        for (int b = 0; b < kBays; ++b) {
            const double x = side * (kAisleOuterX + 0.22);
            const std::string where = sideName(side) + std::to_string(b);
            if ((b + (side < 0.0 ? 0 : 1)) % 2 == 0) {
                addNode(scene, "statue " + where, placed(x, kNicheSillY, bayZ(b), towardsNave),
                        {{bust, b % 4 < 2 ? f.statue : f.bronze}});
            } else {
                addNode(scene, "amphora " + where,
                        placed(x, kNicheSillY + 0.45, bayZ(b), towardsNave + std::numbers::pi / 2.0),
                        {{amphora, f.glaze}});
                addNode(scene, "pedestal " + where, placed(x, kNicheSillY, bayZ(b), towardsNave), {{stand, f.plinth}});
            }
        }
        for (int c = 1; c < kBays; ++c) {
            addNode(scene, "banner " + std::string(sideName(side)) + std::to_string(c), onSide(side, columnZ(c)),
                    {{cloth, c % 2 == 0 ? f.azure : f.crimson}});
        }
    }
    // The colossus in the apse: a head twice a man's height on three steps.
    constexpr double kColossusScale = 2.6;
    const double apseZ = -kHalfLength - 1.0;
    addNode(scene, "dais", placed(0.0, 0.0, apseZ + 0.75), {{addMesh(scene, "dais", dais()), f.column}});
    addNode(scene, "colossus", glm::scale(placed(0.0, 0.48 + 0.9, apseZ), glm::dvec3(kColossusScale)),
            {{addMesh(scene, "colossus", bustMesh(112, 88, 1.25)), f.statue}});
    addNode(scene, "colossus pedestal", glm::scale(placed(0.0, 0.48, apseZ), glm::dvec3(2.4, 2.0, 2.4)),
            {{stand, f.plinth}});
}

} // namespace

Scene makeHall(const LoadOptions& options, LoadLedger&) {
    Scene scene;
    scene.name = "hall";
    scene.background = {0.035f, 0.06f, 0.13f}; // the evening sky behind the windows
    const Finishes finishes = addFinishes(scene);
    addArchitecture(scene, finishes);
    addFurnishings(scene, finishes);
    constexpr int kMostPointLights = kMostLights - 2; // besides the sky and the sun
    addPointLights(scene, std::min(options.lights.value_or(kDefaultHallLights), kMostPointLights));
    addOutdoorLights(scene);
    addCamera(scene, "nave", {0.9, 1.75, 17.6}, {-0.25, 4.35, 0.0}, 62.0);
    addCamera(scene, "aisle", {-5.6, 1.7, 13.0}, {-6.4, 2.4, 6.0}, 60.0);
    addCamera(scene, "gallery", {-1.4, 8.6, -17.4}, {0.7, 4.6, 0.0}, 62.0);
    castShadowsOfNearest(scene, glm::dvec3(scene.cameras.front().worldFromCamera[3]));
    return scene;
}

} // namespace tessera::scenes::builtin
