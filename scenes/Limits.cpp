#include "scenes/Limits.h"

#include <fmt/format.h>

#include "base/Error.h"

namespace tessera::scenes {

void requireDrawableLights(const std::string& source, std::size_t lights) {
    if (lights <= std::size_t(kMostLights)) return;
    throw InputError(fmt::format("{}: has {} lights, and {} at most can be drawn; keep fewer of them, or load "
                                 "only the first",
                                 source, lights, kMostLights));
}

std::string limitProblem(const Camera& camera) {
    if (!isNearEnough(glm::dvec3(camera.worldFromCamera[3])))
        return fmt::format("it stands more than {:g} m from the origin; move it nearer", kFarthestMetres);
    const bool isPerspective = camera.projection == Projection::Perspective;
    if ((isPerspective && camera.nearMetres < kNearestPlaneMetres) || camera.nearMetres > kFarthestMetres)
        return fmt::format("its near plane at {:g} m must lie {:g} to {:g} m ahead", camera.nearMetres,
                           isPerspective ? kNearestPlaneMetres : 0.0, kFarthestMetres);
    if (!isPerspective && camera.halfHeightMetres > kFarthestMetres)
        return fmt::format("its half height of {:g} m must be at most {:g} m", camera.halfHeightMetres,
                           kFarthestMetres);
    return {};
}

} // namespace tessera::scenes
