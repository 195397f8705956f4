#pragma once
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

/// Commands and options of the program as text. The manual page and the shell completions are generated from it, so
/// they match --help.
namespace tessera::app {

/// Possible values of an option or operand.
struct ValueText {
    std::vector<std::string> names{}; ///< keywords to offer; empty if there are none, or they are not known beforehand
    bool isFile = false;              ///< accepts any file
    bool isFolder = false;            ///< accepts any folder
    bool isList = false;              ///< comma-separated list of names
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
    std::vector<OptionText> options; ///< without the program's, in the order of --help
    std::vector<OptionText> operands;
};

struct ProgramText {
    CommandText program; ///< its options are also accepted after a command, except --version
    std::vector<CommandText> commands;
};

/// CLI11's default heading of options.
inline constexpr std::string_view kPlainGroup = "Options";

ProgramText programText(const CLI::App& app);

/// The options accepted after `command`: its local ones and the program's, except the program's --help and --version.
std::vector<OptionText> optionsAfter(const ProgramText& text, const CommandText& command);

} // namespace tessera::app
