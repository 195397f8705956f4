// Files opened and saved through the dialogs by keyboard, or dropped on the window.
#include <filesystem>

#include "tests/viewer/ViewerTest.h"

namespace tessera::test {
namespace {

class ViewerFiles : public ViewerTest {
protected:
    /// Opens a dialog by its keys, and waits until it accepts input.
    static void openDialog(const DrivenViewer& viewer, const std::string& keys, const std::string& said) {
        const std::size_t mark = viewer.mark();
        viewer.key(keys);
        viewer.waitFor(said, mark);
        viewer.pause(0.7);
    }
    static void showOpenDialog(const DrivenViewer& viewer) { openDialog(viewer, "ctrl+o", "shows the open dialog"); }
    static void showSaveDialog(const DrivenViewer& viewer) {
        openDialog(viewer, "ctrl+shift+s", "shows the save dialog");
    }
    static void enter(const DrivenViewer& viewer, const std::string& text) {
        viewer.type(text);
        viewer.pause(0.3);
        viewer.key("Return");
        viewer.pause(0.5);
    }
    /// The image of an opened scene; `mark` precedes the opening.
    static Shot opened(const DrivenViewer& viewer, std::size_t mark, const std::string& ending) {
        const std::string line = viewer.waitFor("opened ", mark);
        EXPECT_NE(line.find(ending + " seconds"), std::string::npos) << line;
        return pictureIn(viewer, viewer.waitForWhole(mark));
    }
};

TEST_F(ViewerFiles, aSceneInAFolderIsOpenedByTypedLettersArrowsAndEnter) {
    folder_.write("things/one.json", R"({"tessera": 1, "base": {"file": "builtin:spheres"}})");
    folder_.write("things/two.json", R"({"tessera": 1, "base": {"file": "builtin:lattice"}})");
    folder_.write("things/unknown.txt", "");
    DrivenViewer viewer = open({"room"});
    const Shot room = pictureIn(viewer, viewer.waitForWhole(0));
    showOpenDialog(viewer);
    EXPECT_GT(differingShare(pictureIn(viewer, room.sizePixels), room), 0.3) << "the dialog is not there";
    enter(viewer, "thi"); // enters the folder
    std::size_t mark = viewer.mark();
    for (int i = 0; i < 3; ++i) viewer.key("Down"); // the parent folder, "one", "two"
    viewer.pause(0.3);
    viewer.key("Return");
    const Shot lattice = opened(viewer, mark, "things/two.json");
    EXPECT_TRUE(lattice == rendered("lattice", lattice.sizePixels));
    // The next dialog starts in this folder; Tab completes names.
    showOpenDialog(viewer);
    mark = viewer.mark();
    viewer.type("o");
    viewer.key("Tab");
    viewer.pause(0.3);
    viewer.key("Return");
    const Shot spheres = opened(viewer, mark, "things/one.json");
    EXPECT_TRUE(spheres == rendered("spheres", spheres.sizePixels));
    viewer.key("ctrl+q");
    EXPECT_EQ(viewer.wait(), 0) << viewer.errors();
}

TEST_F(ViewerFiles, escapeLeavesTheDialogAndNothingIsDoneByLettersTypedIntoIt) {
    DrivenViewer viewer = open({"room"});
    const Shot room = pictureIn(viewer, viewer.waitForWhole(0));
    showOpenDialog(viewer);
    enter(viewer, "t7m"); // keys that mean something elsewhere, and match no file
    viewer.key("Escape");
    viewer.pause(0.7);
    EXPECT_TRUE(pictureIn(viewer, room.sizePixels) == room);
    EXPECT_GT(differingShare(after(viewer, [&] { viewer.drag(middlePixel(), middlePixel() + glm::ivec2(150, 60)); }),
                             room, 4),
              0.1);
    viewer.key("ctrl+q");
    EXPECT_EQ(viewer.wait(), 0) << viewer.errors();
}

TEST_F(ViewerFiles, aBuiltInSceneAndAnEnvironmentAreOpenedByName) {
    DrivenViewer viewer = open({"room"});
    viewer.waitForWhole(0);
    showOpenDialog(viewer);
    std::size_t mark = viewer.mark();
    enter(viewer, "spheres");
    const Shot spheres = opened(viewer, mark, "spheres");
    mark = viewer.mark();
    viewer.key("shift+F12");
    const std::string radiance = savedFile(viewer.waitFor("saved ", mark));
    viewer.key("Escape");
    viewer.pause(0.3);
    showOpenDialog(viewer);
    mark = viewer.mark();
    enter(viewer, radiance.substr(0, radiance.size() - 2)); // the dialog completes the name
    viewer.waitFor("environment " + (folder_.path() / radiance).string(), mark);
    EXPECT_GT(differingShare(pictureIn(viewer, viewer.waitForWhole(mark)), spheres, 4), 0.1);
}

TEST_F(ViewerFiles, whatIsDroppedOnTheWindowOpensAndOfSeveralTheFirstThatCanIsReported) {
    const auto one = folder_.write("one.json", R"({"tessera": 1, "base": {"file": "builtin:spheres"}})");
    const auto two = folder_.write("two.json", R"({"tessera": 1, "base": {"file": "builtin:lattice"}})");
    const auto unknown = folder_.write("unknown.txt", "");
    DrivenViewer viewer = open({"room"});
    viewer.waitForWhole(0);
    std::size_t mark = viewer.mark();
    viewer.drop(middlePixel(), {two});
    const Shot lattice = opened(viewer, mark, "two.json");
    EXPECT_TRUE(lattice == rendered("lattice", lattice.sizePixels));
    mark = viewer.mark();
    viewer.drop(middlePixel(), {unknown, one, two});
    EXPECT_EQ(viewer.waitFor("note Of ", mark),
              "note Of 3 files dropped at once one.json opens; not unknown.txt, two.json");
    const glm::ivec2 size = opened(viewer, mark, "one.json").sizePixels;
    viewer.key("Escape"); // dismisses the message
    viewer.pause(0.7);
    EXPECT_TRUE(pictureIn(viewer, size) == rendered("spheres", size));
}

TEST_F(ViewerFiles, openingShowsADialogAboutEditsThatAreNotSaved) {
    folder_.write("other.json", R"({"tessera": 1, "base": {"file": "builtin:lattice"}})");
    DrivenViewer viewer = open({"spheres"});
    const Shot shown = pictureIn(viewer, viewer.waitForWhole(0));
    const std::size_t edited = viewer.mark();
    addLight(viewer);
    viewer.waitForWhole(edited);
    showOpenDialog(viewer);
    std::size_t mark = viewer.mark();
    enter(viewer, "other.json");
    viewer.waitFor("edits are not saved", mark);
    viewer.pause(0.5);
    mark = viewer.mark();
    viewer.key("s");
    const std::string saved = savedFile(viewer.waitFor("saved ", mark));
    opened(viewer, mark, "other.json");
    EXPECT_GT(differingShare(rendered(saved, shown.sizePixels), shown, 4), 0.02) << "the edit is not in " << saved;
}

TEST_F(ViewerFiles, aSceneAndAPictureAreSavedUnderNamesOfTheUsersChoice) {
    std::filesystem::create_directory(folder_.path() / "kept");
    folder_.write("kept/taken.png", "not a picture");
    DrivenViewer viewer = open({"spheres"});
    const Shot shown = pictureIn(viewer, viewer.waitForWhole(0));
    showSaveDialog(viewer);
    std::size_t mark = viewer.mark();
    enter(viewer, "kept/mine.json"); // replaces the proposed name
    viewer.waitFor("saved " + (folder_.path() / "kept" / "mine.json").string(), mark);
    EXPECT_TRUE(rendered("kept/mine.json", shown.sizePixels) == shown);
    viewer.key("Escape");
    viewer.pause(0.3);
    showSaveDialog(viewer);
    mark = viewer.mark();
    enter(viewer, "kept/taken.png"); // an existing file
    viewer.key("Return");
    viewer.pause(0.5);
    EXPECT_EQ(shell("cat kept/taken.png"), "not a picture") << "Enter twice is no answer";
    viewer.key("ctrl+Return");
    viewer.waitFor("saved ", mark);
    EXPECT_TRUE(readShot(folder_.path() / "kept" / "taken.png") == shown);
    viewer.key("Escape");
}

TEST_F(ViewerFiles, whereAFolderCannotBeWrittenADialogForAnotherPlaceIsShown) {
    const TempFolder home;
    DrivenViewer viewer = open({"spheres"}, {{"HOME", home.path().string()}});
    const Shot shown = pictureIn(viewer, viewer.waitForWhole(0));
    showSaveDialog(viewer);
    std::size_t mark = viewer.mark();
    enter(viewer, "/proc/mine.png"); // where not even root can write
    const std::string said = viewer.waitFor("error ", mark);
    EXPECT_NE(said.find("/proc/mine.png"), std::string::npos) << said;
    viewer.waitFor("shows the save dialog", mark);
    viewer.pause(0.7);
    mark = viewer.mark();
    viewer.key("Return"); // accepts the proposed folder and name
    const std::string saved = savedFile(viewer.waitFor("saved ", mark));
    EXPECT_EQ(saved, (home.path() / "mine.png").string());
    EXPECT_TRUE(readShot(saved) == shown);
}

} // namespace
} // namespace tessera::test
