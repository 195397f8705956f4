// Dialogs of questions and of files, laid out without a window.
#include <algorithm>
#include <filesystem>
#include <string>

#include "tests/support/TempFolder.h"
#include "tests/unit/viewer/ControlledWindow.h"
#include "tests/unit/viewer/PanelTest.h"
#include "viewer/panels/Panels.h"

namespace tessera::viewer {
namespace {

class Dialogs : public test::PanelTest {};

TEST_F(Dialogs, theDialogAboutUnsavedEditsStaysUntilItIsAnswered) {
    State state = test::unusualScene();
    const auto isOpen = [&] {
        show([&] { questionDialog(state, 1.0f); });
        return isPopupOpen();
    };
    EXPECT_FALSE(isOpen());
    state.question = Question{Question::About::Opening, "/scenes/lamps.json"};
    EXPECT_TRUE(isOpen());
    EXPECT_EQ(questionText(*state.question, "room"),
              "room has edits that are not saved. Save them before lamps.json is opened?");
    EXPECT_FALSE(state.requests.answer);
    state.question.reset();
    EXPECT_FALSE(isOpen());
}

TEST_F(Dialogs, theDialogOfFilesTakesTypedTextAndWaitsForAQuestion) {
    const tessera::test::TempFolder folder;
    const std::string file = folder.write("one.glb", "").string();
    State state;
    ImGuiIO& io = ImGui::GetIO();
    io.KeyMap[ImGuiKey_Enter] = test::kEnterKey;
    const auto isOpen = [&] {
        show([&] {
            fileDialog(state, 1.0f);
            questionDialog(state, 1.0f);
        });
        return isPopupOpen();
    };
    EXPECT_FALSE(isOpen());
    state.files.emplace(FileDialog::Purpose::Open, folder.path());
    EXPECT_TRUE(isOpen());
    EXPECT_TRUE(isOpen());
    EXPECT_TRUE(io.WantTextInput) << "the field needs no click first";
    io.AddInputCharacter('o');
    EXPECT_TRUE(isOpen());
    EXPECT_EQ(state.files->text(), "o");
    state.question = Question{};
    EXPECT_TRUE(isOpen());
    EXPECT_FALSE(io.WantTextInput) << "keys are answers";
    state.question.reset();
    EXPECT_TRUE(isOpen());
    EXPECT_TRUE(isOpen());
    io.KeysDown[test::kEnterKey] = true;
    isOpen();
    io.KeysDown[test::kEnterKey] = false;
    EXPECT_FALSE(isOpen());
    EXPECT_FALSE(state.files);
    EXPECT_EQ(state.requests.chosen, file);
}

TEST_F(Dialogs, theDialogOfFilesHearsEveryKeyHoweverFewFramesThereAreBetweenThem) {
    const tessera::test::TempFolder folder;
    const std::string file = folder.write("taken.png", "").string();
    ImGuiIO& io = ImGui::GetIO();
    io.KeyMap[ImGuiKey_Enter] = test::kEnterKey;
    State state;
    InputQueue queue;
    state.files.emplace(FileDialog::Purpose::Save, folder.path(), "taken.png");
    const auto push = [&](int code, bool isDown) {
        InputEvent event = test::key(code);
        event.down = isDown;
        queue.push(event);
    };
    for (const bool withControl : {false, false, true}) { // before the dialog is there
        if (withControl) push(test::kControlKey, true);
        push(test::kEnterKey, true);
        push(test::kEnterKey, false);
        if (withControl) push(test::kControlKey, false);
    }
    int most = 0; // most frames in a row that keys waited
    for (int i = 0, waited = 0; i < 100 && state.files; ++i) {
        waited = state.keysWait() ? waited + 1 : 0;
        most = std::max(most, waited);
        for (const InputEvent& event : queue.takeFrame(state.keysWait())) io.KeysDown[event.code] = event.down;
        io.KeyCtrl = io.KeysDown[test::kControlKey];
        frame([&] { fileDialog(state, 1.0f); });
    }
    EXPECT_FALSE(state.files) << "Enter shows a question, once more is no answer, and Ctrl+Enter replaces";
    EXPECT_EQ(state.requests.saveAs, file);
    EXPECT_GT(most, 1) << "keys before the field listens are not what is tested";
    EXPECT_LT(most, FileDialog::kMostWaits) << "they were let go before it listened";
}

TEST_F(Dialogs, theDialogOfFilesKeepsItsButtonsInViewWhateverItSays) {
    ImGui::GetIO().DisplaySize = {800.0f, 600.0f};
    State state;
    std::filesystem::path folder = "/";
    for (int i = 0; i < 30; ++i) folder /= std::string(100, char('a' + i % 26));
    state.files.emplace(FileDialog::Purpose::Save, folder, "absent/one.png", "the folder before is full");
    const auto overflow = [&] {
        for (int i = 0; i < 4; ++i) frame([&] { fileDialog(state, 1.0f); });
        return ImGui::FindWindowByName("Save as###files")->ScrollMax.y;
    };
    EXPECT_FALSE(state.files->fault().empty());
    EXPECT_EQ(overflow(), 0.0f) << "of a folder that is not there";
    EXPECT_FALSE(state.files->accept());
    EXPECT_EQ(overflow(), 0.0f) << "of a name below one";
    state.files.emplace(FileDialog::Purpose::Save, "/tmp", "one.png");
    EXPECT_EQ(overflow(), 0.0f);
}

TEST_F(Dialogs, keysDoNotWaitForAFieldThatNeverListens) {
    State state;
    EXPECT_FALSE(state.keysWait());
    state.files.emplace(FileDialog::Purpose::Open, "/");
    EXPECT_TRUE(state.keysWait());
    ImGui::GetIO().MouseDown[0] = true; // a button is held all the time
    for (int i = 0; i < FileDialog::kMostWaits; ++i) frame([&] { fileDialog(state, 1.0f); });
    EXPECT_FALSE(state.keysWait());
    state.question = Question{};
    EXPECT_FALSE(state.keysWait()) << "keys are answers";
    frame([&] { fileDialog(state, 1.0f); });
    state.question.reset();
    EXPECT_TRUE(state.keysWait()) << "the dialog is back";
}

} // namespace
} // namespace tessera::viewer
