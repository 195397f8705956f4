// Image sizes that tiles, workgroups and vectors do not divide.
#include <algorithm>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "validation/stress/StressCase.h"
#include "validation/stress/StressScene.h"

namespace tessera::validation {

namespace {

std::vector<StressPicture> targetPictures(StressEffort) {
    // 8193 is one more than 8192, which software rasterisers treat specially.
    constexpr glm::ivec2 kSizes[] = {{1, 1},   {1, 37},   {37, 1},   {2, 3},   {17, 15},
                                     {63, 65}, {127, 73}, {8193, 1}, {1, 8193}};
    std::vector<StressPicture> pictures;
    for (const glm::ivec2& size : kSizes) {
        frame::FrameSettings settings;
        settings.sizePixels = size;
        settings.display = false;
        pictures.push_back({fmt::format("{}x{}", size.x, size.y), stressFloor(), settings});
        scenes::Scene& scene = pictures.back().scene;
        // The floor fills the image and little more: rasterisers lose triangles 1e7 times as wide as the image.
        const double aspect = double(size.x) / double(size.y);
        scene.nodes[0].parentFromNode = glm::scale(glm::dmat4(1.0), {std::max(aspect, 1.0), 1.0, 1.0});
        scene.lights = {stressLight({0.3, 1.0, 0.2}, 1.0f), stressLight({-0.5, 0.5, -0.5}, 0.5f)};
        scene.lights[1].rangeMetres = 1.0f;
    }
    return pictures;
}

} // namespace

void addTargetCases(std::vector<StressCase>& cases) {
    cases.push_back({"target/size",
                     "pictures of one pixel, of 8193 in a row and of odd sizes",
                     StressBound::WorstRel,
                     1e-4,
                     "lambert at distances up to 8193 m: some twenty roundings of 6e-8, and the position's",
                     {},
                     &targetPictures});
}

} // namespace tessera::validation
