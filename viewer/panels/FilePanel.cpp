// The file dialog: the entries of a folder, and the field of a path, which keeps the keyboard.
#include <algorithm>
#include <array>
#include <cfloat>
#include <cstring>
#include <string_view>

#include <fmt/format.h>
#include <imgui.h>

#include "base/OneLine.h"
#include "base/Utf8.h"
#include "viewer/panels/Panels.h"
#include "viewer/panels/Widgets.h"

namespace tessera::viewer {
namespace {

using Purpose = FileDialog::Purpose;

constexpr std::size_t kLongestPath = 4096;            ///< bytes, the limit of Linux
constexpr std::size_t kFieldBytes = 3 * kLongestPath; ///< FieldLetters may triple them
constexpr std::size_t kShownBytes = 200;              ///< of a path or an error: at most three lines of the dialog

/// The end of a long text, which is more specific than the beginning of a path.
std::string endOf(const std::string& text) {
    const std::string line = oneLine(text, text.max_size());
    if (line.size() <= kShownBytes) return line;
    std::size_t begin = line.size() - kShownBytes;
    while (begin < line.size() && letterBytes(std::string_view(line).substr(begin)) == 0) ++begin;
    return "... " + line.substr(begin);
}

/// Handles Up, Down and Tab in the field.
int handleKey(ImGuiInputTextCallbackData* data) {
    FileDialog& dialog = *static_cast<FileDialog*>(data->UserData);
    dialog.typeInField({data->Buf, std::size_t(data->BufTextLen)});
    if (data->EventFlag == ImGuiInputTextFlags_CallbackHistory) {
        dialog.step(data->EventKey == ImGuiKey_UpArrow ? -1 : 1);
    } else {
        dialog.complete();
        const std::string completed = dialog.inField();
        if (completed.size() >= kFieldBytes) return 0;
        data->DeleteChars(0, data->BufTextLen);
        data->InsertChars(0, completed.c_str());
    }
    return 0;
}

/// Closes the dialog with the accepted file, if there is one.
void accept(State& state, bool replaces) {
    const std::optional<std::string> file = state.files->accept(replaces);
    if (!file) return;
    (state.files->purpose() == Purpose::Open ? state.requests.chosen : state.requests.saveAs) = *file;
    state.files.reset();
}

void placeButton(const char* label, const std::optional<std::filesystem::path>& folder, const char* meaning,
                 FileDialog& dialog) {
    ImGui::BeginDisabled(!folder);
    const bool isPressed = ImGui::Button(label);
    ImGui::EndDisabled();
    tip(folder ? fmt::format("{}: {}", meaning, folder->string()) : meaning);
    ImGui::SameLine();
    if (isPressed) dialog.goTo(*folder);
}

/// Buttons for likely folders.
void placeRow(const State& state, FileDialog& dialog) {
    std::optional<std::filesystem::path> above;
    if (dialog.folder() && dialog.folder()->has_relative_path()) above = dialog.folder()->parent_path();
    placeButton("Up", above, "The folder above", dialog);
    placeButton("Home", homeFolder(), "Your own folder", dialog);
    std::error_code error;
    const std::filesystem::path start = std::filesystem::current_path(error);
    placeButton("Start folder", error ? std::nullopt : std::optional(start), "Where the program was started", dialog);
    if (dialog.purpose() == Purpose::Open) {
        if (ImGui::Button("Built-in scenes")) dialog.showBuiltin();
        tip("Scenes that need no file");
        ImGui::SameLine();
    }
    const std::vector<std::string> recent = foldersOf(state.recent);
    ImGui::BeginDisabled(recent.empty());
    ImGui::SetNextItemWidth(-FLT_MIN);
    const bool isOpen = ImGui::BeginCombo("##recent", "Recent folders");
    ImGui::EndDisabled();
    if (!isOpen) return;
    closeOnEscape();
    for (const std::string& folder : recent) {
        ImGui::PushID(folder.c_str());
        if (ImGui::Selectable(labelOf(folder).c_str())) dialog.goTo(folder);
        tip("A folder of a scene that was opened lately");
        ImGui::PopID();
    }
    ImGui::EndCombo();
}

/// The entries: a click chooses, a double click accepts. Returns whether one was accepted.
bool entryRows(FileDialog& dialog, float height) {
    if (!ImGui::BeginChild("list", {0.0f, height}, true)) {
        ImGui::EndChild();
        return false;
    }
    std::optional<std::size_t> clicked;
    bool isAccepted = false;
    const std::span<const FileEntry> entries = dialog.entries();
    ImGuiListClipper clipper; // folders hold thousands of files
    clipper.Begin(int(entries.size()));
    const bool isMoved = dialog.takeMoved();
    if (dialog.chosen() && isMoved)
        clipper.ForceDisplayRangeByIndices(int(*dialog.chosen()), int(*dialog.chosen()) + 1);
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const FileEntry& entry = entries[std::size_t(i)];
            const bool isChosen = dialog.chosen() == std::size_t(i);
            const std::string name = labelOf(entry.name + (entry.isFolder ? "/" : ""));
            ImGui::PushID(i);
            if (ImGui::Selectable(name.c_str(), isChosen, ImGuiSelectableFlags_AllowDoubleClick)) {
                clicked = std::size_t(i);
                isAccepted = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left);
            }
            tip(entry.meaning);
            if (!entry.meaning.empty()) { // as far as it fits
                constexpr float kNameEms = 11.0f;
                ImGui::SameLine(kNameEms * ImGui::GetFontSize());
                ImGui::TextDisabled("%s", entry.meaning.c_str());
            }
            if (isChosen && isMoved) ImGui::SetScrollHereY();
            ImGui::PopID();
        }
    }
    if (entries.empty() && dialog.fault().empty())
        ImGui::TextDisabled("Nothing here that can be %s", dialog.purpose() == Purpose::Open ? "opened" : "replaced");
    ImGui::EndChild();
    if (clicked) dialog.choose(*clicked); // after the rows, which it may replace
    return isAccepted;
}

/// The field of the path. Returns whether Enter was pressed in it.
bool pathField(FileDialog& dialog) {
    std::array<char, kFieldBytes> buffer{};
    const std::string text = dialog.inField();
    std::memcpy(buffer.data(), text.data(), std::min(text.size(), kFieldBytes - 1));
    const bool isFree = ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows) && !ImGui::IsAnyItemActive() &&
                        !ImGui::IsMouseDown(ImGuiMouseButton_Left);
    if (isFree) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-FLT_MIN);
    const ImGuiInputTextFlags flags = ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll |
                                      ImGuiInputTextFlags_CallbackCompletion | ImGuiInputTextFlags_CallbackHistory;
    const char* const hint = dialog.purpose() == Purpose::Open ? "name, path or ~/path; Tab completes, arrows choose"
                                                               : "name or path; Tab completes, arrows choose";
    const bool isEntered =
        ImGui::InputTextWithHint("##path", hint, buffer.data(), buffer.size(), flags, handleKey, &dialog);
    dialog.noteKeyboard(ImGui::IsItemActive());
    dialog.typeInField(buffer.data());
    return isEntered;
}

/// Buttons that open or save the chosen file; replacing an existing file has its own button.
void answerButtons(State& state, bool isEntered) {
    FileDialog& dialog = *state.files;
    const bool confirmsReplacing = dialog.confirmsReplacing();
    const char* const label = dialog.purpose() == Purpose::Open ? "Open (Enter)" : "Save (Enter)";
    bool isAccepted = ImGui::Button(label) || isEntered;
    tip(dialog.purpose() == Purpose::Open ? "Opens the file, or goes into the folder"
                                          : "Saves under this name: .json the scene, .png or .exr the picture");
    bool replaces = confirmsReplacing && isEntered && ImGui::GetIO().KeyCtrl;
    ImGui::SameLine();
    if (confirmsReplacing) {
        if (ImGui::Button("Replace (Ctrl+Enter)")) isAccepted = replaces = true;
        tip("Writes over the file that is there");
        ImGui::SameLine();
    }
    const bool isCancelled = ImGui::Button("Cancel (Esc)");
    tip("Back, and nothing is done");
    if (isCancelled)
        state.files.reset();
    else if (isAccepted)
        accept(state, replaces);
}

} // namespace

void fileDialog(State& state, float scale) {
    constexpr const char* kId = "###files";
    constexpr float kWidth = 640.0f, kHeight = 480.0f;
    const bool isShown = state.files && !state.question;
    const char* const title =
        state.files && state.files->purpose() == Purpose::Save ? "Save as###files" : "Open###files";
    if (isShown && !ImGui::IsPopupOpen(kId)) ImGui::OpenPopup(kId);
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(kWidth * scale, display.x), std::min(kHeight * scale, display.y)});
    const ImGuiWindowFlags flags =
        ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;
    if (state.files && state.question) state.files->leaveKeyboard();
    if (!ImGui::BeginPopupModal(title, nullptr, flags)) {
        if (state.files) state.files->noteKeyboard(false);
        return;
    }
    if (!isShown) {
        ImGui::CloseCurrentPopup();
    } else {
        FileDialog& dialog = *state.files;
        if (!dialog.reason().empty()) errorParagraph(endOf(dialog.reason()));
        placeRow(state, dialog);
        paragraph(dialog.folder() ? endOf(dialog.folder()->string()) : std::string("Built-in scenes"));
        const std::string fault = endOf(dialog.fault());
        const float line = ImGui::GetFrameHeightWithSpacing(), spacing = ImGui::GetStyle().ItemSpacing.y;
        const float faultHeight =
            ImGui::CalcTextSize(fault.c_str(), nullptr, false, ImGui::GetContentRegionAvail().x).y;
        const float below = 2.0f * line + std::max(2.0f * ImGui::GetTextLineHeight(), faultHeight) + 2.0f * spacing;
        const bool isAccepted = entryRows(dialog, std::max(ImGui::GetContentRegionAvail().y - below, 3.0f * line));
        const bool isEntered = pathField(dialog);
        if (!dialog.fault().empty()) errorParagraph(endOf(dialog.fault()));
        answerButtons(state, isEntered || isAccepted);
    }
    ImGui::EndPopup();
}

} // namespace tessera::viewer
