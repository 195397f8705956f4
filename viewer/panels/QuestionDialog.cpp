#include <filesystem>

#include <imgui.h>

#include "viewer/panels/Panels.h"
#include "viewer/panels/Widgets.h"

namespace tessera::viewer {

void questionDialog(State& state, float scale) {
    constexpr const char* kTitle = "Unsaved edits";
    constexpr float kWidth = 380.0f;
    if (state.question && !ImGui::IsPopupOpen(kTitle)) ImGui::OpenPopup(kTitle);
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({kWidth * scale, 0.0f});
    const ImGuiWindowFlags flags =
        ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;
    if (!ImGui::BeginPopupModal(kTitle, nullptr, flags)) return;
    if (!state.question) {
        ImGui::CloseCurrentPopup();
    } else {
        const std::string edited =
            state.open ? std::filesystem::path(state.open->source()).filename().string() : std::string();
        paragraph(questionText(*state.question, edited));
        ImGui::Spacing();
        for (const AnswerChoice& choice : answersTo(state.question->about)) {
            if (ImGui::Button(choice.label)) state.requests.answer = choice.answer;
            tip(choice.meaning);
            ImGui::SameLine();
        }
        ImGui::NewLine();
    }
    ImGui::EndPopup();
}

} // namespace tessera::viewer
