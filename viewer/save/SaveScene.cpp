#include "viewer/save/SaveScene.h"

#include "scenes/Error.h"
#include "scenes/Extension.h"
#include "validation/AtomicFile.h"

namespace tessera::viewer {

void saveScene(const std::string& path, const scenes::Scene& scene, const scenes::SceneOrigin& origin) {
    if (extensionOf(path) != ".json") throw InputError(path + ": edited scenes are saved as .json; give such a name");
    validation::writeFileAtomically(path, scenes::sceneText(scene, origin, path));
}

} // namespace tessera::viewer
