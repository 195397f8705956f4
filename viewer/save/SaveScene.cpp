#include "viewer/save/SaveScene.h"

#include "base/AtomicFile.h"
#include "base/Error.h"
#include "base/Extension.h"

namespace tessera::viewer {

void saveScene(const std::string& path, const scenes::Scene& scene, const scenes::SceneOrigin& origin) {
    if (extensionOf(path) != ".json") throw InputError(path + ": edited scenes are saved as .json; give such a name");
    writeFileAtomically(path, scenes::sceneText(scene, origin, path));
}

} // namespace tessera::viewer
