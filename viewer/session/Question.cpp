#include "viewer/session/Question.h"

#include <filesystem>

#include <GLFW/glfw3.h>
#include <fmt/format.h>

namespace tessera::viewer {
namespace {

constexpr AnswerChoice kUnsavedAnswers[] = {
    {Answer::Keep, "Save (S)", GLFW_KEY_S, "Saves the scene with its edits, then goes on"},
    {Answer::Discard, "Discard (D)", GLFW_KEY_D, "Goes on without the edits"},
    {Answer::Cancel, "Cancel (Esc)", GLFW_KEY_ESCAPE, "Stays here, with the edits"},
};
constexpr AnswerChoice kRecoveryAnswers[] = {
    {Answer::Keep, "Recover (R)", GLFW_KEY_R, "Opens the scene with these edits"},
    {Answer::Discard, "Discard (D)", GLFW_KEY_D, "Deletes these edits"},
    {Answer::Cancel, "Later (Esc)", GLFW_KEY_ESCAPE, "Shows this again at the next start"},
};

} // namespace

std::span<const AnswerChoice> answersTo(Question::About about) {
    if (about == Question::About::Recovering) return kRecoveryAnswers;
    return kUnsavedAnswers;
}

std::string questionText(const Question& question, const std::string& edited) {
    const auto nameOf = [](const std::string& source) { return std::filesystem::path(source).filename().string(); };
    switch (question.about) {
    case Question::About::Quitting:
        break;
    case Question::About::Opening:
        return fmt::format("{} has edits that are not saved. Save them before {} is opened?", edited,
                           nameOf(question.scene));
    case Question::About::Recovering:
        return fmt::format("The viewer ended before edits were saved: {}. Recover them?", nameOf(question.scene));
    }
    return fmt::format("{} has edits that are not saved. Save them before the viewer is closed?", edited);
}

} // namespace tessera::viewer
