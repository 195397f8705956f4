#pragma once
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

/// What the program's own table of commands and options says, in the form from which the manual page and the shells'
/// completion are made: whatever --help tells they tell too.
namespace tessera::app {

/// What can stand for an option's value or an operand.
struct ValueText {
    std::vector<std::string> names{}; ///< words to offer; empty where there are none, or none that are known beforehand
    bool isFile = false;              ///< or any file
    bool isFolder = false;            ///< or any folder
    bool isList = false;              ///< several of the names, with commas between them
};

/// An option, or an operand, which has no names.
struct OptionText {
    std::vector<std::string> names; ///< "-o", "--output"
    std::string type;               ///< "FILE"; empty: the option takes no value
    std::string help;
    std::string group; ///< its heading in --help
    bool isRepeated = false;
    bool isRequired = false;
    ValueText value;

    bool takesValue() const { return !type.empty(); }
};

struct CommandText {
    std::string name;                ///< empty: the program itself
    std::string help;                ///< a sentence
    std::string usage;               ///< "tessera render SCENE -o FILE [options]"
    std::string footer;              ///< examples: lines that begin with two spaces
    std::vector<OptionText> options; ///< its own, in the order of --help
    std::vector<OptionText> operands;
};

struct ProgramText {
    CommandText program; ///< its options may also stand after a command, but for --version
    std::vector<CommandText> commands;
};

/// The heading of options that CLI11 gives no other.
inline constexpr std::string_view kPlainGroup = "Options";

ProgramText programText(const CLI::App& app);

/// The options that may stand after `command`: its own, and those of the program but for its --help and --version.
std::vector<OptionText> optionsAfter(const ProgramText& text, const CommandText& command);

} // namespace tessera::app
