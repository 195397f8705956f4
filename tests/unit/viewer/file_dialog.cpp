#include "viewer/session/FileDialog.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>
#include <unistd.h>

#include "scenes/Load.h"
#include "tests/support/EnvironmentVariable.h"
#include "tests/support/TempFolder.h"
#include "viewer/session/FileTypes.h"

namespace tessera::viewer {
namespace {

using Purpose = FileDialog::Purpose;
using FileNames = std::vector<std::string>;

/// A folder with entries of all kinds.
class Files : public testing::Test {
protected:
    Files() {
        for (const char* name : {"b.glb", "A.JSON", "sky.hdr", "notes.txt", "picture.png", ".hidden.glb",
                                 "models/one.gltf", "models/other.gltf", "maps/x.exr"})
            folder_.write(name, "");
    }
    FileDialog open() const { return {Purpose::Open, folder_.path()}; }
    FileDialog save(const std::string& name) const { return {Purpose::Save, folder_.path(), name}; }
    std::string at(const std::string& name) const { return (folder_.path() / name).string(); }
    /// Expects typed text to be refused with this fault.
    static void expectFault(FileDialog& dialog, const std::string& typed, const std::string& fault) {
        dialog.type(typed);
        EXPECT_EQ(dialog.accept(), std::nullopt);
        EXPECT_EQ(dialog.fault(), fault);
    }
    static void expectCompleted(FileDialog& dialog, const std::string& text) {
        dialog.complete();
        EXPECT_EQ(dialog.text(), text);
    }
    tessera::test::TempFolder folder_;
};

FileNames fileNamesOf(const FileDialog& dialog) {
    FileNames names;
    for (const FileEntry& entry : dialog.entries()) names.push_back(entry.name + (entry.isFolder ? "/" : ""));
    return names;
}

TEST_F(Files, theListHasFoldersAndThenWhatCanBeOpened) {
    EXPECT_EQ(fileNamesOf(open()), (FileNames{"../", "maps/", "models/", "A.JSON", "b.glb", "sky.hdr"}));
    EXPECT_EQ(fileNamesOf(save("")), (FileNames{"../", "maps/", "models/", "A.JSON", "picture.png"}));
    EXPECT_EQ(fileNamesOf({Purpose::Open, "/"}).front().find(".."), std::string::npos) << "nothing is above the root";
}

TEST_F(Files, whereThereIsNothingToOpenTheBuiltInScenesAreShownEachWithItsPurpose) {
    folder_.write("nothing/notes.txt", "");
    FileDialog dialog(Purpose::Open, folder_.path() / "nothing");
    EXPECT_FALSE(dialog.folder());
    ASSERT_EQ(dialog.entries().size(), scenes::builtinScenes().size());
    for (const FileEntry& entry : dialog.entries()) EXPECT_FALSE(entry.meaning.empty()) << entry.name;
    dialog.goTo(folder_.path() / "nothing");
    EXPECT_EQ(fileNamesOf(dialog), FileNames{"../"}) << "who goes there sees it";
    EXPECT_TRUE(FileDialog(Purpose::Save, folder_.path() / "nothing").folder());
}

TEST_F(Files, typedTextNarrowsTheListInAnyCaseAndEnterTakesItsFirst) {
    FileDialog dialog = open();
    dialog.type("m");
    EXPECT_EQ(fileNamesOf(dialog), (FileNames{"maps/", "models/"}));
    dialog.type("a");
    EXPECT_EQ(fileNamesOf(dialog), (FileNames{"A.JSON"}));
    EXPECT_EQ(dialog.accept(), at("A.JSON"));
    dialog.type(".h");
    EXPECT_EQ(fileNamesOf(dialog), (FileNames{".hidden.glb"}));
    dialog.type("models/o");
    EXPECT_EQ(fileNamesOf(dialog), (FileNames{"one.gltf", "other.gltf"}));
    EXPECT_EQ(dialog.accept(), at("models/one.gltf"));
}

TEST_F(Files, arrowsChooseAndEnterGoesIntoFoldersAndUp) {
    FileDialog dialog = open();
    EXPECT_EQ(dialog.accept(), std::nullopt) << "nothing is chosen";
    for (int i = 0; i < 3; ++i) dialog.step(1);
    EXPECT_EQ(dialog.accept(), std::nullopt);
    EXPECT_EQ(dialog.folder(), folder_.path() / "models");
    dialog.step(-1); // from the end
    EXPECT_EQ(dialog.entries()[*dialog.chosen()].name, "other.gltf");
    dialog.step(-100);
    EXPECT_EQ(dialog.accept(), std::nullopt); // ".."
    EXPECT_EQ(dialog.folder(), folder_.path());
    dialog.type("b");
    dialog.step(100);
    EXPECT_EQ(dialog.accept(), at("b.glb"));
    dialog.type("models/");
    dialog.step(1);
    EXPECT_EQ(dialog.accept(), at("models/one.gltf")) << "a typed folder begins below '../'";
}

TEST_F(Files, tabLengthensTheTextAsFarAsNamesAgree) {
    FileDialog dialog = open();
    dialog.type("mo");
    for (const char* longer : {"models/", "models/o", "models/o"}) expectCompleted(dialog, longer);
    dialog.type("models/ot");
    expectCompleted(dialog, "models/other.gltf");
    dialog.type("nothing");
    expectCompleted(dialog, "nothing");
    // Completion keeps letters of several bytes whole.
    for (const char* name : {"x\xc3\xa4.glb", "x\xc3\xb6.glb"}) folder_.write(name, "");
    dialog.type("x");
    expectCompleted(dialog, "x");
}

TEST_F(Files, aPathIsTakenFromTheRootAndFromHome) {
    FileDialog dialog{Purpose::Open, "/"};
    dialog.type(at("b.glb"));
    EXPECT_EQ(dialog.accept(), at("b.glb"));
    dialog.type(at("models"));
    EXPECT_EQ(dialog.accept(), std::nullopt);
    EXPECT_EQ(dialog.folder(), folder_.path() / "models");
    EXPECT_EQ(dialog.text(), "");
    const tessera::test::EnvironmentVariable home("HOME", folder_.path().c_str());
    dialog.type("~/sky.hdr");
    EXPECT_EQ(dialog.accept(), at("sky.hdr"));
    dialog.type("~");
    EXPECT_EQ(dialog.accept(), std::nullopt);
    EXPECT_EQ(dialog.folder(), folder_.path());
}

TEST_F(Files, whatCannotBeOpenedOrReadReportsWhy) {
    FileDialog dialog = open();
    expectFault(dialog, "absent.glb", at("absent.glb") + " is not there");
    expectFault(dialog, "notes.txt", at("notes.txt") + " is no file that can be opened");
    dialog.goTo(folder_.path() / "nowhere");
    EXPECT_EQ(dialog.fault(), at("nowhere") + " cannot be read: No such file or directory");
    EXPECT_EQ(fileNamesOf(dialog), FileNames{"../"}) << "one gets back";
    if (::geteuid() == 0) return; // root may read any folder
    std::filesystem::permissions(folder_.path() / "maps", std::filesystem::perms::none);
    dialog.goTo(folder_.path() / "maps");
    EXPECT_EQ(dialog.fault(), at("maps") + " cannot be read: Permission denied");
    std::filesystem::permissions(folder_.path() / "maps", std::filesystem::perms::owner_all);
}

TEST_F(Files, builtInScenesAreAListOfTheirOwnAndNamesAmongFiles) {
    FileDialog dialog = open();
    dialog.showBuiltin();
    EXPECT_EQ(dialog.folder(), std::nullopt);
    EXPECT_EQ(dialog.entries().size(), scenes::builtinScenes().size());
    dialog.type("sph");
    EXPECT_EQ(dialog.accept(), "spheres");
    dialog.goTo(folder_.path());
    dialog.type("room");
    EXPECT_EQ(dialog.accept(), "room");
}

TEST_F(Files, aNameThatIsThereIsReplacedOnlyWhenSaid) {
    FileDialog dialog = save("new.json");
    EXPECT_EQ(dialog.accept(), at("new.json"));
    dialog.type("picture.png");
    EXPECT_EQ(dialog.accept(), std::nullopt);
    EXPECT_TRUE(dialog.confirmsReplacing());
    EXPECT_EQ(dialog.accept(), std::nullopt) << "Enter twice is no answer";
    EXPECT_EQ(dialog.accept(true), at("picture.png"));
    dialog.type("picture2.png");
    EXPECT_FALSE(dialog.confirmsReplacing());
    expectFault(dialog, "picture.jpg", "A name ends in one of .json, .exr, .png");
    expectFault(dialog, "nowhere/a.png", at("nowhere") + " is no folder");
}

TEST_F(Files, aNameGoesAlongIntoFoldersThatAreChosen) {
    FileDialog dialog = save("new.exr");
    dialog.step(2);
    EXPECT_EQ(dialog.accept(), std::nullopt);
    EXPECT_EQ(dialog.folder(), folder_.path() / "maps");
    EXPECT_EQ(dialog.accept(), at("maps/new.exr"));
    dialog.choose(1); // x.exr, which is there
    EXPECT_EQ(dialog.accept(), std::nullopt);
    EXPECT_EQ(dialog.text(), "x.exr");
    EXPECT_TRUE(dialog.confirmsReplacing());
    EXPECT_EQ(dialog.accept(true), at("maps/x.exr"));
}

TEST_F(Files, namesOfAnyBytesGoThroughTheFieldUnchanged) {
    const std::string smile = "\xf0\x9f\x98\x80.png", lines = "two\nlines.glb", bytes = "\xff\xfe.glb";
    for (const std::string& name : {smile, lines, bytes}) folder_.write(name, "");
    FileDialog dialog = open();
    for (const std::string& name : {lines, bytes}) {
        dialog.type(name.substr(0, 1));
        dialog.complete();
        EXPECT_EQ(dialog.text(), name);
        const std::string held = dialog.inField();
        EXPECT_EQ(held.find('\n'), std::string::npos);
        EXPECT_EQ(held.find('\xff'), std::string::npos);
        dialog.typeInField(held);
        EXPECT_EQ(dialog.accept(), at(name));
    }
    FileDialog saving = save(smile);
    EXPECT_EQ(saving.accept(), std::nullopt);
    saving.typeInField(saving.inField()); // as in each frame
    EXPECT_TRUE(saving.confirmsReplacing());
    EXPECT_EQ(saving.accept(true), at(smile));
}

TEST_F(Files, linksToFoldersAreFoldersAndNothingIsWhatHasGoneSince) {
    std::filesystem::create_directory_symlink(folder_.path() / "models", folder_.path() / "away");
    FileDialog dialog = open();
    EXPECT_EQ(fileNamesOf(dialog)[1], "away/");
    dialog.choose(1);
    std::filesystem::remove(folder_.path() / "away");
    EXPECT_EQ(dialog.accept(), std::nullopt);
    EXPECT_EQ(dialog.fault(), at("away") + " cannot be read: No such file or directory");
    EXPECT_EQ(fileNamesOf(dialog), FileNames{"../"});
}

TEST(RecentFolders, areThoseOfFilesEachOnce) {
    EXPECT_EQ(foldersOf(FileNames{"/a/b.glb", "/c/d.json", "/a/e.obj"}), (FileNames{"/a", "/c"}));
}

TEST(FileTypes, areFoundInAnyCaseAndSayOnceWhatTheyAre) {
    std::set<std::string_view> seen;
    for (const FileType& type : fileTypes()) {
        EXPECT_TRUE(seen.insert(type.extension).second) << type.extension;
        EXPECT_EQ(fileTypeOf("a" + std::string(type.extension)), &type);
        EXPECT_FALSE(type.meaning.empty()) << type.extension;
    }
    EXPECT_EQ(fileTypeOf("A.GLB"), fileTypeOf("a.glb"));
    EXPECT_EQ(fileTypeOf("a.txt"), nullptr);
    EXPECT_EQ(fileTypeOf("glb"), nullptr);
}

TEST(FileTypes, ofFilesDroppedAtOnceTheFirstThatOpensIsTakenAndTheOthersAreReported) {
    const Dropped alone = takeDropped(FileNames{"/a/b.txt"});
    EXPECT_EQ(alone.taken, "/a/b.txt") << "loading reports why not";
    EXPECT_EQ(alone.left, "");
    const Dropped several = takeDropped(FileNames{"/a/b.png", "/c/sky.hdr", "/c/d.json"});
    EXPECT_EQ(several.taken, "/c/sky.hdr");
    EXPECT_EQ(several.left, "Of 3 files dropped at once sky.hdr opens; not b.png, d.json");
    const Dropped many = takeDropped(FileNames{"1.txt", "2.txt", "3.txt", "4.txt", "5.txt", "6.txt"});
    EXPECT_EQ(many.taken, "1.txt");
    EXPECT_EQ(many.left, "Of 6 files dropped at once 1.txt opens; not 2.txt, 3.txt, 4.txt and 2 more");
}

} // namespace
} // namespace tessera::viewer
