#include "viewer/save/Recovery.h"

#include <chrono>
#include <memory>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/support/TempFolder.h"
#include "tests/unit/viewer/Scenes.h"
#include "viewer/save/SaveScene.h"

namespace tessera::viewer {
namespace {

namespace fs = std::filesystem;

class RecoveryTest : public testing::Test {
protected:
    OpenScene& open() { return *open_; }
    void change(float intensity) { test::setIntensity(*open_, intensity); }
    fs::path folder() const { return temporary_.path() / "recovery"; }
    fs::path own() const { return folder() / std::to_string(getpid()) / "tessera-room.json"; }

    tessera::test::TempFolder temporary_;

private:
    std::unique_ptr<OpenScene> open_ = test::opened("room");
};

TEST_F(RecoveryTest, editsAreKeptUntilTheyAreSavedOrUndone) {
    Recovery recovery(folder());
    EXPECT_FALSE(recovery.isBehind(open()));
    recovery.keep(open());
    EXPECT_FALSE(fs::exists(folder())) << "there is nothing to keep";
    change(0.25f);
    EXPECT_TRUE(recovery.isBehind(open()));
    recovery.keep(open());
    EXPECT_FALSE(recovery.isBehind(open()));
    EXPECT_EQ(scenes::loadScene(own().string(), {}).lights.at(0).intensity, 0.25f);
    change(0.5f);
    EXPECT_TRUE(recovery.isBehind(open()));
    recovery.keep(open());
    EXPECT_EQ(scenes::loadScene(own().string(), {}).lights.at(0).intensity, 0.5f);
    open().undo();
    open().undo();
    EXPECT_TRUE(recovery.isBehind(open()));
    recovery.keep(open());
    EXPECT_FALSE(fs::exists(own().parent_path()));
    EXPECT_FALSE(recovery.isBehind(open()));
    open().redo();
    recovery.keep(open());
    recovery.forget();
    EXPECT_FALSE(fs::exists(own().parent_path()));
}

TEST_F(RecoveryTest, theLatestFileOfRunsThatEndedIsOffered) {
    const Recovery recovery(folder());
    EXPECT_FALSE(recovery.left());
    // The system's first process always runs, but it is not a viewer.
    const fs::path old = temporary_.write("recovery/1/tessera-hall.json", "{}");
    const fs::path late = temporary_.write("recovery/1/tessera-room.json", "{}");
    temporary_.write("recovery/1/lock", "");
    fs::last_write_time(old, fs::last_write_time(late) - std::chrono::hours(1));
    EXPECT_EQ(recovery.left(), late);
    Recovery::discard(late);
    EXPECT_EQ(recovery.left(), old);
    Recovery::discard(old);
    EXPECT_FALSE(recovery.left());
    EXPECT_FALSE(fs::exists(old.parent_path()));
}

TEST_F(RecoveryTest, whatARunKeepsIsOfferedOnceItHasEnded) {
    const Recovery another(folder());
    change(0.25f);
    {
        Recovery recovery(folder());
        recovery.keep(open());
        EXPECT_FALSE(another.left()) << "that run goes on";
    }
    EXPECT_EQ(another.left(), own());
}

TEST_F(RecoveryTest, aRunWithTheProcessNumberOfOneThatEndedLeavesItsEditsAlone) {
    const fs::path before = temporary_.write("recovery/" + std::to_string(getpid()) + "/tessera-room.json", "{}");
    Recovery recovery(folder());
    change(0.25f);
    recovery.keep(open());
    EXPECT_EQ(recovery.left(), before);
    EXPECT_EQ(fs::file_size(before), 2u);
}

TEST_F(RecoveryTest, withoutAFolderNothingIsKept) {
    Recovery recovery(std::nullopt);
    change(0.25f);
    EXPECT_FALSE(recovery.isBehind(open()));
    recovery.keep(open());
    EXPECT_FALSE(recovery.left());
}

TEST_F(RecoveryTest, aRecoveredSceneIsUnsavedWhateverIsUndone) {
    open().markUnsaved();
    EXPECT_TRUE(open().isEdited());
    change(0.25f);
    EXPECT_EQ(open().history().stepsToSaved(), -1) << "revert leads to the scene as it was recovered";
    open().undo();
    EXPECT_TRUE(open().isEdited());
    open().becomes("/saved.json");
    EXPECT_FALSE(open().isEdited());
}

TEST(SavedStem, isWithoutWhatSavingPutsAroundAName) {
    EXPECT_EQ(savedStem("room"), "room");
    EXPECT_EQ(savedStem("/models/lamp-2.glb"), "lamp-2");
    EXPECT_EQ(savedStem("/models/tessera-lamp-002.json"), "lamp");
    EXPECT_EQ(savedStem("/recovery/12/tessera-lamp.json"), "lamp");
}

} // namespace
} // namespace tessera::viewer
