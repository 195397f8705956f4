#include "scenes/CameraNames.h"

#include <gtest/gtest.h>

namespace tessera::scenes {
namespace {

Scene withCameras(std::initializer_list<const char*> names) {
    Scene scene;
    for (const char* name : names) scene.cameras.emplace_back().name = name;
    return scene;
}

TEST(CameraNames, chooseTheCameraThatTheyAreOf) {
    const Scene scene = withCameras({"", "side", "side", "0"});
    const char* const names[] = {"0", "side", "2", "0"};
    for (std::size_t i = 1; i < scene.cameras.size(); ++i) {
        EXPECT_EQ(nameOfCamera(scene, i), names[i]);
        EXPECT_EQ(cameraCalled(scene, nameOfCamera(scene, i)), i);
    }
    EXPECT_EQ(nameOfCamera(scene, 0), "0") << "though another camera has that name: nothing else chooses it";
}

TEST(CameraNames, theOthersAreAllButOneAndFewEnoughForALine) {
    EXPECT_EQ(otherCamerasText(withCameras({"front"}), 0), "");
    EXPECT_EQ(otherCamerasText(withCameras({"front", "side", "top"}), 1), "'front', 'top'");
    EXPECT_EQ(otherCamerasText(withCameras({"a", "b", "c", "d", "e", "f"}), 0), "'b', 'c', 'd', 'e', 'f'");
    EXPECT_EQ(otherCamerasText(withCameras({"a", "b", "c", "d", "e", "f", "g", "h"}), 7),
              "'a', 'b', 'c', 'd', 'e' and 2 more");
}

} // namespace
} // namespace tessera::scenes
