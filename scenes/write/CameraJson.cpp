#include <cmath>

#include "scenes/import/SceneJsonNames.h"
#include "scenes/import/SceneJsonParts.h"
#include "scenes/write/ElementJson.h"
#include "scenes/write/WithFields.h"

namespace tessera::scenes::write {

Json cameraJson(const Camera& camera) {
    Json json;
    if (!camera.name.empty()) json["name"] = camera.name;
    json["type"] = scenejson::nameOf(camera.projection);
    json["matrix"] = numbers(camera.worldFromCamera);
    if (camera.projection == Projection::Perspective)
        json["fovYDegrees"] = degreesOf(camera.fovYRadians);
    else
        json["halfHeight"] = number(camera.halfHeightMetres);
    json["near"] = number(camera.nearMetres);
    if (!std::isinf(camera.farMetres)) json["far"] = number(camera.farMetres);
    const Json least = {{"name", "camera"}, {"matrix", numbers(glm::dmat4(1.0))}};
    return withFields(camera, std::move(json), least,
                      [](const JsonValue& value) { return scenejson::readCamera(value, 0); });
}

} // namespace tessera::scenes::write
