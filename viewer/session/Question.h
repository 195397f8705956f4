#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace tessera::viewer {

enum class Answer : std::uint8_t { Keep, Discard, Cancel };

/// A question about unsaved edits. Nothing is lost until it is answered.
struct Question {
    enum class About : std::uint8_t {
        Quitting,  ///< with unsaved edits
        Opening,   ///< another scene, with unsaved edits
        Recovering ///< edits of a run that ended unexpectedly
    };
    About about = About::Quitting;
    std::string scene;                       ///< to be opened; for Recovering, the recovery file
    std::optional<std::string> variant = {}; ///< for Opening: variant to reload the open scene in; empty: none
    bool operator==(const Question&) const = default;
};

/// An answer in the dialog, and its key.
struct AnswerChoice {
    Answer answer;
    const char* label;
    int key; ///< GLFW_KEY_*
    const char* meaning;
};
std::span<const AnswerChoice> answersTo(Question::About about);

/// The text of the dialog. `edited` is the name of the scene with the edits.
std::string questionText(const Question& question, const std::string& edited);

} // namespace tessera::viewer
