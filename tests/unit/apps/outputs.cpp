#include "apps/Outputs.h"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/Error.h"
#include "tests/support/ErrorText.h"
#include "tests/support/TempFolder.h"

namespace tessera::app {
namespace {

using tessera::test::TempFolder;

std::string refusal(const auto& action) {
    return test::errorText<std::exception>(action);
}

TEST(Outputs, anInputIsNoOutputInEitherOrder) {
    const TempFolder folder;
    const std::string file = folder.write("a.json", "").string(), link = (folder.path() / "b.json").string();
    std::filesystem::create_symlink("a.json", link);
    const std::string why = ": is read for this, and would be written over; name another file";
    Outputs first({link});
    EXPECT_EQ(refusal([&] { first.reads({file}); }), link + why);
    Outputs second;
    second.reads({file});
    EXPECT_EQ(refusal([&] { second.add(link); }), link + why);
    EXPECT_EQ(refusal([&] { second.addFolder(folder.path().string()); }), file + why);
    Outputs third;
    third.addFolder(folder.path().string());
    EXPECT_EQ(refusal([&] { third.reads({file}); }), file + why);
}

TEST(Outputs, twoOutputsAreNotOneFileUnlessThatIsNone) {
    Outputs outputs({"a.json", "-", "-", "", "", "/dev/null", "/dev/null"});
    EXPECT_EQ(refusal([&] { outputs.add("none/../a.json"); }),
              "none/../a.json: two outputs have this name; give each its own");
}

TEST(Outputs, aFileInALinkedFolderIsTheOneInTheFolderItself) {
    const TempFolder folder;
    const std::string real = (folder.path() / "real/a.json").string(), linked = (folder.path() / "l/a.json").string();
    std::filesystem::create_directory(folder.path() / "real");
    std::filesystem::create_directory_symlink("real", folder.path() / "l");
    Outputs outputs({linked});
    EXPECT_EQ(refusal([&] { outputs.add(real); }), real + ": two outputs have this name; give each its own");
    folder.write("real/a.json", "");
    for (const std::string& name : {linked, real}) EXPECT_EQ(refusal([&] { outputs.at(name); }), "") << name;
}

TEST(Outputs, onlyRegisteredFilesAreWritten) {
    Outputs outputs({"a.json"});
    outputs.addFolder("parts");
    for (const char* registered : {"a.json", "./a.json", "-", "", "/dev/null", "parts/b.json"})
        EXPECT_EQ(refusal([&] { outputs.at(registered); }), "") << registered;
    for (const char* unregistered : {"b.json", "parts", "parts2/b.json"})
        EXPECT_THROW(outputs.at(unregistered), std::logic_error) << unregistered;
}

} // namespace
} // namespace tessera::app
