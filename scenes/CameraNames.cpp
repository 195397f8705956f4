#include "scenes/CameraNames.h"

#include <fmt/format.h>

namespace tessera::scenes {
namespace {

constexpr std::size_t kMostCamerasNamed = 5; ///< as many as fit on a line

} // namespace

std::string nameOfCamera(const Scene& scene, std::size_t camera) {
    const std::string& name = scene.cameras[camera].name;
    return !name.empty() && cameraCalled(scene, name) == camera ? name : fmt::format("{}", camera);
}

std::string otherCamerasText(const Scene& scene, std::size_t camera) {
    std::string text;
    std::size_t named = 0;
    for (std::size_t i = 0; i < scene.cameras.size() && named < kMostCamerasNamed; ++i) {
        if (i == camera) continue;
        text += fmt::format("{}'{}'", named == 0 ? "" : ", ", nameOfCamera(scene, i));
        ++named;
    }
    if (scene.cameras.size() > named + 1) text += fmt::format(" and {} more", scene.cameras.size() - named - 1);
    return text;
}

} // namespace tessera::scenes
