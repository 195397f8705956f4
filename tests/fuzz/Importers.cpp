#include <algorithm>
#include <string>
#include <vector>

#include "scenes/Clips.h"
#include "scenes/Environment.h"
#include "scenes/LightTexture.h"
#include "scenes/Pose.h"
#include "scenes/import/Importers.h"
#include "tests/fuzz/Readers.h"

namespace tessera::fuzz {

using std::filesystem::path;

void readGltf(const path& file) {
    scenes::LoadLedger ledger(kMemoryLimitBytes);
    scenes::Scene scene = scenes::importGltf(file, ledger);
    scenes::checkScene(scene);
    scenes::poseScene(scene, 0.5);
    scenes::checkScene(scene);
}

/// Poses every clip at its ends, between them and far beyond.
void poseGltf(const path& file) {
    scenes::LoadLedger ledger(kMemoryLimitBytes);
    scenes::Scene scene = scenes::importGltf(file, ledger);
    scenes::checkScene(scene);
    constexpr std::size_t kMostClips = 4; // more would only slow the fuzzer
    for (std::size_t clip = 0; clip < std::min(scene.rig.clips.size(), kMostClips); ++clip) {
        scenes::playClip(scene, std::to_string(clip));
        const double end = scenes::playingSeconds(scene.rig);
        for (const double timeSeconds : {-1.0, 0.0, 0.37 * end, end, 1e9}) {
            scenes::poseScene(scene, timeSeconds);
            scenes::checkScene(scene);
        }
    }
}

void readObj(const path& file) {
    scenes::LoadLedger ledger(kMemoryLimitBytes);
    const scenes::Scene scene = scenes::importObj(file, ledger);
    scenes::checkScene(scene);
}

/// Reads a material library through a model beside it.
void readMtl(const path& file) {
    readObj(file.parent_path() / "uses.obj");
}

void readScene(const path& file) {
    scenes::LoadLedger ledger(kMemoryLimitBytes);
    const scenes::Scene scene = scenes::importSceneJson(file, ledger);
    scenes::checkScene(scene);
}

void readPicture(const path& file) {
    scenes::LoadLedger ledger(kMemoryLimitBytes);
    scenes::readImage(file, ledger);
}

void readEnvironment(const path& file) {
    scenes::LoadLedger ledger(kMemoryLimitBytes);
    std::vector<std::string> warnings;
    scenes::loadEnvironment(file.string(), ledger, warnings);
}

void readLightPicture(const path& file) {
    scenes::LoadLedger ledger(kMemoryLimitBytes);
    std::vector<std::string> warnings;
    scenes::loadLightTexture(file.string(), ledger, warnings);
}

} // namespace tessera::fuzz
