#include <fmt/format.h>

#include "apps/CommandText.h"
#include "apps/Commands.h"
#include "apps/Completion.h"
#include "apps/Manual.h"
#include "base/Error.h"
#include "base/Names.h"

namespace tessera::app {

namespace {

constexpr ShellInfo kShells[] = {{"bash", bashCompletion}, {"zsh", zshCompletion}};

const ShellInfo& shellNamed(const std::string& name) {
    std::vector<std::string_view> names;
    for (const ShellInfo& shell : shellTable()) {
        if (shell.name == name) return shell;
        names.push_back(shell.name);
    }
    throw InputError(fmt::format("no completion for the shell '{}': {}", name, suggestNames(name, names)));
}

} // namespace

std::span<const ShellInfo> shellTable() {
    return kShells;
}

void addCompletionCommand(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("completion", "Prints a script by which a shell completes command lines");
    auto shell = std::make_shared<std::string>();
    command->add_option("shell", *shell, "bash or zsh")->type_name("SHELL")->required();
    command->footer(R"(Examples
  source <(tessera completion bash)     in ~/.bashrc
  source <(tessera completion zsh)      in ~/.zshrc, behind compinit
The Debian package brings both, and the shells find them.)");
    command->callback([&app, shell, &run] {
        run = [&app, shell] {
            fmt::print("{}", shellNamed(*shell).script(programText(app)));
            return kGood;
        };
    });
}

void addManualCommand(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("manual", "Prints the manual page");
    command->footer(R"(Examples
  tessera manual | man -l -
  tessera manual > tessera.1)");
    command->callback([&app, &run] {
        run = [&app] {
            fmt::print("{}", manualPage(programText(app), TESSERA_VERSION));
            return kGood;
        };
    });
}

} // namespace tessera::app
