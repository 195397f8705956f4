#include "tests/fuzz/Targets.h"

#include "renderer/shader/Preprocess.h"
#include "scenes/Pose.h"
#include "scenes/import/Importers.h"

namespace tessera::fuzz {
namespace {

using std::filesystem::path;

void readGltf(const path& file) {
    scenes::LoadLedger ledger(kMemoryLimitBytes);
    scenes::Scene scene = scenes::importGltf(file, ledger);
    scenes::checkScene(scene);
    scenes::poseScene(scene, 0.5);
    scenes::checkScene(scene);
}

void readObj(const path& file) {
    scenes::LoadLedger ledger(kMemoryLimitBytes);
    const scenes::Scene scene = scenes::importObj(file, ledger);
    scenes::checkScene(scene);
}

/// A material library, used by a model beside it.
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

/// A file of shaders/ that includes those beside it, and itself.
void expandShader(const path& file) {
    const shader::SourceTree tree(file.parent_path());
    shader::mapLog(shader::expand(tree, file.filename().string()).text, {});
}

constexpr Target kTargets[] = {
#define TARGET(name, fileName, read) {#name, fileName, read},
#include "tests/fuzz/Targets.inc"
#undef TARGET
};

} // namespace

std::span<const Target> targets() {
    return kTargets;
}

} // namespace tessera::fuzz
