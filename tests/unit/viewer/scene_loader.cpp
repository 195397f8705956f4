#include "viewer/session/SceneLoader.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <thread>

#include <gtest/gtest.h>

#include "tests/support/TempFolder.h"

namespace tessera::viewer {
namespace {

TEST(SceneLoader, aNewRequestTakesThePlaceOfAllBeforeWhichAreNotLoadedAtOnce) {
    const auto threads = [] {
        const std::filesystem::directory_iterator tasks("/proc/self/task");
        return std::distance(begin(tasks), end(tasks));
    };
    const auto wait = [](const SceneLoader& loader) {
        for (int i = 0; i < 6000 && !loader.hasResult(); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
    };
    const std::ptrdiff_t before = threads();
    std::ptrdiff_t most = 0;
    SceneLoader loader([] {});
    for (int i = 0; i < 30; ++i) {
        loader.start("lattice", {});
        most = std::max(most, threads());
    }
    loader.start("room", {});
    wait(loader);
    const std::optional<SceneLoader::Result> result = loader.take();
    ASSERT_TRUE(result);
    EXPECT_EQ(result->source, "room");
    EXPECT_TRUE(result->scene) << result->error;
    EXPECT_FALSE(loader.take());
    EXPECT_LE(most, before + 3) << "not one for each; some that ended may still be counted";
    loader.start("room", {}); // an idle loader starts again
    wait(loader);
    EXPECT_TRUE(loader.take());
}

TEST(SceneLoader, anErrorNamesItsFolderOnce) {
    const tessera::test::TempFolder folder;
    const std::string file =
        folder
            .write("model.gltf", R"({"asset": {"version": "2.0"}, "buffers": [{"uri": "gone.bin", "byteLength": 12}],
            "bufferViews": [{"buffer": 0, "byteLength": 12}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 1, "type": "VEC3"}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "nodes": [{"mesh": 0}]})")
            .string();
    SceneLoader loader([] {});
    loader.start(file, {});
    for (int i = 0; i < 6000 && !loader.hasResult(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const std::optional<SceneLoader::Result> result = loader.take();
    ASSERT_TRUE(result);
    EXPECT_EQ(result->error, file + ": /buffers/0: gone.bin: there is no such file; check the name and the folder");
}

} // namespace
} // namespace tessera::viewer
