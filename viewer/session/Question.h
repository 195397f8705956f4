#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace tessera::viewer {

enum class Answer : std::uint8_t { Keep, Discard, Cancel };

/// What the window asks about edits that are not saved. Nothing is lost until it is answered.
struct Question {
    enum class About : std::uint8_t {
        Quitting,  ///< with edits that are not saved
        Opening,   ///< another scene, the same
        Recovering ///< edits of a run that ended without being asked
    };
    About about = About::Quitting;
    std::string scene;                       ///< that is opened by the answer; of Recovering the file of the edits
    std::optional<std::string> variant = {}; ///< of Opening: in which the open scene is read again; empty: in none
    bool operator==(const Question&) const = default;
};

/// An answer as the dialog offers it, and the key that gives it.
struct AnswerChoice {
    Answer answer;
    const char* label;
    int key; ///< GLFW_KEY_*
    const char* meaning;
};
std::span<const AnswerChoice> answersTo(Question::About about);

/// What the dialog asks. `edited` is the name of the scene that has the edits.
std::string questionText(const Question& question, const std::string& edited);

} // namespace tessera::viewer
